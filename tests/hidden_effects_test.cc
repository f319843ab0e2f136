// SPDX-License-Identifier: BSD-3-Clause
// The generator and hexcal's model, written apart from the same description of the effects, must
// put the tool in the same place and have the tracker read the same.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hidden/as_dataset.h"
#include "model/effect.h"
#include "model/forward.h"
#include "model/predict.h"

namespace hexcal::hidden {
namespace {

// Sets a parameter of a model's effect by its name.
void Set(Effect* effect, const char* parameter, const Eigen::VectorXd& values) {
  const EffectKind* kind = FindEffectKind(effect->name);
  if (effect->parameters.size() == 0)
    effect->parameters = Eigen::VectorXd::Zero(kind->SizeFor(effect->index));
  effect->parameters.segment(kind->OffsetOf(parameter), values.size()) = values;
}

void Set(Effect* effect, const char* parameter, double value) {
  Set(effect, parameter, Eigen::VectorXd::Constant(1, value));
}

// The generator's parameters of a pattern over n legs or joints as one number each.
Eigen::VectorXd Spread(const HiddenEffect& hidden, const Eigen::VectorXd& parameters, int each) {
  if (parameters.size() == 6 * each) return parameters;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(6 * each);
  for (int i = 0; i < 6; ++i)
    if (hidden.carriers.empty() || hidden.carriers[0] == i + 1)
      all.segment(each * i, each) = parameters;
  return all;
}

const std::map<std::string, std::string>& OneNumberNames() {
  static const std::map<std::string, std::string> names = {{"leg_screw_rotation", "lead"},
                                                           {"leg_thermal", "expansion"},
                                                           {"leg_clearance", "gap"},
                                                           {"settling", "fraction"},
                                                           {"base_radius", "growth"},
                                                           {"platform_radius", "growth"},
                                                           {"plate_thermal", "expansion"},
                                                           {"base_flexure", "compliance"},
                                                           {"latency", "delay"},
                                                           {"tracker_scale", "scale"},
                                                           {"tracker_depth_scale", "scale"},
                                                           {"tracker_distortion", "coefficient"}};
  return names;
}

void SetLegs(const HiddenEffect& hidden, Effect* effect) {
  const std::map<std::string, const char*> names = {{"leg_offset", "offset"},
                                                    {"leg_gain", "gain"},
                                                    {"leg_nonlinearity", "curvature"},
                                                    {"leg_backlash", "gap"}};
  if (names.count(hidden.name) > 0)
    Set(effect, names.at(hidden.name), Spread(hidden, hidden.parameters, 1));
  if (hidden.name == "base_joint_offset" || hidden.name == "platform_joint_offset")
    Set(effect, "offset", Spread(hidden, hidden.parameters, 3));
  if (hidden.name == "leg_periodic") {
    const auto half = hidden.parameters.size() / 2;
    const Eigen::VectorXd sine = Spread(hidden, hidden.parameters.head(half), 1);
    const Eigen::VectorXd cosine = Spread(hidden, hidden.parameters.tail(half), 1);
    const Eigen::VectorXd phase =
        cosine.binaryExpr(sine, [](double c, double s) { return std::atan2(c, s); });
    const Eigen::VectorXd amplitude = (sine.cwiseAbs2() + cosine.cwiseAbs2()).cwiseSqrt();
    Set(effect, "amplitude", amplitude);
    Set(effect, "phase", phase);
    Set(effect, "period", hidden.fixed.at("period"));
    Set(effect, "amplitude_2", hidden.fixed.at("second_harmonic") * amplitude);
    Set(effect, "phase_2", phase);
  }
}

// The same effect in the model's words.
Effect AsModelEffect(const Scene& scene, const HiddenEffect& hidden) {
  Effect effect;
  effect.name = hidden.name;
  const Eigen::VectorXd& p = hidden.parameters;
  const bool is_marker = hidden.name.rfind("marker_", 0) == 0;
  if (is_marker) effect.index = hidden.carriers;
  Set(&effect, std::string(FindEffectKind(hidden.name)->parameters[0].name).c_str(), 0.0);
  SetLegs(hidden, &effect);
  if (OneNumberNames().count(hidden.name) > 0)
    Set(&effect, OneNumberNames().at(hidden.name).c_str(), p[0]);
  if (hidden.name == "leg_compliance") {
    Set(&effect, "compliance", p[0]);
    Set(&effect, "platform_mass", hidden.fixed.at("platform_mass"));
    if (!scene.tells_payload_centre) Set(&effect, "load_height", hidden.fixed.at("load_height"));
  }
  if (hidden.name == "joint_axis_offset") {
    effect.parameters.setZero();
    effect.parameters[hidden.fixed.at("is_base") > 0 ? 0 : 1] = p[0];
  }
  if (is_marker) Set(&effect, "offset", p);
  const std::set<std::string> twists = {
      "base_drift", "tool_drift", "base_step", "tool_step", "tool_thermal"};
  if (twists.count(hidden.name) > 0) Set(&effect, "twist", p);
  if (hidden.name == "tracker_warmup") {
    Set(&effect, p.size() == 6 ? "twist" : "scale", p);
    Set(&effect, "time_constant", hidden.fixed.at("time_constant"));
  }
  if (hidden.fixed.count("time") > 0) Set(&effect, "time", hidden.fixed.at("time"));
  if (hidden.name == "tool_sag") {
    Set(&effect, "deflection", p[0]);
    Set(&effect, "rotation", p[1]);
  }
  return effect;
}

// What the model has the tracker read in one row.
Reading ModelReading(const Case& made,
                     const Row& row,
                     const Pose3d& world_from_tool,
                     const Corrections<double>& corrections) {
  Reading reading;
  for (int m = 0; m < 8; ++m) {
    Eigen::Vector3d marker =
        m < 4 ? made.scene.base_markers.col(m) : made.scene.tool_markers.col(m - 4);
    const auto& moved = corrections.markers[m / 4];
    if (moved.cols() > 0) marker += moved.col(m % 4);
    const Eigen::Vector3d p_in_world = m < 4 ? marker : Eigen::Vector3d(world_from_tool * marker);
    reading.segment<3>(3 * m) =
        TrackerReading(corrections, AsPose(row.tracker_from_world) * p_in_world);
  }
  return reading;
}

struct Difference {
  double readings = 0.0, effect = 0.0, tool = 0.0;  // largest, m
};

Difference Compare(const Case& made) {
  const Scene& scene = made.scene;
  const Dataset dataset = AsDataset(made);
  const auto visits = MakeVisits(dataset, &*dataset.hexapod, ReportedPoses(dataset));
  Effect effect = AsModelEffect(scene, made.effects[0]);
  effect.reference = ReferenceFor(*FindEffectKind(effect.name), visits, dataset);
  const Mounts mounts = {AsPose(scene.world_from_base), AsPose(scene.platform_from_tool)};
  Difference difference;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const Row& row = scene.rows[i];
    const auto corrections = CorrectionsOf({effect}, visits[i]);
    const ForwardPose model = Forward(mounts, &*dataset.hexapod, visits[i], corrections);
    const Additions additions = Sum(made.effects, scene, row);
    const Reading truth = TrueReading(scene, row, additions);
    const auto grow = [](double* largest, double x) { *largest = std::max(*largest, x); };
    EXPECT_TRUE(model.reached);
    grow(&difference.tool,
         Minus(model.world_from_tool, AsPose(TrueTool(scene, row, additions))).norm());
    grow(&difference.readings,
         (ModelReading(made, row, model.world_from_tool, corrections) - truth)
             .cwiseAbs()
             .maxCoeff());
    grow(&difference.effect, (TrueReading(scene, row, {}) - truth).cwiseAbs().maxCoeff());
  }
  return difference;
}

Case MakeTold(const std::string& kind, const DetailOptions& detail, int* number) {
  CaseOptions options;
  options.kind = kind;
  options.detail = detail;
  options.scene.measured = 20;
  options.scene.visited_only = 10;
  for (;;) {
    // Where the centre of the travel is not told, the two take the mean of turns a little
    // otherwise.
    const Case made = MakeCase(options, 21, (*number)++);
    if (made.scene.tells_home) return made;
  }
}

TEST(HiddenEffects, AreThoseOfTheModel) {
  DetailOptions harmonic;
  harmonic.second_harmonic = 0.25;
  for (const EffectRow& row : ListedEffects()) {
    int number = 0;
    for (int k = 0; k < 6; ++k) {
      Case made = MakeTold(row.name, harmonic, &number);
      const Difference difference = Compare(made);
      EXPECT_GT(difference.effect, 1e-7) << row.name;
      // Of uneven plates the two find the plane otherwise, along z and across.
      const bool has_plane = row.name == "leg_screw_rotation" || row.name == "base_radius" ||
                             row.name == "platform_radius" || row.name == "joint_axis_offset";
      const double tolerance = has_plane ? 2e-3 * difference.effect : 1e-10;
      EXPECT_LT(difference.readings, tolerance) << row.name << " " << difference.effect;
      EXPECT_LT(difference.tool, 10 * tolerance) << row.name;
    }
  }
}

}  // namespace
}  // namespace hexcal::hidden
