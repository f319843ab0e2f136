// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"
#include "estimator/target_error.h"
#include "geometry/linear_algebra.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/quantity.h"
#include "report/space_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kTurn = 6.283185307179586;
constexpr int kMeridians = 24, kCircles = 12;
// The parts of the scene that the longest arrow and the ellipsoid are drawn at.
constexpr double kArrowPart = 0.1, kEllipsoidPart = 0.03;

std::size_t MiddleOf(const Observations& observations) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Observation& o : observations.items) mean += o.base_from_platform.translation;
  mean /= static_cast<double>(observations.items.size());
  const auto nearest =
      std::min_element(observations.items.begin(),
                       observations.items.end(),
                       [&](const Observation& a, const Observation& b) {
                         return (a.base_from_platform.translation - mean).squaredNorm() <
                                (b.base_from_platform.translation - mean).squaredNorm();
                       });
  return static_cast<std::size_t>(nearest - observations.items.begin());
}

double SizeOf(const Scene& scene) {
  Points all = {scene.world_from_base.translation,
                scene.world_from_platform.translation,
                scene.world_from_tool.translation,
                Eigen::Vector3d::Zero()};
  for (const auto& [base, platform] : scene.legs) all.push_back(base), all.push_back(platform);
  for (const Scene::Arrow& arrow : scene.arrows) all.push_back(arrow.from);
  Eigen::Vector3d low = all[0], high = all[0];
  for (const Eigen::Vector3d& p : all) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

// position: of the words, so that two frames in one place can both be read.
void AddFrame(const char* name,
              const Pose3d& world_from_frame,
              double length,
              const char* position,
              Json* data) {
  constexpr const char* kColours[3] = {"@before", "@good", "@after"};
  for (int k = 0; k < 3; ++k) {
    const Points axis = {world_from_frame.translation,
                         world_from_frame * Eigen::Vector3d(length * Eigen::Vector3d::Unit(k))};
    Json trace = SpaceTrace(name, "lines+text", axis, 0, kColours[k]);
    trace["text"] = Json::array({k == 0 ? name : "", std::string(1, "xyz"[k])});
    trace["textfont"] = {{"size", 11}};
    trace["textposition"] = position;
    trace["showlegend"] = false;
    data->push_back(trace);
  }
}

Json Ellipsoid(const Scene& scene, double factor) {
  const Eigenvalues axes = DecomposeSymmetric(scene.covariance);
  const double reach = std::sqrt(ChiSquareQuantile(0.95, 3.0));
  const Eigen::Matrix3d root =
      axes.vectors * (factor * reach * axes.values.cwiseMax(0.0).cwiseSqrt()).asDiagonal();
  Points rings;
  for (int i = 1; i < kCircles; ++i)
    for (int k = 0; k <= kMeridians; ++k) {
      const double polar = 0.5 * kTurn * i / kCircles, around = kTurn * k / kMeridians;
      rings.push_back(scene.world_from_tool.translation +
                      root * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                             std::sin(polar) * std::sin(around),
                                             std::cos(polar)));
    }
  Json trace = SpaceTrace(
      fmt::format("95 % ellipsoid, {} times", factor), "lines", rings, kMeridians + 1, "@floor");
  trace["line"]["width"] = 1;
  return trace;
}

std::vector<bool> UsedOf(const Scene& scene) {
  std::vector<bool> used;
  for (const Scene::Arrow& arrow : scene.arrows) used.push_back(arrow.used);
  return used;
}

HtmlTable ArrowTable(const Scene& scene) {
  HtmlTable table = {{{"pose"}, {"x, mm", true}, {"y, mm", true}, {"z, mm", true}}, {}};
  const bool has_before = !scene.arrows.empty() && scene.arrows.front().before.has_value();
  if (has_before)
    for (const char* axis : {"before, x, mm", "y, mm", "z, mm"})
      table.columns.push_back({axis, true});
  for (const Scene::Arrow& arrow : scene.arrows) {
    std::vector<std::string> row = {arrow.label};
    for (const double x : arrow.along) row.push_back(MilliText(x));
    if (arrow.before)
      for (const double x : *arrow.before) row.push_back(MilliText(x));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

Scene MakeScene(const Dataset& dataset,
                const Observations& observations,
                const Estimate& estimate) {
  Scene scene;
  const Observation& shown = observations.items[MiddleOf(observations)];
  const BaseAndTool& mounts = estimate.mounts;
  scene.label = shown.label;
  scene.world_from_base = mounts.world_from_base;
  scene.world_from_platform = mounts.world_from_base * shown.base_from_platform;
  scene.world_from_tool = scene.world_from_platform * mounts.platform_from_tool;
  if (dataset.hexapod)
    for (int leg = 0; leg < kNumLegs; ++leg)
      scene.legs.emplace_back(
          scene.world_from_base * Eigen::Vector3d(dataset.hexapod->base_joints_in_base.col(leg)),
          scene.world_from_platform *
              Eigen::Vector3d(dataset.hexapod->platform_joints_in_platform.col(leg)));
  if (dataset.measurement->kind == Measurement::Kind::kMarkers)
    for (int b = 0; b < 2; ++b) {
      const MarkerBody& body = dataset.measurement->bodies[b];
      const Pose3d world_from_body = b == 0 ? Pose3d{} : scene.world_from_tool;
      for (Eigen::Index k = 0; k < body.p_in_body.cols(); ++k)
        scene.markers.emplace_back((b == 0 ? "base/" : "tool/") + body.markers[k],
                                   world_from_body * Eigen::Vector3d(body.p_in_body.col(k)));
    }
  CHECK_EQ(estimate.poses.size(), observations.items.size());
  const std::size_t stride = StrideOf(observations.items.size());
  for (std::size_t i = 0; i < observations.items.size(); i += stride) {
    const Observation& o = observations.items[i];
    const Pose3d predicted =
        mounts.world_from_base * o.base_from_platform * mounts.platform_from_tool;
    scene.arrows.push_back(
        {o.label,
         predicted.translation,
         predicted.rotation * Eigen::Vector3d(estimate.poses[i].residual.head<3>()),
         {},
         estimate.poses[i].weight > 0.0});
  }
  const Eigen::Matrix<double, 3, 12> j =
      TargetJacobian(mounts, shown.base_from_platform, Eigen::Vector3d::Zero());
  scene.covariance = j * estimate.covariance * j.transpose();
  return scene;
}

Scene MakeScene(const Dataset& dataset, const Discovery& discovery) {
  Estimate estimate = discovery.estimate;
  CHECK_EQ(estimate.poses.size(), discovery.poses.size());
  for (std::size_t i = 0; i < discovery.poses.size(); ++i)
    estimate.poses[i].residual = discovery.poses[i].after;
  Scene scene = MakeScene(dataset, discovery.observations, estimate);
  if (discovery.effects.empty()) return scene;
  const std::size_t stride = StrideOf(discovery.poses.size());
  for (std::size_t i = 0; i < scene.arrows.size(); ++i) {
    const Eigen::Quaterniond world_from_tool =
        discovery.observations.items[i * stride].world_from_tool.rotation;
    scene.arrows[i].before =
        world_from_tool * Eigen::Vector3d(discovery.poses[i * stride].before.head<3>());
  }
  return scene;
}

Chart SceneChart(const Scene& scene) {
  const double size = SizeOf(scene);
  const bool has_before = !scene.arrows.empty() && scene.arrows.front().before.has_value();
  double longest = 0.0;
  for (const Scene::Arrow& arrow : scene.arrows)
    longest = std::max({longest, arrow.along.norm(), arrow.before.value_or(arrow.along).norm()});
  const double arrows = RoundFactor(kArrowPart * size / longest);
  const double widest = std::sqrt(DecomposeSymmetric(scene.covariance).values[2]);
  const double ellipsoid = RoundFactor(kEllipsoidPart * size / widest);

  Chart chart;
  chart.is_in_space = true;
  chart.title = "The machine, and what is left over";
  chart.shows = fmt::format(
      "frames W, B, A and T{}{} at pose {} (mm, frame W); for every pose the tool's predicted "
      "place "
      "and how far the measured one is off{}, {} times enlarged{}.",
      scene.legs.empty() ? "" : ", legs",
      scene.markers.empty() ? "" : ", markers",
      scene.label,
      has_before ? ", before and after what was found" : "",
      arrows,
      widest > 0.0 ? fmt::format("; the ellipsoid, {} times enlarged, holds the predicted tool "
                                 "with 95 %",
                                 ellipsoid)
                   : "");
  chart.shows += LeftOutNote(UsedOf(scene));
  chart.good =
      "arrows in all directions. Neighbours that point the same way mean that the model misses "
      "something; a long, thin ellipsoid says along which direction the poses tell least.";
  AddFrame("W", {}, 0.12 * size, "bottom right", &chart.data);
  AddFrame("B", scene.world_from_base, 0.12 * size, "top left", &chart.data);
  AddFrame("A", scene.world_from_platform, 0.08 * size, "bottom left", &chart.data);
  AddFrame("T", scene.world_from_tool, 0.08 * size, "top right", &chart.data);
  Points legs, ends, ends_before, places, markers;
  for (const auto& [base, platform] : scene.legs) legs.push_back(base), legs.push_back(platform);
  Json names = Json::array(), labels = Json::array();
  for (const auto& [name, p] : scene.markers)
    markers.push_back(p), names.push_back(EscapeLabel(name));
  for (const Scene::Arrow& arrow : scene.arrows) {
    places.push_back(arrow.from);
    ends.push_back(arrow.from), ends.push_back(arrow.from + arrows * arrow.along);
    if (has_before)
      ends_before.push_back(arrow.from),
          ends_before.push_back(arrow.from + arrows * arrow.before.value_or(arrow.along));
    labels.push_back(EscapeLabel(arrow.label));
  }
  if (!legs.empty()) chart.data.push_back(SpaceTrace("legs", "lines+markers", legs, 2, "@other"));
  if (!markers.empty()) {
    Json trace = SpaceTrace("markers", "markers", markers, 0, "@ink");
    trace["text"] = names, trace["hoverinfo"] = "text";
    chart.data.push_back(trace);
  }
  Json trace = SpaceTrace("poses, as predicted", "markers", places, 0, "@after");
  trace["text"] = labels, trace["hoverinfo"] = "text", trace["marker"]["size"] = 2;
  MarkLeftOut(UsedOf(scene), &trace, "x");
  chart.data.push_back(trace);
  if (has_before)
    chart.data.push_back(
        SpaceTrace(fmt::format("before, {} times", arrows), "lines", ends_before, 2, "@before"));
  chart.data.push_back(
      SpaceTrace(fmt::format("{}, {} times", has_before ? "after" : "left over", arrows),
                 "lines",
                 ends,
                 2,
                 has_before ? "@after" : "@before"));
  if (widest > 0.0) chart.data.push_back(Ellipsoid(scene, ellipsoid));
  chart.layout = SpaceLayout(chart.data);
  chart.table = ArrowTable(scene);
  return chart;
}

}  // namespace hexcal
