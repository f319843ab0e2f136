// SPDX-License-Identifier: BSD-3-Clause
#include "methods.h"

namespace hexcal {

std::vector<Method> OpenCv() { return {}; }

}  // namespace hexcal
