// SPDX-License-Identifier: BSD-3-Clause
// Every column that discovery tests against must be what the exact forward model does, in the
// poses and in the markers' misfit.
#include "discovery/gap_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "estimator/calibrate.h"
#include "model/described_effect.h"
#include "model/predict.h"
#include "model/simulate.h"

namespace hexcal {
namespace {

const std::string kExample = HEXCAL_EXAMPLES "/hidden-effect/dataset.yaml";

class GapModel : public ::testing::Test {
 protected:
  void SetUp() override { Take(ReadDataset(kExample, true)); }

  void Take(const Dataset& dataset) {
    dataset_ = dataset;
    data_ = MakeGapData(dataset_, ReportedPoses(dataset_));
    const Estimate estimate = Calibrate(MakeObservations(dataset_), std::nullopt, {});
    mounts_ = {estimate.mounts.world_from_base, estimate.mounts.platform_from_tool};
    library_ = MakeFormLibrary(dataset_, data_.visits, data_.rows);
    problem_ = MakeGapProblem(data_, mounts_, {}, library_);
  }

  // What an effect in the machine takes out of the error, by central differences, one after the
  // other: poses, then shapes.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> Taken(const FormDefinition& form, int k) const {
    const double h = 1e-2 * form.scale[k];
    std::array<GapProblem, 2> moved;
    for (const int side : {0, 1}) {
      Eigen::VectorXd c = Eigen::VectorXd::Zero(form.size());
      c[k] = side == 0 ? h : -h;
      moved[side] = MakeGapProblem(data_, mounts_, {EffectOf(form, c)}, {});
    }
    return {(moved[1].linear.error - moved[0].linear.error) / (2.0 * h),
            (moved[1].linear.shape_error - moved[0].linear.shape_error) / (2.0 * h)};
  }

  Dataset dataset_;
  GapData data_;
  Mounts mounts_;
  FormLibrary library_;
  GapProblem problem_;
};

TEST_F(GapModel, ColumnsAreDerivativesOfTheExactModel) {
  constexpr double kSigma = 1e-5;  // of a reading, m: the unit of shape rows
  const LinearProblem& linear = problem_.linear;
  std::set<int> done;
  int compared = 0;
  for (std::size_t f = 0; f < library_.forms.size(); ++f) {
    const FormDefinition& form = library_.forms[f];
    // One form of each family, of searched ones some in the middle.
    const bool is_late = f % 5 == 3 || form.log_prior > -2.5;
    if (!is_late || !done.insert(form.family).second) continue;
    for (int k = 0; k < std::min(form.size(), 6); ++k) {
      if (form.reading == FormDefinition::Reading::kCompliance && k > 0) continue;
      const int column = linear.forms[f].first + k;
      const auto [pose, shape] = Taken(form, k);
      const Eigen::VectorXd expected = linear.columns->col(column);
      const double size = expected.norm();
      // The columns are those of a perfect fit; the gap itself turns them by some 1e-4.
      EXPECT_LT((pose - expected).norm(), 1e-3 * size + 1e-3)
          << library_.families[form.family].name << " column " << k;
      if (linear.shape_of[column] >= 0) {
        const Eigen::VectorXd by_shape = linear.shape_columns->col(linear.shape_of[column]);
        EXPECT_LT((shape - by_shape).norm(), 1e-3 * by_shape.norm() + 1e-4 / kSigma)
            << library_.families[form.family].name << " column " << k;
      } else {
        EXPECT_LT(shape.norm(), 1e-4 / kSigma) << library_.families[form.family].name;
      }
      ++compared;
    }
  }
  EXPECT_EQ(done.size(), library_.families.size());
  EXPECT_GT(compared, 100);
}

// A tracker that stood still sees the base once; what moves its readings of the tool moves the
// pose.
TEST_F(GapModel, ReadingsMoveThePoseUnderAStaticTrackerToo) {
  Dataset seen = dataset_;
  seen.tracker.is_static = true;
  Machine machine;
  machine.world_from_base = mounts_.world_from_base;
  machine.platform_from_tool = mounts_.platform_from_tool;
  Take(Simulate(seen, machine, {}));
  ASSERT_TRUE(problem_.seen[0].bodies[0].markers.empty());
  std::set<std::string> moving;
  for (std::size_t f = 0; f < library_.forms.size(); ++f) {
    const FormDefinition& form = library_.forms[f];
    const EffectKind* kind = FindEffectKind(form.effect.name);
    if (kind == nullptr || (kind->site != "tracker" && kind->site != "marker")) continue;
    if (!moving.insert(form.effect.name).second) continue;
    for (int k = 0; k < form.size(); ++k) {
      const Eigen::VectorXd expected =
          problem_.linear.columns->col(problem_.linear.forms[f].first + k);
      const Eigen::VectorXd pose = Taken(form, k).first;
      EXPECT_LT((pose - expected).norm(), 1e-3 * expected.norm() + 1e-3) << form.effect.name << k;
    }
  }
  EXPECT_EQ(moving.count("tracker_warmup") + moving.count("marker_offset"), 2u);
}

TEST_F(GapModel, ShapesHaveNoRigidMotionInThem) {
  for (const SeenPose& seen : problem_.seen)
    for (const SeenBody& body : seen.bodies) {
      Eigen::Matrix3Xd turned = body.p_in_tracker;
      const Eigen::Vector3d axis(1e-3, -2e-3, 3e-3);
      for (Eigen::Index i = 0; i < turned.cols(); ++i)
        turned.col(i) =
            axis.cross(body.tracker_from_body * Eigen::Vector3d(body.p_in_body.col(i))) +
            Eigen::Vector3d(0.1, 0.2, -0.3);
      EXPECT_LT(body.ShapeOf(turned).norm(), 1e-9 * turned.norm() / body.sigma(0, 0));
      EXPECT_EQ(body.Misfit().size(), 3 * static_cast<Eigen::Index>(body.markers.size()) - 6);
    }
}

TEST_F(GapModel, ABodysTwistIsWhatMovesTheMeasuredPose) {
  const SeenPose& seen = problem_.seen[3];
  Vector6d base, tool;
  base << 1e-5, -2e-5, 3e-5, 2e-5, 1e-5, -3e-5;
  tool << -1e-5, 2e-5, 1e-5, 3e-5, -2e-5, 1e-5;
  const Pose3d moved = Plus(seen.bodies[0].tracker_from_body, base).Inverse() *
                       Plus(seen.bodies[1].tracker_from_body, tool);
  EXPECT_LT((Minus(moved, seen.world_from_tool) - seen.MeasuredTwist(base, tool)).norm(), 1e-8);
}

TEST_F(GapModel, APoseMapIsAnEffectAndBack) {
  for (const FormDefinition& form : library_.forms)
    if (IsPoseMap(form.effect)) {
      Effect effect = form.effect;
      effect.parameters.setLinSpaced(-1e-4, 1e-4);
      const PoseMap map = PoseMapOf(effect);
      const Effect again = PoseMapEffect(map);
      EXPECT_EQ(again.parameters, effect.parameters);
      const Visit& visit = data_.visits[5];
      const Corrections<double> corrections = CorrectionsOf({effect}, visit);
      EXPECT_LT((corrections.platform_twist - PoseMapTwist(map, visit.base_from_platform)).norm(),
                1e-15);
    }
}

}  // namespace
}  // namespace hexcal
