// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace hexcal {

// Most bytes that were allocated at one time while work ran, above those before it. Counts every
// malloc of the program (operator new, Eigen, OpenCV), by all threads; glibc only. Linking this
// replaces malloc.
std::size_t PeakMemory(const std::function<void()>& work);

}  // namespace hexcal
