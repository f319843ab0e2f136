// SPDX-License-Identifier: BSD-3-Clause
#include "study_markers.h"

#include <algorithm>
#include <random>
#include <string>

#include "model/simulate.h"
#include "study_scene.h"

namespace hexcal {
namespace {

constexpr double kSigma = 1e-4;  // m

MarkerBody Body(const std::string& prefix) {
  MarkerBody body;
  body.p_in_body.resize(3, 4);
  body.p_in_body << 0.10, -0.05, -0.06, 0.0, 0.0, 0.08, -0.07, 0.02, 0.0, 0.01, 0.0, 0.06;
  for (int m = 1; m <= 4; ++m) body.markers.push_back(prefix + std::to_string(m));
  return body;
}

}  // namespace

MarkerStudy MakeMarkerStudy(int poses, std::uint64_t seed) {
  const StudyScene scene = MakeStudyScene(poses, IsotropicNoise(), seed);
  MarkerStudy study;
  study.truth = scene.truth;
  study.dataset.name = "study";
  for (const Observation& o : scene.exact)
    study.dataset.robot_poses.rows.push_back({o.label, o.base_from_platform, {}, 0});
  // The tracker looks at both from a metre and a half away.
  study.dataset.tracker.tracker_from_world =
      Pose3d{{0.3, -0.2, 1.5}, Exp(Eigen::Vector3d(2, 1, 0))};
  Measurement& measurement = study.dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.bodies = {Body("b"), Body("t")};
  measurement.marker_sigma = Eigen::Vector3d::Constant(kSigma);
  return study;
}

Dataset DrawMarkers(const MarkerStudy& study,
                    std::uint64_t draw,
                    bool sigma_is_stated,
                    double unseen) {
  const Machine machine{
      "study", study.truth.world_from_base, study.truth.platform_from_tool, {}, {}};
  SimulateOptions options;
  options.seed = draw;
  Dataset drawn = Simulate(study.dataset, machine, options);
  Measurement& measurement = *drawn.measurement;
  if (!sigma_is_stated) measurement.marker_sigma.reset();
  std::seed_seq seed{draw, std::uint64_t{2}};
  std::mt19937_64 rng(seed);
  std::bernoulli_distribution is_unseen(unseen);
  auto& readings = measurement.readings;
  readings.erase(
      std::remove_if(
          readings.begin(), readings.end(), [&](const MarkerReading&) { return is_unseen(rng); }),
      readings.end());
  return drawn;
}

}  // namespace hexcal
