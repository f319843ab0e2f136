// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/align_points.h"
#include "measurement/dataset.h"

namespace hexcal {

// The paper's frame of three markers (Section 5.1): origin at their centroid, z = (m2-m1) x
// (m3-m1), x from one named marker to another, y = z x x. Columns of p_in_tracker and
// sigma_in_tracker: the markers as listed, m. Covariance by the construction's own Jacobian.
Alignment CentroidFrame(const Eigen::Matrix3d& p_in_tracker,
                        const Eigen::Matrix3d& sigma_in_tracker,
                        const std::array<int, 2>& x_axis);

}  // namespace hexcal
