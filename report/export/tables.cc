// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <map>

#include "config/input_error.h"
#include "report/export/writers.h"

namespace hexcal {
namespace {

std::string TumRow(std::size_t number, const Pose3d& pose) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format(
      "{} {} {} {} {} {} {} {}\n", number, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

// The x with Minus(measured, x) = residual.
Pose3d Predicted(const Pose3d& measured, const Vector6d& residual) {
  const Eigen::Vector3d turn = residual.tail<3>();
  const Eigen::Quaterniond rotation = (measured.rotation * Exp<double>(-turn)).normalized();
  return {measured.translation - rotation * residual.head<3>(), rotation};
}

}  // namespace

ExportedFiles WriteTum(const ExportInput& input) {
  std::map<std::string_view, const Observation*> by_label;
  for (const Observation& item : input.observations->items) by_label[item.label] = &item;
  const std::string head = fmt::format("# {}: {}, ", kExportMark, input.calibration.dataset);
  std::string measured = head + "tool in world, measured; number of the pose, m, q x y z w\n";
  std::string predicted = head + "tool in world, predicted; number of the pose, m, q x y z w\n";
  for (std::size_t i = 0; i < input.calibration.poses.size(); ++i) {
    const CalibratedPose& pose = input.calibration.poses[i];
    const auto found = by_label.find(pose.label);
    if (found == by_label.end())
      throw InputError(FileLocation(input.calibration.path),
                       fmt::format("the pose '{}', which the dataset has not measured", pose.label),
                       "the result of this dataset");
    const Pose3d& seen = found->second->world_from_tool;
    measured += TumRow(i, seen);
    predicted += TumRow(i, Predicted(seen, pose.residual));
  }
  return {{"measured.tum", measured}, {"predicted.tum", predicted}};
}

ExportedFiles WriteResiduals(const ExportInput& input) {
  std::string text = fmt::format(
      "# {}: {}, measured minus predicted in the frame of the tool, m and rad\n"
      "pose,weight,dx,dy,dz,rx,ry,rz\n",
      kExportMark,
      input.calibration.dataset);
  for (const CalibratedPose& pose : input.calibration.poses) {
    text += fmt::format("{},{}", pose.label, pose.weight);
    for (const double value : pose.residual) text += fmt::format(",{}", value);
    text += '\n';
  }
  return {{"residuals.csv", text}};
}

}  // namespace hexcal
