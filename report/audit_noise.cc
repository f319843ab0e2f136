// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_noise.h"

#include <fmt/format.h>

#include "report/quantity.h"

namespace hexcal {
namespace {

// Axes whose sigmas differ by less than this factor move no number that is shown.
constexpr double kAlike = 1.2;

bool Differ(const Eigen::Vector3d& sigma) { return sigma.maxCoeff() > kAlike * sigma.minCoeff(); }

// By the readings with a sigma for each axis; a fit by poses has none of its own.
bool IsTakenByAxis(const Estimate& estimate) {
  return estimate.noise.marker && Differ(*estimate.noise.marker);
}

// What to state, as the readings have it.
std::string Remedy(const std::optional<AxisNoise>& noise) {
  const std::string state = "state the noise of the measurement (measurement: noise";
  if (!noise) return state + ")";
  return fmt::format(
      "{}: sigma; along the tracker's x, y, z the bodies' markers scatter by {}, {}, {})",
      state,
      SizeText(noise->sigma.x(), "m"),
      SizeText(noise->sigma.y(), "m"),
      SizeText(noise->sigma.z(), "m"));
}

}  // namespace

std::optional<AxisNoise> AxisNoiseOf(const Dataset& dataset, const Observations& observations) {
  if (dataset.measurement->kind != Measurement::Kind::kMarkers || dataset.measurement->marker_sigma)
    return std::nullopt;
  return NoiseWithinBodies(MakeMarkerObservations(dataset, observations));
}

void AddDoubtsOfNoise(const Audit& audit, std::vector<std::string>* doubts) {
  const std::optional<AxisNoise>& noise = audit.axis_noise;
  const bool is_uneven =
      noise && noise->AxesDiffer() && Differ(noise->sigma) && !IsTakenByAxis(audit.estimate);
  if (is_uneven)
    doubts->push_back(
        "the markers' noise is not alike along the tracker's axes, and was taken for alike, as "
        "none "
        "is stated: " +
        Remedy(noise));
  for (const PointReport& report : audit.points)
    if (report.check && report.check->exceeds_stated)
      doubts->push_back(fmt::format(
          "only {} of the repetitions ({}) have the error of {} within the {} that are stated with "
          "95 %{}",
          ShareText(static_cast<double>(report.check->inside_stated) / report.check->draws),
          audit.repeated.words,
          report.point.name,
          SizeText(report.worst.length_95, "m"),
          is_uneven || !audit.estimate.noise.estimated ? "" : ": " + Remedy(noise)));
}

}  // namespace hexcal
