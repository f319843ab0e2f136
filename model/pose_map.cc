// SPDX-License-Identifier: BSD-3-Clause
#include "model/pose_map.h"

#include <glog/logging.h>

#include <algorithm>

namespace hexcal {

int PoseMapTermCount(int degree) {
  CHECK(degree == 1 || degree == 2) << degree;
  return degree == 1 ? 7 : 28;
}

Eigen::VectorXd PoseMapTerms(const PoseMap& map, const Pose3d& base_from_platform) {
  const Vector6d coordinates = Minus(base_from_platform, map.reference);
  Eigen::VectorXd terms = Eigen::VectorXd::Zero(PoseMapTermCount(map.degree));
  terms[0] = 1.0;
  for (int i = 0; i < 6; ++i)
    if (map.half_width[i] > 0.0)
      terms[1 + i] = std::clamp((coordinates[i] - map.centre[i]) / map.half_width[i], -1.0, 1.0);
  if (map.degree == 1) return terms;
  int term = 7;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) terms[term++] = terms[1 + i] * terms[1 + j];
  return terms;
}

Vector6d PoseMapTwist(const PoseMap& map, const Pose3d& base_from_platform) {
  return map.coefficients * PoseMapTerms(map, base_from_platform);
}

}  // namespace hexcal
