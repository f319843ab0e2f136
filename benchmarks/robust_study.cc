// SPDX-License-Identifier: BSD-3-Clause
// What outliers cost and how often clean poses are taken for some: docs/estimator.md has the tables
// that this prints. usage: robust_study [DRAWS]   (500)

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "estimator/calibrate.h"
#include "estimator/outliers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;

constexpr NoiseLevels kNoise = {1e-4, 2e-4};

struct Scene {
  int poses;
  double bad_share;
  bool noise_is_stated;
};

Matrix6d NoiseCovariance() {
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kNoise.position),
      Eigen::Vector3d::Constant(kNoise.orientation);
  return sigma.cwiseAbs2().asDiagonal();
}

Observations Observe(const Scene& scene, const std::vector<Observation>& rows) {
  return scene.noise_is_stated ? testing::KnownNoise(rows, NoiseCovariance())
                               : testing::UnknownNoise(rows);
}

template <typename Rng>
std::vector<Observation> NoisyRows(Rng& rng, const BaseAndTool& truth, int poses) {
  std::vector<Observation> rows = testing::HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, NoiseCovariance(), &rows);
  return rows;
}

// Mean squared errors in units of the covariance of the clean poses' fit, a parameter.
class NormalisedError {
 public:
  void Add(const Vector12d& error, const Matrix12d& covariance) {
    sum_ += error.dot(Vector12d(covariance.llt().solve(error))) / 12.0;
    ++draws_;
  }
  double Root() const { return std::sqrt(sum_ / draws_); }

 private:
  double sum_ = 0.0;
  int draws_ = 0;
};

const char* NoiseText(const Scene& scene) { return scene.noise_is_stated ? "stated" : "estimated"; }

void PrintGross(const Scene& scene, int draws) {
  std::mt19937_64 rng(1);
  const auto bad_count = static_cast<std::size_t>(std::lround(scene.bad_share * scene.poses));
  NormalisedError clean_error, robust_error, plain_error;
  std::size_t missed = 0, wrongly_listed = 0;
  double seconds = 0.0;
  for (int k = 0; k < draws; ++k) {
    const BaseAndTool truth = AnyMounts(rng);
    std::vector<Observation> rows = NoisyRows(rng, truth, scene.poses);
    const auto bad = testing::DrawIndices(rng, bad_count, rows.size());
    std::vector<Observation> clean_rows;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!std::binary_search(bad.begin(), bad.end(), i)) clean_rows.push_back(rows[i]);
    testing::SpoilGrossly(rng, bad, kNoise, &rows);
    const Observations all = Observe(scene, rows);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Outlier> outliers = FindOutliers(all, {}, {}).outliers;
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::size_t right = 0;
    for (const Outlier& o : outliers) right += std::binary_search(bad.begin(), bad.end(), o.index);
    missed += bad.size() - right;
    wrongly_listed += outliers.size() - right;
    const Estimate of_clean = Calibrate(Observe(scene, clean_rows), {}, {});
    clean_error.Add(Difference(of_clean.mounts, truth), of_clean.covariance);
    robust_error.Add(Difference(Calibrate(Without(all, outliers), {}, {}).mounts, truth),
                     of_clean.covariance);
    plain_error.Add(Difference(Calibrate(all, {}, {}).mounts, truth), of_clean.covariance);
  }
  fmt::print("| {} | {:.0f} % | {} | {:.3f} | {:.1f} | {:.1f} % | {:.3f} % | {:.0f} |\n",
             scene.poses,
             100.0 * scene.bad_share,
             NoiseText(scene),
             robust_error.Root() / clean_error.Root(),
             plain_error.Root() / clean_error.Root(),
             100.0 * missed / std::max<std::size_t>(draws * bad_count, 1),
             100.0 * wrongly_listed / (static_cast<double>(draws) * scene.poses),
             1e3 * seconds / draws);
}

void PrintFalseAlarms(const Scene& scene, int draws) {
  fmt::print("| {} | {} |", scene.poses, NoiseText(scene));
  for (const double alpha : {0.1, 0.01}) {
    std::mt19937_64 rng(2);
    int alarms = 0;
    for (int k = 0; k < draws; ++k) {
      const auto rows = NoisyRows(rng, AnyMounts(rng), scene.poses);
      alarms += !FindOutliers(Observe(scene, rows), {}, {alpha}).outliers.empty();
    }
    const double share = static_cast<double>(alarms) / draws;
    fmt::print(" {:.2f} ± {:.2f} % |", 100.0 * share, 100.0 * std::sqrt(share / draws));
  }
  fmt::print("\n");
}

void PrintPower(const Scene& scene, double sigmas, int draws) {
  std::mt19937_64 rng(3);
  int found = 0;
  for (int k = 0; k < draws; ++k) {
    auto rows = NoisyRows(rng, AnyMounts(rng), scene.poses);
    testing::Spoil(rng,
                   k % 2 == 0 ? testing::Spoilt::kPosition : testing::Spoilt::kOrientation,
                   sigmas,
                   kNoise,
                   &rows[0]);
    for (const Outlier& o : FindOutliers(Observe(scene, rows), {}, {}).outliers)
      found += o.index == 0;
  }
  fmt::print("| {} | {} | {} | {:.1f} % |\n",
             scene.poses,
             sigmas,
             NoiseText(scene),
             100.0 * found / draws);
}

void Run(int draws) {
  fmt::print(
      "| poses | bad | noise | error over that of the clean poses alone | the same without a "
      "search "
      "| bad ones not listed | clean ones listed | ms a search |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double share : {0.0, 0.1, 0.3, 0.4})
    for (const bool stated : {true, false}) PrintGross({60, share, stated}, draws);
  for (const bool stated : {true, false}) PrintGross({20, 0.3, stated}, draws);

  fmt::print(
      "\n| poses, all clean | noise | lists some at alpha = 10 % | at alpha = 1 % |\n"
      "| --- | --- | --- | --- |\n");
  for (const int poses : {60, 20, 10})
    for (const bool stated : {true, false}) PrintFalseAlarms({poses, 0.0, stated}, 4 * draws);

  fmt::print("\n| poses | one of them off, sigmas | noise | found |\n| --- | --- | --- | --- |\n");
  for (const double sigmas : {6.0, 8.0, 10.0})
    for (const bool stated : {true, false}) PrintPower({20, 0.0, stated}, sigmas, draws);
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  hexcal::Run(argc > 1 ? std::atoi(argv[1]) : 500);
  return 0;
}
