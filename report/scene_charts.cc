// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/quantity.h"
#include "report/scene.h"
#include "report/space_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kTurn = 6.283185307179586;
constexpr int kMeridians = 24, kCircles = 12;
// The parts of the poses' box that the longest arrow and the ellipsoid's half axis are drawn at.
constexpr double kArrowPart = 0.2, kEllipsoidPart = 0.12;

double DiagonalOf(const Points& points) {
  Eigen::Vector3d low = points[0], high = points[0];
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

double SizeOfMachine(const Scene& scene) {
  Points all = {scene.world_from_base.translation,
                scene.world_from_platform.translation,
                scene.world_from_tool.translation,
                Eigen::Vector3d::Zero()};
  for (const auto& [base, platform] : scene.legs) all.push_back(base), all.push_back(platform);
  for (const Scene::Arrow& arrow : scene.arrows) all.push_back(arrow.from);
  return DiagonalOf(all);
}

// Of the places where the tool was; of the machine, in part, where that was one place.
double SizeOfCloud(const Scene& scene) {
  constexpr double kLeast = 0.02;
  Points all = {scene.world_from_tool.translation};
  for (const Scene::Arrow& arrow : scene.arrows) all.push_back(arrow.from);
  return std::max(DiagonalOf(all), kLeast * SizeOfMachine(scene));
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
      fmt::format("95 % ellipsoid, {} times", factor), "lines", rings, kMeridians + 1, "@good");
  trace["line"]["width"] = 2;
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
    for (const char* axis : {"before: x, mm", "before: y, mm", "before: z, mm"})
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

// The joints of one end of the legs in their order about z of their frame, closed.
Points OutlineOf(const Scene& scene, bool is_base) {
  const Pose3d frame = (is_base ? scene.world_from_base : scene.world_from_platform).Inverse();
  Points joints;
  for (const auto& [base, platform] : scene.legs) joints.push_back(is_base ? base : platform);
  const auto angle = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d p_in_frame = frame * p;
    return std::atan2(p_in_frame.y(), p_in_frame.x());
  };
  std::sort(joints.begin(), joints.end(), [&](const auto& a, const auto& b) {
    return angle(a) < angle(b);
  });
  joints.push_back(Eigen::Vector3d(joints.front()));
  return joints;
}

void AddMachine(const Scene& scene, Json* data) {
  if (!scene.legs.empty()) {
    Points legs;
    for (const auto& [base, platform] : scene.legs) legs.push_back(base), legs.push_back(platform);
    data->push_back(SpaceTrace("legs", "lines+markers", legs, 2, "@other"));
    data->push_back(SpaceTrace("platform", "lines", OutlineOf(scene, false), 0, "@ink"));
    data->push_back(SpaceTrace("base", "lines", OutlineOf(scene, true), 0, "@muted"));
  }
  if (scene.markers.empty()) return;
  Points markers;
  Json names = Json::array();
  for (const auto& [name, p] : scene.markers)
    markers.push_back(p), names.push_back(EscapeLabel(name));
  Json trace = SpaceTrace("markers", "markers", markers, 0, "@before");
  trace["text"] = names, trace["hoverinfo"] = "text";
  data->push_back(trace);
}

Json Places(const Scene& scene, const char* colour) {
  Points places;
  Json labels = Json::array();
  for (const Scene::Arrow& arrow : scene.arrows) {
    places.push_back(arrow.from);
    labels.push_back(EscapeLabel(arrow.label));
  }
  Json trace = SpaceTrace("poses, as predicted", "markers", places, 0, colour);
  trace["text"] = labels, trace["hoverinfo"] = "text", trace["marker"]["size"] = 2;
  MarkLeftOut(UsedOf(scene), &trace, "x");
  return trace;
}

Json Arrows(const Scene& scene, double factor, bool is_before, const std::string& name) {
  Points ends;
  for (const Scene::Arrow& arrow : scene.arrows) {
    const Eigen::Vector3d along = is_before ? arrow.before.value_or(arrow.along) : arrow.along;
    ends.push_back(arrow.from), ends.push_back(arrow.from + factor * along);
  }
  const bool has_both = scene.arrows.front().before.has_value();
  return SpaceTrace(name, "lines", ends, 2, is_before || !has_both ? "@before" : "@after");
}

bool HasBefore(const Scene& scene) {
  return !scene.arrows.empty() && scene.arrows.front().before.has_value();
}

double LongestOf(const Scene& scene) {
  double longest = 0.0;
  for (const Scene::Arrow& arrow : scene.arrows)
    longest = std::max({longest, arrow.along.norm(), arrow.before.value_or(arrow.along).norm()});
  return longest;
}

Chart MachineChart(const Scene& scene) {
  const double size = SizeOfMachine(scene);
  Chart chart;
  chart.is_in_space = true;
  chart.title = "The machine, and where the tool was";
  chart.shows = fmt::format(
      "frames W, B, A and T{}{} at pose {} (mm, frame W), and the places of the tool at all poses, "
      "as predicted.",
      scene.legs.empty() ? "" : ", legs, outlines of base and platform",
      scene.markers.empty() ? "" : ", markers",
      scene.label);
  chart.shows += LeftOutNote(UsedOf(scene));
  chart.good =
      "the machine as it stands there: the tool on the right side of the platform, the markers "
      "where they are. Poses all in one plane or along a line tell little of the rest.";
  AddFrame("W", {}, 0.12 * size, "bottom right", &chart.data);
  AddFrame("B", scene.world_from_base, 0.12 * size, "top left", &chart.data);
  AddFrame("A", scene.world_from_platform, 0.08 * size, "bottom left", &chart.data);
  AddFrame("T", scene.world_from_tool, 0.08 * size, "top right", &chart.data);
  AddMachine(scene, &chart.data);
  chart.data.push_back(Places(scene, "@after"));
  chart.layout = SpaceLayout(chart.data);
  return chart;
}

Chart CloudChart(const Scene& scene) {
  const double size = SizeOfCloud(scene);
  const double arrows = RoundFactor(kArrowPart * size / LongestOf(scene));
  const double widest = std::sqrt(DecomposeSymmetric(scene.covariance).values[2]);
  const double ellipsoid = RoundFactor(kEllipsoidPart * size / widest);
  const bool has_before = HasBefore(scene);
  Chart chart;
  chart.is_in_space = true;
  chart.title = "What is left over, where the tool was";
  chart.shows = fmt::format(
      "for every pose the tool's predicted place (a dot; mm, frame W) and how far the measured one "
      "is off{}, {} times enlarged{}.{}",
      has_before ? ", before and after what was found" : "",
      arrows,
      widest > 0.0 ? fmt::format("; the ellipsoid about T at pose {}, {} times enlarged, holds the "
                                 "predicted tool with 95 %",
                                 scene.label,
                                 ellipsoid)
                   : "",
      LeftOutNote(UsedOf(scene)));
  chart.good =
      "lines in all directions. Neighbours that point the same way mean that the model misses "
      "something; a long, thin ellipsoid says along which direction the poses tell least.";
  chart.data.push_back(Places(scene, "@muted"));
  if (has_before)
    chart.data.push_back(Arrows(scene, arrows, true, fmt::format("before, {} times", arrows)));
  chart.data.push_back(
      Arrows(scene,
             arrows,
             false,
             fmt::format("{}, {} times", has_before ? "after" : "left over", arrows)));
  if (widest > 0.0) chart.data.push_back(Ellipsoid(scene, ellipsoid));
  AddFrame("T", scene.world_from_tool, 0.15 * size, "top right", &chart.data);
  chart.layout = SpaceLayout(chart.data);
  chart.table = ArrowTable(scene);
  return chart;
}

}  // namespace

std::vector<Chart> SceneCharts(const Scene& scene) {
  if (scene.arrows.empty()) return {MachineChart(scene)};
  return {MachineChart(scene), CloudChart(scene)};
}

}  // namespace hexcal
