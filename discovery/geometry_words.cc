// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/geometry_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hexcal {
namespace {

constexpr const char* kDecide =
    "to tell them apart: the maker's drawing or a coordinate measuring machine on the joints; "
    "poses "
    "beyond those measured, in the corners of the workspace, tell leg geometry from a map";

std::string Range(const Bound& bound) {
  std::string name = bound.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const bool is_angle = bound.unit == "rad";
  const double by = is_angle ? 180.0 / M_PI : 1.0;
  return fmt::format("{} {:.3g} {} ({:.3g} to {:.3g})",
                     name,
                     by * bound.value,
                     is_angle ? "deg" : bound.unit,
                     by * bound.lower,
                     by * bound.upper);
}

}  // namespace

std::string GeometrySentence(const GeometryClass& geometry) {
  std::string text = fmt::format(
      "Leg geometry, as a class: a symmetric hexapod whose joints and leg zeros are off by some "
      "{:.2g} mm each: ",
      1e3 * geometry.error_size);
  for (std::size_t k = 0; k < geometry.bounds.size(); ++k)
    text += (k > 0 ? ", " : "") + Range(geometry.bounds[k]);
  text += "; in parentheses 95 % bounds, given how its frames lie.";
  if (!geometry.is_complete)
    text += " A map of the pose explains more beside it, so it is not the whole cause.";
  return text;
}

std::vector<Rival> GeometryRivals(const GeometryClass& geometry) {
  const std::string held_out =
      geometry.heldout.rms_position > 0.0
          ? fmt::format("held-out poses to {:.4f} mm by leg geometry, {:.4f} mm by the map",
                        1e3 * geometry.heldout.rms_position,
                        1e3 * geometry.heldout_map.rms_position)
          : "not tried on held-out poses";
  const std::string one_class =
      "one class, leg geometry: without a published hexapod the places of joints and the zeros and "
      "leads of legs cannot be taken apart";
  std::vector<Rival> rivals;
  if (geometry.is_in_model) {
    rivals = {
        {"platform_joint_offset", one_class + "; " + kDecide},
        {"leg_offset", one_class},
        {"leg_gain", one_class},
        {"unknown", fmt::format("a smooth map of the platform over the pose ({})", held_out)}};
  } else {
    rivals = {{"base_joint_offset",
               fmt::format("{}; {}. {}", held_out, GeometrySentence(geometry), kDecide)},
              {"platform_joint_offset", one_class},
              {"leg_offset", one_class},
              {"leg_gain", one_class}};
  }
  return rivals;
}

}  // namespace hexcal
