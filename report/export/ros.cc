// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "report/export/writers.h"

namespace hexcal {
namespace {

struct Link {
  const char* name;
  const Pose3d& pose;
  const std::string &parent, &child;
};

std::string Ros1Node(const Link& link) {
  const Eigen::Vector3d& t = link.pose.translation;
  const Eigen::Quaterniond& q = link.pose.rotation;
  return fmt::format(
      "  <node pkg=\"tf2_ros\" type=\"static_transform_publisher\" name=\"{}\"\n"
      "        args=\"{} {} {} {} {} {} {} {} {}\"/>\n",
      link.name,
      t.x(),
      t.y(),
      t.z(),
      q.x(),
      q.y(),
      q.z(),
      q.w(),
      link.parent,
      link.child);
}

std::string Ros2Node(const Link& link) {
  const Eigen::Vector3d& t = link.pose.translation;
  const Eigen::Quaterniond& q = link.pose.rotation;
  return fmt::format(
      "  <node pkg=\"tf2_ros\" exec=\"static_transform_publisher\" name=\"{}\"\n"
      "        args=\"--x {} --y {} --z {} --qx {} --qy {} --qz {} --qw {} --frame-id {} "
      "--child-frame-id {}\"/>\n",
      link.name,
      t.x(),
      t.y(),
      t.z(),
      q.x(),
      q.y(),
      q.z(),
      q.w(),
      link.parent,
      link.child);
}

std::string Launch(const ExportInput& input, std::string (*node)(const Link&)) {
  const Calibration& found = input.calibration;
  const FrameNames& names = input.frames;
  std::string text = fmt::format("<!-- {}: parent from child, m -->\n<launch>\n", kExportMark);
  text += node({"hexcal_base", found.base.parent_from_child, names.world, names.base});
  text += node({"hexcal_tool", found.tool.parent_from_child, names.platform, names.tool});
  return text + "</launch>\n";
}

}  // namespace

ExportedFiles WriteRos1(const ExportInput& input) {
  return {{"static_transforms.launch", Launch(input, &Ros1Node)}};
}

ExportedFiles WriteRos2(const ExportInput& input) {
  return {{"static_transforms.launch.xml", Launch(input, &Ros2Node)}};
}

}  // namespace hexcal
