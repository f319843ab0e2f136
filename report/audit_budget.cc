// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_budget.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "report/effect_numbers.h"

namespace hexcal {
namespace {

std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

bool Turns(SourceSite site) {
  return site != SourceSite::kPoint && site != SourceSite::kPointInTool;
}

// The rows of one source: its positions, and its orientations where it has any.
class Rows {
 public:
  Rows(const TargetCovariance& at, Budget* budget) : at_(at), budget_(*budget) {}

  void AddCalibration(const std::string& name,
                      const std::string& origin,
                      const Eigen::Matrix3d& share,
                      double degrees_of_freedom) {
    BudgetRow row;
    row.name = name;
    row.origin = origin;
    SetTold(degrees_of_freedom, &row);
    row.value = std::sqrt(std::max(share.trace(), 0.0));
    row.degrees_of_freedom = degrees_of_freedom;
    Add(row);
  }

  // is_fitted: a fit to readings told it, as for the calibration.
  void AddSource(const ErrorSource& source, const std::string& origin, bool is_fitted = false) {
    BudgetRow row;
    row.name = source.name;
    row.origin = origin;
    row.degrees_of_freedom = source.degrees_of_freedom;
    const bool is_uniform = source.spread == Spread1d::kUniform;
    row.spread = is_uniform ? BudgetSpread::kRectangular : BudgetSpread::kNormal;
    if (is_fitted) SetTold(source.degrees_of_freedom, &row);
    row.divisor = is_uniform ? std::sqrt(3.0) : 1.0;
    const Eigen::Vector2d& sensitivity = at_.sensitivities[next_++];
    row.quantity = BudgetQuantity::kPosition;
    row.value = row.divisor * (source.covariance_in_tool
                                   ? std::sqrt(source.covariance_in_tool->trace() / 3.0)
                                   : source.position);
    row.sensitivity = sensitivity[0];
    Add(row);
    if (!Turns(source.site)) return;
    row.quantity = BudgetQuantity::kOrientation;
    row.value = row.divisor * source.orientation;
    row.sensitivity = sensitivity[1];
    Add(row);
  }

 private:
  // Whoever states the noise has evaluated it; only what the data told is of type A.
  static void SetTold(double degrees_of_freedom, BudgetRow* row) {
    const bool is_told = std::isfinite(degrees_of_freedom);
    row->type = is_told ? 'A' : 'B';
    row->spread = is_told ? BudgetSpread::kStudent : BudgetSpread::kNormal;
  }

  void Add(BudgetRow row) {
    row.contribution = row.sensitivity * row.value / row.divisor;
    row.share = row.contribution * row.contribution / at_.total.trace();
    budget_.rows.push_back(std::move(row));
  }

  const TargetCovariance& at_;
  Budget& budget_;
  std::size_t next_ = 0;  // source of at_
};

// Names, units and degrees of freedom; the numbers follow.
std::vector<ParameterRow> NamedParameters(const Audit& audit) {
  std::vector<ParameterRow> rows;
  for (int i = 0; i < 12; ++i) {
    ParameterRow row;
    row.name = kParameters[i].name;
    row.unit = i % 6 < 3 ? "m" : "rad";
    row.degrees_of_freedom = audit.estimate.intervals.degrees_of_freedom[i];
    rows.push_back(row);
  }
  if (!audit.grown) return rows;
  const GrownSolution& solution = audit.grown->solution();
  for (std::size_t e = 0; e < solution.fit.effects.size(); ++e)
    for (const int number : solution.effects[e].free) {
      const Effect& effect = solution.fit.effects[e];
      const EffectKind& kind = *FindEffectKind(effect.name);
      ParameterRow row;
      row.name = effect.name + " " + FreeNumberName(kind, number);
      row.unit = kind.UnitOf(number);
      const Eigen::RowVectorXd one =
          Eigen::RowVectorXd::Unit(audit.grown->size(), static_cast<Eigen::Index>(rows.size()));
      row.degrees_of_freedom =
          audit.grown->FreedomOf(one).value_or(std::numeric_limits<double>::infinity());
      rows.push_back(row);
    }
  return rows;
}

void AddParameters(const Audit& audit, const TargetError::Carried& carried, Budget* budget) {
  const double total =
      (carried.by_parameters * carried.covariance * carried.by_parameters.transpose()).trace();
  budget->parameters = NamedParameters(audit);
  budget->correlations = 1.0;
  Eigen::Index i = 0;
  for (ParameterRow& row : budget->parameters) {
    row.value = std::sqrt(carried.covariance(i, i));
    row.sensitivity = carried.by_parameters.col(i).norm();
    row.contribution = row.sensitivity * row.value;
    row.share = row.contribution * row.contribution / total;
    budget->correlations -= row.share;
    ++i;
  }
}

}  // namespace

std::string_view NameOf(BudgetQuantity quantity) {
  if (quantity == BudgetQuantity::kLength) return "length";
  return quantity == BudgetQuantity::kPosition ? "position" : "orientation";
}

std::string_view NameOf(BudgetSpread spread) {
  if (spread == BudgetSpread::kNormal) return "normal";
  return spread == BudgetSpread::kRectangular ? "rectangular" : "t";
}

std::string LabelOf(const BudgetRow& row) {
  if (row.quantity == BudgetQuantity::kLength) return row.name;
  return row.name + ": " + std::string(NameOf(row.quantity));
}

Budget BudgetOf(const Audit& audit, const NamedPoint& point, const Pose3d& base_from_platform) {
  const TargetError error = ErrorOf(audit, point);
  const TargetCovariance at = error.At(base_from_platform, point.p_in_tool);
  Budget budget;
  Rows rows(at, &budget);
  const double freedom = LeastDegreesOfFreedom(audit.estimate);
  if (audit.grown) {
    rows.AddCalibration("calibration of base and tool",
                        "the covariance of the 12 parameters, were the effects known",
                        at.calibration - at.of_effects,
                        freedom);
    rows.AddCalibration(
        "effects of the model", "the joint covariance: what they add", at.of_effects, freedom);
  } else {
    rows.AddCalibration("calibration of base and tool",
                        "the covariance of the 12 parameters",
                        at.calibration,
                        freedom);
  }
  const Requirements& stated = audit.requirements;
  if (stated.robot) rows.AddSource(stated.robot->source, stated.robot->origin);
  for (const StatedSource& source : stated.sources) rows.AddSource(source.source, source.origin);
  ErrorSource own = point.Source();
  own.name = "the point in frame T";
  rows.AddSource(
      own,
      point.pivot ? "pivoting, " + FileName(point.pivot->path) : "its standard_deviation",
      point.pivot.has_value());
  if (const auto carried = error.CarriedTo(base_from_platform, point.p_in_tool))
    AddParameters(audit, *carried, &budget);
  return budget;
}

}  // namespace hexcal
