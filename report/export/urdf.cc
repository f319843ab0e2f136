// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "geometry/rotation_angles.h"
#include "report/export/writers.h"

namespace hexcal {
namespace {

std::string Joint(const Pose3d& pose, const std::string& parent, const std::string& child) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Vector3d rpy = FixedAxisAngles(pose.rotation);
  return fmt::format(
      "<joint name=\"{0}_to_{1}\" type=\"fixed\">\n"
      "  <parent link=\"{0}\"/>\n"
      "  <child link=\"{1}\"/>\n"
      "  <origin xyz=\"{2} {3} {4}\" rpy=\"{5} {6} {7}\"/>\n"
      "</joint>\n",
      parent,
      child,
      t.x(),
      t.y(),
      t.z(),
      rpy[0],
      rpy[1],
      rpy[2]);
}

}  // namespace

Eigen::Vector3d FixedAxisAngles(const Eigen::Quaterniond& rotation) {
  // The transpose of Rz(y) Ry(p) Rx(r) is Rx(-r) Ry(-p) Rz(-y).
  return -AnglesFromRotation(rotation.conjugate().toRotationMatrix());
}

ExportedFiles WriteUrdf(const ExportInput& input) {
  const Calibration& found = input.calibration;
  const FrameNames& names = input.frames;
  return {{"mounts.urdf",
           fmt::format("<!-- {}: for the robot's own description; m, rad -->\n", kExportMark) +
               Joint(found.base.parent_from_child, names.world, names.base) +
               Joint(found.tool.parent_from_child, names.platform, names.tool)}};
}

}  // namespace hexcal
