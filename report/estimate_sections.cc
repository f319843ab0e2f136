// SPDX-License-Identifier: BSD-3-Clause
#include "report/estimate_sections.h"

#include <fmt/format.h>

#include <algorithm>
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

// Mounts as the six numbers of Eq. (2), each with one standard deviation.
HtmlTable MountTable(const Estimate& estimate, bool is_base) {
  const Pose3d& pose =
      is_base ? estimate.mounts.world_from_base : estimate.mounts.platform_from_tool;
  const int first = is_base ? 0 : 6;
  const Vector6d values = VectorFromPose(pose);
  const Vector6d sigmas = PoseVectorSigma(pose, estimate.covariance.block<6, 6>(first, first));
  HtmlTable table = {{{""},
                      {"value of Eq. (2)", true},
                      {"u of it", true},
                      {"u along own axis", true},
                      {"U, p = 95 %", true},
                      {"k", true},
                      {"ν", true}},
                     {}};
  for (int i = 0; i < 6; ++i) {
    const int k = first + i;
    const bool is_known = estimate.observability.determined[k];
    const double dof = estimate.intervals.degrees_of_freedom[k];
    const auto number = [&](double value) {
      return is_known && std::isfinite(value) ? MilliText(value) : "not determined";
    };
    table.rows.push_back(
        {kNumbers[i],
         MilliText(values[i]),
         number(sigmas[i]),
         number(std::sqrt(estimate.covariance(k, k))),
         number(estimate.intervals.half_width[k]),
         CoverageFactorText(estimate.intervals.half_width[k], std::sqrt(estimate.covariance(k, k))),
         std::isfinite(dof) ? fmt::format("{:.0f}", dof) : "∞"});
  }
  return table;
}

std::string QuaternionText(const Pose3d& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format(
      "quaternion (w, x, y, z): {:.9f}, {:.9f}, {:.9f}, {:.9f}", q.w(), q.x(), q.y(), q.z());
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
      "Values and the first standard uncertainty u are of the six numbers of Eq. (2). The second u "
      "is of a small motion along or about the mount's own axis, as in the covariance of "
      "result.json, and what follows is of it. Expanded uncertainty U = k u: the truth lies within "
      "it with p = 95 %, each number by itself (coverage factor k of Student's t with ν degrees of "
      "freedom; where few poses told the noise, k has in it what the weights' own error adds).");
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
  if (!record.call.empty()) page->Code(record.call);
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
