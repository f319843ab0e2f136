// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/noise_reader.h"

#include <fmt/format.h>

namespace hexcal {
namespace {

// In the dataset's units. Beyond these no instrument is meant, and squares of squares overflow.
constexpr double kSmallestSigma = 1e-20;
constexpr double kLargestSigma = 1e20;

}  // namespace

double ReadSigma(const YamlNode& node, std::string_view what) {
  const double sigma = ReadNumber(node, fmt::format("the 1-sigma of {}", what));
  if (sigma >= kSmallestSigma && sigma <= kLargestSigma) return sigma;
  throw InputError(node.where,
                   fmt::format("{} for the 1-sigma of {}", sigma, what),
                   sigma > 0 ? fmt::format("a number from {} to {}", kSmallestSigma, kLargestSigma)
                             : "a number above zero");
}

Eigen::Vector3d ReadSigmas(const YamlNode& node, std::string_view what) {
  if (node.kind == YamlNode::Kind::kScalar) return Eigen::Vector3d::Constant(ReadSigma(node, what));
  const std::string expected = fmt::format("the 1-sigma of {}: a number, or three", what);
  if (node.kind != YamlNode::Kind::kSequence || node.items.size() != 3)
    throw InputError(node.where, Describe(node), expected);
  return {ReadSigma(node.items[0], what),
          ReadSigma(node.items[1], what),
          ReadSigma(node.items[2], what)};
}

PoseNoise ReadPoseNoise(const YamlNode& node, const Units& units) {
  const MapReader map(node, "the noise of poses", {"position", "orientation"});
  PoseNoise noise;
  noise.position = units.length * ReadSigmas(map.Required("position"), "the position");
  noise.orientation = units.angle * ReadSigmas(map.Required("orientation"), "the orientation");
  return noise;
}

}  // namespace hexcal
