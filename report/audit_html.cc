// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/audit_model.h"
#include "report/audit_sections.h"
#include "report/estimate_sections.h"
#include "report/fit_words.h"
#include "report/html/page.h"
#include "report/missing_effects.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kShortId = 12;  // of a report's number, at the foot of a printed page

// Of each coordinate, mm.
std::string DeviationText(const NamedPoint& point) {
  if (!point.pivot) return MilliText(point.standard_deviation);
  const Eigen::Vector3d sigma = 1e3 * point.pivot->covariance.diagonal().cwiseSqrt();
  return fmt::format("{:.4f}, {:.4f}, {:.4f} (pivoting)", sigma.x(), sigma.y(), sigma.z());
}

Tone ToneOf(Compliance compliance) {
  if (compliance == Compliance::kPass) return Tone::kGood;
  return compliance == Compliance::kFail ? Tone::kBad : Tone::kWarn;
}

void AddVerdict(const Audit& audit, HtmlPage* page) {
  std::string sentence;
  for (const Decision& decision : audit.decisions) {
    if (!sentence.empty()) sentence += " ";
    if (audit.decisions.size() > 1)
      sentence += fmt::format("{} ({}): ", decision.requirement.name, NameOf(decision.compliance));
    sentence += decision.reason;
  }
  if (audit.decisions.empty())
    sentence =
        "No requirement was given (--requirement): nothing is decided, everything is measured.";
  page->Verdict(ToneOf(audit.compliance), "verdict", NameOf(audit.compliance), sentence);
  HtmlTable table = {{{"requirement"},
                      {"verdict"},
                      {"point"},
                      {"probability", true},
                      {"limit, mm", true},
                      {"value, mm", true},
                      {"guard band (k = 2), mm", true}},
                     {}};
  std::vector<std::string> places;
  for (const Decision& d : audit.decisions) {
    const bool is_known = d.value > 0.0;
    table.rows.push_back({d.requirement.name,
                          std::string(NameOf(d.compliance)),
                          audit.requirements.points[d.requirement.point].name,
                          ShareText(d.requirement.probability),
                          fmt::format("{:.4g}", 1e3 * d.requirement.limit),
                          is_known ? MilliText(d.value) : "–",
                          is_known ? fmt::format("{:.3g}", 1e3 * d.guard) : "–"});
    if (is_known)
      places.push_back(fmt::format("{}: worst at {}", d.requirement.name, WordsOf(d.worst)));
  }
  if (!table.rows.empty()) {
    page->Table(table);
    page->List(places);
    page->Note(
        "Decision rule, guarded acceptance (JCGM 106:2012, 8.3): PASS where value and guard band "
        "stay "
        "within the limit and nothing below speaks against it; FAIL where the value less the guard "
        "band is beyond the limit; else INCONCLUSIVE. Guard band: twice the standard "
        "uncertainty of the value (k = 2, p = 95 %): of the standard deviations that it is made "
        "of, "
        "by their degrees of freedom (where the noise was stated, those of the residuals that "
        "confirm it), and what repetition has it differ by.");
  }
  if (!audit.doubts.empty()) {
    page->Heading("What keeps a requirement from passing");
    page->List(audit.doubts);
  }
}

// What nobody said is said to be missing: an auditor asks for it.
void AddWhoAndWhere(const Requirements& requirements, const RunRecord& record, HtmlTable* table) {
  const auto is_stated = [&](std::string_view word) {
    return std::any_of(requirements.identification.begin(),
                       requirements.identification.end(),
                       [&](const auto& entry) { return entry.first == word; });
  };
  if (!record.operator_name.empty())
    table->rows.push_back(
        {is_stated("operator") ? "operator (--operator)" : "operator", record.operator_name});
  else if (!is_stated("operator"))
    table->rows.push_back(
        {"operator",
         "not stated (identification: in the requirement file, or --operator with --history)"});
  if (!is_stated("place"))
    table->rows.push_back({"place", "not stated (identification: in the requirement file)"});
}

void AddIdentification(const AuditIdentity& identity,
                       const RunRecord& record,
                       const Audit& audit,
                       HtmlPage* page) {
  page->Section("Identification and inputs");
  HtmlTable table = {{{""}, {""}}, {}};
  table.rows.push_back({"report", identity.id});
  table.rows.push_back({"dataset", audit.header.dataset});
  if (!audit.description.empty()) table.rows.push_back({"description", audit.description});
  for (const auto& [key, value] : audit.requirements.identification)
    table.rows.push_back({key, value});
  AddWhoAndWhere(audit.requirements, record, &table);
  table.rows.push_back({"program",
                        fmt::format("{}, revision {}",
                                    record.version.substr(0, record.version.find('\n')),
                                    record.revision)});
  table.rows.push_back({"run", record.started_utc});
  table.rows.push_back(
      {"took", fmt::format("{:.3g} s, at most {} threads", record.seconds, record.threads)});
  table.rows.push_back(
      {"host",
       fmt::format(
           "{}, {} processors, {}", record.host.name, record.host.processors, record.host.system)});
  table.rows.push_back({"poses measured", fmt::format("{}", audit.estimate.poses.size())});
  page->Table(table);
  HtmlTable files = {{{"input"}, {"SHA-256"}}, {}};
  for (const HashedFile& file : identity.inputs) files.rows.push_back({file.path, file.sha256});
  page->Table(files);
  AddRowCounts(audit, page);
  page->Note(
      "The report's number is the SHA-256 of the inputs' hashes, the settings and result.json; its "
      "first 12 digits are at the foot of every printed page. "
      "What "
      "the dataset and the requirement file state is taken as it stands.");
}

void AddMeasurand(const Audit& audit, HtmlPage* page) {
  page->Section("Measurand and frames");
  page->Paragraph(
      "Measurand: the position of a named point of the tool in frame W where the robot reports a "
      "pose "
      "T_A^B. Its error is predicted minus true position; what is judged is the length of that "
      "error.");
  page->Figure(FrameGraphDrawing(audit.frames));
  page->List(
      {"M: the tracker.",
       "W, the world: the base markers' body (of measured poses: the frame they are given in).",
       "B: the base of the hexapod. A: its mobile platform. T: the tool markers' body.",
       "T_T^W = T_B^W T_A^B T_T^A (Eq. 1): world_from_tool = world_from_base * "
       "base_from_platform * platform_from_tool. T_X^Y maps points of X into Y.",
       "Rotations: Tra(x, y, z) Rot(x, rx) Rot(y, ry) Rot(z, rz) (Eq. 2); quaternions are scalar "
       "first; m and rad in files, mm and mrad here.",
       "A small motion acts on the right of a transform, translation first, in m and rad."});
  HtmlTable points = {{{"point of the tool, frame T"},
                       {"x, mm", true},
                       {"y, mm", true},
                       {"z, mm", true},
                       {"standard uncertainty, mm", true}},
                      {}};
  for (const NamedPoint& point : audit.requirements.points)
    points.rows.push_back({point.name,
                           MilliText(point.p_in_tool.x()),
                           MilliText(point.p_in_tool.y()),
                           MilliText(point.p_in_tool.z()),
                           DeviationText(point)});
  page->Table(points);
}

void AddModel(const Audit& audit, HtmlPage* page) {
  page->Section("Model and assumptions");
  const Estimate& estimate = audit.estimate;
  page->List(
      {std::string("measured = T_B^W T_A^B T_T^A with noise; estimated are 12 numbers, a small "
                   "motion of six for T_B^W and for T_T^A each") +
           (audit.grown ? ", and with them the effects of the model, below."
                        : ". Nothing else of the machine is corrected."),
       fmt::format("Solver: {}.", SolverWords(audit.header)),
       fmt::format("Loss: {}.", LossWords(audit.header)),
       fmt::format("Covariance of the 12: {}.", CovarianceWords(audit.header)),
       audit.global.is_rounding
           ? "Noise of a measured pose: " + std::string(kOnlyRounding) + "."
           : fmt::format("Noise of a measured pose: {} and {} a coordinate, {}.",
                         SizeText(estimate.noise.position, "m"),
                         SizeText(estimate.noise.orientation, "rad"),
                         estimate.noise.estimated ? "estimated from what is left over (type A)"
                                                  : "as the dataset states it (type B)"),
       "Noise is independent from pose to pose and has mean zero. What poses have in common beyond "
       "base and tool (a bent platform, a tracker out of scale) is not in the uncertainty; the "
       "tests "
       "below may show it, and hexcal discover looks for it.",
       audit.robot_is_stated
           ? "The robot's own error is in the budget, as stated."
           : "Nothing is stated of the robot's own error; it is left out, and nothing passes."});
  if (audit.grown) AddModelEffects(audit, page);
}

// On paper; the page itself decides nothing by them.
void AddSignatures(const AuditIdentity& identity, HtmlPage* page) {
  const std::string line(24, '_'), date(12, '_');
  page->Section("Signatures");
  page->Paragraph("Of report " + identity.id + ".");
  page->Table({{{""}, {"name"}, {"date"}, {"signature"}},
               {{"made by", line, date, line},
                {"checked by", line, date, line},
                {"approved by", line, date, line}}});
}

// For programs that are given nothing but the page.
void AddData(const AuditIdentity& identity,
             const Audit& audit,
             std::string_view result,
             HtmlPage* page) {
  constexpr std::size_t kMostBytes = 8 << 20;  // beyond, the page would not open well
  const std::string json = AuditJson(identity, audit);
  page->Heading("For programs");
  if (json.size() + result.size() > kMostBytes)
    return page->Paragraph(
        "audit.json and result.json lie beside this report; of so many poses they are too large to "
        "be in it.");
  page->Paragraph(
      "audit.json and result.json are in this page, too: the texts of its elements \"audit\" and "
      "\"result\", script elements of type application/json.");
  page->Data("audit", json);
  page->Data("result", result);
}

void AddGlossary(HtmlPage* page) {
  page->Section("Words");
  page->List(
      {"Standard uncertainty: one standard deviation. Expanded uncertainty: the half width that "
       "holds "
       "the truth with 95 %. Words are those of JCGM 200:2012 and JCGM 100:2008.",
       "Target registration error: the error of a point other than those that were measured.",
       "Correlation: of the errors of two parameters, from -1 to 1.",
       "Redundancy of a pose: the part of an error of its measurement that shows in its residual.",
       "Documents are named for what was done as they say; this report claims compliance with "
       "none."});
}

}  // namespace

std::string AuditHtml(const AuditIdentity& identity,
                      const RunRecord& record,
                      const Audit& audit,
                      std::string_view result) {
  HtmlPage page(
      "audit",
      "Accuracy audit: " + audit.header.dataset,
      fmt::format("{} poses · how far a point of the tool may be from where it is predicted",
                  audit.estimate.poses.size()));
  page.Footer("hexcal audit: report " + identity.id.substr(0, kShortId));
  AddVerdict(audit, &page);
  AddIdentification(identity, record, audit, &page);
  AddMeasurand(audit, &page);
  AddPoseDesign(audit, &page);
  AddModel(audit, &page);
  AddMounts(audit.estimate, &page);
  AddLinearizedAgainstNonlinear(audit, record.methods, &page);
  AddGoodnessOfFit(audit, &page);
  AddMissingEffects(audit, &page);
  AddBudget(audit, &page);
  AddValidation(audit, &page);
  AddAccuracy(audit, &page);
  AddChange(audit, &page);
  if (identity.log) AddChangeLog(*identity.log, &page);
  AddReproduction(record,
                  audit.estimate.warnings,
                  identity.log
                      ? "result.json, model.yaml and (but for its key history, which grows "
                        "with the store) audit.json"
                      : "result.json, model.yaml and audit.json",
                  &page);
  AddData(identity, audit, result, &page);
  AddGlossary(&page);
  AddSignatures(identity, &page);
  return page.Html();
}

}  // namespace hexcal
