// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of the forces in the legs.

// Axial forces that hold still what hangs on the platform, N, push positive: of the payload at its
// centre; more for each m by which the load sits higher (along z of A); for each kg at the origin
// of A.
struct LegForces {
  Vector6d payload, height, platform_mass;
};

// The legs hold the platform where J' f balances gravity's wrench at the origin of A, frame A.
LegForces LegForcesOf(const Visit& visit) {
  const Eigen::Vector3d down =
      visit.base_from_platform.rotation.conjugate() * visit.gravity_in_base;
  const Eigen::Vector3d weight = visit.payload * kStandardGravity * down;
  Eigen::Matrix<double, 6, 3> wrenches = Eigen::Matrix<double, 6, 3>::Zero();
  wrenches.col(0) << weight, visit.payload_centre.cross(weight);
  wrenches.col(1).tail<3>() = Eigen::Vector3d::UnitZ().cross(weight);
  wrenches.col(2).head<3>() = kStandardGravity * down;
  const Eigen::PartialPivLU<Matrix6d> balance(visit.leg_jacobian.transpose());
  const Eigen::Matrix<double, 6, 3> forces = balance.solve(-wrenches);
  return {forces.col(0), forces.col(1), forces.col(2)};
}

// parameters: compliance, platform_mass, load_height. A leg that is pushed gets shorter.
template <typename T>
void LegCompliance(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  const LegForces forces = LegForcesOf(input.visit);
  const T compliance = parameters[0], mass = parameters[1], height = parameters[2];
  for (int i = 0; i < kNumLegs; ++i) {
    const T force =
        T(forces.payload[i]) + mass * forces.platform_mass[i] + height * forces.height[i];
    if (Carries(input, i)) corrections->leg[i] -= compliance * force;
  }
}

template <typename T>
void LegClearance(const EffectInput& input, const T* gap, Corrections<T>* corrections) {
  const Vector6d force = LegForcesOf(input.visit).payload;
  for (int i = 0; i < kNumLegs; ++i)
    if (Carries(input, i)) corrections->leg[i] -= gap[0] * (0.5 * Sign(force[i]));
}

ParameterKind Nuisance(std::string_view name, std::string_view unit, double scale) {
  ParameterKind nuisance = {name, unit, 1, scale};
  nuisance.acts_alone = false;
  return nuisance;
}

}  // namespace

std::vector<EffectKind> ForceEffects() {
  return {
      {"leg_compliance",
       "leg",
       "leg_force",
       "linear",
       "Screw, nut and joints give way under the axial force of the load.",
       {{"compliance", "m/N", 1, 3e-7},
        Nuisance("platform_mass", "kg", 2.0),
        Nuisance("load_height", "m", 0.05)},
       {"legs", "payload", "gravity"},
       LegCompliance<double>,
       LegCompliance<Dual>},
      {"leg_clearance",
       "leg",
       "leg_force",
       "sign",
       "The joints have play, which the load takes up on one side or the other.",
       {{"gap", "m", 1, 1e-5}},
       {"legs", "payload", "gravity"},
       LegClearance<double>,
       LegClearance<Dual>},
  };
}

}  // namespace hexcal
