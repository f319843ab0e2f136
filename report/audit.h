// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discovery/screening.h"
#include "estimator/axis_noise.h"
#include "estimator/compare.h"
#include "estimator/grown_target.h"
#include "estimator/pose_check.h"
#include "estimator/target_check.h"
#include "report/accuracy_map.h"
#include "report/audit_readings.h"
#include "report/budget.h"
#include "report/change.h"
#include "report/correlation.h"
#include "report/frame_graph.h"
#include "report/global_test.h"
#include "report/left_over.h"
#include "report/linearity.h"
#include "report/point_validation.h"
#include "report/pose_design.h"
#include "report/repeated_as.h"
#include "report/requirement.h"
#include "report/result_json.h"
#include "report/row_counts.h"
#include "report/scene.h"
#include "report/workspace.h"

namespace hexcal {

enum class Compliance { kNotAsked, kPass, kFail, kInconclusive };
std::string_view NameOf(Compliance compliance);  // none, PASS, FAIL, INCONCLUSIVE

// The error of a point at a place.
struct PointAt {
  Place place;
  double rms = 0.0;
  double length_95 = 0.0;  // not exceeded with 95 %, m
  double by_priors = 0.0;  // share of the calibration's variance that rests on effects' priors
  double degrees_of_freedom = 0.0;  // of the sum
};

// A point of the tool, in the middle of the workspace and where it is worst in it.
struct PointReport {
  NamedPoint point;
  PointAt centre, worst;
  Budget budget;                     // where it is worst
  std::optional<TargetCheck> check;  // there; nothing where the draws could not be made
  PointValidation validation;
  AccuracyMap map;
};

// The decision on a requirement (JCGM 106, guarded acceptance).
struct Decision {
  Requirement requirement;
  Compliance compliance = Compliance::kInconclusive;
  double value = 0.0;  // the length that the error does not exceed, where it is worst, m
  double guard = 0.0;  // twice the standard uncertainty of value, m
  Place worst;
  std::string reason;  // one sentence
};

// Markers of a body, each reading of which has this noise: what they are worth.
struct BodyReport {
  std::string name;
  Eigen::Index markers = 0;
  double sigma = 0.0;                  // of a coordinate, RMS over the axes, m
  double fiducial = 0.0;               // FRE, m
  std::vector<double> at_points = {};  // TRE at the named points; the tool alone
};

// Poses predicted from the others.
struct HeldOutTest {
  double rms_position = 0.0, expected_position = 0.0;        // m
  double rms_orientation = 0.0, expected_orientation = 0.0;  // rad
  int inside = 0, poses = 0;                                 // within their 95 % region
  int fewest = 0;                    // so many at least with a probability of 99 %, were all well
  std::optional<Coverage> coverage;  // of the 95 % regions
};

// All that a report of accuracy says. SI.
struct Audit {
  ResultHeader header;
  std::string description;
  Requirements requirements;
  Workspace workspace;
  std::size_t places = 0;  // of the workspace that were looked at
  bool robot_is_stated = false;
  Estimate estimate;
  Comparison comparison;
  RepeatedAs repeated;         // what the comparison's propagation is of
  std::vector<RowCount> rows;  // of the inputs
  PoseDesign design;
  Linearity linearity;
  FrameGraph frames;
  Scene scene;
  LeftOver left_over;
  GlobalTest global;
  HeldOutTest held_out;
  std::vector<PoseCheck> poses;
  std::optional<ReadingReport> readings;  // of markers; not with effects
  std::vector<Correlation> correlations;  // above 0.9
  std::vector<PointReport> points;
  std::vector<Decision> decisions;
  std::vector<BodyReport> bodies;
  std::optional<AxisNoise> axis_noise;  // of markers whose noise was not stated
  std::optional<Change> change;
  std::shared_ptr<const GrownTarget> grown;  // where effects of a model are in it
  std::vector<ErrorSource> sources;          // with the points' own errors left out
  std::optional<Screening> missing;          // effects that the data may ask for; else why not:
  std::string why_not_screened;
  std::vector<std::string> doubts;  // why nothing may pass
  Compliance compliance = Compliance::kNotAsked;
};

struct AuditInput {
  const Dataset& dataset;
  const Observations& observations;
  NoiseLevels levels;  // of poses, where the dataset states none
  ResultHeader header;
  Estimate estimate;
  Comparison comparison;  // with its draws kept
  std::optional<Requirements> requirements;
  std::optional<EarlierResult> earlier;
  std::uint64_t seed = 1;
  // The model with effects that the estimate was made with; the observations are then its own.
  std::shared_ptr<const GrownTarget> grown = nullptr;
  // At the requirements' points, or at the origin of frame T; else why it was not made.
  std::optional<Screening> missing = std::nullopt;
  std::string why_not_screened = {};
  // What the comparison's propagation repeats; nothing: its reference, or the joint fit of grown.
  std::optional<RepeatedAs> repeated = {};
  int threads = 1;  // the audit does not depend on it
};

Audit MakeAudit(AuditInput input);

// The sources of error of a point: those of the audit and the point's own.
std::vector<ErrorSource> SourcesOf(const Audit& audit, const NamedPoint& point);
TargetError ErrorOf(const Audit& audit, const NamedPoint& point);

}  // namespace hexcal
