// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/dataset_comments.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

#include "config/utf8.h"

namespace hexcal {
namespace {

constexpr std::size_t kWidth = 98;
constexpr int kLongest = 4000;

// In lines of comment of at most kWidth, words whole.
std::string Comment(const std::string& text) {
  const std::string clean = Shorten(text, kLongest);  // no line breaks from names in files
  std::string lines, line;
  std::string_view rest = clean;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    const std::string word(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      lines += "# " + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + "# " + line + "\n";
}

std::string MeasurementComment(const Assembled& assembled) {
  const bool markers = assembled.dataset.measurement->kind == Measurement::Kind::kMarkers;
  std::string comment = Comment(fmt::format("What the tracker saw. {}.", assembled.tracker));
  for (const std::string& body : assembled.bodies) comment += Comment(body + ".");
  return comment +
         Comment(markers ? "May be added: 'noise: {sigma: [0.0001, 0.0001, 0.0003]}', 1-sigma of a "
                           "coordinate along the axes of the tracker, m; else it is estimated."
                         : "May be added: 'noise: {position: 0.0001, orientation: 0.001}', 1-sigma "
                           "along the axes of the tool, m and rad; else it is estimated.");
}

// Above the line that begins with the key; nothing where there is none.
void InsertAbove(std::string& text, std::string_view key, const std::string& comment) {
  const std::string line = fmt::format("\n{}:", key);
  const std::size_t at = text.find(line);
  if (at != std::string::npos) text.insert(at + 1, comment);
}

}  // namespace

std::string WithComments(const std::string& dataset_yaml, const Assembled& assembled) {
  std::string text = dataset_yaml;
  InsertAbove(text, "units", Comment("Of this file and of its tables."));
  InsertAbove(text,
              "covariates",
              Comment("Further columns of the table of poses: of what effects may depend on."));
  InsertAbove(text, "hexapod", Comment("Joints B1..B6 on the base and A1..A6 on the platform."));
  std::string robot = Comment(fmt::format("What the robot reported. {}.", assembled.robot));
  if (!assembled.dataset.hexapod)
    robot += Comment(
        "May be added above: 'hexapod:' with the joints' places, without which no leg "
        "is known and discover cannot name effects of legs and joints.");
  InsertAbove(text, "robot_poses", robot);
  InsertAbove(
      text,
      "tracker",
      Comment("static: whether tracker and base stood still throughout, so that one pose of "
              "the tracker serves all readings of the base."));
  if (assembled.dataset.measurement)
    InsertAbove(text, "measurement", MeasurementComment(assembled));
  return text;
}

}  // namespace hexcal
