// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/geometry_search.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

using Place = Eigen::Matrix<double, 7, 1>;

constexpr int kOrientations = 8;  // four yaws, z up or down
constexpr int kDraws = 30;        // of each
constexpr int kRefined = 3;
constexpr double kStep = 1e-6;    // of the differences, in sigmas of the prior: rounding is less
constexpr double kNoGain = 1e10;  // cost of what cannot be
constexpr int kSamples = 400;     // of the bounds
constexpr double kTail = 5.0;     // freedom of Student's t that they are drawn from
constexpr double kLikelyWidth = 5e-4;  // m, within a factor of 3 or so

struct Drawing {
  NominalHexapod nominal;
  double width;
};

// In (0, 30) degrees, evenly.
double HalfAngle(double place) { return M_PI / 6.0 * 0.5 * std::erfc(-place / std::sqrt(2.0)); }

Drawing DrawingAt(int orientation, const Place& place, double reach, double home_height) {
  Drawing drawing;
  NominalHexapod& nominal = drawing.nominal;
  nominal.platform_radius = reach * std::exp(1.2 + place[0]);
  nominal.base_radius = nominal.platform_radius * std::exp(0.2 + 0.4 * place[1]);
  nominal.base_half_angle = HalfAngle(place[2]);
  nominal.platform_half_angle = HalfAngle(place[3]);
  const double up = orientation % 2 == 0 ? 1.0 : -1.0;
  const double height = up * nominal.platform_radius * std::exp(0.1 + 0.5 * place[4]);
  nominal.platform_height = 0.5 * nominal.platform_radius * place[5];
  nominal.base_height = home_height + nominal.platform_height - height;
  nominal.yaw = (orientation / 2) * M_PI / 6.0;
  drawing.width = kLikelyWidth * std::exp(1.1 * place[6]);
  return drawing;
}

Vector6d NumbersOf(const NominalHexapod& nominal) {
  return (Vector6d() << nominal.base_radius,
          nominal.platform_radius,
          nominal.base_half_angle,
          nominal.platform_half_angle,
          nominal.base_height,
          nominal.platform_height)
      .finished();
}

class Cost final : public ceres::FirstOrderFunction {
 public:
  Cost(const GeometryLikelihood& likelihood, int orientation, double reach, double home_height)
      : likelihood_(likelihood),
        orientation_(orientation),
        reach_(reach),
        home_height_(home_height) {}

  int NumParameters() const override { return 7; }

  // - ln of likelihood and prior.
  double At(const Place& place) const {
    const Drawing drawing = DrawingAt(orientation_, place, reach_, home_height_);
    const double gain = likelihood_.LogGain(MakeHexapod(drawing.nominal), drawing.width);
    return std::isfinite(gain) ? 0.5 * place.squaredNorm() - gain : kNoGain;
  }

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Place place = Eigen::Map<const Place>(parameters);
    if (!place.allFinite()) return false;
    *cost = At(place);
    for (int k = 0; gradient != nullptr && k < 7; ++k)
      gradient[k] = (At(place + kStep * Place::Unit(k)) - *cost) / kStep;
    return *cost < kNoGain;
  }

 private:
  const GeometryLikelihood& likelihood_;
  const int orientation_;
  const double reach_, home_height_;
};

struct Start {
  double cost = 0.0;
  int orientation = 0;
  Place place;
};

// Best first.
std::vector<Start> Draws(const GeometryLikelihood& likelihood, double reach, double home_height) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(0.0, 0.7);
  std::vector<Start> starts;
  for (int orientation = 0; orientation < kOrientations; ++orientation) {
    const Cost cost(likelihood, orientation, reach, home_height);
    for (int i = 0; i < kDraws; ++i) {
      Start start;
      start.orientation = orientation;
      for (double& x : start.place) x = normal(generator);
      start.cost = cost.At(start.place);
      starts.push_back(start);
    }
  }
  std::stable_sort(
      starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  return starts;
}

void Refine(const GeometryLikelihood& likelihood, double reach, double home_height, Start* start) {
  const ceres::GradientProblem problem(
      new Cost(likelihood, start->orientation, reach, home_height));
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-6;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  Place place = start->place;
  ceres::Solve(options, problem, place.data(), &summary);
  if (!summary.IsSolutionUsable() || !(summary.final_cost < start->cost)) return;
  start->place = place, start->cost = summary.final_cost;
}

// Second derivatives of the cost by differences, made positive: no direction is held more loosely
// than by the prior.
Eigen::Matrix<double, 7, 7> Curvature(const Cost& cost, const Place& at) {
  constexpr double kWide = 3e-2;
  Eigen::Matrix<double, 7, 7> bend;
  const auto step = [&](int k) { return Place(kWide * Place::Unit(k)); };
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j <= i; ++j)
      bend(i, j) = bend(j, i) =
          (cost.At(at + step(i) + step(j)) - cost.At(at + step(i) - step(j)) -
           cost.At(at - step(i) + step(j)) + cost.At(at - step(i) - step(j))) /
          (4.0 * kWide * kWide);
  return bend;
}

// The value below which this share of the weight lies.
double Quantile(std::vector<std::pair<double, double>> values, double share) {
  std::sort(values.begin(), values.end());
  double all = 0.0, sum = 0.0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values) {
    sum += weight;
    if (sum >= share * all) return value;
  }
  return values.back().first;
}

}  // namespace

std::optional<GeometryFound> GeometrySearch::Find(const GeometryLikelihood& likelihood) const {
  if (!(reach_ > 0.0)) return std::nullopt;
  std::vector<Start> starts = Draws(likelihood, reach_, home_height_);
  // Not all from one way in which the frames may lie.
  std::array<bool, kOrientations> used = {};
  Start best;
  int refined = 0;
  for (Start& start : starts) {
    if (refined == kRefined || start.cost >= 0.0) break;
    if (used[start.orientation]) continue;
    used[start.orientation] = true;
    ++refined;
    Refine(likelihood, reach_, home_height_, &start);
    if (start.cost < best.cost) best = start;
  }
  if (!(best.cost < 0.0)) return std::nullopt;
  const Drawing drawing = DrawingAt(best.orientation, best.place, reach_, home_height_);
  GeometryFound found;
  found.nominal = drawing.nominal;
  found.width = drawing.width;
  found.log_gain = likelihood.LogGain(MakeHexapod(drawing.nominal), drawing.width);
  found.orientation = best.orientation;
  found.place = best.place;
  return found;
}

std::vector<Bound> GeometrySearch::Bounds(const GeometryLikelihood& likelihood,
                                          const GeometryFound& found,
                                          std::uint64_t seed) const {
  const Cost cost(likelihood, found.orientation, reach_, home_height_);
  const Eigenvalues bend = DecomposeSymmetric(Curvature(cost, found.place));
  const Eigen::VectorXd spread = bend.values.cwiseMax(1.0).cwiseSqrt().cwiseInverse();
  const double least = cost.At(found.place);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> tail(kTail);
  std::array<std::vector<std::pair<double, double>>, 6> samples;
  for (int i = 0; i < kSamples; ++i) {
    Place draw;
    for (double& x : draw) x = normal(generator);
    draw *= std::sqrt(kTail / tail(generator));
    const Place place = found.place + bend.vectors * spread.cwiseProduct(draw);
    const double log_density = -0.5 * (kTail + 7.0) * std::log1p(draw.squaredNorm() / kTail);
    const double weight = std::exp(least - cost.At(place) - log_density);
    const Vector6d numbers =
        NumbersOf(DrawingAt(found.orientation, place, reach_, home_height_).nominal);
    for (int k = 0; k < 6; ++k) samples[k].emplace_back(numbers[k], weight);
  }
  constexpr const char* kNames[][2] = {{"base_radius", "m"},
                                       {"platform_radius", "m"},
                                       {"base_half_angle", "rad"},
                                       {"platform_half_angle", "rad"},
                                       {"base_height", "m"},
                                       {"platform_height", "m"}};
  const Vector6d values = NumbersOf(found.nominal);
  std::vector<Bound> bounds;
  for (int k = 0; k < 6; ++k)
    bounds.push_back({kNames[k][0],
                      kNames[k][1],
                      values[k],
                      Quantile(samples[k], 0.025),
                      Quantile(samples[k], 0.975)});
  return bounds;
}

}  // namespace hexcal
