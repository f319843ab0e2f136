// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/tool_pose.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/align_points.h"
#include "measurement/marker_body.h"

namespace hexcal {
namespace {

constexpr int kMinPoses = 3;
constexpr int kMinMarkers = 3;
// A body whose seen markers spread less than this part of its size is as good as collinear.
constexpr double kCollinear = 1e-3;

// The mean of a marker's readings in one pose, and how many there were.
struct MeanReading {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;

  void Add(const Eigen::Vector3d& p) { sum += p, ++count; }
};

using BodyReadings = std::vector<MeanReading>;  // by marker

// The markers of a body that were seen: columns of equal index belong together.
struct SeenMarkers {
  Eigen::Matrix3Xd p_in_tracker, p_in_body, sigma;
};

SeenMarkers Select(const BodyReadings& readings,
                   const MarkerBody& body,
                   const Eigen::Vector3d& sigma) {
  std::vector<int> seen;
  for (int m = 0; m < static_cast<int>(readings.size()); ++m)
    if (readings[m].count > 0) seen.push_back(m);
  const auto n = static_cast<Eigen::Index>(seen.size());
  SeenMarkers markers{Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n), Eigen::Matrix3Xd(3, n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const MeanReading& mean = readings[seen[k]];
    markers.p_in_tracker.col(k) = mean.sum / mean.count;
    markers.sigma.col(k) = sigma / std::sqrt(static_cast<double>(mean.count));
    if (!body.is_centroid) markers.p_in_body.col(k) = body.p_in_body.col(seen[k]);
  }
  return markers;
}

// The body's frame, or nothing and the reason: is_collinear, else too few markers.
std::optional<Alignment> FitBody(const BodyReadings& readings,
                                 const MarkerBody& body,
                                 const Eigen::Vector3d& sigma,
                                 bool* is_collinear,
                                 std::string* reason) {
  *is_collinear = false;
  const SeenMarkers seen = Select(readings, body, sigma);
  if (seen.p_in_tracker.cols() < kMinMarkers) {
    *reason = fmt::format("only {} of its {} markers were seen, {} are needed",
                          seen.p_in_tracker.cols(),
                          readings.size(),
                          kMinMarkers);
    return std::nullopt;
  }
  const Eigen::Matrix3Xd& shape = body.is_centroid ? seen.p_in_tracker : seen.p_in_body;
  const double size = (shape.colwise() - shape.rowwise().mean().eval()).norm();
  if (!(PlanarSpread(shape) > kCollinear * size)) {
    *is_collinear = true;
    *reason = "the markers that were seen are collinear";
    return std::nullopt;
  }
  if (body.is_centroid) return CentroidFrame(seen.p_in_tracker, seen.sigma, body.x_axis);
  return AlignPointsWeighted(seen.p_in_tracker, seen.p_in_body, seen.sigma);
}

const char* BodyName(BodyId body) { return body == BodyId::kBase ? "base" : "tool"; }

// Eqs. (36)-(41), with the covariance of both bodies carried to the right of the product.
void SetWorldFromTool(const Alignment& tracker_from_world,
                      const Alignment& tracker_from_tool,
                      bool world_is_common,
                      ToolPose* tool) {
  tool->world_from_tool = tracker_from_world.a_from_b.Inverse() * tracker_from_tool.a_from_b;
  tool->covariance = tracker_from_tool.covariance;
  if (world_is_common) return;
  const Matrix6d carry = InverseAdjoint(tool->world_from_tool);
  tool->covariance += carry * tracker_from_world.covariance * carry.transpose();
}

class MarkersToPoses {
 public:
  explicit MarkersToPoses(const Dataset& dataset)
      : dataset_(dataset), measurement_(*dataset.measurement) {
    for (int b = 0; b < 2; ++b)
      readings_[b].resize(dataset.robot_poses.rows.size(),
                          BodyReadings(measurement_.bodies[b].markers.size()));
    for (const MarkerReading& r : measurement_.readings)
      readings_[static_cast<int>(r.body)][r.pose][r.marker].Add(r.p_in_tracker);
    result_.has_covariance = measurement_.marker_sigma.has_value();
    sigma_ = measurement_.marker_sigma.value_or(Eigen::Vector3d::Ones());
  }

  ToolPoses Run() {
    if (measurement_.bodies[0].markers.empty())
      common_world_ = Alignment();  // W is the tracker's frame
    else if (dataset_.tracker.is_static)
      FitCommonWorld();
    for (int pose = 0; pose < static_cast<int>(dataset_.robot_poses.rows.size()); ++pose)
      AddPose(pose);
    return std::move(result_);
  }

 private:
  // The tracker stood still: all readings of the base markers make one frame.
  void FitCommonWorld() {
    BodyReadings all(measurement_.bodies[0].markers.size());
    for (const BodyReadings& pose : readings_[0])
      for (std::size_t m = 0; m < pose.size(); ++m) {
        all[m].sum += pose[m].sum;
        all[m].count += pose[m].count;
      }
    std::string reason;
    bool is_collinear = false;
    common_world_ = FitBody(all, measurement_.bodies[0], sigma_, &is_collinear, &reason);
    if (!common_world_)
      throw InputError(measurement_.where,
                       "a base body whose frame cannot be found: " + reason,
                       "three base markers that are not collinear");
    result_.tracker_from_world = common_world_->a_from_b;
    const double variance = result_.has_covariance ? 1.0 : BaseVariance(all);
    result_.tracker_from_world_covariance = variance * common_world_->covariance;
  }

  // Of one coordinate of a base marker, m^2: from the scatter of its readings, where no noise was
  // stated.
  double BaseVariance(const BodyReadings& all) {
    double sum = 0.0;
    int redundant = 0;
    for (const MarkerReading& r : measurement_.readings)
      if (r.body == BodyId::kBase)
        sum += (r.p_in_tracker - all[r.marker].sum / all[r.marker].count).squaredNorm();
    for (const MeanReading& marker : all) redundant += std::max(marker.count - 1, 0);
    if (redundant > 0) return sum / (3.0 * redundant);
    result_.warnings.emplace_back(
        "every base marker was read only once and no noise is stated: the covariance of the base "
        "is without the error of these readings");
    return 0.0;
  }

  std::optional<Alignment> Fit(BodyId body, int pose) {
    std::string reason;
    bool is_collinear = false;
    const int b = static_cast<int>(body);
    auto fit = FitBody(readings_[b][pose], measurement_.bodies[b], sigma_, &is_collinear, &reason);
    if (fit) return fit;
    result_.left_out.push_back({pose, body, is_collinear});
    result_.warnings.push_back(fmt::format("pose '{}' is left out: of the {} body, {}",
                                           dataset_.robot_poses.rows[pose].label,
                                           BodyName(body),
                                           reason));
    return fit;
  }

  bool HasReadings(int pose) const {
    for (const auto& body : readings_)
      for (const MeanReading& marker : body[pose])
        if (marker.count > 0) return true;
    return false;
  }

  void AddPose(int pose) {
    if (!HasReadings(pose)) return;
    const bool common = common_world_.has_value();
    const std::optional<Alignment> world = common ? common_world_ : Fit(BodyId::kBase, pose);
    const std::optional<Alignment> tool =
        world ? Fit(BodyId::kTool, pose) : std::optional<Alignment>();
    if (!world || !tool) return;
    ToolPose measured;
    measured.pose = pose;
    SetWorldFromTool(*world, *tool, common, &measured);
    result_.poses.push_back(measured);
  }

  const Dataset& dataset_;
  const Measurement& measurement_;
  Eigen::Vector3d sigma_;
  std::array<std::vector<BodyReadings>, 2> readings_;  // by body, pose
  std::optional<Alignment> common_world_;
  ToolPoses result_;
};

ToolPoses FromMeasuredPoses(const Measurement& measurement) {
  ToolPoses result;
  result.has_covariance = measurement.pose_noise.has_value();
  result.poses.reserve(measurement.poses.size());
  for (const MeasuredPose& measured : measurement.poses) {
    ToolPose tool{measured.pose, measured.world_from_tool, Matrix6d::Zero()};
    if (result.has_covariance) tool.covariance = measurement.pose_noise->Covariance();
    result.poses.push_back(tool);
  }
  const auto stands_before = [](const ToolPose& a, const ToolPose& b) { return a.pose < b.pose; };
  if (!std::is_sorted(result.poses.begin(), result.poses.end(), stands_before))
    std::sort(result.poses.begin(), result.poses.end(), stands_before);
  return result;
}

}  // namespace

ToolPoses ComputeToolPoses(const Dataset& dataset) {
  const Measurement& measurement = dataset.measurement.value();
  ToolPoses result = measurement.kind == Measurement::Kind::kPoses ? FromMeasuredPoses(measurement)
                                                                   : MarkersToPoses(dataset).Run();
  if (static_cast<int>(result.poses.size()) < kMinPoses) {
    std::string found = fmt::format("{} poses whose tool frame is known", result.poses.size());
    for (const std::string& warning : result.warnings) found += "; " + warning;
    throw InputError(measurement.where, found, fmt::format("at least {}", kMinPoses));
  }
  return result;
}

}  // namespace hexcal
