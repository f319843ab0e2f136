// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"

namespace hexcal {

// How much one form explains beyond the nuisances, before anything is refitted (the score, or
// Lagrange multiplier, test; Rao 1948).
struct Score {
  int form = 0;
  int rank = 0;           // of its columns after the nuisances were projected out; 0: a gauge
  double gain = 0.0;      // fall of the whitened sum of squares
  double log10_p = 0.0;   // of the F test of that gain
  double evidence = 0.0;  // 2 ln of the Bayes factor against no effect, prior scale mixed
};

// All forms against one problem and its noise: what can be computed before the data are looked at
// is kept, so that simulated data cost little.
class Scorer {
 public:
  Scorer(const LinearProblem& problem, const GapNoise& noise);

  // The same under the same noise, with these forms among the nuisances: problem.With(forms), at a
  // fraction of its cost.
  Scorer Given(const std::vector<int>& forms) const;

  // The data themselves.
  const std::vector<Score>& scores() const { return scores_; }
  double squared_residual() const { return residual_.squaredNorm(); }
  int freedom() const { return freedom_; }  // rows less the rank of the nuisances

  // Best first by evidence, log priors of forms included: one entry a family, the family's
  // evidence over all its forms in place of the form's.
  struct FamilyScore {
    int family = 0;
    Score best;
    double evidence = 0.0;
    double log10_p = 0.0;  // the smallest of its forms
  };
  std::vector<FamilyScore> Families() const;

  // -log10 p of the best form of each family, for columns of draws (rows x draws) of white noise.
  Eigen::MatrixXd FamilyMaxima(Eigen::MatrixXd draws) const;
  int rows() const { return static_cast<int>(residual_.size()); }

  // Best coefficients of a form without and with its prior (at the prior's widest scale), and the
  // covariance of the former in its determined directions.
  Eigen::VectorXd Coefficients(int form, double prior_scale) const;
  Eigen::MatrixXd CoefficientCovariance(int form) const;

  // The width of the prior, in units of its scale, under which the data are most likely.
  double LikeliestWidth(int form) const;

  // The part of `effect`'s explained sum of squares that `rival` explains as well, in [0, 1].
  double Explained(int effect, int rival) const;

 private:
  struct Block {
    Eigen::MatrixXd directions;  // eigenvectors of the scaled normal matrix, determined ones first
    Eigen::VectorXd squares;     // its eigenvalues: squared size of one prior sigma, in sigmas
    int rank = 0;
  };
  Eigen::VectorXd Rotated(const Form& form,
                          const Block& block,
                          const Eigen::VectorXd& product) const;
  void ScoreAll();
  Block MakeBlock(const Form& form) const;
  Score MakeScore(int form, const Eigen::VectorXd& product, double squared) const;

  LinearProblem problem_;  // its columns are shared
  // Whitened, pose rows then shape rows; not projected. Shared with what is given more.
  std::shared_ptr<const Eigen::MatrixXd> columns_;
  Eigen::MatrixXd basis_;  // of the nuisances
  Eigen::MatrixXd along_;  // basis' columns
  Eigen::VectorXd residual_;
  int freedom_ = 0;
  std::vector<Block> blocks_;
  std::vector<Score> scores_;
};

}  // namespace hexcal
