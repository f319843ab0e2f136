// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "estimator/certificate.h"
#include "estimator/estimate.h"

namespace hexcal {

// Pieces that several of hexcal's files have in common. SI units.

template <typename Derived>
nlohmann::ordered_json JsonList(const Eigen::DenseBase<Derived>& v) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) list.push_back(v(i));
  return list;
}

// xyz, quaternion (w first), matrix (4 x 4).
nlohmann::ordered_json JsonPose(const Pose3d& pose);

// The names of the 12.
nlohmann::ordered_json JsonParameterNames();

// cost, rmspe, rmsoe of each.
nlohmann::ordered_json JsonIterations(const std::vector<IterationRecord>& iterations);

// null where the data do not determine the parameter.
nlohmann::ordered_json JsonStandardDeviations(const Matrix12d& covariance,
                                              const Observability& observability);

nlohmann::ordered_json JsonCertificate(const Certificate& certificate);

}  // namespace hexcal
