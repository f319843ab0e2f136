// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "batch/run_chunks.h"

namespace hexcal {

// The share of this process among several: by --task=K/N, else as a rank under mpirun (Open MPI's,
// MPICH's or MVAPICH's variables, no library). Nothing: it works alone. UsageError for what is no
// share.
struct ShareOfRun {
  Share share;
  bool is_rank = false;  // whose engine waits for the others, so that the last can merge
};
std::optional<ShareOfRun> ShareOfThisProcess(const std::string& task_flag);

}  // namespace hexcal
