// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/refit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "discovery/common_world.h"
#include "estimator/rms.h"
#include "model/described_effect.h"

namespace hexcal {
namespace {

constexpr int kIterations = 50;
constexpr double kConverged = 1e-3;  // of a standard deviation
constexpr double kLeastFall = 1e-9;  // of the squares: less is rounding
constexpr int kHalvings = 12;
constexpr double kHarmonicPrior = 30.0;  // in plausible sizes: as good as none

bool IsCarrying(const Effect& effect, const EffectKind& kind, int number) {
  const ParameterKind& parameter = kind.ParameterOf(number);
  if (effect.index.empty() || parameter.is_per_marker) return true;
  const int each = parameter.size / kNumLegs;  // numbers a leg
  if (parameter.size % kNumLegs != 0 || (kind.site != "leg" && parameter.size == kNumLegs))
    return true;
  const int leg = (number - kind.OffsetOf(parameter.name)) / each + 1;
  return std::find(effect.index.begin(), effect.index.end(), leg) != effect.index.end();
}

// Numbers that the refit may move. A step's time has no derivative; a phase without its amplitude
// has none either.
std::vector<int> FreeNumbers(const Effect& effect) {
  std::vector<int> numbers;
  if (IsPoseMap(effect)) {
    numbers.resize(effect.parameters.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }
  if (effect.name == kUnknownEffect) {
    const bool by_leg = effect.found.at("site") == "leg" && !effect.index.empty();
    for (int k = 0; k < 6; ++k)
      if (!by_leg || std::count(effect.index.begin(), effect.index.end(), k + 1) > 0)
        numbers.push_back(k);
    return numbers;
  }
  const EffectKind& kind = *FindEffectKind(effect.name);
  for (int n = 0; n < effect.parameters.size(); ++n) {
    const ParameterKind& parameter = kind.ParameterOf(n);
    if (!IsCarrying(effect, kind, n)) continue;
    if (parameter.is_search && (parameter.name == "time" || effect.parameters[n] == 0.0)) continue;
    if (parameter.name == "amplitude_2" || parameter.name == "phase_2")
      if (effect.parameters.segment<kNumLegs>(kind.OffsetOf("amplitude_2")).isZero(0.0)) continue;
    if (kind.name == "leg_compliance" && n > 0 && effect.parameters[n] == 0.0) continue;
    numbers.push_back(n);
  }
  return numbers;
}

double ScaleOf(const Effect& effect, int number) {
  if (effect.name == kUnknownEffect) return number % 6 < 3 ? 1e-4 : 2e-4;
  const EffectKind& kind = *FindEffectKind(effect.name);
  const double scale = kind.ScaleOf(number);
  // Of what was searched for nothing is known beforehand but its own size.
  return scale > 0.0 ? scale : std::abs(effect.parameters[number]);
}

}  // namespace

FormLibrary FreeForms(const std::vector<Effect>& effects) {
  FormLibrary library;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const std::vector<int> numbers = FreeNumbers(effects[e]);
    FormDefinition form;
    form.family = static_cast<int>(e);
    form.effect = effects[e];
    form.directions.setZero(effects[e].parameters.size(),
                            static_cast<Eigen::Index>(numbers.size()));
    form.scale.resize(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      form.directions(numbers[k], k) = 1.0;
      form.scale[k] = ScaleOf(effects[e], numbers[k]);
    }
    library.families.push_back({effects[e].name, 0.0, false});
    library.forms.push_back(std::move(form));
  }
  return library;
}

namespace {

Eigen::VectorXd PriorMean(const FormLibrary& library) {
  std::vector<double> mean;
  for (const FormDefinition& form : library.forms)
    for (int k = 0; k < form.size(); ++k) {
      const double value = form.directions.col(k).dot(form.effect.parameters);
      const EffectKind* kind = FindEffectKind(form.effect.name);
      int number = 0;
      form.directions.col(k).maxCoeff(&number);
      // Neither is a phase ever near zero beforehand.
      const bool is_searched =
          kind != nullptr && (kind->ParameterOf(number).is_search ||
                              kind->ParameterOf(number).name.substr(0, 5) == "phase");
      // The step counts from the present value, so zero lies minus that value away.
      mean.push_back(is_searched ? 0.0 : -value);
    }
  return Eigen::Map<Eigen::VectorXd>(mean.data(), static_cast<Eigen::Index>(mean.size()));
}

class Refitter {
 public:
  Refitter(const GapData& data, const GapNoise& noise, double prior_width)
      : data_(data), noise_(noise), prior_width_(prior_width) {}

  // Gauss-Newton from where refit stands; a step that makes things worse is halved.
  void Run(Refit* refit) {
    refit->converged = false;
    FormLibrary library = FreeForms(refit->effects);
    refit->problem = MakeGapProblem(data_, refit->mounts, refit->effects, library);
    double objective = Objective(*refit, library);
    refit->iterations.push_back(RecordOf(*refit, objective));
    double fall = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kIterations; ++i) {
      const JointFit fit = Fit(*refit, library);
      refit->covariance = fit.covariance;
      const Eigen::VectorXd deviation = fit.covariance.diagonal().cwiseSqrt();
      Eigen::VectorXd step(fit.mounts.size() + fit.coefficients.size());
      step << fit.mounts, fit.coefficients;
      SetDeviations(deviation, library, &refit->effects);
      const double size = (step.array().abs() / deviation.array().max(1e-300)).maxCoeff();
      refit->converged = size < kConverged || fall < kLeastFall * objective;
      if (refit->converged) return;
      const double before = objective;
      if (!Take(step, &library, refit, &objective)) return;
      refit->iterations.push_back(RecordOf(*refit, objective));
      fall = before - objective;
    }
  }

  JointFit Fit(const Refit& refit, const FormLibrary& library) const {
    std::vector<int> all;
    for (std::size_t f = 0; f < library.forms.size(); ++f) all.push_back(static_cast<int>(f));
    return FitJointly(refit.problem.linear, noise_, all, prior_width_, PriorMean(library));
  }

 private:
  static void Move(const Eigen::VectorXd& step, const FormLibrary& library, Refit* refit) {
    refit->mounts.world_from_base = Plus(refit->mounts.world_from_base, Vector6d(step.head<6>()));
    refit->mounts.platform_from_tool =
        Plus(refit->mounts.platform_from_tool, Vector6d(step.segment<6>(6)));
    Eigen::Index at = 12;
    for (std::size_t e = 0; e < library.forms.size(); ++e) {
      const FormDefinition& form = library.forms[e];
      refit->effects[e].parameters += form.directions * step.segment(at, form.size());
      at += form.size();
    }
  }

  static void SetDeviations(const Eigen::VectorXd& deviation,
                            const FormLibrary& library,
                            std::vector<Effect>* effects) {
    Eigen::Index at = 12;
    for (std::size_t e = 0; e < library.forms.size(); ++e) {
      const FormDefinition& form = library.forms[e];
      Effect& effect = (*effects)[e];
      effect.standard_deviation = Eigen::VectorXd::Constant(
          effect.parameters.size(), std::numeric_limits<double>::quiet_NaN());
      for (int k = 0; k < form.size(); ++k, ++at) {
        int number = 0;
        form.directions.col(k).maxCoeff(&number);
        effect.standard_deviation[number] = deviation[at];
      }
    }
  }

  // Whitened squares that are left, and what the priors add to them.
  double Objective(const Refit& refit, const FormLibrary& library) const {
    const LinearProblem& linear = refit.problem.linear;
    double sum = WhitenPoseRows(linear, noise_, linear.error).squaredNorm() +
                 WhitenShapeRows(linear, noise_, linear.shape_error).squaredNorm();
    const Eigen::VectorXd mean = PriorMean(library);
    Eigen::Index at = 0;
    for (const FormDefinition& form : library.forms)
      for (int k = 0; k < form.size(); ++k, ++at)
        sum += std::pow(mean[at] / (prior_width_ * form.scale[k]), 2);
    return sum;
  }

  static IterationRecord RecordOf(const Refit& refit, double objective) {
    const LinearProblem& linear = refit.problem.linear;
    RmsError rms;
    for (int k = 0; k < linear.poses; ++k) rms.Add(linear.error.segment<6>(6 * k));
    return {0.5 * objective, rms.Position(), rms.Orientation()};
  }

  // The longest of the step, its half, its quarter... that leads downhill. False: none does.
  bool Take(const Eigen::VectorXd& step,
            FormLibrary* library,
            Refit* refit,
            double* objective) const {
    double share = 1.0;
    for (int i = 0; i < kHalvings; ++i, share *= 0.5) {
      Refit next = *refit;
      Move(share * step, *library, &next);
      FormLibrary there = FreeForms(next.effects);
      std::optional<GapProblem> problem =
          MakeGapProblemInReach(data_, next.mounts, next.effects, there);
      if (!problem) continue;
      next.problem = *std::move(problem);
      const double found = Objective(next, there);
      if (!(found <= *objective * (1.0 + kLeastFall))) continue;
      *refit = std::move(next), *library = std::move(there), *objective = found;
      return true;
    }
    return false;
  }

  const GapData& data_;
  const GapNoise& noise_;
  const double prior_width_;
};

// Starts the second harmonic of a periodic effect where the data show one.
bool StartSecondHarmonic(
    const GapData& data, const GapNoise& noise, const Refit& refit, std::size_t e, Effect* effect) {
  const EffectKind& kind = *FindEffectKind(effect->name);
  FormLibrary library = FreeForms(refit.effects);
  const int amplitude = kind.OffsetOf("amplitude_2"), phase = kind.OffsetOf("phase_2");
  const auto legs = static_cast<Eigen::Index>(effect->index.size());
  for (int part = 0; part < 2; ++part) {
    FormDefinition form;
    form.family = static_cast<int>(e);
    form.effect = *effect;
    form.effect.parameters.segment<kNumLegs>(phase).setConstant(part == 0 ? 0.0 : 0.5 * M_PI);
    form.directions.setZero(effect->parameters.size(), legs);
    form.scale = Eigen::VectorXd::Constant(legs, kind.ScaleOf(amplitude));
    for (Eigen::Index i = 0; i < legs; ++i)
      form.directions(amplitude + effect->index[i] - 1, i) = 1.0;
    library.forms.push_back(form);
  }
  const GapProblem problem = MakeGapProblem(data, refit.mounts, refit.effects, library);
  std::vector<int> all;
  for (std::size_t f = 0; f < library.forms.size(); ++f) all.push_back(static_cast<int>(f));
  const JointFit without = FitJointly(
      problem.linear, noise, {all.begin(), all.end() - 2}, kHarmonicPrior, Eigen::VectorXd());
  const JointFit with = FitJointly(problem.linear, noise, all, kHarmonicPrior, Eigen::VectorXd());
  // Two numbers a leg, at some 1 in 100.
  if (without.squares - with.squares < 9.2 * static_cast<double>(legs)) return false;
  const Eigen::VectorXd pairs = with.coefficients.tail(2 * legs);
  for (Eigen::Index i = 0; i < legs; ++i) {
    const int leg = effect->index[i] - 1;
    effect->parameters[amplitude + leg] = std::hypot(pairs[i], pairs[legs + i]);
    effect->parameters[phase + leg] = std::atan2(pairs[legs + i], pairs[i]);
  }
  return true;
}

}  // namespace

Refit RefitAsSeen(const GapData& data,
                  const Mounts& start,
                  const std::vector<Effect>& effects,
                  const GapNoise& noise,
                  double prior_width) {
  Refit refit;
  refit.mounts = start;
  refit.effects = effects;
  Refitter refitter(data, noise, prior_width);
  refitter.Run(&refit);
  bool more = false;
  for (std::size_t e = 0; e < effects.size(); ++e)
    if (effects[e].name == "leg_periodic")
      more = StartSecondHarmonic(data, noise, refit, e, &refit.effects[e]) || more;
  if (more) refitter.Run(&refit);
  return refit;
}

Refit RefitMachine(const GapData& data,
                   const Mounts& start,
                   const std::vector<Effect>& effects,
                   const GapNoise& noise,
                   double prior_width) {
  Refit refit = RefitAsSeen(data, start, effects, noise, prior_width);
  CorrectCommonWorld(data, FreeForms(refit.effects), &refit);
  return refit;
}

}  // namespace hexcal
