// SPDX-License-Identifier: BSD-3-Clause
#include "report/export/formats.h"

#include <algorithm>

#include "report/export/writers.h"

namespace hexcal {

const std::vector<ExportFormat>& ExportFormats() {
  static const std::vector<ExportFormat> formats = {
      {"ros1",
       "ROS 1 launch file with static transforms",
       false,
       {"static_transforms.launch"},
       &WriteRos1},
      {"ros2",
       "ROS 2 launch file with static transforms",
       false,
       {"static_transforms.launch.xml"},
       &WriteRos2},
      {"urdf", "URDF fixed joints with their origins", false, {"mounts.urdf"}, &WriteUrdf},
      {"easy_handeye",
       "easy_handeye calibrations, YAML",
       false,
       {"base_easy_handeye.yaml", "tool_easy_handeye.yaml"},
       &WriteEasyHandeye},
      {"pose_with_covariance",
       "ROS PoseWithCovarianceStamped, YAML",
       false,
       {"base_pose_with_covariance.yaml", "tool_pose_with_covariance.yaml"},
       &WritePoseWithCovariance},
      {"tum",
       "TUM trajectories of measured and predicted poses, for evo",
       true,
       {"measured.tum", "predicted.tum"},
       &WriteTum},
      {"residuals",
       "CSV of what is left over at every pose",
       false,
       {"residuals.csv"},
       &WriteResiduals},
  };
  return formats;
}

const ExportFormat* FindExportFormat(std::string_view name) {
  const std::vector<ExportFormat>& formats = ExportFormats();
  const auto found = std::find_if(
      formats.begin(), formats.end(), [name](const ExportFormat& f) { return f.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace hexcal
