// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "config/yaml_number.h"
#include "geometry/pose.h"
#include "report/export/writers.h"

namespace hexcal {
namespace {

// Of the inverse pose: x^-1 moves by -Ad of x's own motion, in (translation, rotation) uncoupled.
Matrix6d InverseCovariance(const Pose3d& pose, const Matrix6d& covariance) {
  // x [+] d inverted: rotation Exp(-r) R', translation -Exp(-r) R' (t + R d), to first order
  // x^-1 [+] d' with d' = [R (-d - [R' t]x r), -R r] in the axes of x^-1's right side.
  const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
  const Eigen::Vector3d t_in_child = R.transpose() * pose.translation;
  Matrix6d by_motion = Matrix6d::Zero();
  by_motion.topLeftCorner<3, 3>() = -R;
  by_motion.topRightCorner<3, 3>() = -R * Skew<double>(t_in_child);
  by_motion.bottomRightCorner<3, 3>() = -R;
  return by_motion * covariance * by_motion.transpose();
}

std::string File(const ExportInput& input, bool is_tool) {
  const Calibration& found = input.calibration;
  CalibratedMount mount = is_tool ? found.tool : found.base;
  if (!is_tool) {
    if (mount.covariance)
      mount.covariance = InverseCovariance(mount.parent_from_child, *mount.covariance);
    mount.parent_from_child = mount.parent_from_child.Inverse();
  }
  const Eigen::Vector3d& t = mount.parent_from_child.translation;
  const Eigen::Quaterniond& q = mount.parent_from_child.rotation;
  std::string text = fmt::format(
      "# {}: {}, {}, m\n"
      "parameters:\n  eye_on_hand: {}\n  freehand_robot_movement: true\n"
      "  move_group: manipulator\n  move_group_namespace: /\n  namespace: /hexcal/\n"
      "  robot_base_frame: {}\n  robot_effector_frame: {}\n"
      "  tracking_base_frame: {}\n  tracking_marker_frame: {}\n"
      "transformation:\n  x: {}\n  y: {}\n  z: {}\n  qx: {}\n  qy: {}\n  qz: {}\n  qw: {}\n",
      kExportMark,
      found.dataset,
      is_tool ? "robot_effector_frame from tracking_base_frame"
              : "robot_base_frame from tracking_base_frame",
      is_tool,
      input.frames.base,
      input.frames.platform,
      is_tool ? input.frames.tool : input.frames.world,
      is_tool ? input.frames.world : input.frames.tool,
      YamlNumber(t.x()),
      YamlNumber(t.y()),
      YamlNumber(t.z()),
      YamlNumber(q.x()),
      YamlNumber(q.y()),
      YamlNumber(q.z()),
      YamlNumber(q.w()));
  if (!mount.covariance) return text;
  const Matrix6d covariance = CovarianceInParent(mount);
  text += "covariance:  # x y z and turns about the parent's x y z, by rows, m and rad\n";
  for (int i = 0; i < 6; ++i)  // symmetric: a column is a row
    text += fmt::format("  - {}\n", YamlNumbers(covariance.col(i).data(), 6));
  return text;
}

}  // namespace

ExportedFiles WriteEasyHandeye(const ExportInput& input) {
  return {{"base_easy_handeye.yaml", File(input, false)},
          {"tool_easy_handeye.yaml", File(input, true)}};
}

}  // namespace hexcal
