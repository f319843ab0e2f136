// SPDX-License-Identifier: BSD-3-Clause
// Laws that all effects obey. tests/effects_test.cc has each one's own values.
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "model/effect.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::SeededByTest;
using testing::Uniform;

struct Words {
  const char *name, *site, *driver, *shape;
};
// What the names of effects are fixed to be.
constexpr Words kNames[] = {
    {"leg_offset", "leg", "constant", "constant"},
    {"leg_gain", "leg", "leg_length", "linear about l_home"},
    {"leg_nonlinearity", "leg", "leg_length", "quadratic about l_home"},
    {"leg_periodic", "leg", "leg_length", "periodic"},
    {"leg_screw_rotation", "leg", "relative roll of the leg's joints", "linear"},
    {"leg_backlash", "leg", "leg_direction", "sign"},
    {"leg_thermal", "leg", "temperature", "linear × l_i"},
    {"leg_compliance", "leg", "leg_force", "linear"},
    {"leg_clearance", "leg", "leg_force", "sign"},
    {"base_joint_offset", "base_joint", "constant", "constant"},
    {"platform_joint_offset", "platform_joint", "constant", "constant"},
    {"base_radius", "base_joint", "constant", "constant"},
    {"platform_radius", "platform_joint", "constant", "constant"},
    {"joint_axis_offset", "base_joint or platform_joint", "joint angle", "even"},
    {"plate_thermal", "base_joint and platform_joint", "temperature", "linear"},
    {"base_drift", "base", "time", "linear (or exponential)"},
    {"tool_drift", "tool", "time", "linear (or exponential)"},
    {"base_step", "base", "time", "step"},
    {"tool_step", "tool", "time", "step"},
    {"base_flexure", "base", "platform position × payload", "linear"},
    {"tool_sag", "tool", "gravity seen from the platform", "linear"},
    {"tool_thermal", "tool", "temperature", "linear"},
    {"tracker_scale", "tracker", "position", "linear"},
    {"tracker_depth_scale", "tracker", "depth", "linear"},
    {"tracker_distortion", "tracker", "off-axis distance", "cubic"},
    {"tracker_warmup", "tracker", "time", "exponential"},
    {"marker_offset", "marker", "constant", "constant"},
    {"marker_shift", "marker", "time", "step"},
    {"settling", "leg", "last move", "linear"},
    {"latency", "platform", "velocity", "linear"},
    {"wrong_rotation_order", "data", "–", "discrete"},
    {"transposed_rotation", "data", "–", "discrete"},
    {"wrong_quaternion_order", "data", "–", "discrete"},
    {"swapped_legs", "data", "–", "discrete"},
    {"swapped_markers", "data", "–", "discrete"},
    {"shifted_rows", "data", "–", "discrete"},
    {"wrong_unit", "data", "–", "discrete"},
};

TEST(EffectKinds, AreThoseThatMayBeNamed) {
  EXPECT_EQ(EffectKinds().size(), std::size(kNames));
  for (const Words& words : kNames) {
    const EffectKind* kind = FindEffectKind(words.name);
    ASSERT_NE(kind, nullptr) << words.name;
    EXPECT_EQ(kind->site, words.site) << words.name;
    EXPECT_EQ(kind->driver, words.driver) << words.name;
    EXPECT_EQ(kind->shape, words.shape) << words.name;
  }
  EXPECT_EQ(FindEffectKind("unknown"), nullptr);
  EXPECT_EQ(FindEffectKind("leg_offse"), nullptr);
}

TEST(EffectKinds, AreCompleteRows) {
  const std::set<std::string_view> needs = {
      "legs", "time", "temperature", "payload", "gravity", "order", "velocity", "markers"};
  for (const EffectKind& kind : EffectKinds()) {
    SCOPED_TRACE(kind.name);
    EXPECT_EQ(kind.cause.back(), '.');
    for (const std::string_view need : kind.needs) EXPECT_EQ(needs.count(need), 1u) << need;
    EXPECT_EQ(kind.IsFault(), kind.site == "data");
    EXPECT_EQ(kind.IsFault(), kind.apply_dual == nullptr);
    EXPECT_EQ(kind.IsFault(), kind.parameters.empty());
    bool one_acts_alone = kind.IsFault();
    for (const ParameterKind& parameter : kind.parameters) {
      EXPECT_FALSE(parameter.unit.empty());
      EXPECT_TRUE(parameter.scale > 0.0 || parameter.is_search) << parameter.name;
      EXPECT_FALSE(parameter.is_search && parameter.acts_alone) << parameter.name;
      EXPECT_EQ(parameter.rotation_scale > 0.0, parameter.name == "twist");
      EXPECT_TRUE(!parameter.is_per_marker || &parameter == &kind.parameters.back());
      one_acts_alone |= parameter.acts_alone;
    }
    EXPECT_TRUE(one_acts_alone);
  }
}

// docs/effects.md has a row a kind, in the same order, with the same parameters, units, needs and
// cause.
TEST(EffectKinds, StandInTheDocumentation) {
  std::ifstream file(HEXCAL_SOURCE "/docs/effects.md");
  std::stringstream all;
  all << file.rdbuf();
  const std::string text = all.str();
  std::size_t at = 0;
  for (const EffectKind& kind : EffectKinds()) {
    SCOPED_TRACE(kind.name);
    at = text.find("\n| `" + std::string(kind.name) + "` | ", at);
    ASSERT_NE(at, std::string::npos);
    const std::string row = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    EXPECT_NE(row.find("| " + std::string(kind.cause) + " |"), std::string::npos) << row;
    for (const std::string_view need : kind.needs)
      EXPECT_NE(row.find(need), std::string::npos) << need;
    if (row.find("as above") != std::string::npos) continue;
    for (const ParameterKind& parameter : kind.parameters) {
      EXPECT_NE(row.find(parameter.name), std::string::npos) << parameter.name;
      EXPECT_NE(row.find(parameter.unit.substr(0, parameter.unit.find(','))), std::string::npos)
          << parameter.name;
    }
  }
}

TEST(EffectKind, CountsItsNumbers) {
  const EffectKind& periodic = *FindEffectKind("leg_periodic");
  EXPECT_EQ(periodic.size(), 25);
  EXPECT_EQ(periodic.OffsetOf("amplitude"), 0);
  EXPECT_EQ(periodic.OffsetOf("period"), 12);
  EXPECT_EQ(periodic.OffsetOf("phase_2"), 19);
  EXPECT_EQ(periodic.ParameterOf(12).name, "period");
  EXPECT_EQ(periodic.ParameterOf(18).name, "amplitude_2");
  EXPECT_EQ(periodic.UnitOf(11), "rad");
  EXPECT_DEATH(periodic.OffsetOf("pitch"), "no parameter called pitch");
  EXPECT_DEATH(periodic.ParameterOf(25), "no parameter number 25");
}

TEST(EffectKind, TellsMetresFromRadians) {
  const EffectKind& thermal = *FindEffectKind("tool_thermal");
  EXPECT_EQ(thermal.UnitOf(2), "m/K");
  EXPECT_EQ(thermal.UnitOf(3), "rad/K");
  EXPECT_EQ(thermal.ScaleOf(2), 1e-5);
  EXPECT_EQ(thermal.ScaleOf(3), 2e-5);
  EXPECT_EQ(FindEffectKind("base_drift")->UnitOf(6), "s");
}

TEST(EffectKind, HasThreeNumbersAMarker) {
  const EffectKind& shift = *FindEffectKind("marker_shift");
  EXPECT_EQ(shift.size(), 4);
  EXPECT_EQ(shift.SizeFor({1, 5}), 7);
  EXPECT_EQ(shift.ParameterOf(6).name, "offset");
  EXPECT_EQ(shift.ScaleOf(6), 1e-4);
  EXPECT_EQ(FindEffectKind("leg_gain")->SizeFor({3}), 6);
}

// Data in which every driver moves.
struct FullData {
  explicit FullData(std::mt19937_64& rng) {
    for (int i = 0; i < 6; ++i)
      poses.push_back(testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.4));
    dataset = testing::DatasetOfPoses(poses);
    dataset.hexapod = testing::LargeHexapod();
    dataset.gravity_in_base = Eigen::Vector3d(0.36, 0.48, -0.8);
    std::vector<double> times;
    for (int i = 0; i < 6; ++i) times.push_back(1000.0 + 100.0 * i);
    dataset.robot_poses.covariates.push_back({"time", Unit(), times});
    for (const char* name :
         {"temperature", "payload", "payload_x", "payload_y", "vx", "vy", "vz", "wx", "wy", "wz"}) {
      std::vector<double> values;
      for (int i = 0; i < 6; ++i) values.push_back(Uniform(rng, 0.5, 1.5));
      dataset.robot_poses.covariates.push_back({name, Unit(), values});
    }
    dataset.measurement = Measurement();
    dataset.measurement->kind = Measurement::Kind::kMarkers;
    dataset.measurement->bodies[0].markers = {"b1", "b2", "b3", "b4"};
    dataset.measurement->bodies[1].markers = {"t1", "t2", "t3"};
    visits = MakeVisits(dataset, &*dataset.hexapod, poses);
  }

  Effect EffectOf(const EffectKind& kind) const {
    Effect effect;
    effect.name = kind.name;
    if (kind.parameters.back().is_per_marker) effect.index = {2, 6};
    effect.parameters = Eigen::VectorXd::Zero(kind.SizeFor(effect.index));
    effect.reference = ReferenceFor(kind, visits, dataset);
    return effect;
  }

  std::vector<Pose3d> poses;
  Dataset dataset;
  std::vector<Visit> visits;
};

// All numbers in one column.
Eigen::VectorXd Flat(const Corrections<double>& c) {
  const Eigen::Index base = c.markers[0].size(), tool = c.markers[1].size();
  Eigen::VectorXd flat(69 + base + tool);
  flat << c.leg, c.base_joints.reshaped(), c.platform_joints.reshaped(), c.base_twist,
      c.platform_twist, c.tool_twist, c.tracker_scale, c.tracker_depth_scale, c.tracker_distortion,
      c.tracker_twist, c.markers[0].reshaped(), c.markers[1].reshaped();
  return flat;
}

// Numbers such as a search would try; within the data's times.
double SearchedValue(const ParameterKind& parameter) {
  if (parameter.name == "period") return 0.05;
  return parameter.name == "time" ? 1250.0 : 200.0;
}

TEST(Effects, AddNothingWhereTheirParametersAreZero) {
  std::mt19937_64 rng = SeededByTest();
  const FullData data(rng);
  for (const EffectKind& kind : EffectKinds()) {
    if (kind.IsFault()) continue;
    SCOPED_TRACE(kind.name);
    Effect effect = data.EffectOf(kind);
    for (const bool with_searched : {false, true}) {
      for (int n = 0; with_searched && n < effect.parameters.size(); ++n)
        if (kind.ParameterOf(n).is_search)
          effect.parameters[n] = SearchedValue(kind.ParameterOf(n));
      for (const Visit& visit : data.visits) {
        const Eigen::VectorXd flat = Flat(CorrectionsOf({effect}, visit));
        EXPECT_TRUE(MatrixNear(flat, Eigen::VectorXd::Zero(flat.size()), 0.0));
        for (int n = 0; n < effect.parameters.size(); ++n) {
          const Eigen::VectorXd slope = Flat(CorrectionsBy(effect, n, visit));
          EXPECT_TRUE(slope.allFinite());
          EXPECT_TRUE(kind.ParameterOf(n).acts_alone || slope.isZero(0.0));
        }
      }
    }
  }
}

TEST(Effects, HaveTheDerivativesOfTheirDifferences) {
  std::mt19937_64 rng = SeededByTest();
  const FullData data(rng);
  for (const EffectKind& kind : EffectKinds()) {
    if (kind.IsFault()) continue;
    SCOPED_TRACE(kind.name);
    Effect effect = data.EffectOf(kind);
    for (int n = 0; n < effect.parameters.size(); ++n)
      effect.parameters[n] = kind.ParameterOf(n).is_search ? SearchedValue(kind.ParameterOf(n))
                                                           : Uniform(rng, 0.5, 1.5);
    double largest = 0.0;
    for (const Visit& visit : data.visits) {
      const int size = static_cast<int>(effect.parameters.size());
      for (int n = 0; n < size; ++n) {
        const double step = 1e-6 * std::abs(effect.parameters[n]);
        const auto moved = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
          Effect other = effect;
          other.parameters[n] += d[0];
          return Flat(CorrectionsOf({other}, visit));
        };
        const Eigen::MatrixXd slope = Flat(CorrectionsBy(effect, n, visit));
        EXPECT_TRUE(JacobianNear(slope, testing::NumericJacobian(moved, 1, step), 1e-6))
            << kind.ParameterOf(n).name;
        largest = std::max(largest, slope.cwiseAbs().maxCoeff());
      }
    }
    EXPECT_GT(largest, 0.0);  // it does something
  }
}

// Predicting some rows, as a dataset of their own, says what predicting all does: nothing that the
// effect refers to may come from the rows themselves. Moves from visit to visit are left out; they
// are of the rows by their nature.
TEST(Effects, SayTheSameOfFewerRows) {
  std::mt19937_64 rng = SeededByTest();
  const FullData data(rng);
  Dataset few = data.dataset;
  const int first = 2, last = 4;
  few.robot_poses.rows.assign(data.dataset.robot_poses.rows.begin() + first,
                              data.dataset.robot_poses.rows.begin() + last);
  for (Covariate& covariate : few.robot_poses.covariates)
    covariate.values = {covariate.values.begin() + first, covariate.values.begin() + last};
  const std::vector<Pose3d> poses(data.poses.begin() + first, data.poses.begin() + last);
  const std::vector<Visit> visits = MakeVisits(few, &*few.hexapod, poses);
  for (const EffectKind& kind : EffectKinds()) {
    if (kind.IsFault() || kind.name == "settling" || kind.name == "leg_backlash") continue;
    SCOPED_TRACE(kind.name);
    Effect effect = data.EffectOf(kind);
    for (int n = 0; n < effect.parameters.size(); ++n)
      effect.parameters[n] = kind.ParameterOf(n).is_search ? SearchedValue(kind.ParameterOf(n))
                                                           : Uniform(rng, 0.5, 1.5);
    for (int row = first; row < last; ++row)
      EXPECT_TRUE(MatrixNear(Flat(CorrectionsOf({effect}, visits[row - first])),
                             Flat(CorrectionsOf({effect}, data.visits[row])),
                             1e-14));
  }
}

TEST(ReferenceFor, TakesWhatTheDataSay) {
  std::mt19937_64 rng = SeededByTest();
  FullData data(rng);
  const EffectReference drift =
      ReferenceFor(*FindEffectKind("tool_drift"), data.visits, data.dataset);
  EXPECT_EQ(drift.size(), 3u);
  EXPECT_EQ(drift.at("time_origin"), std::vector<double>{1000.0});
  EXPECT_EQ(drift.at("time_span"), std::vector<double>{500.0});
  EXPECT_EQ(drift.at("time_is_row"), std::vector<double>{0.0});
  const EffectReference marker =
      ReferenceFor(*FindEffectKind("marker_offset"), data.visits, data.dataset);
  EXPECT_EQ(marker.at("markers"), (std::vector<double>{4.0, 3.0}));
  const EffectReference gain = ReferenceFor(*FindEffectKind("leg_gain"), data.visits, data.dataset);
  EXPECT_EQ(gain.at("home_lengths")[4], data.visits[0].home_lengths[4]);
  EXPECT_TRUE(ReferenceFor(*FindEffectKind("leg_offset"), data.visits, data.dataset).empty());
}

TEST(ReferenceFor, TakesTheStatedTemperatureOrTheMean) {
  std::mt19937_64 rng = SeededByTest();
  FullData data(rng);
  const EffectKind& thermal = *FindEffectKind("leg_thermal");
  double mean = 0.0;
  for (const Visit& visit : data.visits) mean += visit.temperature / 6;
  EXPECT_NEAR(
      ReferenceFor(thermal, data.visits, data.dataset).at("reference_temperature")[0], mean, 1e-15);
  data.dataset.reference_temperature = 20.0;
  EXPECT_EQ(ReferenceFor(thermal, data.visits, data.dataset).at("reference_temperature")[0], 20.0);
}

TEST(ReferenceFor, CountsRowsWithoutTime) {
  const std::vector<Pose3d> poses(5);
  const Dataset dataset = testing::DatasetOfPoses(poses);
  const std::vector<Visit> visits = MakeVisits(dataset, nullptr, poses);
  const EffectReference drift = ReferenceFor(*FindEffectKind("base_drift"), visits, dataset);
  EXPECT_EQ(drift.at("time_origin"), std::vector<double>{0.0});
  EXPECT_EQ(drift.at("time_span"), std::vector<double>{4.0});
  EXPECT_EQ(drift.at("time_is_row"), std::vector<double>{1.0});
}

TEST(MissingFor, SaysInWordsWhatIsNotThere) {
  Drivers drivers;
  EXPECT_EQ(MissingFor(*FindEffectKind("leg_compliance"), drivers),
            "a hexapod with base_joints and platform_joints, a payload column, the direction of "
            "gravity");
  drivers.legs = drivers.payload = true;
  EXPECT_EQ(MissingFor(*FindEffectKind("leg_compliance"), drivers), "the direction of gravity");
  drivers.gravity = true;
  EXPECT_EQ(MissingFor(*FindEffectKind("leg_compliance"), drivers), "");
  EXPECT_EQ(MissingFor(*FindEffectKind("leg_thermal"), drivers), "a temperature column");
  drivers.order = true;
  EXPECT_EQ(MissingFor(*FindEffectKind("base_drift"), drivers), "");  // rows will do
}

}  // namespace
}  // namespace hexcal
