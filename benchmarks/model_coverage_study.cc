// SPDX-License-Identifier: BSD-3-Clause
// How often the true point lies within the length that an audit of a machine with effects states
// with 95 %: the table of docs/audit.md. Whole measurements are drawn, and fitted jointly from a
// model whose effects are half of what they are.
//   model_coverage_study [DRAWS]     (1000 of each)
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <random>

#include "testing/model_scene.h"

namespace hexcal {
namespace {

struct Case {
  std::vector<std::string> effects;
  int poses;
};

// Wilson's interval of a share, 95 %.
std::string IntervalOf(double share, double n) {
  constexpr double kZ = 1.959963984540054;
  const double middle = (share + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half =
      kZ * std::sqrt(share * (1 - share) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  return fmt::format(
      "{:.1f} [{:.1f}, {:.1f}]", 100 * share, 100 * (middle - half), 100 * (middle + half));
}

std::string CoverageOf(const testing::ModelScene& scene, int draws, bool is_stated) {
  int inside = 0;
  for (int k = 0; k < draws; ++k) {
    const auto made = testing::CalibrateModel(scene, 1000 + k, is_stated);
    inside += testing::IsWithinLength(scene, *made);
  }
  return IntervalOf(static_cast<double>(inside) / draws, draws);
}

void PrintAll(int draws) {
  const std::vector<Case> cases = {{{"leg_gain"}, 16},
                                   {{"leg_backlash"}, 16},
                                   {{"tool_thermal"}, 16},
                                   {{"tracker_scale"}, 16},
                                   {{"base_drift"}, 24},
                                   {{"base_joint_offset"}, 24},
                                   {{"leg_gain", "tracker_scale"}, 24}};
  fmt::print("{:<24}{:>6}{:>22}{:>22}\n", "effects", "poses", "noise stated, %", "estimated, %");
  std::mt19937_64 rng(1);
  for (const Case& one : cases) {
    const testing::ModelScene scene = testing::MakeModelScene(rng, one.effects, one.poses);
    std::string name;
    for (const std::string& effect : one.effects) name += (name.empty() ? "" : ", ") + effect;
    fmt::print("{:<24}{:>6}{:>22}", name, one.poses, CoverageOf(scene, draws, true));
    std::fflush(stdout);
    fmt::print("{:>22}\n", CoverageOf(scene, draws, false));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  int draws = 1000;
  if (argc > 1) std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), draws);
  hexcal::PrintAll(std::max(draws, 1));
}
