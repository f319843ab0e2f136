// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "residuals/pose_moments.h"

namespace hexcal {

// Base and tool from the moments of the poses: no pose is looked at again. Rotations are compared
// by their entries in place of their angle, of which |1 - R|^2 / 2 (Frobenius) is the square, less
// a twelfth of its fourth power.
class MomentStart {
 public:
  explicit MomentStart(const PoseMoments& moments) : moments_(moments) {}  // not owned

  // Shah's closed form (estimator/closed_form.h). Nothing where the rotations hardly tell base from
  // tool.
  std::optional<BaseAndTool> ClosedForm() const;

  // Gauss-Newton steps from *mounts to the least sum of weighted squares; weights 1/m^2 and
  // 1/rad^2. Returns the largest factor by which the steps shrank, or nothing where they did not.
  std::optional<double> Minimise(double position, double orientation, BaseAndTool* mounts) const;

  // Gradients of the two parts of that sum at weight one; normal matrices without terms that are as
  // small as the errors. No squares.
  IsotropicSums At(const BaseAndTool& mounts) const;

  // These squared errors in units of the poses' own spread, as Misfit in estimator/start.h.
  double Misfit(double position_squares, double orientation_squares) const;

 private:
  IsotropicSums::Part PositionsAt(const BaseAndTool& mounts) const;
  IsotropicSums::Part OrientationsAt(const BaseAndTool& mounts) const;

  const PoseMoments& moments_;
};

}  // namespace hexcal
