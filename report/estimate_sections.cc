// SPDX-License-Identifier: BSD-3-Clause
#include "report/estimate_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/rotation_angles.h"
#include "report/accuracy_charts.h"
#include "report/correlation.h"
#include "report/quantity.h"
#include "report/result_table.h"

namespace hexcal {
namespace {

constexpr const char* kNumbers[6] = {
    "x,\u00a0mm", "y,\u00a0mm", "z,\u00a0mm", "rx,\u00a0mrad", "ry,\u00a0mrad", "rz,\u00a0mrad"};

constexpr const char* kNotDetermined = "not determined";

// Standard and expanded uncertainty of one number, k and ν, as columns have them.
std::vector<std::string> UncertaintyCells(bool is_known,
                                          double sigma,
                                          const NumberInterval& interval) {
  if (!is_known || !std::isfinite(sigma)) return {kNotDetermined, kNotDetermined, "–", "–"};
  if (IsRounding(sigma)) return {MilliText(sigma), "–", "–", "–"};
  const double dof = interval.degrees_of_freedom;
  return {MilliText(sigma),
          MilliText(interval.half_width),
          CoverageFactorText(interval.half_width, sigma),
          std::isfinite(dof) ? fmt::format("{:.0f}", dof) : "∞"};
}

std::vector<HtmlTable::Column> WithUncertainty(std::vector<HtmlTable::Column> columns) {
  for (const char* heading : {"u", "U, p = 95 %", "k", "ν"}) columns.push_back({heading, true});
  return columns;
}

// A mount as the six numbers of Eq. (2).
HtmlTable MountTable(const Estimate& estimate, bool is_base) {
  const Pose3d& pose =
      is_base ? estimate.mounts.world_from_base : estimate.mounts.platform_from_tool;
  const int first = is_base ? 0 : 6;
  const Vector6d values = VectorFromPose(pose);
  const Vector6d sigmas = PoseVectorSigma(pose, estimate.covariance.block<6, 6>(first, first));
  const Matrix6d by_motion = PoseVectorByMotion(pose);
  const std::array<bool, 12> determined = DeterminedNumbers(estimate.observability);
  HtmlTable table = {WithUncertainty({{""}, {"value of Eq. (2)", true}}), {}};
  for (int i = 0; i < 6; ++i) {
    Vector12d weights = Vector12d::Zero();
    weights.segment<6>(first) = by_motion.row(i);
    table.rows.push_back({kNumbers[i], MilliText(values[i])});
    const auto cells =
        UncertaintyCells(determined[first + i],
                         sigmas[i],
                         IntervalOf(estimate.intervals, estimate.covariance, weights));
    table.rows.back().insert(table.rows.back().end(), cells.begin(), cells.end());
  }
  return table;
}

// The 12 small motions along and about the mounts' own axes.
HtmlTable MotionTable(const Estimate& estimate) {
  HtmlTable table = {WithUncertainty({{""}}), {}};
  for (int i = 0; i < 12; ++i) {
    table.rows.push_back(
        {fmt::format("{}, {}", kParameters[i].name, kParameters[i].is_angle ? "mrad" : "mm")});
    const auto cells = UncertaintyCells(
        estimate.observability.determined[i],
        std::sqrt(estimate.covariance(i, i)),
        {estimate.intervals.half_width[i], estimate.intervals.degrees_of_freedom[i]});
    table.rows.back().insert(table.rows.back().end(), cells.begin(), cells.end());
  }
  return table;
}

std::string QuaternionText(const Pose3d& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format(
      "quaternion (w, x, y, z): {:.9f}, {:.9f}, {:.9f}, {:.9f}", q.w(), q.x(), q.y(), q.z());
}

// A flag a line, for a shell: a printed line that is too long breaks after a hyphen.
std::string OverLines(const std::string& call) {
  std::string text;
  bool is_quoted = false;
  for (std::size_t i = 0; i < call.size(); ++i) {
    if (!is_quoted && call[i] == '\\')
      text += call[i++];  // and what it escapes
    else if (call[i] == '\'')
      is_quoted = !is_quoted;
    if (!is_quoted && call.compare(i, 3, " --") == 0) text += " \\\n ";
    text += call[i];
  }
  return text;
}

}  // namespace

void AddMounts(const Estimate& estimate, HtmlPage* page) {
  page->Section("Results");
  page->Heading("Base in world, T_B^W");
  page->Table(MountTable(estimate, true));
  page->Note(QuaternionText(estimate.mounts.world_from_base));
  page->Heading("Tool on platform, T_T^A");
  page->Table(MountTable(estimate, false));
  page->Note(QuaternionText(estimate.mounts.platform_from_tool));
  page->Note(
      "u is the standard uncertainty of the number in its row and U = k u its expanded "
      "uncertainty: "
      "the truth lies within U of it with p = 95 %, each number by itself (coverage factor k of "
      "Student's t with ν degrees of freedom; where few poses told the noise, k has in it what the "
      "weights' own error adds). Dashes: only the rounding of the numbers is left over, of which "
      "no U "
      "is stated.");
  page->Heading("Small motions along and about the mounts' own axes");
  page->Table(MotionTable(estimate));
  page->Note(
      "What the covariance of result.json, the correlations below and the budget are of: not of "
      "the "
      "numbers of Eq. (2), whose axes are W's and A's, but of a small motion of the base along and "
      "about the axes of B, of the tool those of T. The best estimate of each motion is zero.");
  page->Figure(CorrelationChart(estimate));
  std::vector<std::string> strong;
  for (const Correlation& c : StrongCorrelations(estimate))
    strong.push_back(
        fmt::format("{} and {}: {:.3f}", kParameters[c.a].name, kParameters[c.b].name, c.value));
  page->Heading("Strong correlations and weak directions");
  if (strong.empty())
    page->Paragraph("No two parameters are correlated by more than 0.9.");
  else
    page->List(strong);
  const Observability& observability = estimate.observability;
  if (observability.weak_directions.empty())
    page->Paragraph(fmt::format(
        "The poses determine all 12 parameters; condition number of the scaled Jacobian {:.3g}.",
        observability.condition_number));
  else
    page->Paragraph("The poses do not determine:");
  page->List(observability.weak_directions);
}

void AddReproduction(const RunRecord& record,
                     const std::vector<std::string>& warnings,
                     std::string_view files,
                     HtmlPage* page) {
  if (!warnings.empty()) {
    page->Section("Warnings");
    page->List(warnings);
  }
  page->Section("How to reproduce");
  page->Paragraph(fmt::format(
      "The same build, input and seed give the same {} beside this report, with every number of "
      "it.",
      files));
  if (!record.call.empty()) {
    page->Code(OverLines(record.call));
    page->Note("Paths that do not begin with / are of the folder in which it was run.");
  }
  HtmlTable settings = {{{"setting"}, {"value"}}, {}};
  for (const auto& [name, value] : record.settings) {
    const auto not_set = std::find_if(record.not_set.begin(),
                                      record.not_set.end(),
                                      [&name = name](const auto& s) { return s.first == name; });
    if (not_set != record.not_set.end())
      settings.rows.push_back({name, fmt::format("not set ({})", not_set->second)});
    else if (!value.empty())
      settings.rows.push_back({name, value});
  }
  page->Table(settings);
  page->Heading("Inputs");
  page->List(record.inputs);
  page->Heading("Versions");
  page->Code(record.version);
}

}  // namespace hexcal
