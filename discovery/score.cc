// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "discovery/log_tail.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

// Directions that keep less of their square than this after projection are gauges, or as good as.
constexpr double kAbsorbed = 1e-9;
constexpr double kRank = 1e-7;
// The prior size is known to an order of magnitude or so: evidence is averaged over these widths.
constexpr std::array<double, 5> kWidths = {0.3, 1.0, 3.0, 10.0, 30.0};

// Where the likeliest width is looked for.
constexpr double kNarrowest = 0.01, kWidest = 32.0, kFiner = 1.2589254117941673;  // ten a decade

double LogSumExp(const std::vector<double>& terms) {
  const double most = *std::max_element(terms.begin(), terms.end());
  double sum = 0.0;
  for (const double t : terms) sum += std::exp(t - most);
  return most + std::log(sum);
}

// 2 ln of the Bayes factor of coefficients ~ N(0, (width scale)^2) against zero: a component of
// squared size s per prior variance and squared projection a gives w s / (1 + w s) a - ln(1 + w s)
// with w the squared width.
double EvidenceAt(double width,
                  const Eigen::VectorXd& squares,
                  const Eigen::VectorXd& projected,
                  int rank) {
  double sum = 0.0;
  for (int k = 0; k < rank; ++k) {
    const double s = width * width * squares[k];
    sum += s / (1.0 + s) * projected[k] - std::log1p(s);
  }
  return sum;
}

// Averaged over widths of the prior.
double Evidence(const Eigen::VectorXd& squares, const Eigen::VectorXd& projected, int rank) {
  std::vector<double> halves;
  for (const double width : kWidths)
    halves.push_back(0.5 * EvidenceAt(width, squares, projected, rank) -
                     std::log(static_cast<double>(kWidths.size())));
  return 2.0 * LogSumExp(halves);
}

Eigen::MatrixXd Stacked(const Eigen::MatrixXd& pose_rows, const Eigen::MatrixXd& shape_rows) {
  Eigen::MatrixXd all(pose_rows.rows() + shape_rows.rows(), pose_rows.cols());
  all << pose_rows, shape_rows;
  return all;
}

// log10 p as a function of the explained share of the squares, tabulated: draws by the thousand
// ask for it.
class ShareToP {
 public:
  ShareToP(int rank, int freedom) {
    for (int i = 0; i <= kPoints; ++i) {
      const double share = kLargest * i / kPoints;
      const double f = share / rank / ((1.0 - share) / (freedom - rank));
      table_.push_back(-Log10FisherTail(f, rank, freedom - rank));
    }
  }
  double operator()(double share) const {
    const double x = std::clamp(share, 0.0, kLargest * 0.999999) / kLargest * kPoints;
    const int i = static_cast<int>(x);
    return table_[i] + (x - i) * (table_[i + 1] - table_[i]);
  }

 private:
  static constexpr int kPoints = 400;
  static constexpr double kLargest = 0.4;  // of white noise no form explains more
  std::vector<double> table_;
};

}  // namespace

Scorer::Scorer(const LinearProblem& problem, const GapNoise& noise) : problem_(problem) {
  const Eigen::Index pose_rows = problem.error.size(), shape_rows = problem.shape_error.size();
  auto columns = std::make_shared<Eigen::MatrixXd>(pose_rows + shape_rows, problem.columns->cols());
  columns->topRows(pose_rows) = WhitenPoseRows(problem, noise, *problem.columns);
  columns->bottomRows(shape_rows).setZero();
  if (shape_rows > 0) {
    const Eigen::MatrixXd shape = WhitenShapeRows(problem, noise, *problem.shape_columns);
    for (std::size_t k = 0; k < problem.shape_of.size(); ++k)
      if (problem.shape_of[k] >= 0)
        columns->col(k).bottomRows(shape_rows) = shape.col(problem.shape_of[k]);
  }
  columns_ = std::move(columns);
  const Eigen::MatrixXd nuisance = Stacked(WhitenPoseRows(problem, noise, problem.nuisance),
                                           WhitenShapeRows(problem, noise, problem.shape_nuisance));
  const Eigen::VectorXd error = Stacked(WhitenPoseRows(problem, noise, problem.error),
                                        WhitenShapeRows(problem, noise, problem.shape_error));
  basis_ = OrthonormalBasis(nuisance, kRank);
  along_ = basis_.transpose() * *columns_;
  residual_ = error - basis_ * (basis_.transpose() * error);
  freedom_ = static_cast<int>(pose_rows - basis_.cols());
  for (const int rows : problem.shape_freedom) freedom_ += rows;
  ScoreAll();
}

Scorer Scorer::Given(const std::vector<int>& forms) const {
  Eigen::Index count = 0;
  for (const int f : forms) count += problem_.forms[f].size;
  Eigen::MatrixXd extra(residual_.size(), count);
  Eigen::Index at = 0;
  for (const int f : forms)
    for (int k = 0; k < problem_.forms[f].size; ++k) {
      const auto column = columns_->col(problem_.forms[f].first + k);
      const double length = column.norm();
      const Eigen::VectorXd left = column - basis_ * (basis_.transpose() * column);
      // What the nuisances hold already is rounding, and must not be scaled up.
      if (length > 0.0 && left.norm() > kRank * length) extra.col(at++) = left / length;
    }
  const Eigen::MatrixXd more = OrthonormalBasis(extra.leftCols(at), kRank);
  Scorer given = *this;
  given.problem_ = problem_.With(forms);
  given.basis_.conservativeResize(Eigen::NoChange, basis_.cols() + more.cols());
  given.basis_.rightCols(more.cols()) = more;
  given.along_.conservativeResize(basis_.cols() + more.cols(), Eigen::NoChange);
  given.along_.bottomRows(more.cols()) = more.transpose() * *columns_;
  given.residual_ -= more * (more.transpose() * residual_);
  given.freedom_ -= static_cast<int>(more.cols());
  given.ScoreAll();
  return given;
}

void Scorer::ScoreAll() {
  blocks_.clear(), scores_.clear();
  const Eigen::VectorXd product = columns_->transpose() * residual_;
  const double squared = residual_.squaredNorm();
  for (std::size_t f = 0; f < problem_.forms.size(); ++f) {
    blocks_.push_back(MakeBlock(problem_.forms[f]));
    scores_.push_back(MakeScore(static_cast<int>(f), product, squared));
  }
}

Scorer::Block Scorer::MakeBlock(const Form& form) const {
  const auto g = columns_->middleCols(form.first, form.size);
  const auto q = along_.middleCols(form.first, form.size);
  const auto d = problem_.scale.segment(form.first, form.size).asDiagonal();
  const Eigen::MatrixXd whole = d * (g.transpose() * g) * d;
  const Eigen::MatrixXd normal = whole - d * (q.transpose() * q) * d;
  Block block;
  const double floor = kAbsorbed * std::max(whole.diagonal().maxCoeff(), 1e-300);
  if (form.size == 1) {
    block.directions = Eigen::MatrixXd::Ones(1, 1);
    block.squares = normal.diagonal();
  } else {
    const Eigenvalues eigen = DecomposeSymmetric(normal);
    block.directions = eigen.vectors.rowwise().reverse();
    block.squares = eigen.values.reverse();
  }
  while (block.rank < form.size && block.squares[block.rank] > floor) ++block.rank;
  // A test needs some freedom left.
  if (freedom_ < 2 * block.rank + 5) block.rank = 0;
  return block;
}

// Squared projections of a residual on the determined directions.
Eigen::VectorXd Scorer::Rotated(const Form& form,
                                const Block& block,
                                const Eigen::VectorXd& product) const {
  const Eigen::VectorXd scaled = problem_.scale.segment(form.first, form.size)
                                     .cwiseProduct(product.segment(form.first, form.size));
  return (block.directions.leftCols(block.rank).transpose() * scaled)
      .cwiseAbs2()
      .cwiseQuotient(block.squares.head(block.rank));
}

Score Scorer::MakeScore(int form, const Eigen::VectorXd& product, double squared) const {
  const Block& block = blocks_[form];
  Score score;
  score.form = form;
  score.rank = block.rank;
  if (block.rank == 0) return score;
  const Eigen::VectorXd projected = Rotated(problem_.forms[form], block, product);
  score.gain = projected.sum();
  const double left = std::max(squared - score.gain, 1e-12 * squared);
  const double f = score.gain / score.rank / (left / (freedom_ - score.rank));
  score.log10_p = Log10FisherTail(f, score.rank, freedom_ - score.rank);
  // Evidence is in units of the noise; what is left tells its level better than what is assumed.
  score.evidence = Evidence(block.squares, projected, block.rank);
  return score;
}

std::vector<Scorer::FamilyScore> Scorer::Families() const {
  std::map<int, FamilyScore> found;
  std::map<int, std::vector<double>> halves;
  std::map<int, double> best;
  for (const Score& score : scores_) {
    if (score.rank == 0) continue;
    const Form& form = problem_.forms[score.form];
    const double half = 0.5 * score.evidence + form.log_prior;
    FamilyScore& family = found[form.family];
    if (halves[form.family].empty() || half > best[form.family]) {
      best[form.family] = half;
      family.best = score;
    }
    family.family = form.family;
    family.log10_p = std::min(family.log10_p, score.log10_p);
    halves[form.family].push_back(half);
  }
  std::vector<FamilyScore> families;
  for (auto& [index, family] : found) {
    family.evidence = 2.0 * (LogSumExp(halves[index]) + problem_.families[index].log_prior);
    families.push_back(family);
  }
  std::stable_sort(families.begin(), families.end(), [](const auto& a, const auto& b) {
    return a.evidence > b.evidence;
  });
  return families;
}

Eigen::MatrixXd Scorer::FamilyMaxima(Eigen::MatrixXd draws) const {
  draws -= basis_ * (basis_.transpose() * draws).eval();
  const Eigen::MatrixXd products = columns_->transpose() * draws;
  const Eigen::VectorXd squared = draws.colwise().squaredNorm();
  Eigen::MatrixXd maxima =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem_.families.size()), draws.cols());
  std::map<int, ShareToP> tables;
  for (std::size_t f = 0; f < problem_.forms.size(); ++f) {
    const Block& block = blocks_[f];
    if (block.rank == 0) continue;
    const Form& form = problem_.forms[f];
    const ShareToP& p = tables.try_emplace(block.rank, block.rank, freedom_).first->second;
    const Eigen::MatrixXd directions =
        problem_.scale.segment(form.first, form.size).asDiagonal() *
        block.directions.leftCols(block.rank) *
        block.squares.head(block.rank).cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::VectorXd gain =
        (directions.transpose() * products.middleRows(form.first, form.size))
            .colwise()
            .squaredNorm();
    for (Eigen::Index b = 0; b < draws.cols(); ++b) {
      double& most = maxima(form.family, b);
      most = std::max(most, p(gain[b] / squared[b]));
    }
  }
  return maxima;
}

Eigen::VectorXd Scorer::Coefficients(int f, double prior_scale) const {
  const Form& form = problem_.forms[f];
  const Block& block = blocks_[f];
  const Eigen::VectorXd scale = problem_.scale.segment(form.first, form.size);
  const Eigen::VectorXd product =
      scale.cwiseProduct(columns_->middleCols(form.first, form.size).transpose() * residual_);
  const auto directions = block.directions.leftCols(block.rank);
  const double prior = prior_scale > 0.0 ? 1.0 / (prior_scale * prior_scale) : 0.0;
  const Eigen::VectorXd amount =
      (directions.transpose() * product)
          .cwiseQuotient((block.squares.head(block.rank).array() + prior).matrix());
  return scale.cwiseProduct(directions * amount);
}

Eigen::MatrixXd Scorer::CoefficientCovariance(int f) const {
  const Form& form = problem_.forms[f];
  const Block& block = blocks_[f];
  const auto d = problem_.scale.segment(form.first, form.size).asDiagonal();
  const auto directions = block.directions.leftCols(block.rank);
  return d * directions * block.squares.head(block.rank).cwiseInverse().asDiagonal() *
         directions.transpose() * d;
}

double Scorer::LikeliestWidth(int f) const {
  const Form& form = problem_.forms[f];
  const Block& block = blocks_[f];
  const Eigen::VectorXd projected = Rotated(form, block, columns_->transpose() * residual_);
  double best = kNarrowest, most = -1e300;
  for (double width = kNarrowest; width < kWidest; width *= kFiner) {
    const double evidence = EvidenceAt(width, block.squares, projected, block.rank);
    if (evidence > most) most = evidence, best = width;
  }
  return best;
}

double Scorer::Explained(int effect, int rival) const {
  const Form& a = problem_.forms[effect];
  const Form& b = problem_.forms[rival];
  const Eigen::VectorXd c = Coefficients(effect, 0.0);
  const Eigen::VectorXd whole = columns_->middleCols(a.first, a.size) * c;
  const Eigen::VectorXd signal = whole - basis_ * (basis_.transpose() * whole);
  const double total = signal.squaredNorm();
  if (!(total > 0.0) || blocks_[rival].rank == 0) return 0.0;
  const Eigen::VectorXd product =
      problem_.scale.segment(b.first, b.size)
          .cwiseProduct(columns_->middleCols(b.first, b.size).transpose() * signal);
  const Block& block = blocks_[rival];
  return (block.directions.leftCols(block.rank).transpose() * product)
             .cwiseAbs2()
             .cwiseQuotient(block.squares.head(block.rank))
             .sum() /
         total;
}

}  // namespace hexcal
