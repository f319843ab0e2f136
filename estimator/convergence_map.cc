// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/convergence_map.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <random>

#include "config/units.h"

namespace hexcal {
namespace {

constexpr double kDegrees[] = {0, 5, 10, 20, 30, 45, 60, 90, 120, 150, 180};
// Of the size of the poses' travel.
constexpr double kTravels[] = {0, 1, 10, 100};
constexpr std::size_t kMostPoses = 60;
// Iterations after which what still moves has no limit.
constexpr int kLimitIterations = 200;
constexpr double kArrivedSigmas = 0.1;
// Nearer than this, rad and travels, is arrived however small the noise.
constexpr double kArrived = 1e-7;
// An update below this, m and rad, ends an iteration early.
constexpr double kStill = 1e-9;

Eigen::Vector3d Direction(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Eigen::Vector3d v;
  for (double& value : v) value = normal(rng);
  return v.normalized();
}

Pose3d Off(const Pose3d& pose, double rotation, double translation, std::mt19937_64& rng) {
  Vector6d d;
  d.head<3>() = translation * Direction(rng);
  d.tail<3>() = rotation * Direction(rng);
  return Plus(pose, d);
}

class Mapper {
 public:
  Mapper(const std::vector<Observation>& observations,
         const std::vector<Matrix6d>& whiteners,
         const Estimate& solution,
         const LinearizedOptions& linearized,
         const ConvergenceMapOptions& options)
      : solution_(solution), linearized_(linearized), options_(options) {
    const std::size_t n = observations.size(), kept = std::min(n, kMostPoses);
    for (std::size_t k = 0; k < kept; ++k) {
      rows_.push_back(observations[k * n / kept]);
      if (!whiteners.empty()) whiteners_.push_back(whiteners[k * n / kept]);
    }
    travel_ = Spread(rows_).position;
    linearized_.tolerance = kStill;
  }

  ConvergenceMap Run() {
    ConvergenceMap map;
    for (const double degrees : kDegrees) map.rotation_errors.push_back(degrees * kPi / 180.0);
    for (const double travels : kTravels) map.translation_errors.push_back(travels * travel_);
    FindLimit();
    map.has_limit = has_limit_;
    std::deque<std::future<double>> running;
    const std::size_t columns = map.translation_errors.size();
    const std::size_t cells = map.rotation_errors.size() * columns;
    std::size_t next = 0;
    for (std::size_t done = 0; done < cells; ++done) {
      for (;
           next < cells && running.size() < static_cast<std::size_t>(std::max(options_.threads, 1));
           ++next)
        running.push_back(std::async(std::launch::async, [this, &map, columns, next] {
          return Share(
              map.rotation_errors[next / columns], map.translation_errors[next % columns], next);
        }));
      if (done % columns == 0) map.share.emplace_back();
      map.share.back().push_back(running.front().get());
      running.pop_front();
      if (options_.progress)
        options_.progress(static_cast<long>(done + 1), static_cast<long>(cells));
    }
    return map;
  }

 private:
  // Where the iteration leads from the solution, if it leads anywhere near.
  void FindLimit() {
    LinearizedOptions options = linearized_;
    options.max_iterations = kLimitIterations;
    const Solution limit = SolveLinearized(rows_, whiteners_, solution_.mounts, options);
    limit_ = limit.mounts;
    const double turn = std::max(
        Minus(limit_.world_from_base, solution_.mounts.world_from_base).tail<3>().norm(),
        Minus(limit_.platform_from_tool, solution_.mounts.platform_from_tool).tail<3>().norm());
    has_limit_ = limit.converged && turn < 0.1;
  }

  // Of the starts of one cell.
  double Share(double rotation, double translation, std::size_t cell) const {
    if (!has_limit_) return 0.0;
    std::seed_seq words{
        options_.seed & 0xffffffffU, options_.seed >> 32, static_cast<std::uint64_t>(cell)};
    std::mt19937_64 rng(words);
    int arrived = 0;
    for (int k = 0; k < options_.starts; ++k) {
      BaseAndTool start;
      start.world_from_base = Off(solution_.mounts.world_from_base, rotation, translation, rng);
      start.platform_from_tool =
          Off(solution_.mounts.platform_from_tool, rotation, translation, rng);
      arrived += HasArrived(SolveLinearized(rows_, whiteners_, start, linearized_).mounts);
    }
    return static_cast<double>(arrived) / options_.starts;
  }

  bool HasArrived(const BaseAndTool& mounts) const {
    Vector12d difference;
    difference << Minus(mounts.world_from_base, limit_.world_from_base),
        Minus(mounts.platform_from_tool, limit_.platform_from_tool);
    for (int i = 0; i < 12; ++i) {
      if (!solution_.observability.determined[i]) continue;
      const double sigma = std::sqrt(solution_.covariance(i, i));
      const double unit = kParameters[i].is_angle ? 1.0 : travel_;
      if (!(std::abs(difference[i]) <= std::max(kArrivedSigmas * sigma, kArrived * unit)))
        return false;
    }
    return true;
  }

  const Estimate& solution_;
  LinearizedOptions linearized_;
  const ConvergenceMapOptions& options_;
  std::vector<Observation> rows_;
  std::vector<Matrix6d> whiteners_;
  double travel_ = 1.0;
  BaseAndTool limit_;
  bool has_limit_ = false;
};

}  // namespace

ConvergenceMap MapConvergence(const std::vector<Observation>& observations,
                              const std::vector<Matrix6d>& whiteners,
                              const Estimate& solution,
                              const LinearizedOptions& linearized,
                              const ConvergenceMapOptions& options) {
  return Mapper(observations, whiteners, solution, linearized, options).Run();
}

}  // namespace hexcal
