// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <opencv2/calib3d.hpp>

#include "methods.h"

namespace hexcal {
namespace {

cv::Mat RotationOf(const Pose3d& pose) {
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  cv::Mat m(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m.at<double>(i, j) = r(i, j);
  return m;
}

cv::Mat TranslationOf(const Pose3d& pose) {
  cv::Mat m(3, 1, CV_64F);
  for (int i = 0; i < 3; ++i) m.at<double>(i) = pose.translation[i];
  return m;
}

Pose3d PoseOf(const cv::Mat& r, const cv::Mat& t) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = r.at<double>(i, j);
  return MakePose(rotation, {t.at<double>(0), t.at<double>(1), t.at<double>(2)});
}

// OpenCV's names: the tool is its camera, the platform its gripper.
struct Views {
  std::vector<cv::Mat> r_world_to_tool, t_world_to_tool, r_base_to_platform, t_base_to_platform;
};

Method OpenCvMethod(const std::string& name, cv::RobotWorldHandEyeCalibrationMethod method) {
  return {name, [method](const Observations& observations, const BaseAndTool&) -> Calibration {
            const auto views = std::make_shared<Views>();
            for (const Observation& o : observations.items) {
              const Pose3d tool_from_world = o.world_from_tool.Inverse();
              const Pose3d platform_from_base = o.base_from_platform.Inverse();
              views->r_world_to_tool.push_back(RotationOf(tool_from_world));
              views->t_world_to_tool.push_back(TranslationOf(tool_from_world));
              views->r_base_to_platform.push_back(RotationOf(platform_from_base));
              views->t_base_to_platform.push_back(TranslationOf(platform_from_base));
            }
            return [views, method] {
              cv::Mat r_base, t_base, r_tool, t_tool;
              cv::calibrateRobotWorldHandEye(views->r_world_to_tool,
                                             views->t_world_to_tool,
                                             views->r_base_to_platform,
                                             views->t_base_to_platform,
                                             r_base,
                                             t_base,
                                             r_tool,
                                             t_tool,
                                             method);
              return BaseAndTool{PoseOf(r_base, t_base), PoseOf(r_tool, t_tool).Inverse()};
            };
          }};
}

}  // namespace

std::vector<Method> OpenCv() {
  cv::setNumThreads(1);
  return {OpenCvMethod("OpenCV Shah", cv::CALIB_ROBOT_WORLD_HAND_EYE_SHAH),
          OpenCvMethod("OpenCV Li", cv::CALIB_ROBOT_WORLD_HAND_EYE_LI)};
}

}  // namespace hexcal
