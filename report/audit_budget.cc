// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_budget.h"

#include <cmath>
#include <filesystem>
#include <string>

namespace hexcal {
namespace {

std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

std::vector<BudgetRow> BudgetOf(const Audit& audit,
                                const NamedPoint& point,
                                const TargetCovariance& at) {
  std::vector<BudgetRow> rows;
  const double total = at.total.trace();
  const auto add = [&](const std::string& name,
                       const std::string& origin,
                       char type,
                       const Eigen::Matrix3d& share,
                       double dof) {
    rows.push_back({name, origin, type, std::sqrt(share.trace()), share.trace() / total, dof});
  };
  const double freedom = LeastDegreesOfFreedom(audit.estimate);
  if (audit.grown) {
    add("calibration of base and tool",
        "the covariance of the 12 parameters, were the effects known",
        'A',
        at.calibration - at.of_effects,
        freedom);
    add("effects of the model", "the joint covariance: what they add", 'A', at.of_effects, freedom);
  } else {
    add("calibration of base and tool",
        "the covariance of the 12 parameters",
        'A',
        at.calibration,
        freedom);
  }
  std::size_t i = 0;
  const Requirements& stated = audit.requirements;
  if (stated.robot)
    add(stated.robot->source.name,
        stated.robot->origin,
        'B',
        at.shares[i++],
        stated.robot->source.degrees_of_freedom);
  for (const StatedSource& source : stated.sources)
    add(source.source.name, source.origin, 'B', at.shares[i++], source.source.degrees_of_freedom);
  add("the point in frame T",
      point.pivot ? "pivoting, " + FileName(point.pivot->path) : "its standard_deviation",
      point.pivot ? 'A' : 'B',
      at.shares[i],
      point.Source().degrees_of_freedom);
  return rows;
}

}  // namespace hexcal
