// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/described_forms.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "measurement/covariates.h"
#include "model/described_effect.h"

namespace hexcal {
namespace {

// ln of how much less likely a description is beforehand than a name: there are many of them, each
// of them bends to much, and a name that explains nearly as much says more.
constexpr double kLogPrior = -7.0;
constexpr double kShift = 1e-4, kTurn = 2e-4, kLeg = 3e-5;  // prior 1-sigma, m and rad

struct Named {
  const char *site, *driver;
  int power;
};
// What the table has a name for.
constexpr Named kNamed[] = {{"base", "time", 1},
                            {"tool", "time", 1},
                            {"tool", "temperature", 1},
                            {"leg", "leg_length", 1},
                            {"leg", "leg_length", 2}};

bool IsNamed(const std::string& site, const std::string& driver, int power) {
  for (const Named& named : kNamed)
    if (site == named.site && driver == named.driver && power == named.power) return true;
  return false;
}

// Mean and half the range of a driver over the measured poses; false where it does not vary.
bool RangeOf(const std::string& driver,
             const std::vector<Visit>& visits,
             const std::vector<int>& rows,
             double* centre,
             double* half_range) {
  double least = 0.0, most = 0.0, sum = 0.0;
  bool is_first = true;
  for (const int row : rows) {
    const Vector6d values = DriverOf(visits[row], driver);
    if (!values.allFinite()) return false;
    if (is_first) least = most = values[0], is_first = false;
    least = std::min(least, values.minCoeff()), most = std::max(most, values.maxCoeff());
    sum += values.mean();
  }
  *centre = sum / static_cast<double>(rows.size());
  *half_range = 0.5 * (most - least);
  return *half_range > 1e-9 * (1.0 + std::abs(*centre));
}

FormDefinition MakeForm(int family, const Effect& effect, const std::vector<int>& numbers) {
  FormDefinition form;
  form.family = family;
  form.effect = effect;
  form.directions.setZero(6, static_cast<Eigen::Index>(numbers.size()));
  form.scale.resize(static_cast<Eigen::Index>(numbers.size()));
  const bool is_leg = effect.found.at("site") == "leg";
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    form.directions(numbers[k], k) = 1.0;
    form.scale[k] = is_leg ? kLeg : numbers[k] < 3 ? kShift : kTurn;
  }
  return form;
}

void AddFamily(const std::string& site,
               const std::string& driver,
               double centre,
               double half_range,
               FormLibrary* library) {
  const int family = static_cast<int>(library->families.size());
  library->families.push_back({site + " by " + driver, kLogPrior, true});
  const bool is_leg = site == "leg";
  for (int power = 1; power <= 3; ++power) {
    if (IsNamed(site, driver, power)) continue;
    const Effect effect = DescribedEffect(site, driver, power, centre, half_range);
    const double log_prior = -std::log(3.0);
    FormDefinition each = MakeForm(family, effect, {0, 1, 2, 3, 4, 5});
    if (is_leg) each.effect.index = {1, 2, 3, 4, 5, 6};
    each.log_prior = log_prior + (is_leg ? std::log(0.5) : 0.0);
    const int at = static_cast<int>(library->forms.size());
    library->forms.push_back(each);
    for (int leg = 0; is_leg && leg < kNumLegs; ++leg) {
      FormDefinition one = MakeForm(family, effect, {leg});
      one.effect.index = {leg + 1};
      one.log_prior = log_prior + std::log(0.5 / 6.0);
      one.shares = at, one.shares_from = leg;
      library->forms.push_back(one);
    }
  }
}

// The platform's twist as a polynomial of the whole reported pose: what is left for a cause that
// is smooth in the pose but has no form of its own.
void AddPoseMaps(const std::vector<Visit>& visits,
                 const std::vector<int>& rows,
                 bool is_last_resort,
                 FormLibrary* library) {
  PoseMap map;
  std::vector<Pose3d> poses;
  for (const int row : rows) poses.push_back(visits[row].base_from_platform);
  map.reference = HomePose(nullptr, poses);
  Vector6d least = Vector6d::Constant(1e300), most = -least;
  for (const Pose3d& pose : poses) {
    const Vector6d coordinates = Minus(pose, map.reference);
    least = least.cwiseMin(coordinates), most = most.cwiseMax(coordinates);
  }
  map.centre = 0.5 * (least + most);
  map.half_width = 0.5 * (most - least);
  const int family = static_cast<int>(library->families.size());
  library->families.push_back({"platform by pose", kLogPrior, true, is_last_resort});
  for (const int degree : {2, 1}) {
    map.degree = degree;
    const int terms = PoseMapTermCount(degree) - 1;
    map.coefficients.setZero(6, terms + 1);
    FormDefinition form;
    form.family = family;
    form.effect = PoseMapEffect(map);
    form.directions.setIdentity(6L * terms, 6L * terms);
    form.scale.resize(6L * terms);
    for (int k = 0; k < 6 * terms; ++k) form.scale[k] = k % 6 < 3 ? kShift : kTurn;
    form.log_prior = std::log(0.5);
    // Linear terms come first, so the smaller map's columns are among the larger one's.
    if (degree == 1)
      form.shares = static_cast<int>(library->forms.size()) - 1, form.shares_from = 0;
    library->forms.push_back(form);
  }
}

}  // namespace

void AddDescribedForms(const Dataset& dataset,
                       const std::vector<Visit>& visits,
                       const std::vector<int>& rows,
                       FormLibrary* library) {
  const Drivers drivers = DriversOf(dataset);
  std::vector<std::string> names = DriverNames();
  for (const Covariate& covariate : dataset.robot_poses.covariates)
    if (!HasMeaning(covariate.name) && !IsDriverName(covariate.name))
      names.push_back(covariate.name);
  for (const std::string& driver : names) {
    double centre = 0.0, half_range = 0.0;
    if (!RangeOf(driver, visits, rows, &centre, &half_range)) continue;
    const bool is_length = driver == "leg_length";
    if (is_length && !drivers.legs) continue;
    if (!is_length) {
      AddFamily("base", driver, centre, half_range, library);
      AddFamily("tool", driver, centre, half_range, library);
    }
    if (drivers.legs) AddFamily("leg", driver, centre, half_range, library);
  }
  // Where legs are known a cause in the legs or joints is sought first.
  AddPoseMaps(visits, rows, drivers.legs, library);
}

}  // namespace hexcal
