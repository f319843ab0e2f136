// SPDX-License-Identifier: BSD-3-Clause
// A study's numbers held against the truth it drew from.
#include "batch/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "batch/run_chunks.h"
#include "batch/store.h"
#include "batch/study_job.h"
#include "batch/study_result.h"
#include "batch/study_summary.h"
#include "config/strict_yaml.h"
#include "model/predict.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::TemporaryFolder;

const std::string kExamples = HEXCAL_EXAMPLES "/";

Dataset Neurobot() { return ReadDataset(kExamples + "neurobot/dataset.yaml", true); }
Machine Truth() { return ReadMachine(kExamples + "neurobot/truth.yaml"); }

// The same poses, but measured as poses: quick.
Dataset Posed(double along_y = 2e-4, double about_z = 1e-3) {
  Dataset dataset = Neurobot();
  dataset.measurement->kind = Measurement::Kind::kPoses;
  dataset.measurement->readings.clear();
  dataset.measurement->marker_sigma.reset();
  dataset.measurement->pose_noise =
      PoseNoise{Eigen::Vector3d(1e-4, along_y, 1e-4), Eigen::Vector3d(5e-4, 5e-4, about_z)};
  return dataset;
}

StudyEstimator By(Method method) {
  StudyEstimator estimator;
  estimator.name = std::string(InfoOf(method).name);
  estimator.method = method;
  return estimator;
}

Study PosedStudy(int draws) {
  Study study;
  study.name = "test";
  study.draws = draws;
  study.cells = {MakeStudyCell("s", Posed(), Truth(), nullptr, 1.0, 12, 1.0, true)};
  study.estimators = {By(Method::kNonlinear)};
  return study;
}

// All of a study's rows.
class Results {
 public:
  explicit Results(Study study) {
    batch_.name = study.name;
    batch_.digest = "d";
    auto job = std::make_unique<StudyJob>(std::move(study));
    job_ = job.get();
    batch_.job = std::move(job);
    store_ = std::make_unique<Store>(folder_.Path("db"), batch_);
    const std::vector<Column> columns = AllColumns(*job_);
    std::vector<Row> rows;
    for (std::int64_t task = 0; task < job_->tasks(); ++task)
      for (const Outcome& outcome : job_->Work(task))
        rows.push_back(MakeRow(static_cast<std::int64_t>(rows.size()), outcome, columns));
    store_->Insert(rows);
  }

  std::vector<StudySummary> Summaries() { return Summarise(job_->study(), store_.get()); }

  // A column of real numbers over all rows.
  std::vector<double> Reals(const std::string& name) {
    const std::vector<Column> columns = AllColumns(*job_);
    std::size_t at = 0;
    while (columns.at(at).name != name) ++at;
    std::vector<double> values;
    store_->ForEach([&](const Row& row) {
      const auto* x = std::get_if<double>(&row.cells[at]);
      values.push_back(x != nullptr ? *x : std::nan(""));
    });
    return values;
  }

 private:
  TemporaryFolder folder_;
  Batch batch_;
  const StudyJob* job_ = nullptr;
  std::unique_ptr<Store> store_;
};

TEST(Study, ADrawDependsOnItsNumberAndTheStudyAlone) {
  const Study study = PosedStudy(10);
  Study longer = PosedStudy(1000);
  Study other = PosedStudy(10);
  other.seed = 2;
  std::set<std::uint64_t> seeds;
  for (int task = 0; task < 10; ++task) {
    EXPECT_EQ(SeedOf(study, task), SeedOf(longer, task));
    EXPECT_NE(SeedOf(study, task), SeedOf(other, task));
    seeds.insert(SeedOf(study, task));
  }
  EXPECT_EQ(seeds.size(), 10u);
  const Dataset a = DrawDataset(study.cells[0], 5), b = DrawDataset(study.cells[0], 5);
  const Dataset c = DrawDataset(study.cells[0], 6);
  ASSERT_EQ(a.measurement->poses.size(), 12u);
  EXPECT_EQ(a.measurement->poses[3].world_from_tool.translation,
            b.measurement->poses[3].world_from_tool.translation);
  EXPECT_NE(a.measurement->poses[3].world_from_tool.translation,
            c.measurement->poses[3].world_from_tool.translation);
}

TEST(Study, DrawsEveryPoseEquallyOften) {
  const StudyCell cell = MakeStudyCell("s", Posed(), Truth(), nullptr, 1.0, 12, 1.0, true);
  std::map<std::string, int> count;
  const int draws = 500;
  for (int i = 0; i < draws; ++i) {
    std::string last;
    for (const RobotPose& row : DrawDataset(cell, i).robot_poses.rows) ++count[row.label];
  }
  EXPECT_EQ(count.size(), 60u);
  for (const auto& [label, times] : count) {  // 100 expected, sigma 9
    EXPECT_GT(times, 60) << label;
    EXPECT_LT(times, 140) << label;
  }
}

TEST(Study, WithoutNoiseAllThatIsExactIsExact) {
  Study study = PosedStudy(3);
  study.cells = {MakeStudyCell("s", Posed(), Truth(), nullptr, 0.0, 0, 1.0, false)};
  study.estimators = {By(Method::kNonlinear),
                      By(Method::kTwist),
                      By(Method::kShah),
                      By(Method::kLi),
                      By(Method::kParkMartin)};
  Results results(study);
  for (const StudySummary& s : results.Summaries()) {
    EXPECT_EQ(s.done, 3) << s.estimator->name;
    EXPECT_LT(s.rms_position, 1e-9) << s.estimator->name;
    EXPECT_LT(s.rms_orientation, 1e-8) << s.estimator->name;
    EXPECT_LT(s.rms_error.maxCoeff(), 1e-8) << s.estimator->name;
  }
}

// A cell of a row by its name.
double CellOf(const std::vector<Cell>& cells, const std::string& name) {
  const std::vector<Column> columns = StudyColumns(0);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) {
      const auto* x = std::get_if<double>(&cells[i]);
      return x != nullptr ? *x : std::nan("");
    }
  ADD_FAILURE() << "no column " << name;
  return std::nan("");
}

// Worked by hand: a base 1 mm too far along its x puts every tool 1 mm off and turns none.
TEST(Study, JudgesAKnownErrorByHand) {
  const Study study = PosedStudy(1);
  StudyResult result;
  result.mounts = {study.cells[0].truth.world_from_base, study.cells[0].truth.platform_from_tool};
  Vector6d error = Vector6d::Zero();
  error[0] = 1e-3;
  result.mounts.world_from_base = Plus(result.mounts.world_from_base, error);
  Estimate estimate;
  estimate.mounts = result.mounts;
  estimate.covariance = 4e-6 * Matrix12d::Identity();
  estimate.covariance(0, 1) = estimate.covariance(1, 0) = 2e-6;
  estimate.intervals.half_width.setLinSpaced(1.0, 12.0);
  estimate.intervals.ellipsoid = 21.0;
  estimate.observability.determined.fill(true);
  estimate.observability.determined[7] = false;
  result.estimate = estimate;
  const std::vector<Cell> cells = StudyCells(study, 0, study.estimators[0], result);
  EXPECT_NEAR(CellOf(cells, "error_base_dx"), 1e-3, 1e-15);
  EXPECT_NEAR(CellOf(cells, "error_base_dy"), 0.0, 1e-15);
  EXPECT_NEAR(CellOf(cells, "error_tool_dx"), 0.0, 1e-15);
  EXPECT_NEAR(CellOf(cells, "rms_position"), 1e-3, 1e-12);
  EXPECT_NEAR(CellOf(cells, "rms_orientation"), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(CellOf(cells, "rms_position_measured")));
  EXPECT_EQ(CellOf(cells, "half_width_base_dx"), 1.0);
  EXPECT_EQ(CellOf(cells, "half_width_base_rx"), 4.0);
  EXPECT_TRUE(std::isnan(CellOf(cells, "half_width_tool_dy")));
  EXPECT_EQ(CellOf(cells, "half_width_tool_rz"), 12.0);
  // (C^-1)_11 of [4 2; 2 4] e-6 is 4/12 e6.
  EXPECT_NEAR(CellOf(cells, "squared_distance"), 1e-6 * 1e6 / 3.0, 1e-9);
  EXPECT_EQ(CellOf(cells, "ellipsoid"), 21.0);

  // Turned by 2 mrad about its own z.
  error.setZero();
  error[5] = 2e-3;
  result.mounts.world_from_base = Plus(study.cells[0].truth.world_from_base, error);
  const std::vector<Cell> turned = StudyCells(study, 0, study.estimators[0], result);
  EXPECT_NEAR(CellOf(turned, "error_base_rz"), 2e-3, 1e-12);
  EXPECT_NEAR(CellOf(turned, "rms_orientation"), 2e-3, 1e-12);
}

TEST(Study, ErrorsGrowWithTheNoise) {
  Study study = PosedStudy(100);
  study.cells.push_back(MakeStudyCell("s", Posed(), Truth(), nullptr, 3.0, 12, 1.0, true));
  Results results(study);
  const std::vector<StudySummary> s = results.Summaries();
  EXPECT_GT(s[1].rms_position, 2.5 * s[0].rms_position);
  EXPECT_LT(s[1].rms_position, 3.5 * s[0].rms_position);
}

// Errors scatter as the intervals say, and these hold the truth in 95 of 100 draws: of 1200
// intervals, dependent within a draw, and of 400 regions.
TEST(Study, CoverageIsWhatItSays) {
  Study study = PosedStudy(400);
  // Estimated noise is taken to be one level for positions and one for orientations.
  study.cells.push_back(
      MakeStudyCell("u", Posed(1e-4, 5e-4), Truth(), nullptr, 3.0, 12, 1.0, false));
  Results results(study);
  const std::vector<StudySummary> summaries = results.Summaries();
  for (const StudySummary& s : summaries) {
    EXPECT_EQ(s.done, 400);
    EXPECT_NEAR(s.mean_coverage, 0.95, 0.015) << s.cell->scenario;
    for (const double coverage : s.coverage) EXPECT_NEAR(coverage, 0.95, 4.0 * 0.0109);
    EXPECT_NEAR(s.ellipsoid_coverage, 0.95, 4.0 * 0.0109);
  }
  // The bias is within what so many draws leave.
  for (int i = 0; i < 12; ++i)
    EXPECT_LT(std::abs(summaries[0].bias[i]), 4.0 * summaries[0].rms_error[i] / 20.0);
}

// E[d' C^-1 d] = 12 for known noise: the whole covariance, not its diagonal alone.
TEST(Study, ErrorsHaveTheCovarianceThatIsStated) {
  Results results(PosedStudy(400));
  double mean = 0.0;
  for (const double d : results.Reals("squared_distance")) mean += d / 400.0;
  EXPECT_NEAR(mean, 12.0, 4.0 * std::sqrt(24.0 / 400.0));
}

// Figure 5's numbers by another way: tests/figure5_test.cc draws subsets of readings that were
// measured once, this draws the readings too.
TEST(Study, FollowsFigure5) {
  const Dataset test = ReadDataset(kExamples + "neurobot-test/dataset.yaml", true);
  Study study;
  study.name = "figure5";
  study.draws = 60;
  for (const int poses : {10, 60})
    study.cells.push_back(MakeStudyCell("n", Neurobot(), Truth(), &test, 1.0, poses, 1.0, true));
  study.estimators = {By(Method::kNonlinear), By(Method::kPaper)};
  study.estimators[1].calibrate.linearized.tolerance = 1e-9;
  Results results(study);
  const std::vector<StudySummary> s = results.Summaries();
  EXPECT_NEAR(s[0].rms_position_measured, 0.0824e-3, 0.003e-3);  // 10 poses, nonlinear
  EXPECT_NEAR(s[1].rms_position_measured, 0.0845e-3, 0.003e-3);  // paper's iteration
  EXPECT_NEAR(s[2].rms_position_measured, 0.0750e-3, 0.002e-3);  // 60 poses
  EXPECT_GT(s[0].rms_position, 2.0 * s[2].rms_position);
  EXPECT_GT(s[1].rms_position, 1.02 * s[0].rms_position);
}

TEST(Study, RecordsHowIterationsConverge) {
  Study study = PosedStudy(5);
  study.records = 4;
  study.estimators = {By(Method::kTwist)};
  Results results(study);
  const StudySummary s = results.Summaries()[0];
  ASSERT_EQ(s.rmspe.size(), 4u);
  EXPECT_GT(s.rmspe[0], 1e-3);  // the first guess is off by centimetres
  EXPECT_LT(s.rmspe[1], 0.1 * s.rmspe[0]);
  EXPECT_LT(s.rmspe[3], 5e-4);
  EXPECT_GE(s.iterations, 2.0);
}

Effect Periodic(double amplitude) {
  Effect effect;
  effect.name = "leg_periodic";
  effect.index = {2};
  const EffectKind& kind = *FindEffectKind("leg_periodic");
  effect.parameters = Eigen::VectorXd::Zero(kind.SizeFor(effect.index));
  for (Eigen::Index k = 0; k < effect.parameters.size(); ++k) {
    const ParameterKind& parameter = kind.ParameterOf(static_cast<int>(k));
    effect.parameters[k] = parameter.is_search ? 5e-3 : 0.0;
  }
  effect.parameters[1] = amplitude;
  return effect;
}

TEST(Study, AFactorOnEffectsLeavesTheirPeriods) {
  Machine truth = Truth();
  truth.effects = {Periodic(1e-4)};
  const Dataset dataset = Posed();
  const auto cell = [&](double effects) {
    return MakeStudyCell("s", dataset, truth, nullptr, 1.0, 0, effects, true);
  };
  const Eigen::VectorXd& once = truth.effects[0].parameters;
  const StudyCell half = cell(0.5);
  const Eigen::VectorXd& halved = half.truth.effects[0].parameters;
  int periods = 0;
  for (Eigen::Index k = 0; k < once.size(); ++k) {
    const bool is_period =
        FindEffectKind("leg_periodic")->ParameterOf(static_cast<int>(k)).is_search;
    periods += is_period ? 1 : 0;
    EXPECT_EQ(halved[k], is_period ? once[k] : 0.5 * once[k]) << k;
  }
  EXPECT_GE(periods, 1);
  EXPECT_TRUE(cell(0.0).truth.effects.empty());
  // What is hidden is in the true poses.
  const StudyCell full = cell(1.0), none = cell(0.0);
  double moved = 0.0;
  for (std::size_t i = 0; i < full.test_true.size(); ++i)
    moved = std::max(moved, (full.test_true[i].translation - none.test_true[i].translation).norm());
  EXPECT_GT(moved, 5e-5);
  EXPECT_LT(moved, 1e-3);
}

TEST(Study, CountsWhatWasNamed) {
  Machine truth = Truth();
  truth.effects = {Periodic(1e-4)};
  Discovery discovery;
  EXPECT_EQ(DetectionOf(truth, discovery).hidden, 1);
  EXPECT_EQ(DetectionOf(truth, discovery).named, 0);
  discovery.effects.resize(2);
  discovery.effects[0].effect.name = "leg_backlash";
  discovery.effects[0].could_also_be = {{"leg_periodic", ""}};
  discovery.effects[1].effect.name = "base_drift";
  EXPECT_EQ(DetectionOf(truth, discovery).named, 1);
  EXPECT_EQ(DetectionOf(truth, discovery).false_names, 1);
  truth.effects.clear();
  EXPECT_EQ(DetectionOf(truth, discovery).hidden, 0);
  EXPECT_EQ(DetectionOf(truth, discovery).false_names, 2);
}

// Large, it is always named; absent, hardly ever anything is.
TEST(Study, TellsTheDetectionPower) {
  Machine truth = Truth();
  truth.effects = {Periodic(3e-3)};
  Study study;
  study.name = "power";
  study.draws = 2;
  for (const double effects : {0.0, 1.0})
    study.cells.push_back(MakeStudyCell("s", Posed(), truth, nullptr, 1.0, 0, effects, true));
  StudyEstimator discover;
  discover.name = "discover";
  discover.discovers = true;
  discover.discover.bootstraps = 99;
  discover.discover.folds = 0;
  study.estimators = {discover};
  Results results(study);
  const std::vector<StudySummary> s = results.Summaries();
  EXPECT_EQ(s[0].false_names, 0.0);
  EXPECT_TRUE(std::isnan(s[0].all_named));  // nothing is hidden
  EXPECT_EQ(s[1].all_named, 1.0);
  // With the effect in the model the prediction is better than a base and tool can make it.
  EXPECT_LT(s[1].rms_position, 3e-4);
}

}  // namespace
}  // namespace hexcal
