// SPDX-License-Identifier: BSD-3-Clause
#include "report/frame_graph.h"

#include <fmt/format.h>

#include "report/html/escape.h"

namespace hexcal {
namespace {

// The chain stands on the right, the world at the bottom as it does in the workshop.
constexpr int kLeft = 150, kWidth = 204, kHeight = 40, kFirst = 56, kStep = 92, kAxis = 172;
constexpr std::size_t kLongestName = 24;  // of a point, characters

enum class Link { kEstimated, kKnown, kMeasured };

std::string StrokeOf(Link link) {
  switch (link) {
    case Link::kEstimated:
      return R"svg(stroke="var(--link)" stroke-width="3")svg";
    case Link::kKnown:
      return R"svg(stroke="currentColor" stroke-width="1.5")svg";
    case Link::kMeasured:
      break;
  }
  return R"svg(stroke="var(--muted)" stroke-width="1.5" stroke-dasharray="5 4")svg";
}

std::string_view MarkerOf(Link link) {
  return link == Link::kEstimated ? "tip-estimated"
         : link == Link::kKnown   ? "tip-known"
                                  : "tip-measured";
}

// path: SVG's path data.
std::string Arrow(Link link, std::string_view path) {
  return fmt::format("<path d=\"{}\" fill=\"none\" {} marker-end=\"url(#{})\"/>\n",
                     path,
                     StrokeOf(link),
                     MarkerOf(link));
}

std::string Tip(Link link, std::string_view colour) {
  return fmt::format(
      "<marker id=\"{}\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"10\" "
      "markerHeight=\"10\" markerUnits=\"userSpaceOnUse\" orient=\"auto\">"
      "<path d=\"M0 0L10 5L0 10z\" fill=\"{}\"/></marker>\n",
      MarkerOf(link),
      colour);
}

std::string Text(int x, int y, std::string_view text, bool is_strong = false, bool is_pale = true) {
  return fmt::format("<text x=\"{}\" y=\"{}\"{}{}>{}</text>\n",
                     x,
                     y,
                     is_strong ? " font-weight=\"600\" font-size=\"15\"" : "",
                     is_strong || !is_pale ? "" : " fill=\"var(--muted)\"",
                     EscapeHtml(text));
}

// A frame: its letter and what it is.
std::string Box(int x, int y, int width, std::string_view letter, std::string_view name) {
  return fmt::format(
             "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"6\" fill=\"var(--panel)\" "
             "stroke=\"var(--line)\"/>\n",
             x,
             y,
             width,
             kHeight) +
         Text(x + 12, y + 26, letter, true) + Text(x + 36, y + 25, name, false, false);
}

int YOf(int level) { return kFirst + kStep * level; }  // 0: the tool

// Up the chain, from a frame to the one above it.
std::string Rung(int level, Link link, std::string_view transform, std::string_view what) {
  const int from = YOf(level + 1), to = YOf(level) + kHeight;
  return Arrow(link, fmt::format("M{0} {1}L{0} {2}", kAxis, from, to)) +
         Text(kAxis + 14, to + 22, transform, false, false) + Text(kAxis + 14, to + 38, what);
}

std::string Shortened(const std::string& name) {
  std::size_t characters = 0, end = 0;
  for (; end < name.size(); ++end)
    if ((static_cast<unsigned char>(name[end]) & 0xC0) != 0x80 && ++characters > kLongestName)
      break;
  return end == name.size() ? name : name.substr(0, end) + "…";
}

std::string Points(const FrameGraph& graph) {
  if (graph.points.empty()) return "";
  const int y = kFirst - 34;
  std::string text = "point: " + Shortened(graph.points[0]);
  if (graph.points.size() > 1) text += fmt::format(" and {} more", graph.points.size() - 1);
  return Arrow(Link::kKnown, fmt::format("M{0} {1}L{0} {2}", kAxis, kFirst, y + 6)) +
         fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"currentColor\"/>\n", kAxis, y) +
         Text(kAxis + 14, y + 5, text, false, false);
}

std::string Markers(std::size_t count, const char* body) {
  return fmt::format("{} marker{} of", count, count == 1 ? "" : "s") + std::string("\n") + body;
}

// Two lines under each other, at the left edge.
std::string SideText(int y, std::string_view text) {
  const std::size_t end = text.find('\n');
  return Text(4, y, text.substr(0, end)) + Text(4, y + 15, text.substr(end + 1));
}

// How the tool is seen from the world.
std::string Measured(const FrameGraph& graph) {
  const int tool = YOf(0) + kHeight / 2, world = YOf(3) + kHeight / 2, middle = (tool + world) / 2;
  if (!graph.markers || (*graph.markers)[0] == 0)
    return Arrow(Link::kMeasured,
                 fmt::format("M{0} {1}C40 {1} 40 {2} {0} {2}", kLeft, world, tool)) +
           (graph.markers ? SideText(middle - 8, Markers((*graph.markers)[1], "the tool"))
                          : SideText(middle - 8, "T_T^W\nmeasured"));
  const int top = middle - kHeight / 2, bottom = middle + kHeight / 2;
  return Arrow(Link::kMeasured,
               fmt::format("M56 {0}C56 {1} 90 {2} {3} {2}", top, top - 80, tool, kLeft)) +
         Arrow(Link::kMeasured,
               fmt::format("M56 {0}C56 {1} 90 {2} {3} {2}", bottom, bottom + 80, world, kLeft)) +
         Box(4, top, 104, "M", "tracker") +
         (graph.tracker_is_static ? Text(4, bottom + 17, "stood still") : "") +
         SideText(tool - 12, Markers((*graph.markers)[1], "the tool")) +
         SideText(world + 6, Markers((*graph.markers)[0], "the base"));
}

std::string Legend(int y) {
  std::string svg;
  for (const auto& [link, text] : {std::pair{Link::kEstimated, "estimated, with covariance"},
                                   std::pair{Link::kKnown, "known: told by robot or user"},
                                   std::pair{Link::kMeasured, "measured, with noise"}}) {
    svg += Arrow(link, fmt::format("M{} {}l44 0", 74, y - 4)) + Text(128, y, text);
    y += 20;
  }
  return svg;
}

std::string_view WorldOf(const FrameGraph& graph) {
  if (!graph.markers) return "world of the poses";
  return (*graph.markers)[0] == 0 ? "world: the tracker" : "world: base markers";
}

}  // namespace

FrameGraph FrameGraphOf(const Dataset& dataset, std::vector<std::string> points) {
  FrameGraph graph;
  const Measurement& measurement = *dataset.measurement;
  if (measurement.kind == Measurement::Kind::kMarkers)
    graph.markers = {{measurement.bodies[0].markers.size(), measurement.bodies[1].markers.size()}};
  graph.tracker_is_static = dataset.tracker.is_static;
  graph.are_leg_lengths = dataset.robot_poses.are_leg_lengths;
  graph.points = std::move(points);
  return graph;
}

Drawing FrameGraphDrawing(const FrameGraph& graph) {
  Drawing drawing;
  drawing.title = "Frames and what is known between them";
  drawing.shows =
      "the loop W → B → A → T that is closed by the measurement, T_T^W = T_B^W T_A^B T_T^A (Eq. "
      "1). An arrow from X to Y stands for the transform T_Y^X, which maps points of Y into X.";
  drawing.good =
      "a loop with two links that are estimated: any error of a link that counts as known is "
      "taken for noise, or goes into those two.";
  const int height = YOf(3) + kHeight + 86;
  drawing.width = 360;
  drawing.height = height;
  drawing.svg = "<defs>\n" + Tip(Link::kEstimated, "var(--link)") +
                Tip(Link::kKnown, "currentColor") + Tip(Link::kMeasured, "var(--muted)") +
                "</defs>\n" + Measured(graph) + Points(graph) +
                Rung(0, Link::kEstimated, "T_T^A", "platform_from_tool") +
                Rung(1,
                     Link::kKnown,
                     "T_A^B",
                     graph.are_leg_lengths ? "by leg lengths" : "as the robot says") +
                Rung(2, Link::kEstimated, "T_B^W", "world_from_base") +
                Box(kLeft, YOf(0), kWidth, "T", graph.markers ? "tool markers" : "tool") +
                Box(kLeft, YOf(1), kWidth, "A", "mobile platform") +
                Box(kLeft, YOf(2), kWidth, "B", "base of the hexapod") +
                Box(kLeft, YOf(3), kWidth, "W", WorldOf(graph)) + Legend(height - 52);
  return drawing;
}

}  // namespace hexcal
