// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// log10 of the tail of Fisher's F above f. It keeps its digits where the tail is below the
// smallest double: ranking by p needs them.
double Log10FisherTail(double f, double numerator_dof, double denominator_dof);

}  // namespace hexcal
