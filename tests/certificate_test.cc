// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/certificate.h"

#include <gmock/gmock.h>

#include "estimator/calibrate.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using ::testing::HasSubstr;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::KnownNoise;
using testing::SeededByTest;
using testing::TrackerLikeCovariance;
using testing::UnknownNoise;

Certificate CertificateOf(const Observations& observations) {
  const Estimate estimate = Calibrate(observations, {}, {});
  return Certify(observations, {estimate.noise.position, estimate.noise.orientation}, estimate);
}

TEST(Certificate, IsExactForOneNoiseOfPositionsAndOneOfOrientations) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    auto rows = HexapodObservations(rng, AnyMounts(rng), 40);
    testing::AddNoise(rng, Isotropic(4e-5, 3.4e-4), &rows);
    for (const bool known : {true, false}) {
      const Certificate c =
          CertificateOf(known ? KnownNoise(rows, Isotropic(4e-5, 3.4e-4)) : UnknownNoise(rows));
      EXPECT_TRUE(c.certified && c.exact) << c.why;
      EXPECT_GE(c.gap, 0.0);
      EXPECT_LT(c.gap, 1e-6);
      EXPECT_LT(c.distance, 1e-3);
      EXPECT_GT(c.smallest_eigenvalue, 1e-3);
    }
  }
}

TEST(Certificate, SaysThatItIsNotExactForOtherNoise) {
  auto rng = SeededByTest();
  auto rows = HexapodObservations(rng, AnyMounts(rng), 40);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Certificate c = CertificateOf(KnownNoise(rows, TrackerLikeCovariance()));
  EXPECT_TRUE(c.certified) << c.why;
  EXPECT_FALSE(c.exact);
  EXPECT_GT(c.distance, 0.01);  // other weights, another optimum
  EXPECT_LT(c.distance, 10.0);
  EXPECT_THAT(c.why, HasSubstr("not of that kind"));
}

TEST(Certificate, HoldsForExactData) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const Certificate c = CertificateOf(UnknownNoise(HexapodObservations(rng, AnyMounts(rng), 10)));
    EXPECT_TRUE(c.certified) << c.why;
    EXPECT_EQ(c.distance, 0.0);
  }
}

TEST(Certificate, IsNotGivenWhereTheDataLeaveADirectionOpen) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) {
    o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -1, 1)));
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  testing::AddNoise(rng, Isotropic(4e-5, 3.4e-4), &rows);
  const Certificate c = CertificateOf(KnownNoise(rows, Isotropic(4e-5, 3.4e-4)));
  EXPECT_FALSE(c.certified);
  EXPECT_THAT(c.why, HasSubstr("more than one best solution"));
  EXPECT_THAT(c.why, HasSubstr("more than one axis"));
}

TEST(Certificate, IsNotGivenToAWorseMinimum) {
  auto rng = SeededByTest();
  int worse = 0;
  for (int i = 0; i < 60; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 20);
    testing::AddNoise(rng, Isotropic(4e-5, 3.4e-4), &rows);
    const Observations observations = KnownNoise(rows, Isotropic(4e-5, 3.4e-4));
    CalibrateOptions options;
    options.start = Start::kInitial;
    Estimate estimate = Calibrate(observations, AnyMounts(rng), options);
    if (estimate.message.find("local minimum") == std::string::npos) continue;
    ++worse;
    estimate.converged = true;  // as if nothing else had noticed
    const Certificate c = Certify(observations, {}, estimate);
    EXPECT_FALSE(c.certified);
    EXPECT_TRUE(c.smallest_eigenvalue < 0 || c.distance > 10.0);
    EXPECT_FALSE(c.why.empty());
  }
  EXPECT_GT(worse, 3);
}

TEST(Certificate, IsNotGivenWhereTheSolverDidNotConverge) {
  auto rng = SeededByTest();
  const Observations observations = UnknownNoise(HexapodObservations(rng, AnyMounts(rng), 10));
  Estimate estimate = Calibrate(observations, {}, {});
  estimate.converged = false;
  EXPECT_FALSE(Certify(observations, {1e-4, 1e-3}, estimate).certified);
}

TEST(Certificate, IsOfThePosesThatHaveWeight) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 20);
  testing::AddNoise(rng, Isotropic(4e-5, 3.4e-4), &rows);
  const Observations good = KnownNoise(rows, Isotropic(4e-5, 3.4e-4));
  Estimate estimate = Calibrate(good, {}, {});
  rows.push_back(rows.back());
  rows.back().world_from_tool = testing::RandomPose(rng, 1.0);
  estimate.poses.push_back({"bad", 1.0, Vector6d::Constant(0.5)});
  const Observations all = KnownNoise(rows, Isotropic(4e-5, 3.4e-4));
  EXPECT_FALSE(Certify(all, {}, estimate).certified);  // the bad pose pulls the optimum away
  estimate.poses.back().weight = 0.0;
  const Certificate without = Certify(all, {}, estimate);
  EXPECT_TRUE(without.certified && without.exact) << without.why;
  EXPECT_LT(without.distance, 1e-3);
  estimate.poses[0].weight = 0.5;  // a robust loss is none of these weights
  EXPECT_FALSE(Certify(all, {}, estimate).exact);
}

}  // namespace
}  // namespace hexcal
