// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "estimator/marker_sight.h"
#include "measurement/dataset.h"
#include "model/effect.h"
#include "model/forward.h"
#include "model/pose_map.h"
#include "model/visit.h"

namespace hexcal {

// One measured pose. whitener: W with W' W = C^-1 of the pose error, [m, rad], frame T.
struct GrownPose {
  int row = 0;             // of robot_poses
  Pose3d world_from_tool;  // as the tracker has it
  Matrix6d whitener = Matrix6d::Identity();
};

// An effect of the model, and which numbers of its parameters are estimated.
struct GrownEffect {
  Effect effect;
  std::vector<int> free;
  // Gaussian priors, one a free number; a sigma that is not finite: none.
  Eigen::VectorXd prior_mean, prior_sigma;
};

// What effects and pose map do to one visit.
Corrections<double> CorrectionsOf(const std::vector<Effect>& effects,
                                  const std::optional<PoseMap>& pose_map,
                                  const Visit& visit);

// A machine with effects and the data that it is held against. Residuals, dimensionless: W
// (measured [-] predicted) of each pose, the markers' misfit within their bodies, the priors.
// Parameters: 12 right perturbations of the mounts, the free numbers of the effects in their order.
class GrownProblem {
 public:
  struct Data {
    const Dataset* dataset = nullptr;
    const HexapodGeometry* hexapod = nullptr;    // nominal; null: none
    const std::vector<Visit>* visits = nullptr;  // of all rows
    std::vector<GrownPose> poses;
    std::optional<PoseMap> pose_map;  // held fixed
    bool with_misfit = false;         // rows of the markers' misfit, too
    double misfit_scale = 1.0;        // of the stated sigma of a reading
  };
  // Refers to what data point to.
  GrownProblem(Data data, std::vector<GrownEffect> effects);

  int num_free() const { return num_free_; }
  int num_rows() const { return num_rows_; }
  int num_misfit() const { return num_misfit_; }
  int misfit_freedom() const { return misfit_freedom_; }  // when each rigid fit has taken its six
  const Data& data() const { return data_; }
  Eigen::VectorXd Start() const;  // the free numbers of the effects as given
  std::vector<Effect> EffectsAt(const Eigen::VectorXd& free) const;
  // Which effect and which of its numbers.
  std::vector<std::pair<int, int>> FreeNumbers() const;

  struct Evaluation {
    Eigen::VectorXd residual;
    Eigen::MatrixXd jacobian;             // rows x (12 + free), where asked for
    std::vector<Vector6d> errors;         // measured [-] predicted, not whitened
    std::vector<Pose3d> predicted, seen;  // world_from_tool; seen: rid of tracker and markers
  };
  // Nothing where legs reach no pose, or numbers are not finite.
  std::optional<Evaluation> Evaluate(const Mounts& mounts,
                                     const Eigen::VectorXd& free,
                                     bool with_jacobian) const;

 private:
  std::vector<Corrections<double>> CorrectionsAt(const std::vector<Effect>& effects) const;
  Sight SightAt(const std::vector<Corrections<double>>& corrections) const;
  void AddMisfit(const Eigen::VectorXd& misfit, Eigen::Ref<Eigen::VectorXd> rows) const;
  void AddPriors(const Eigen::VectorXd& free, Evaluation* evaluation) const;
  void AddForward(const Mounts& mounts,
                  const std::vector<Effect>& effects,
                  const std::vector<Corrections<double>>& corrections,
                  const std::vector<ForwardPose>& poses,
                  Evaluation* evaluation) const;
  void AddSight(const Eigen::VectorXd& free, Evaluation* evaluation) const;

  Data data_;
  std::vector<GrownEffect> effects_;
  MarkerSight sight_;
  bool sees_truly_ = true;  // no effect is of the tracker or of markers
  int num_free_ = 0, num_misfit_ = 0, num_rows_ = 0, misfit_freedom_ = 0;
};

}  // namespace hexcal
