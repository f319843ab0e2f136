// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/unknown_geometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "discovery/geometry_search.h"
#include "discovery/hold_out.h"
#include "discovery/joint_fit.h"
#include "discovery/score.h"
#include "model/described_effect.h"
#include "model/forward.h"
#include "model/hexapod.h"

namespace hexcal {
namespace {

constexpr const char* kErrors[] = {
    "leg_offset", "leg_gain", "base_joint_offset", "platform_joint_offset"};
constexpr double kKeep = 3.0;  // -log10 p that an effect must keep when the errors are there
// Of the map's held-out chi-square: what a cause that is not the whole one must do better than.
constexpr double kMuchBetter = 0.5;

// Base, tool and the errors of a part of the poses, from their own search.
struct Trained {
  Eigen::VectorXd nuisances;
  std::optional<GeometryFound> found;
  GeometryLikelihood::Fit fit;
};

Trained TrainAlone(const LinearProblem& problem, const GapNoise& noise) {
  Trained trained;
  trained.nuisances = FitJointly(problem, noise, {}, 1.0, Eigen::VectorXd()).mounts;
  return trained;
}

Trained Train(const ReportedGap& gap, const GapNoise& noise, const GeometrySearch& search) {
  const GeometryLikelihood likelihood(gap, noise);
  Trained trained;
  trained.found = search.Find(likelihood);
  if (!trained.found) return TrainAlone(*gap.problem, noise);
  trained.fit = likelihood.Solve(MakeHexapod(trained.found->nominal), trained.found->width);
  trained.nuisances = trained.fit.nuisances;
  return trained;
}

Eigen::VectorXd Left(const ReportedGap& gap, const Trained& trained) {
  Eigen::VectorXd left = gap.problem->error - gap.problem->nuisance * trained.nuisances;
  if (trained.found)
    left -= GeometryColumns(gap, MakeHexapod(trained.found->nominal)) * trained.fit.errors;
  return left;
}

void Put(const Eigen::VectorXd& part, const std::vector<int>& poses, Eigen::VectorXd* whole) {
  for (std::size_t i = 0; i < poses.size(); ++i)
    whole->segment<6>(6 * poses[i]) = part.segment<6>(6 * static_cast<Eigen::Index>(i));
}

// Errors of poses of which neither fit nor search knew, with base and tool (and the others) alone
// and with the errors of a hexapod.
struct HeldOutErrors {
  Eigen::VectorXd before, after;
};

HeldOutErrors HoldOutGeometry(const ReportedGap& gap,
                              const GapNoise& noise,
                              const GeometrySearch& search,
                              int folds,
                              std::uint64_t seed) {
  const int poses = gap.problem->poses;
  HeldOutErrors errors = {Eigen::VectorXd(6 * poses), Eigen::VectorXd(6 * poses)};
  for (const std::vector<int>& part : HoldOutFolds(poses, std::min(folds, poses / 2), seed)) {
    const std::vector<int> rest = AllBut(poses, part);
    const LinearProblem train = gap.problem->Restricted(rest), test = gap.problem->Restricted(part);
    const GapNoise part_noise = RestrictedNoise(noise, rest);
    const Trained alone = TrainAlone(train, part_noise),
                  trained = Train(gap.Restricted(train, rest), part_noise, search);
    const ReportedGap tested = gap.Restricted(test, part);
    Put(Left(tested, alone), part, &errors.before);
    Put(Left(tested, trained), part, &errors.after);
  }
  return errors;
}

// A problem with this hexapod's errors among its nuisances.
LinearProblem WithErrors(const LinearProblem& problem,
                         const ReportedGap& gap,
                         const HexapodGeometry& hexapod) {
  LinearProblem with = problem;
  const Eigen::Index at = with.nuisance.cols();
  with.nuisance.conservativeResize(Eigen::NoChange, at + kGeometryErrors);
  with.nuisance.rightCols(kGeometryErrors) = GeometryColumns(gap, hexapod);
  with.shape_nuisance.conservativeResize(Eigen::NoChange, at + kGeometryErrors);
  with.shape_nuisance.rightCols(kGeometryErrors).setZero();
  return with;
}

// Whether no map of the pose explains anything beside these errors.
bool IsComplete(const LinearProblem& with_errors,
                const GapNoise& noise,
                const FormLibrary& library) {
  for (std::size_t form = 0; form < library.forms.size(); ++form)
    if (IsPoseMap(library.forms[form].effect) &&
        -Scorer(with_errors.Only({static_cast<int>(form)}), noise).scores()[0].log10_p >= kKeep)
      return false;
  return true;
}

// Of some forms those that explain something that these errors do not.
std::vector<int> StillNeeded(const LinearProblem& problem,
                             const ReportedGap& gap,
                             const HexapodGeometry& hexapod,
                             const GapNoise& noise,
                             const std::vector<int>& forms) {
  const LinearProblem with = WithErrors(problem, gap, hexapod);
  std::vector<int> needed;
  for (const int form : forms)
    if (-Scorer(with.Only({form}), noise).scores()[0].log10_p >= kKeep) needed.push_back(form);
  return needed;
}

std::vector<Effect> ErrorEffects(const HexapodGeometry& hexapod, const Eigen::VectorXd& errors) {
  std::vector<Effect> effects;
  Eigen::Index at = 0;
  for (const char* name :
       {"leg_offset", "leg_gain", "base_joint_offset", "platform_joint_offset"}) {
    Effect effect;
    effect.name = name;
    effect.index.resize(kNumLegs);
    std::iota(effect.index.begin(), effect.index.end(), 1);
    effect.parameters = errors.segment(at, FindEffectKind(name)->size());
    at += effect.parameters.size();
    if (effect.name == "leg_gain") {
      const LegLengths lengths = InverseKinematics(hexapod, *hexapod.home);
      effect.parameters /= lengths.mean();
      effect.reference["home_lengths"] = {lengths.data(), lengths.data() + kNumLegs};
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

bool Reaches(const GapData& data, const UnknownGeometry& geometry) {
  return std::all_of(data.visits.begin(), data.visits.end(), [&](const Visit& visit) {
    const Corrections<double> corrections = CorrectionsOf(geometry.effects, visit);
    return Forward(geometry.mounts, &geometry.hexapod, visit, corrections).reached;
  });
}

std::vector<Pose3d> ReportedOf(const std::vector<Visit>& visits) {
  std::vector<Pose3d> reported;
  for (const Visit& visit : visits) reported.push_back(visit.base_from_platform);
  return reported;
}

class GeometryFinder {
 public:
  GeometryFinder(const GapData& data, const Mounts& mounts, const GapProblem& problem)
      : data_(data), mounts_(mounts), problem_(problem) {
    home_ = HomePose(nullptr, ReportedOf(data.visits));
    for (const int row : data.rows) {
      poses_.push_back(data.visits[row].base_from_platform);
      reach_ = std::max(reach_, (poses_.back().translation - home_.translation).norm());
    }
  }

  std::optional<UnknownGeometry> Run(const FormLibrary& library,
                                     const Selection& selection,
                                     int folds,
                                     std::uint64_t seed) const {
    UnknownGeometry geometry;
    for (const int form : selection.chosen)
      if (!FollowsPose(library.forms[form].effect)) geometry.others.push_back(form);
    if (geometry.others.size() == selection.chosen.size()) return std::nullopt;
    const GeometrySearch search(reach_, home_.translation.z());
    LinearProblem given = problem_.linear.With(geometry.others);
    const ReportedGap gap = {&given, poses_, mounts_.platform_from_tool, home_};
    // What the noise is, and what else is needed, depends on what explains the gap.
    const Trained first = Train(gap, selection.noise, search);
    if (!first.found) return std::nullopt;
    const HexapodGeometry hexapod = MakeHexapod(first.found->nominal);
    geometry.others = StillNeeded(problem_.linear, gap, hexapod, selection.noise, geometry.others);
    given = problem_.linear.With(geometry.others);
    const GapNoise noise = EstimateGapNoise(WithErrors(given, gap, hexapod), problem_.trend);
    const Trained trained = Train(gap, noise, search);
    if (!trained.found) return std::nullopt;
    Describe(*trained.found, gap, noise, search, seed, &geometry);
    Fill(library, trained, &geometry);
    const int taken = static_cast<int>(std::lround(trained.fit.freedom)) + 6;
    geometry.report.after = SizeOf(problem_.linear,
                                   selection.noise,
                                   Left(gap, trained),
                                   static_cast<int>(given.nuisance.cols()) + taken);
    geometry.report.is_complete =
        IsComplete(WithErrors(given, gap, MakeHexapod(trained.found->nominal)), noise, library);
    geometry.noise = noise;
    if (folds >= 2) {
      const HeldOutErrors errors = HoldOutGeometry(gap, noise, search, folds, seed);
      geometry.report.heldout = SizeOf(problem_.linear, selection.noise, errors.after, 0);
      geometry.heldout_before = SizeOf(problem_.linear, noise, errors.before, 0);
      geometry.heldout_after = SizeOf(problem_.linear, noise, errors.after, 0);
    }
    if (!Reaches(data_, geometry)) return std::nullopt;
    return geometry;
  }

 private:
  static void Describe(const GeometryFound& found,
                       const ReportedGap& gap,
                       const GapNoise& noise,
                       const GeometrySearch& search,
                       std::uint64_t seed,
                       UnknownGeometry* geometry) {
    geometry->report.bounds = search.Bounds(GeometryLikelihood(gap, noise), found, seed);
    geometry->report.yaw = found.nominal.yaw;
    geometry->report.error_size = found.width;
    geometry->hexapod = MakeHexapod(found.nominal);
    geometry->prior_width = found.width / FindEffectKind("leg_offset")->ScaleOf(0);
  }

  void Fill(const FormLibrary& library, const Trained& trained, UnknownGeometry* geometry) const {
    geometry->hexapod.home = home_;
    const Eigen::VectorXd& step = trained.nuisances;
    geometry->mounts = {Plus(mounts_.world_from_base, Vector6d(step.head<6>())),
                        Plus(mounts_.platform_from_tool, Vector6d(step.segment<6>(6)))};
    Eigen::Index at = 12;
    for (const int form : geometry->others) {
      const FormDefinition& definition = library.forms[form];
      geometry->effects.push_back(EffectOf(definition, step.segment(at, definition.size())));
      at += definition.size();
    }
    for (Effect& effect : ErrorEffects(geometry->hexapod, trained.fit.errors))
      geometry->effects.push_back(std::move(effect));
  }

  const GapData& data_;
  const Mounts& mounts_;
  const GapProblem& problem_;
  Pose3d home_;
  std::vector<Pose3d> poses_;  // measured
  double reach_ = 0.0;
};

}  // namespace

bool Wins(const GeometryClass& geometry) {
  const double left = geometry.heldout.chi_square / geometry.heldout_map.chi_square;
  return left < (geometry.is_complete ? 1.0 : kMuchBetter);
}

bool IsGeometryError(const std::string& name) {
  return std::find(std::begin(kErrors), std::end(kErrors), name) != std::end(kErrors);
}

bool FollowsPose(const Effect& effect) {
  if (effect.name != kUnknownEffect) return false;
  const auto driver = effect.found.find("driver");
  return driver != effect.found.end() && driver->second != "time" &&
         driver->second != "temperature" && driver->second != "payload";
}

std::optional<UnknownGeometry> FindUnknownGeometry(const GapData& data,
                                                   const Mounts& mounts,
                                                   const GapProblem& problem,
                                                   const FormLibrary& library,
                                                   const Selection& selection,
                                                   int folds,
                                                   std::uint64_t seed) {
  if (data.hexapod) return std::nullopt;
  return GeometryFinder(data, mounts, problem).Run(library, selection, folds, seed);
}

Refit RefitGeometry(const UnknownGeometry& geometry, GapData* data) {
  data->hexapod = geometry.hexapod;
  data->visits = MakeVisits(*data->dataset, &*data->hexapod, ReportedOf(data->visits));
  return RefitMachine(
      *data, geometry.mounts, geometry.effects, geometry.noise, geometry.prior_width);
}

}  // namespace hexcal
