// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run_main.h"

int main(int argc, char** argv) { return hexcal::RunMain(argc, argv); }
