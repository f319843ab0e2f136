// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study_scene.h"

namespace hexcal {

// One whole calibration; what it returns is the estimate.
using Calibration = std::function<BaseAndTool()>;

// A way to find base and tool. prepare turns the poses into what the method reads (no part of its
// time, but of its memory); the observations must outlive the calibration.
struct Method {
  std::string name;
  std::function<Calibration(const Observations&, const BaseAndTool& truth)> prepare;
};

// Calibrate: with covariance, intervals, residuals and warnings. Full: each pose has a 6 x 6
// covariance of its own, if only by a hair.
Method Hexcal();
Method HexcalFull();

// What Calibrate is made of, for poses that are packed beforehand: base, tool and covariance.
Method HexcalPacked();
Method HexcalPackedFull();

// One residual block a pose by automatic derivatives, quaternions, Ceres's own options and
// covariance: what is written in an hour. Starts 0.1 m and 0.1 rad an axis from the truth.
Method PlainCeres();

// Shah's and Li's closed forms in OpenCV; none where OpenCV is not installed.
std::vector<Method> OpenCv();

}  // namespace hexcal
