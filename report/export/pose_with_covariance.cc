// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "config/input_error.h"
#include "config/yaml_number.h"
#include "report/export/writers.h"

namespace hexcal {
namespace {

std::string Message(const ExportInput& input, bool is_tool) {
  const Calibration& found = input.calibration;
  const CalibratedMount& mount = is_tool ? found.tool : found.base;
  if (!mount.covariance)
    throw InputError(FileLocation(found.path),
                     fmt::format("no whole covariance of the {}: the data do not determine it",
                                 is_tool ? "tool" : "base"),
                     "one, for pose_with_covariance");
  const Eigen::Vector3d& t = mount.parent_from_child.translation;
  const Eigen::Quaterniond& q = mount.parent_from_child.rotation;
  std::string text = fmt::format(
      "# {}: {}, geometry_msgs/PoseWithCovarianceStamped of {} in {}; m, rad, by rows: x y z and "
      "turns about fixed axes\n"
      "header:\n  frame_id: {}\n"
      "pose:\n  pose:\n    position: {{x: {}, y: {}, z: {}}}\n"
      "    orientation: {{x: {}, y: {}, z: {}, w: {}}}\n  covariance: ",
      kExportMark,
      found.dataset,
      is_tool ? input.frames.tool : input.frames.base,
      is_tool ? input.frames.platform : input.frames.world,
      is_tool ? input.frames.platform : input.frames.world,
      YamlNumber(t.x()),
      YamlNumber(t.y()),
      YamlNumber(t.z()),
      YamlNumber(q.x()),
      YamlNumber(q.y()),
      YamlNumber(q.z()),
      YamlNumber(q.w()));
  const Matrix6d covariance = CovarianceInParent(mount);
  // Symmetric: by columns as by rows.
  return text + YamlNumbers(covariance.data(), 36) + "\n";
}

}  // namespace

Matrix6d CovarianceInParent(const CalibratedMount& mount) {
  const Eigen::Matrix3d R = mount.parent_from_child.rotation.toRotationMatrix();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = R;
  turn.bottomRightCorner<3, 3>() = R;
  return turn * *mount.covariance * turn.transpose();
}

ExportedFiles WritePoseWithCovariance(const ExportInput& input) {
  return {{"base_pose_with_covariance.yaml", Message(input, false)},
          {"tool_pose_with_covariance.yaml", Message(input, true)}};
}

}  // namespace hexcal
