// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/swapped_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "estimator/rounding_noise.h"
#include "geometry/align_points.h"
#include "model/data_fault.h"

namespace hexcal {
namespace {

constexpr int kFirstLook = 6;        // poses that tell whether a pair is worth the whole look
constexpr double kFarBetter = 0.25;  // of the squared misfit, and still left with the names right
constexpr double kClear = 40.0;      // of 2 ln likelihood, as for other faults
constexpr double kExact = 1e-20;     // of the squares: rounding
constexpr std::size_t kMostSwaps = 3;

// Squared misfit of each body in its known shape, and the coordinates beyond the six of a body.
struct Misfit {
  std::array<double, 2> squares = {};
  std::array<int, 2> freedom = {};
};

// The bodies that two markers are of.
struct Touched {
  bool base = false, tool = false;
  double Squares(const Misfit& m) const {
    return (base ? m.squares[0] : 0.0) + (tool ? m.squares[1] : 0.0);
  }
  int Freedom(const Misfit& m) const {
    return (base ? m.freedom[0] : 0) + (tool ? m.freedom[1] : 0);
  }
};

class Bodies {
 public:
  explicit Bodies(const Measurement& measurement) : bodies_(measurement.bodies) {
    double size = 0.0;
    for (const MarkerReading& reading : measurement.readings) {
      if (seen_.emplace(reading.pose, seen_.size()).second) poses_.push_back(reading.pose);
      size = std::max(size, reading.p_in_tracker.norm());
    }
    rounding_ = kRoundingsOfNoise * std::numeric_limits<double>::epsilon() * size;
  }

  Misfit Of(const Measurement& measurement, int every) const {
    std::map<std::pair<int, int>, std::vector<const MarkerReading*>> frames;
    for (const MarkerReading& reading : measurement.readings)
      if (seen_.at(reading.pose) % every == 0)
        frames[{reading.pose, reading.frame}].push_back(&reading);
    Misfit misfit;
    for (const auto& [key, readings] : frames)
      for (const BodyId body : {BodyId::kBase, BodyId::kTool}) Add(readings, body, &misfit);
    return misfit;
  }

  int poses() const { return static_cast<int>(poses_.size()); }

  // Of one coordinate, m^2: less is the rounding of the readings.
  double LeastSquare() const { return rounding_ * rounding_; }

 private:
  void Add(const std::vector<const MarkerReading*>& readings, BodyId body, Misfit* misfit) const {
    const Eigen::Matrix3Xd& shape = bodies_[static_cast<int>(body)].p_in_body;
    Eigen::Matrix3Xd seen(3, readings.size()), known(3, readings.size());
    Eigen::Index count = 0;
    for (const MarkerReading* reading : readings) {
      if (reading->body != body) continue;
      seen.col(count) = reading->p_in_tracker;
      known.col(count++) = shape.col(reading->marker);
    }
    if (count < 3) return;
    seen.conservativeResize(3, count), known.conservativeResize(3, count);
    if (!(PlanarSpread(known) > 0.0) || !(PlanarSpread(seen) > 0.0)) return;
    const Pose3d tracker_from_body = AlignPoints(seen, known);
    for (Eigen::Index i = 0; i < count; ++i)
      misfit->squares[static_cast<int>(body)] +=
          (seen.col(i) - tracker_from_body * Eigen::Vector3d(known.col(i))).squaredNorm();
    misfit->freedom[static_cast<int>(body)] += static_cast<int>(3 * count - 6);
  }

  const std::array<MarkerBody, 2>& bodies_;
  std::map<int, std::size_t> seen_;  // place of each pose in the order of the readings
  std::vector<int> poses_;
  double rounding_ = 0.0;
};

Effect Swap(int first, int second) {
  Effect effect;
  effect.name = "swapped_markers";
  effect.parameters.resize(0);
  effect.index = {first, second};
  return effect;
}

// The pair whose names, put right, leave least.
std::optional<FaultFound> FindOne(const Measurement& measurement) {
  const Bodies bodies(measurement);
  const int in_base = static_cast<int>(measurement.bodies[0].markers.size());
  const int markers = in_base + static_cast<int>(measurement.bodies[1].markers.size());
  const int every = std::max(1, bodies.poses() / kFirstLook);
  const Misfit first_look = bodies.Of(measurement, every), whole = bodies.Of(measurement, 1);
  std::optional<FaultFound> best;
  for (int a = 1; a <= markers; ++a)
    for (int b = a + 1; b <= markers; ++b) {
      const Effect effect = Swap(a, b);
      const Touched touched = {a <= in_base, b > in_base};
      const double before = touched.Squares(whole);
      if (before <= touched.Freedom(whole) * bodies.LeastSquare()) continue;
      const Measurement mended = MendedMeasurement(measurement, {effect});
      if (touched.Squares(bodies.Of(mended, every)) > kFarBetter * touched.Squares(first_look))
        continue;
      const double left = touched.Squares(bodies.Of(mended, 1));
      if (left > kFarBetter * before) continue;
      const double gain =
          touched.Freedom(whole) * std::log(before / std::max(left, kExact * before));
      if (gain > kClear && (!best || gain > best->gain)) best = FaultFound{effect, gain};
    }
  return best;
}

}  // namespace

std::vector<FaultFound> FindSwappedMarkers(const Dataset& dataset) {
  std::vector<FaultFound> found;
  if (!dataset.measurement || dataset.measurement->kind != Measurement::Kind::kMarkers)
    return found;
  Measurement measurement = *dataset.measurement;
  if (measurement.bodies[0].is_centroid || measurement.bodies[1].is_centroid) return found;
  while (found.size() < kMostSwaps) {
    const std::optional<FaultFound> one = FindOne(measurement);
    if (!one) break;
    measurement = MendedMeasurement(measurement, {one->effect});
    found.push_back(*one);
  }
  return found;
}

}  // namespace hexcal
