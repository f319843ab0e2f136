// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "hidden/hidden_effect.h"

namespace hexcal::hidden {
namespace {

HiddenEffect Named(const std::string& name, const std::string& driver, double largest) {
  HiddenEffect effect;
  effect.name = name;
  effect.right = {name};
  effect.driver = driver;
  effect.parameters = Eigen::VectorXd::Ones(1);
  effect.largest = Eigen::VectorXd::Constant(1, largest);
  return effect;
}

// The tracker misreads a point p by parameter * (what misread says of it in that row).
HiddenEffect Misreading(
    HiddenEffect effect,
    const std::function<Eigen::Vector3d(const Scene&, const Row&, const Eigen::Vector3d&)>& misread,
    Dice* dice) {
  effect.parameters *= dice->Sign();
  effect.add =
      [misread](
          const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->misreadings.push_back(
            [misread, &scene, &row, size = p[0]](const Eigen::Vector3d& point) {
              return Eigen::Vector3d(size * misread(scene, row, point));
            });
      };
  return effect;
}

HiddenEffect Scale(const Scene&, const DetailOptions&, Dice* dice) {
  return Misreading(
      Named("tracker_scale", "position", 5e-3),
      [](const Scene&, const Row&, const Eigen::Vector3d& point) { return point; },
      dice);
}

HiddenEffect DepthScale(const Scene&, const DetailOptions&, Dice* dice) {
  return Misreading(
      Named("tracker_depth_scale", "depth", 1e-2),
      [](const Scene&, const Row&, const Eigen::Vector3d& point) {
        return Eigen::Vector3d(0, 0, point.z());
      },
      dice);
}

HiddenEffect Distortion(const Scene&, const DetailOptions&, Dice* dice) {
  return Misreading(
      Named("tracker_distortion", "off_axis_distance", 5e-2),
      [](const Scene&, const Row&, const Eigen::Vector3d& point) {
        return Eigen::Vector3d(point.head<2>().squaredNorm() *
                               Eigen::Vector3d(point.x(), point.y(), 0));
      },
      dice);
}

// The first readings are off, later ones no longer: the whole tracker, where it stands still for
// all of them (else it hides in its own pose), or its scale.
HiddenEffect Warmup(const Scene& scene, const DetailOptions&, Dice* dice) {
  const double constant = dice->Uniform(0.05, 0.4) * scene.TimeSpan();
  const auto left = [constant](const Scene& of, const Row& row) {
    return std::exp(-(row.time - of.FirstTime()) / constant);
  };
  HiddenEffect effect = Named("tracker_warmup", "time", 5e-3);
  if (scene.tracker_is_static) {
    effect.parameters = dice->Normals(6);
    effect.parameters.tail<3>() *= 0.5;
    effect.largest = Eigen::VectorXd::Constant(6, 5e-3);
    effect.add =
        [left](const Scene& of, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
          additions->tracker_twist += left(of, row) * Six(p);
        };
  } else {
    effect = Misreading(
        effect,
        [left](const Scene& of, const Row& row, const Eigen::Vector3d& point) {
          return Eigen::Vector3d(left(of, row) * point);
        },
        dice);
  }
  effect.fixed = {{"time_constant", constant}};
  return effect;
}

HiddenEffect Marker(const std::string& name, double after, Dice* dice) {
  const int marker = dice->Below(8);  // base body first
  HiddenEffect effect = Named(name, after > 0 ? "time" : "constant", 5e-3);
  effect.parameters = dice->Normals(3);
  effect.largest = Eigen::VectorXd::Constant(3, 5e-3);
  effect.carriers = {marker + 1};
  effect.add = [marker, after](
                   const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
    if (row.time <= after) return;
    Markers* markers = marker < 4 ? &additions->base_markers : &additions->tool_markers;
    markers->col(marker % 4) += p;
  };
  return effect;
}

HiddenEffect MarkerOffset(const Scene&, const DetailOptions&, Dice* dice) {
  return Marker("marker_offset", 0.0, dice);
}

HiddenEffect MarkerShift(const Scene& scene, const DetailOptions&, Dice* dice) {
  const double at = scene.FirstTime() + dice->Uniform(0.2, 0.8) * scene.TimeSpan();
  HiddenEffect effect = Marker("marker_shift", at, dice);
  effect.fixed = {{"time", at}};
  return effect;
}

}  // namespace

std::vector<EffectRow> TrackerEffects() {
  return {{"tracker_scale", Scale},
          {"tracker_depth_scale", DepthScale},
          {"tracker_distortion", Distortion},
          {"tracker_warmup", Warmup},
          {"marker_offset", MarkerOffset},
          {"marker_shift", MarkerShift}};
}

}  // namespace hexcal::hidden
