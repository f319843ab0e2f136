// SPDX-License-Identifier: BSD-3-Clause
#include "model/described_effect.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z", "rx", "ry", "rz"};

double NumberOf(const Effect& effect, const std::string& name) {
  const auto found = effect.reference.find(name);
  CHECK(found != effect.reference.end()) << "an unknown effect without its " << name;
  return found->second[0];
}

}  // namespace

const std::vector<std::string>& DriverNames() {
  static const std::vector<std::string> names = {
      "time", "temperature", "payload", "leg_length", "x", "y", "z", "rx", "ry", "rz"};
  return names;
}

bool IsDriverName(const std::string& driver) {
  return std::count(DriverNames().begin(), DriverNames().end(), driver) > 0;
}

Vector6d DriverOf(const Visit& visit, const std::string& driver) {
  if (driver == "leg_length") return visit.lengths;
  if (driver == "time") return Vector6d::Constant(std::isnan(visit.time) ? visit.row : visit.time);
  if (driver == "temperature") return Vector6d::Constant(visit.temperature);
  if (driver == "payload") return Vector6d::Constant(visit.payload);
  const Pose3d& pose = visit.base_from_platform;
  for (int k = 0; k < 6; ++k)
    if (driver == kAxes[k])
      return Vector6d::Constant(k < 3 ? pose.translation[k] : Log(pose.rotation)[k - 3]);
  const auto other = visit.others.find(driver);
  return Vector6d::Constant(other != visit.others.end() ? other->second
                                                        : std::numeric_limits<double>::quiet_NaN());
}

Effect DescribedEffect(const std::string& site,
                       const std::string& driver,
                       int power,
                       double centre,
                       double half_range) {
  CHECK(site == "base" || site == "tool" || site == "leg") << site;
  Effect effect;
  effect.name = std::string(kUnknownEffect);
  effect.parameters = Vector6d::Zero();
  effect.found = {{"site", site}, {"driver", driver}};
  effect.reference = {
      {"centre", {centre}}, {"half_range", {half_range}}, {"power", {static_cast<double>(power)}}};
  return effect;
}

Effect PoseMapEffect(const PoseMap& map) {
  Effect effect;
  effect.name = std::string(kUnknownEffect);
  effect.found = {{"site", "platform"}, {"driver", "pose"}};
  const Eigen::MatrixXd slopes = map.coefficients.rightCols(map.coefficients.cols() - 1);
  effect.parameters = Eigen::Map<const Eigen::VectorXd>(slopes.data(), slopes.size());
  std::vector<double> reference(Pose3d::kNumParameters);
  map.reference.ToParameters(reference.data());
  const auto numbers = [](const Vector6d& v) {
    return std::vector<double>(v.data(), v.data() + 6);
  };
  effect.reference = {{"degree", {static_cast<double>(map.degree)}},
                      {"reference", reference},
                      {"centre", numbers(map.centre)},
                      {"half_width", numbers(map.half_width)}};
  return effect;
}

bool IsPoseMap(const Effect& effect) {
  const auto site = effect.found.find("site");
  return effect.name == kUnknownEffect && site != effect.found.end() && site->second == "platform";
}

PoseMap PoseMapOf(const Effect& effect) {
  PoseMap map;
  map.degree = static_cast<int>(NumberOf(effect, "degree"));
  map.reference = Pose3d::FromParameters(effect.reference.at("reference").data());
  map.centre = Eigen::Map<const Vector6d>(effect.reference.at("centre").data());
  map.half_width = Eigen::Map<const Vector6d>(effect.reference.at("half_width").data());
  map.coefficients.setZero(6, PoseMapTermCount(map.degree));
  const Eigen::Index terms = map.coefficients.cols() - 1;
  map.coefficients.rightCols(terms) =
      Eigen::Map<const Eigen::MatrixXd>(effect.parameters.data(), 6, terms);
  return map;
}

void AddDescribed(const Effect& effect,
                  const Eigen::VectorXd& factor,
                  const Visit& visit,
                  Corrections<double>* corrections) {
  if (effect.found.count("site") == 0) return;  // nothing is said of it
  const std::string& site = effect.found.at("site");
  if (IsPoseMap(effect)) {
    const PoseMap map = PoseMapOf(effect);
    const Eigen::VectorXd terms = PoseMapTerms(map, visit.base_from_platform);
    const Eigen::Map<const Eigen::MatrixXd> by_term(factor.data(), 6, factor.size() / 6);
    corrections->platform_twist += by_term * terms.tail(terms.size() - 1);
    return;
  }
  const Vector6d driver = DriverOf(visit, effect.found.at("driver"));
  const Vector6d unit =
      (driver.array() - NumberOf(effect, "centre")) / NumberOf(effect, "half_range");
  const Vector6d sum = factor.cwiseProduct(unit.array().pow(NumberOf(effect, "power")).matrix());
  if (site == "base")
    corrections->base_twist += sum;
  else if (site == "tool")
    corrections->tool_twist += sum;
  else
    corrections->leg += sum;
}

}  // namespace hexcal
