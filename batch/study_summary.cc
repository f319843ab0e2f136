// SPDX-License-Identifier: BSD-3-Clause
#include "batch/study_summary.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "batch/csv.h"
#include "batch/study_result.h"

namespace hexcal {
namespace {

// The mean of what is there.
class Mean {
 public:
  void Add(double x) {
    if (std::isnan(x)) return;
    sum_ += x;
    ++count_;
  }
  double operator()() const {
    return count_ > 0 ? sum_ / static_cast<double>(count_)
                      : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0.0;
  std::int64_t count_ = 0;
};

struct Tally {
  std::int64_t done = 0, untrusted = 0, failed = 0;
  Mean rms_position, rms_position_measured, rms_orientation, ellipsoid, all_named, false_names,
      iterations;
  std::array<Mean, 12> error, square, covered;
  std::vector<Mean> rmspe;
};

// Where the columns are that a summary reads.
class Columns {
  std::vector<Column> all_;

  static std::vector<Column> AllOf(int records) {
    std::vector<Column> all = {{"status", CellKind::kText}, {"message", CellKind::kText}};
    for (const Column& column : StudyColumns(records)) all.push_back(column);
    return all;
  }
  std::size_t At(std::string_view name) const {
    const auto found = std::find_if(
        all_.begin(), all_.end(), [name](const Column& column) { return column.name == name; });
    CHECK(found != all_.end()) << name;
    return static_cast<std::size_t>(found - all_.begin());
  }

 public:
  explicit Columns(int records) : all_(AllOf(records)), rmspe(records > 0 ? At("rmspe_0") : 0) {}

  const std::size_t rmspe;  // where there are records
  const std::size_t iterations = At("iterations");
  const std::size_t rms_position = At("rms_position");
  const std::size_t rms_position_measured = At("rms_position_measured");
  const std::size_t rms_orientation = At("rms_orientation");
  const std::size_t error = At("error_base_dx");  // of 12
  const std::size_t half_width = At("half_width_base_dx");
  const std::size_t squared_distance = At("squared_distance");
  const std::size_t ellipsoid = At("ellipsoid");
  const std::size_t false_names = At("false_names");
  const std::size_t hidden = At("hidden");
  const std::size_t named = At("named");
};

double Number(const Row& row, std::size_t at) {
  if (const auto* real = std::get_if<double>(&row.cells[at])) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&row.cells[at]))
    return static_cast<double>(*whole);
  return std::numeric_limits<double>::quiet_NaN();
}

// 1 or 0; NaN where either is not known.
double IsWithin(double value, double limit) {
  if (std::isnan(value) || std::isnan(limit)) return std::numeric_limits<double>::quiet_NaN();
  return value <= limit ? 1.0 : 0.0;
}

void AddRow(const Columns& columns, const Row& row, Tally* tally) {
  const std::string& status = std::get<std::string>(row.cells[0]);
  if (status == NameOf(RowStatus::kFailed)) {
    ++tally->failed;
    return;
  }
  for (std::size_t k = 0; k < tally->rmspe.size(); ++k)
    tally->rmspe[k].Add(Number(row, columns.rmspe + k));
  tally->iterations.Add(Number(row, columns.iterations));
  if (status == NameOf(RowStatus::kUntrusted)) {
    ++tally->untrusted;
    return;
  }
  ++tally->done;
  tally->rms_position.Add(Number(row, columns.rms_position));
  tally->rms_position_measured.Add(Number(row, columns.rms_position_measured));
  tally->rms_orientation.Add(Number(row, columns.rms_orientation));
  for (std::size_t i = 0; i < 12; ++i) {
    const double error = Number(row, columns.error + i);
    tally->error[i].Add(error);
    tally->square[i].Add(error * error);
    tally->covered[i].Add(IsWithin(std::abs(error), Number(row, columns.half_width + i)));
  }
  tally->ellipsoid.Add(
      IsWithin(Number(row, columns.squared_distance), Number(row, columns.ellipsoid)));
  const double false_names = Number(row, columns.false_names);
  if (std::isnan(false_names)) return;
  const double hidden = Number(row, columns.hidden);
  if (hidden > 0) tally->all_named.Add(Number(row, columns.named) == hidden ? 1.0 : 0.0);
  tally->false_names.Add(false_names > 0 ? 1.0 : 0.0);
}

StudySummary SummaryOf(const Tally& tally, const StudyCell& cell, const StudyEstimator& estimator) {
  StudySummary s;
  s.cell = &cell;
  s.estimator = &estimator;
  s.done = tally.done;
  s.untrusted = tally.untrusted;
  s.failed = tally.failed;
  s.rms_position = tally.rms_position();
  s.rms_position_measured = tally.rms_position_measured();
  s.rms_orientation = tally.rms_orientation();
  Mean coverage;
  for (int i = 0; i < 12; ++i) {
    s.bias[i] = tally.error[i]();
    s.rms_error[i] = std::sqrt(tally.square[i]());
    s.coverage[i] = tally.covered[i]();
    coverage.Add(s.coverage[i]);
  }
  s.mean_coverage = coverage();
  s.ellipsoid_coverage = tally.ellipsoid();
  s.all_named = tally.all_named();
  s.false_names = tally.false_names();
  s.iterations = tally.iterations();
  for (const Mean& mean : tally.rmspe) s.rmspe.push_back(mean());
  return s;
}

std::string NumberText(double x) { return std::isnan(x) ? "" : fmt::format("{}", x); }

std::string Scaled(double x, double factor, int digits) {
  return std::isnan(x) ? "-" : fmt::format("{:.{}f}", factor * x, digits);
}

}  // namespace

std::vector<StudySummary> Summarise(const Study& study, Store* store) {
  const std::size_t estimators = study.estimators.size();
  std::vector<Tally> tallies(study.cells.size() * estimators);
  for (Tally& tally : tallies) tally.rmspe.resize(study.records);
  const Columns columns(study.records);
  // Tasks run over the cells, rows of a task over the estimators.
  store->ForEach([&](const Row& row) {
    AddRow(columns, row, &tallies[static_cast<std::size_t>(row.index) % tallies.size()]);
  });
  std::vector<StudySummary> summaries;
  for (std::size_t i = 0; i < tallies.size(); ++i)
    summaries.push_back(
        SummaryOf(tallies[i], study.cells[i / estimators], study.estimators[i % estimators]));
  return summaries;
}

std::string SummaryCsv(const std::string& study, const std::vector<StudySummary>& summaries) {
  std::string text =
      "study,scenario,noise,poses,effects,estimator,done,untrusted,failed,rms_position,"
      "rms_position_measured,rms_orientation,coverage,ellipsoid_coverage,all_named,false_names,"
      "iterations";
  for (const char* what : {"bias", "rms_error", "coverage"})
    for (const ParameterInfo& p : kParameters) {
      std::string name = fmt::format(",{}_{}", what, p.name);
      std::replace(name.begin(), name.end(), '.', '_');
      text += name;
    }
  for (std::size_t k = 0; k < summaries[0].rmspe.size(); ++k) text += fmt::format(",rmspe_{}", k);
  text += "\n";
  for (const StudySummary& s : summaries) {
    text += fmt::format("{},{},{},{},{},{},{},{},{}",
                        study,
                        s.cell->scenario,
                        s.cell->noise,
                        s.cell->PosesADraw(),
                        s.cell->effects,
                        s.estimator->name,
                        s.done,
                        s.untrusted,
                        s.failed);
    for (const double x : {s.rms_position,
                           s.rms_position_measured,
                           s.rms_orientation,
                           s.mean_coverage,
                           s.ellipsoid_coverage,
                           s.all_named,
                           s.false_names,
                           s.iterations})
      text += "," + NumberText(x);
    for (const Vector12d* numbers : {&s.bias, &s.rms_error, &s.coverage})
      for (const double x : *numbers) text += "," + NumberText(x);
    for (const double x : s.rmspe) text += "," + NumberText(x);
    text += "\n";
  }
  return text;
}

std::string SummaryTable(const std::string& study, const std::vector<StudySummary>& summaries) {
  std::string text = fmt::format(
      "{}\n\n  {:<16}{:>6}{:>6}{:>8}  {:<13}{:>7}{:>7}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>8}\n"
      "  {:<16}{:>6}{:>6}{:>8}  {:<13}{:>7}{:>7}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>8}\n",
      study,
      "scenario",
      "noise",
      "poses",
      "effects",
      "estimator",
      "done",
      "not",
      "position",
      "to meas.",
      "orient.",
      "in 95 %",
      "in all",
      "named",
      "false",
      "",
      "",
      "",
      "",
      "",
      "",
      "",
      "mm",
      "mm",
      "mrad",
      "%",
      "%",
      "%",
      "%");
  for (const StudySummary& s : summaries)
    text += fmt::format(
        "  {:<16}{:>6}{:>6}{:>8}  {:<13}{:>7}{:>7}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>8}\n",
        s.cell->scenario,
        s.cell->noise,
        s.cell->PosesADraw(),
        s.cell->effects,
        s.estimator->name,
        s.done,
        s.untrusted + s.failed,
        Scaled(s.rms_position, 1e3, 4),
        Scaled(s.rms_position_measured, 1e3, 4),
        Scaled(s.rms_orientation, 1e3, 4),
        Scaled(s.mean_coverage, 100.0, 1),
        Scaled(s.ellipsoid_coverage, 100.0, 1),
        Scaled(s.all_named, 100.0, 1),
        Scaled(s.false_names, 100.0, 1));
  return text;
}

}  // namespace hexcal
