// SPDX-License-Identifier: BSD-3-Clause
#include "report/requirement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/nearest_word.h"
#include "config/strict_yaml.h"
#include "config/units.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/requirement/1";
constexpr const char* kAxes[6] = {"x", "y", "z", "rx", "ry", "rz"};
constexpr double kLargest = 1e6;  // m or rad: beyond it no machine is meant

double ReadInRange(const YamlNode& node, std::string_view what, double low, double high) {
  const double value = ReadNumber(node, what);
  if (value < low || value > high)
    throw InputError(
        node.where, fmt::format("{}", value), fmt::format("{}, from {} to {}", what, low, high));
  return value;
}

double ReadSigma(const YamlNode& node, std::string_view what) {
  return ReadInRange(node, fmt::format("the standard deviation of {}", what), 0.0, kLargest);
}

template <typename Value>
Value ReadChoice(const YamlNode& node,
                 const std::vector<std::pair<std::string_view, Value>>& choices) {
  std::string expected;
  for (const auto& [word, value] : choices)
    expected += (expected.empty() ? "" : " or ") + std::string(word);
  const std::string text = ReadText(node, expected);
  for (const auto& [word, value] : choices)
    if (text == word) return value;
  throw InputError(node.where, fmt::format("'{}'", text), expected);
}

Units ReadUnits(const YamlNode& node) {
  const MapReader map(node, "units", {"length", "angle"});
  const auto length = FindLengthUnit(ReadText(map.Required("length"), "m or mm"));
  const auto angle = FindAngleUnit(ReadText(map.Required("angle"), "rad or deg"));
  if (!length) throw InputError(map.Required("length").where, "another unit", "m or mm");
  if (!angle) throw InputError(map.Required("angle").where, "another unit", "rad or deg");
  return {length->factor, angle->factor};
}

class Reader {
 public:
  explicit Reader(const std::string& path)
      : root_(ParseYamlFile(path)),
        map_(root_,
             "the requirement file",
             {"format",
              "units",
              "identification",
              "points",
              "workspace",
              "robot",
              "sources",
              "requirements"}) {
    result_.path = path;
  }

  Requirements Read() {
    const YamlNode& format = map_.Required("format");
    if (ReadText(format, kFormat) != kFormat)
      throw InputError(format.where, Describe(format), fmt::format("'{}'", kFormat));
    units_ = ReadUnits(map_.Required("units"));
    if (const YamlNode* node = map_.Optional("identification")) ReadIdentification(*node);
    for (const YamlNode& node : NotEmpty(map_.Required("points"), "points of the tool"))
      ReadPoint(node);
    if (const YamlNode* node = map_.Optional("workspace")) ReadWorkspace(*node);
    if (const YamlNode* node = map_.Optional("robot")) ReadRobot(*node);
    if (const YamlNode* node = map_.Optional("sources"))
      for (const YamlNode& source : ReadSequence(*node, "a list of sources of error"))
        ReadSource(source);
    for (const YamlNode& node : NotEmpty(map_.Required("requirements"), "requirements"))
      ReadRequirement(node);
    return std::move(result_);
  }

 private:
  static const std::vector<YamlNode>& NotEmpty(const YamlNode& node, const std::string& what) {
    const auto& items = ReadSequence(node, "a list of " + what);
    if (items.empty()) throw InputError(node.where, "an empty list", "one or more " + what);
    return items;
  }

  void ReadIdentification(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::kMap)
      throw InputError(node.where, Describe(node), "a mapping of words to text");
    for (const auto& [key, value] : node.entries)
      result_.identification.emplace_back(key.scalar, ReadText(value));
  }

  void ReadPoint(const YamlNode& node) {
    const MapReader map(node, "a point", {"name", "xyz", "standard_deviation", "pivot"});
    NamedPoint point;
    point.name = ReadText(map.Required("name"), "the name of the point");
    for (const NamedPoint& other : result_.points)
      if (other.name == point.name)
        throw InputError(map.Required("name").where,
                         fmt::format("a second point '{}'", point.name),
                         "a name of its own for each");
    if (const YamlNode* pivot = map.Optional("pivot")) {
      ReadPivot(map, *pivot, &point);
      result_.points.push_back(std::move(point));
      return;
    }
    const auto xyz = ReadNumbers(map.Required("xyz"), 3, "the point in frame T: [x, y, z]");
    point.p_in_tool = units_.length * Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
    if (!(point.p_in_tool.norm() < kLargest))
      throw InputError(
          map.Required("xyz").where, "a point beyond any machine", "a point of the tool");
    if (const YamlNode* sigma = map.Optional("standard_deviation"))
      point.standard_deviation = units_.length * ReadSigma(*sigma, "the point");
    result_.points.push_back(std::move(point));
  }

  void ReadPivot(const MapReader& map, const YamlNode& pivot, NamedPoint* point) const {
    for (const char* key : {"xyz", "standard_deviation"})
      if (const YamlNode* other = map.Optional(key))
        throw InputError(other->where,
                         fmt::format("'{}' beside 'pivot'", key),
                         "one of them: a pivoting says where the point is and how sure that is");
    point->pivot = ReadPivotPoint(pivot, result_.path);
    point->p_in_tool = point->pivot->p_in_tool;
  }

  void ReadWorkspace(const YamlNode& node) {
    const MapReader map(node, "the workspace", {"x", "y", "z", "rx", "ry", "rz"});
    std::array<std::array<double, 2>, 6> box{};
    for (int i = 0; i < 6; ++i) {
      const YamlNode& range = map.Required(kAxes[i]);
      const auto ends =
          ReadNumbers(range, 2, fmt::format("the range of {}: [low, high]", kAxes[i]));
      if (ends[0] > ends[1] || !(std::max(-ends[0], ends[1]) < kLargest))
        throw InputError(range.where,
                         fmt::format("[{}, {}]", ends[0], ends[1]),
                         fmt::format("the range of {}: [low, high]", kAxes[i]));
      const double unit = i < 3 ? units_.length : units_.angle;
      box[i] = {unit * ends[0], unit * ends[1]};
    }
    result_.workspace = box;
  }

  // What robot and sources have in common.
  StatedSource ReadSpread(const MapReader& map, const std::string& name) {
    StatedSource stated;
    stated.source.name = name;
    stated.origin = ReadText(map.Required("from"), "where the value is from, in words");
    if (const YamlNode* position = map.Optional("position"))
      stated.source.position = units_.length * ReadSigma(*position, "a coordinate");
    if (const YamlNode* orientation = map.Optional("orientation"))
      stated.source.orientation = units_.angle * ReadSigma(*orientation, "a turn about an axis");
    if (const YamlNode* distribution = map.Optional("distribution"))
      stated.source.spread = ReadChoice<Spread1d>(
          *distribution, {{"normal", Spread1d::kNormal}, {"uniform", Spread1d::kUniform}});
    if (const YamlNode* dof = map.Optional("degrees_of_freedom"))
      stated.source.degrees_of_freedom =
          ReadInRange(*dof, "the degrees of freedom of the standard deviation", 1.0, 1e9);
    return stated;
  }

  void ReadRobot(const YamlNode& node) {
    const MapReader map(node,
                        "the robot's own error",
                        {"position", "orientation", "distribution", "degrees_of_freedom", "from"});
    map.Required("position");
    map.Required("orientation");
    result_.robot = ReadSpread(map, "robot");
  }

  void ReadSource(const YamlNode& node) {
    const MapReader map(
        node,
        "a source of error",
        {"name", "at", "position", "orientation", "distribution", "degrees_of_freedom", "from"});
    StatedSource stated =
        ReadSpread(map, ReadText(map.Required("name"), "the name of the source of error"));
    stated.source.site = ReadChoice<SourceSite>(map.Required("at"),
                                                {{"platform", SourceSite::kPlatform},
                                                 {"tool", SourceSite::kTool},
                                                 {"world", SourceSite::kWorld},
                                                 {"point", SourceSite::kPoint}});
    if (stated.source.site == SourceSite::kPoint && map.Has("orientation"))
      throw InputError(map.Required("orientation").where,
                       "an orientation at a point",
                       "position alone, or at: platform, tool or world");
    if (!map.Has("position") && !map.Has("orientation"))
      throw InputError(map.where(), "no size", "position, orientation or both");
    result_.sources.push_back(std::move(stated));
  }

  std::size_t PointOf(const YamlNode& node) const {
    const std::string name = ReadText(node, "the name of a point");
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      if (result_.points[i].name == name) return i;
      names.push_back(result_.points[i].name);
    }
    throw InputError(node.where,
                     fmt::format("'{}'", name),
                     fmt::format("the name of one of the points{}", DidYouMean(name, names)));
  }

  void ReadRequirement(const YamlNode& node) {
    const MapReader map(node, "a requirement", {"name", "point", "over", "limit", "probability"});
    Requirement requirement;
    requirement.name = ReadText(map.Required("name"), "the name of the requirement");
    for (const Requirement& other : result_.requirements)
      if (other.name == requirement.name)
        throw InputError(map.Required("name").where,
                         fmt::format("a second requirement '{}'", requirement.name),
                         "a name of its own for each");
    requirement.point = PointOf(map.Required("point"));
    if (const YamlNode* over = map.Optional("over"))
      requirement.over = ReadChoice<Requirement::Places>(
          *over,
          {{"workspace", Requirement::Places::kWorkspace}, {"poses", Requirement::Places::kPoses}});
    requirement.limit =
        units_.length * ReadInRange(map.Required("limit"), "the largest error", 1e-12, kLargest);
    if (const YamlNode* probability = map.Optional("probability"))
      requirement.probability = ReadInRange(*probability, "a probability", 0.5, 0.9999);
    result_.requirements.push_back(std::move(requirement));
  }

  const YamlNode root_;
  const MapReader map_;
  Units units_;
  Requirements result_;
};

}  // namespace

ErrorSource NamedPoint::Source() const {
  if (!pivot) return {name, SourceSite::kPoint, standard_deviation};
  ErrorSource source{name, SourceSite::kPointInTool};
  source.degrees_of_freedom = pivot->degrees_of_freedom;
  source.covariance_in_tool = pivot->covariance;
  return source;
}

Requirements ReadRequirements(const std::string& path) { return Reader(path).Read(); }

}  // namespace hexcal
