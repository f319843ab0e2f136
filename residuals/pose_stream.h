// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "residuals/pose_batch.h"
#include "residuals/pose_moments.h"
#include "residuals/pose_pass.h"
#include "residuals/robust_loss.h"
#include "residuals/streamed_residual.h"

namespace hexcal {

// The pose residual of residuals/pose_residual.h over all poses in one pass: 12 parameters, no row
// stored. Batch and weights are not owned. Sums are taken over fixed chunks in fixed order, so that
// they do not depend on the number of threads.
class PoseStream final : public StreamedResidual {
 public:
  PoseStream(const PoseBatch& batch,
             const PoseWeights& weights,
             RobustLoss loss = {},
             int threads = 1);

  std::vector<int> BlockSizes() const override { return {7, 7}; }
  NormalEquations Evaluate(double const* const* parameters) const override;
  NormalEquations At(const BaseAndTool& mounts) const;

  // The two parts of isotropic weights apart.
  IsotropicSums PartsAt(const BaseAndTool& mounts) const;

  // Of the poses alone, without weights or loss.
  PoseMoments Moments() const;

 private:
  template <typename Sums>
  Sums SumChunks(const BaseAndTool& mounts,
                 const std::function<Sums(const PassInput&)>& pass) const;

  const PoseBatch& batch_;
  const PoseWeights& weights_;
  RobustLoss loss_;
  int threads_;
};

// The normal equations that the two parts make at these weights, 1/m^2 and 1/rad^2; their
// components are positions and orientations.
NormalEquations Weighted(const IsotropicSums& sums,
                         double position_weight,
                         double orientation_weight,
                         std::size_t poses);

}  // namespace hexcal
