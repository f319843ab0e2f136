// SPDX-License-Identifier: BSD-3-Clause
// The effects against another simulator, which shares no code with hexcal and wrote down, without
// noise, where the tool was and what it had hidden. Not covered: sizes of what hexcal does not
// model in the same way (the platform's own mass), and effects of the tracker.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "estimator/calibrate.h"
#include "model/effect.h"
#include "model/forward.h"
#include "model/predict.h"

namespace hexcal {
namespace {

std::string Folder(const std::string& name) {
  return std::string(HEXCAL_HIDDEN_EFFECTS "/") + name;
}

struct HiddenCase {
  explicit HiddenCase(const std::string& name)
      : dataset(ReadDataset(Folder(name) + "/dataset.yaml", true)),
        visits(MakeVisits(dataset, &*dataset.hexapod, ReportedPoses(dataset))) {
    std::ifstream(Folder(name) + "/truth.json") >> truth;
  }

  void Add(const std::string& name, const std::vector<double>& parameters) {
    Effect effect;
    effect.name = name;
    effect.parameters = Eigen::Map<const Eigen::VectorXd>(parameters.data(), parameters.size());
    effect.reference = ReferenceFor(*FindEffectKind(name), visits, dataset);
    effects.push_back(effect);
  }

  // Position RMS, m, of base and tool fitted to the platform with these effects. An effect of the
  // base stands left of the platform, so the mounts need not be known to add it.
  double Rms() const {
    Observations observations = MakeObservations(dataset);
    for (Observation& observation : observations.items) {
      for (const Visit& visit : visits)
        if (dataset.robot_poses.rows[visit.row].label == observation.label)
          observation.base_from_platform =
              Forward({}, &*dataset.hexapod, visit, CorrectionsOf(effects, visit)).world_from_tool;
    }
    const Estimate estimate = Calibrate(observations, std::nullopt, {});
    double sum = 0.0;
    for (const Observation& observation : observations.items) {
      const Pose3d predicted = estimate.mounts.world_from_base * observation.base_from_platform *
                               estimate.mounts.platform_from_tool;
      sum += (predicted.translation - observation.world_from_tool.translation).squaredNorm();
    }
    return std::sqrt(sum / observations.items.size());
  }

  Dataset dataset;
  std::vector<Visit> visits;
  nlohmann::json truth;
  std::vector<Effect> effects;
};

using Numbers = std::vector<double>;

TEST(Agreement, OnLegOffsets) {
  HiddenCase hidden("case-2");
  EXPECT_GT(hidden.Rms(), 3e-5);
  hidden.Add("leg_offset", hidden.truth["effects"]["leg_offset"]);
  EXPECT_LT(hidden.Rms(), 1e-10);
}

TEST(Agreement, OnAPeriodicLegWithItsHarmonicWhileTheBaseDrifts) {
  HiddenCase hidden("case-8");
  EXPECT_GT(hidden.Rms(), 3e-5);
  Numbers drift = hidden.truth["effects"]["base_drift"];
  drift.push_back(0.0);  // straight
  hidden.Add("base_drift", drift);
  EXPECT_GT(hidden.Rms(), 1e-6);
  const nlohmann::json& periodic = hidden.truth["effects"]["leg_periodic"];
  const Numbers amplitude = periodic["amplitude"], phase = periodic["phase"];
  const double second = periodic["harmonics"][1];
  Numbers parameters = amplitude;
  parameters.insert(parameters.end(), phase.begin(), phase.end());
  parameters.push_back(periodic["period"]);
  for (const double a : amplitude) parameters.push_back(second * a);
  parameters.insert(parameters.end(), phase.begin(), phase.end());
  hidden.Add("leg_periodic", parameters);
  EXPECT_LT(hidden.Rms(), 1e-9);
}

}  // namespace
}  // namespace hexcal
