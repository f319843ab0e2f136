// SPDX-License-Identifier: BSD-3-Clause
// Random calibrations, each certified or looked at from many starts: docs/estimator.md has the
// table that this prints. usage: certificate_study [PROBLEMS]   (10000)

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "estimator/calibrate.h"
#include "estimator/certificate.h"
#include "estimator/chordal_optimum.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;

constexpr int kStarts = 100;
// Of each line, problems that are looked at from many starts although they are certified.
constexpr int kCrossChecked = 20;
// What is left over in the paper's Table V, a coordinate.
constexpr double kPosition = 7.08e-5 / 1.7320508;     // m
constexpr double kOrientation = 5.83e-4 / 1.7320508;  // rad

struct Scene {
  const char* name;
  int poses;
  bool arm;        // poses anywhere in place of a hexapod's
  double noise;    // times the paper's
  Vector6d shape;  // of the noise along the six axes
};

Vector6d Shape(double x, double y, double z) {
  Vector6d shape;
  shape << x, y, z, x, y, z;
  return shape;
}

Observations Draw(const Scene& scene, std::mt19937_64& rng) {
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, scene.poses);
  if (scene.arm)
    for (Observation& o : rows) {
      o.base_from_platform = testing::RandomPose(rng, 1.0);
      o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    }
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kPosition), Eigen::Vector3d::Constant(kOrientation);
  sigma = scene.noise * sigma.cwiseProduct(scene.shape);
  const Matrix6d covariance = sigma.cwiseAbs2().asDiagonal();
  testing::AddNoise(rng, covariance, &rows);
  return testing::KnownNoise(rows, covariance);
}

// The smallest chi-square that the calibration finds from starts all around.
double BestOfManyStarts(const Observations& observations, std::mt19937_64& rng) {
  CalibrateOptions options;
  options.start = Start::kInitial;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kStarts; ++k)
    best = std::min(best, Calibrate(observations, AnyMounts(rng), options).chi_square);
  return best;
}

void Study(const Scene& scene, int problems) {
  std::mt19937_64 rng(1);
  int certified = 0, at_best_found = 0, missed = 0, wrong = 0;
  double smallest = std::numeric_limits<double>::infinity(), gap = 0.0, distance = 0.0;
  double seconds = 0.0;
  for (int i = 0; i < problems; ++i) {
    const Observations observations = Draw(scene, rng);
    const Estimate estimate = Calibrate(observations, {}, {});
    const auto before = std::chrono::steady_clock::now();
    const Certificate c = Certify(observations, {}, estimate);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    smallest = std::min(smallest, c.smallest_eigenvalue);
    gap = std::max(gap, c.gap);
    distance = std::max(distance, c.distance);
    certified += c.certified;
    if (c.certified && i >= kCrossChecked) continue;
    const bool is_best = estimate.chi_square <= BestOfManyStarts(observations, rng) * (1.0 + 1e-6);
    wrong += c.certified && !is_best;
    at_best_found += !c.certified && is_best;
    missed += !c.certified && !is_best;
  }
  fmt::print("| {} | {} | {:g} | {} | {} | {} | {} | {:.2g} | {:.1e} | {:.2g} | {:.0f} |\n",
             scene.name,
             scene.poses,
             scene.noise,
             certified,
             at_best_found,
             missed,
             wrong,
             smallest,
             gap,
             distance,
             1e6 * seconds / problems);
}

// How often a descent from anywhere ends in a worse minimum, and how many of these are certified.
void StudyWorseMinima(const Scene& scene, int problems) {
  std::mt19937_64 rng(2);
  int worse = 0, certified = 0;
  for (int i = 0; i < problems; ++i) {
    const Observations observations = Draw(scene, rng);
    ChordalCost cost;
    for (const Observation& o : observations.items)
      cost.Add(o, 1.0 / o.tool_covariance(0, 0), 1.0 / o.tool_covariance(3, 3));
    const double best = FindChordalOptimum(cost, Calibrate(observations, {}, {}).mounts).cost;
    const ChordalOptimum other = FindChordalOptimum(cost, AnyMounts(rng));
    if (other.cost <= best * (1.0 + 1e-6)) continue;
    ++worse;
    certified += other.is_best;
  }
  fmt::print("\n{}, {} poses: of {} descents from any start {} end worse, {} of them certified\n",
             scene.name,
             scene.poses,
             problems,
             worse,
             certified);
}

int Run(int problems) {
  const Vector6d equal = Shape(1, 1, 1), tracker = Shape(1, 1, 3);
  const Scene scenes[] = {{"hexapod, equal noise", 60, false, 1.0, equal},
                          {"hexapod, equal noise", 10, false, 1.0, equal},
                          {"hexapod, equal noise", 60, false, 100.0, equal},
                          {"hexapod, noise 1:1:3", 60, false, 1.0, tracker},
                          {"hexapod, noise 1:1:3", 10, false, 1.0, tracker},
                          {"arm, equal noise", 60, true, 1.0, equal},
                          {"arm, noise 1:1:3", 60, true, 1.0, tracker},
                          {"hexapod, equal noise", 60, false, 1000.0, equal}};
  fmt::print("{} problems a line, base and tool at any rotation; noise in units of Table V's\n\n",
             problems);
  fmt::print(
      "| problem | poses | noise | certified | not, but best of {} starts | missed | wrongly "
      "certified of {} "
      "looked at | smallest "
      "eigenvalue | largest gap | largest distance, sigmas | µs a certificate |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      kStarts,
      kCrossChecked);
  for (const Scene& scene : scenes) Study(scene, problems);
  StudyWorseMinima(scenes[0], problems);
  StudyWorseMinima(scenes[5], problems);
  return 0;
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) { return hexcal::Run(argc > 1 ? std::atoi(argv[1]) : 10000); }
