// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/robot_poses_reader.h"

#include <fmt/format.h>

#include "measurement/labels.h"
#include "measurement/noise_reader.h"
#include "measurement/pose_columns.h"

namespace hexcal {
namespace {

void CheckLegsWithinLimits(const RobotPose& pose,
                           const HexapodGeometry& hexapod,
                           const TableReader& table) {
  if (!hexapod.leg_limits) return;
  const double shortest = (*hexapod.leg_limits)[0], longest = (*hexapod.leg_limits)[1];
  for (int leg = 0; leg < kNumLegs; ++leg) {
    const double length = pose.leg_lengths[leg];
    if (length >= shortest && length <= longest) continue;
    throw InputError(
        table.CellLocation(table.Column(fmt::format("l{}", leg + 1))),
        fmt::format("leg {} of pose {} at {:.6g} m", leg + 1, Quoted(pose.label), length),
        fmt::format("a length within leg_limits, {:.6g} to {:.6g} m", shortest, longest));
  }
}

void ReadNoise(const YamlNode& node, const ReadContext& context, RobotPoses& robot_poses) {
  if (robot_poses.are_leg_lengths) {
    const MapReader map(node, "the noise of leg lengths", {"leg"});
    robot_poses.leg_noise = context.units.length * ReadSigma(map.Required("leg"), "a leg length");
  } else {
    robot_poses.noise = ReadPoseNoise(node, context.units);
  }
}

// Where each declared covariate stands in the table.
std::vector<int> CovariateColumns(const TableReader& table,
                                  const std::vector<CovariateDeclaration>& covariates) {
  std::vector<int> columns;
  for (const CovariateDeclaration& covariate : covariates) {
    columns.push_back(table.Column(covariate.name));
    if (columns.back() < 0)
      throw InputError(covariate.where,
                       fmt::format("the covariate {} without a column in the table of robot_poses",
                                   Quoted(covariate.name)),
                       fmt::format("a column '{}', or no declaration of it", covariate.name));
  }
  return columns;
}

void WarnOfDegrees(const RobotPose& pose, const TableReader& table, const ReadContext& context) {
  context.warnings->push_back(
      fmt::format("{}: pose {} has an angle of more than a turn; is `angle: rad` right?",
                  table.RowLocation().ToString(),
                  Quoted(pose.label)));
}

void ReadRows(TableReader& table,
              const PoseColumns& columns,
              const std::vector<CovariateDeclaration>& covariates,
              const HexapodGeometry* hexapod,
              const ReadContext& context,
              RobotPoses& robot_poses) {
  const int label_column = table.Column("pose");
  const std::vector<int> covariate_columns = CovariateColumns(table, covariates);
  bool has_warned = false;
  while (table.Next()) {
    RobotPose pose;
    pose.label = table.Text(label_column);
    pose.leg_lengths = {};
    pose.line = table.RowLocation().line;
    CheckLabel(pose.label, table.CellLocation(label_column), "pose label");
    if (robot_poses.are_leg_lengths) {
      pose.leg_lengths = columns.ReadLegs(table, context.units);
      CheckLegsWithinLimits(pose, *hexapod, table);
    } else {
      pose.base_from_platform = columns.ReadPose(table, context.units);
      if (!has_warned && context.units.angle == 1 &&
          (has_warned = columns.HasLargeAngle(table, context.units)))
        WarnOfDegrees(pose, table, context);
    }
    for (std::size_t i = 0; i < covariates.size(); ++i) {
      const double value = table.Number(covariate_columns[i]);
      CheckCovariateValue(covariates[i].name, value, table.CellLocation(covariate_columns[i]));
      robot_poses.covariates[i].values.push_back(covariates[i].unit.factor * value);
    }
    robot_poses.rows.push_back(std::move(pose));
  }
}

}  // namespace

RobotPoses ReadRobotPoses(const YamlNode& node,
                          const std::vector<CovariateDeclaration>& covariates,
                          const HexapodGeometry* hexapod,
                          const ReadContext& context) {
  const MapReader map(node, "robot_poses", {"file", "rows", "noise"});
  TableReader table = OpenTable(map, "robot_poses", context);
  std::vector<std::string_view> names;
  for (const CovariateDeclaration& covariate : covariates) names.push_back(covariate.name);
  const PoseColumns columns(table, true, names);

  RobotPoses robot_poses;
  robot_poses.where = table.where();
  robot_poses.are_leg_lengths = columns.set() == PoseColumns::Set::kLegs;
  if (robot_poses.are_leg_lengths && hexapod == nullptr)
    throw InputError(table.HeaderLocation(table.Column("l1")),
                     "leg lengths, but no hexapod: in the dataset",
                     "hexapod: with its joints, or poses in place of leg lengths");
  for (const CovariateDeclaration& covariate : covariates)
    robot_poses.covariates.push_back({covariate.name, covariate.unit, {}});
  if (const YamlNode* noise = map.Optional("noise")) ReadNoise(*noise, context, robot_poses);
  ReadRows(table, columns, covariates, hexapod, context, robot_poses);
  if (robot_poses.rows.empty())
    throw InputError(table.where(), "a table without rows", "a row for each robot pose");
  return robot_poses;
}

}  // namespace hexcal
