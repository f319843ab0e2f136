// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_share.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <utility>

#include "apps/usage_error.h"
#include "config/number.h"

namespace hexcal {
namespace {

constexpr long kMostShares = 1'000'000;

// Which of how many a process is, as mpirun tells it.
constexpr std::array<std::pair<const char*, const char*>, 3> kRankVariables = {
    {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
     {"PMI_RANK", "PMI_SIZE"},
     {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"}}};

Share ShareFrom(std::string_view number, std::string_view count, long first, const char* what) {
  const std::optional<long> k = ParseInteger(number), n = ParseInteger(count);
  if (!k || !n || *n < 1 || *n > kMostShares || *k < first || *k >= first + *n)
    throw UsageError(fmt::format("batch: {}: found '{}' of '{}', expected whole numbers {}",
                                 what,
                                 number,
                                 count,
                                 first == 1 ? "K/N, K from 1 to N" : "from 0 to the size less 1"));
  return {static_cast<int>(*k - first), static_cast<int>(*n)};
}

}  // namespace

std::optional<ShareOfRun> ShareOfThisProcess(const std::string& task_flag) {
  if (!task_flag.empty()) {
    const std::size_t slash = task_flag.find('/');
    const std::string_view flag = task_flag;
    const bool has_slash = slash != std::string::npos;
    return ShareOfRun{ShareFrom(flag.substr(0, slash),
                                has_slash ? flag.substr(slash + 1) : std::string_view(),
                                1,
                                "--task"),
                      false};
  }
  for (const auto& [rank, size] : kRankVariables) {
    const char* const rank_text = std::getenv(rank);
    const char* const size_text = std::getenv(size);
    if (rank_text == nullptr || size_text == nullptr) continue;
    const Share share = ShareFrom(rank_text, size_text, 0, rank);
    if (share.count == 1) return std::nullopt;
    return ShareOfRun{share, true};
  }
  return std::nullopt;
}

}  // namespace hexcal
