// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/start.h"

#include <cmath>
#include <limits>

#include "estimator/closed_form.h"
#include "estimator/pose_fit.h"
#include "estimator/rms.h"

namespace hexcal {
namespace {

using Rows = std::vector<Observation>;

// Of the squared spread: what starts in the right basin leaves less, but for very noisy data.
constexpr double kGoodMisfit = 1e-2;
constexpr std::size_t kSearchPoses = 60;
constexpr int kSearchIterations = 50;
constexpr double kSearchTolerance = 1e-9;

// The best of what it was offered.
struct Best {
  const Rows& rows;
  BaseAndTool mounts;
  double misfit = std::numeric_limits<double>::infinity();

  void Offer(const BaseAndTool& candidate) {
    const double of_candidate = MisfitOf(rows, candidate).Total();
    if (of_candidate < misfit) misfit = of_candidate, mounts = candidate;
  }
};

// The 24 rotations of a cube onto itself: no rotation is further than 63 degrees from one of them.
std::vector<Eigen::Matrix3d> CubeRotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (const double sign_x : {1.0, -1.0})
        for (const double sign_y : {1.0, -1.0}) {
          if (x == y) continue;
          Eigen::Matrix3d m;
          m.col(0) = sign_x * Eigen::Vector3d::Unit(x);
          m.col(1) = sign_y * Eigen::Vector3d::Unit(y);
          m.col(2) = m.col(0).cross(m.col(1));
          rotations.push_back(m);
        }
  return rotations;
}

}  // namespace

std::vector<Observation> EvenSample(const Rows& rows, std::size_t at_most) {
  if (rows.size() <= at_most) return rows;
  Rows few;
  few.reserve(at_most);
  for (std::size_t k = 0; k < at_most; ++k) few.push_back(rows[k * rows.size() / at_most]);
  return few;
}

Misfit MisfitOf(const Rows& rows, const BaseAndTool& mounts) {
  const NoiseLevels spread = Spread(rows);
  RmsError rms;
  for (const Observation& o : rows)
    rms.Add(PoseError(mounts, o.base_from_platform, o.world_from_tool));
  return {std::pow(rms.Position() / spread.position, 2),
          std::pow(rms.Orientation() / spread.orientation, 2)};
}

BaseAndTool FindStart(const Rows& rows) {
  Best best{rows, {}};
  for (const ClosedForm method :
       {ClosedForm::kShah, ClosedForm::kParkMartin, ClosedForm::kPositions}) {
    best.Offer(SolveClosedForm(method, rows));
    if (best.misfit < kGoodMisfit) return best.mounts;
  }

  const Rows few = EvenSample(rows, kSearchPoses);
  const NoiseLevels spread = Spread(few);
  const PoseWeights weights = PoseWeights::Isotropic(spread.position, spread.orientation);
  PoseBatch batch;
  for (const Observation& o : few) batch.Add(o.base_from_platform, o.world_from_tool);
  PoseFitOptions options;
  options.method = PoseFitOptions::Method::kTiny;
  options.nonlinear.max_iterations = kSearchIterations;
  options.nonlinear.tolerance = kSearchTolerance;
  const Eigen::Matrix3d base = best.mounts.world_from_base.rotation.toRotationMatrix();
  for (const Eigen::Matrix3d& turn : CubeRotations())
    best.Offer(FitPoses(batch, &weights, CompleteBase(few, base * turn), options).solution.mounts);
  return best.mounts;
}

}  // namespace hexcal
