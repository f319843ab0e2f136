// SPDX-License-Identifier: BSD-3-Clause
#include "report/point_validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace hexcal {
namespace {

using Repeated = PointValidation::Repeated;
using Numbers = std::array<double, 7>;

Numbers NumbersOf(const Pose3d& pose) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()};
}

void AddVisits(const std::vector<Eigen::Vector3d>& errors, Repeated* worst) {
  const auto n = static_cast<double>(errors.size());
  Eigen::Vector3d barycentre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& error : errors) barycentre += error / n;
  double mean = 0.0, squares = 0.0;
  for (const Eigen::Vector3d& error : errors) mean += (error - barycentre).norm() / n;
  for (const Eigen::Vector3d& error : errors)
    squares += std::pow((error - barycentre).norm() - mean, 2) / (n - 1.0);
  const int visits = static_cast<int>(errors.size());
  worst->fewest = worst->poses == 0 ? visits : std::min(worst->fewest, visits);
  ++worst->poses;
  worst->accuracy = std::max(worst->accuracy, barycentre.norm());
  worst->repeatability = std::max(worst->repeatability, mean + 3.0 * std::sqrt(squares));
}

}  // namespace

PointValidation ValidatePoint(const std::vector<PoseCheck>& checks,
                              const Observations& observations,
                              const BaseAndTool& mounts,
                              const Eigen::Vector3d& p_in_tool) {
  std::map<std::string, const Observation*> of_label;
  for (const Observation& o : observations.items) of_label[o.label] = &o;
  PointValidation result;
  std::vector<Eigen::Vector3d> errors;
  std::map<Numbers, std::vector<Eigen::Vector3d>> visits;
  for (const PoseCheck& check : checks) {
    const Observation& o = *of_label.at(check.label);
    const Eigen::Vector3d in_tool =
        check.held_out.head<3>() + check.held_out.tail<3>().cross(p_in_tool);
    errors.emplace_back(o.world_from_tool.rotation * in_tool);
    const Pose3d predicted =
        mounts.world_from_base * o.base_from_platform * mounts.platform_from_tool;
    visits[NumbersOf(o.base_from_platform)].emplace_back(o.world_from_tool * p_in_tool -
                                                         predicted * p_in_tool);
  }
  result.poses = static_cast<int>(errors.size());
  const auto n = static_cast<double>(std::max(result.poses, 1));
  for (const Eigen::Vector3d& error : errors) result.bias += error / n;
  double squares = 0.0;
  for (const Eigen::Vector3d& error : errors) {
    result.precision += (error - result.bias).cwiseAbs2() / std::max(n - 1.0, 1.0);
    squares += error.squaredNorm() / n;
  }
  result.precision = result.precision.cwiseSqrt().eval();
  result.rms = std::sqrt(squares);
  Repeated worst;
  for (const auto& [pose, of_pose] : visits)
    if (of_pose.size() > 1) AddVisits(of_pose, &worst);
  if (worst.poses > 0) result.repeated = worst;
  return result;
}

std::vector<PoseCheck> UsedOf(const std::vector<PoseCheck>& checks, const Estimate& estimate) {
  std::set<std::string> left_out;
  for (const PoseResult& pose : estimate.poses)
    if (!(pose.weight > 0.0)) left_out.insert(pose.label);
  std::vector<PoseCheck> used;
  for (const PoseCheck& check : checks)
    if (left_out.count(check.label) == 0) used.push_back(check);
  return used;
}

}  // namespace hexcal
