// SPDX-License-Identifier: BSD-3-Clause
#include "report/json_parts.h"

#include <cmath>

namespace hexcal {

using Json = nlohmann::ordered_json;

Json JsonPose(const Pose3d& pose) {
  const Eigen::Matrix4d matrix = pose.Matrix();
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i) rows.push_back(JsonList(matrix.row(i)));
  const Eigen::Quaterniond& q = pose.rotation;
  return {{"xyz", JsonList(pose.translation)},
          {"quaternion", {q.w(), q.x(), q.y(), q.z()}},
          {"matrix", rows}};
}

Json JsonParameterNames() {
  Json list = Json::array();
  for (const ParameterInfo& p : kParameters) list.push_back(std::string(p.name));
  return list;
}

Json JsonIterations(const std::vector<IterationRecord>& iterations) {
  Json list = Json::array();
  for (const IterationRecord& r : iterations)
    list.push_back({{"cost", r.cost}, {"rmspe", r.rmspe}, {"rmsoe", r.rmsoe}});
  return list;
}

Json JsonStandardDeviations(const Matrix12d& covariance, const Observability& observability) {
  Json list = Json::array();
  for (int i = 0; i < 12; ++i)
    list.push_back(observability.determined[i] ? Json(std::sqrt(covariance(i, i))) : Json());
  return list;
}

Json JsonCertificate(const Certificate& certificate) {
  return {{"certified", certificate.certified},
          {"smallest_eigenvalue", certificate.smallest_eigenvalue},
          {"gap", certificate.gap},
          {"exact", certificate.exact},
          {"distance", certificate.distance},
          {"why", certificate.why}};
}

}  // namespace hexcal
