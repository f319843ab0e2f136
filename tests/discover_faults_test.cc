// SPDX-License-Identifier: BSD-3-Clause
// Markers under each other's names, and effects driven by columns that the table of effects does
// not know, put into a machine of an independent simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "discovery/discover.h"
#include "discovery/swapped_markers.h"
#include "estimator/calibrate_grown.h"
#include "model/data_fault.h"
#include "model/described_effect.h"
#include "model/machine.h"
#include "model/predict.h"
#include "model/simulate.h"

namespace hexcal {
namespace {

Dataset Example() { return ReadDataset(HEXCAL_EXAMPLES "/hidden-effect/dataset.yaml", true); }

DiscoverOptions Quick() {
  DiscoverOptions options;
  options.bootstraps = 99;
  options.folds = 0;
  return options;
}

Effect Swap(int a, int b) {
  Effect effect;
  effect.name = "swapped_markers";
  effect.index = {a, b};
  return effect;
}

Dataset WithSwaps(Dataset dataset, const std::vector<Effect>& swaps) {
  dataset.measurement = MendedMeasurement(*dataset.measurement, swaps);
  return dataset;
}

// Base and tool of the example, nothing else, seen with its noise.
Dataset PlainMachine(const Dataset& dataset, const std::vector<Effect>& effects) {
  const Estimate alone = Calibrate(MakeObservations(dataset), std::nullopt, {});
  Machine machine;
  machine.world_from_base = alone.mounts.world_from_base;
  machine.platform_from_tool = alone.mounts.platform_from_tool;
  machine.effects = effects;
  return Simulate(dataset, machine, {});
}

TEST(SwappedMarkers, RightNamesAreLeftAlone) { EXPECT_TRUE(FindSwappedMarkers(Example()).empty()); }

TEST(SwappedMarkers, EveryPairIsFound) {
  const Dataset dataset = Example();
  const int markers = static_cast<int>(dataset.measurement->bodies[0].markers.size() +
                                       dataset.measurement->bodies[1].markers.size());
  for (int a = 1; a <= markers; ++a)
    for (int b = a + 1; b <= markers; ++b) {
      const auto found = FindSwappedMarkers(WithSwaps(dataset, {Swap(a, b)}));
      ASSERT_EQ(found.size(), 1u) << a << " " << b;
      EXPECT_EQ(found[0].effect.index, (std::vector<int>{a, b}));
      EXPECT_GT(found[0].gain, 40.0);
    }
}

TEST(SwappedMarkers, TwoPairsAreFound) {
  const auto found = FindSwappedMarkers(WithSwaps(Example(), {Swap(1, 2), Swap(6, 7)}));
  ASSERT_EQ(found.size(), 2u);
  const std::vector<int> first = found[0].effect.index, second = found[1].effect.index;
  EXPECT_TRUE((first == std::vector<int>{1, 2} && second == std::vector<int>{6, 7}) ||
              (first == std::vector<int>{6, 7} && second == std::vector<int>{1, 2}));
}

// Mended, the data are what they were: the same base and tool, and the other effects too.
TEST(SwappedMarkers, AreMendedBeforeAllElse) {
  const Dataset dataset = PlainMachine(Example(), {});
  const Dataset swapped = WithSwaps(dataset, {Swap(5, 7)});
  const Discovery plain = Discover(dataset, Quick()), mended = Discover(swapped, Quick());
  ASSERT_EQ(mended.effects.size(), plain.effects.size() + 1);
  EXPECT_EQ(mended.effects[0].effect.name, "swapped_markers");
  const MarkerBody& tool = dataset.measurement->bodies[1];
  const int in_base = static_cast<int>(dataset.measurement->bodies[0].markers.size());
  EXPECT_EQ(mended.effects[0].labels,
            (std::vector<std::string>{"tool/" + tool.markers[5 - in_base - 1],
                                      "tool/" + tool.markers[7 - in_base - 1]}));
  const Vector6d apart = Minus(mended.base_and_tool.mounts.world_from_base,
                               plain.base_and_tool.mounts.world_from_base);
  EXPECT_LT(apart.norm(), 1e-9);
  // The grown model mends the next measurement as well.
  const GrownCalibration next = CalibrateGrown(swapped, mended.machine, {});
  EXPECT_LT(Minus(next.machine.platform_from_tool, plain.machine.platform_from_tool).norm(), 1e-6);
}

TEST(MendedMeasurement, AMarkerBeyondTheBodiesIsRefused) {
  EXPECT_THROW(WithSwaps(Example(), {Swap(1, 99)}), InputError);
}

// The tool bends with the humidity, of which the table of effects knows nothing.
TEST(Discover, DescribesWhatFollowsAnUnknownCovariate) {
  Dataset dataset = Example();
  Covariate humidity{"humidity", *FindCovariateUnit("1"), {}};
  const std::size_t rows = dataset.robot_poses.rows.size();
  for (std::size_t i = 0; i < rows; ++i)
    humidity.values.push_back(0.45 + 0.2 * std::sin(1.7 * static_cast<double>(i * i % 101)));
  dataset.robot_poses.covariates.push_back(humidity);
  Effect bends = DescribedEffect("tool", "humidity", 1, 0.45, 0.2);
  bends.parameters << 2e-4, -1e-4, 1e-4, 6e-4, -4e-4, 2e-4;
  const Dataset seen = PlainMachine(dataset, {bends});
  const Discovery discovery = Discover(seen, Quick());
  ASSERT_EQ(discovery.effects.size(), 1u);
  const DiscoveredEffect& found = discovery.effects[0];
  EXPECT_EQ(found.effect.name, kUnknownEffect);
  EXPECT_EQ(found.site, "tool");
  EXPECT_EQ(found.driver, "humidity");
  // Per unit of humidity.
  const double half_range = found.effect.reference.at("half_range")[0];
  for (int k = 0; k < 6; ++k)
    EXPECT_LT(std::abs(found.effect.parameters[k] / half_range - bends.parameters[k] / 0.2),
              4.5 * found.effect.standard_deviation[k] / half_range)
        << k;
  // The model file keeps the driver's name, and asks the next dataset for the column.
  const std::string path = testing::TempDir() + "humid_model.yaml";
  std::ofstream(path) << WriteMachine(discovery.machine);
  const Machine machine = ReadMachine(path);
  EXPECT_NEAR(
      (Predict(machine, seen)[3].translation - Predict(discovery.machine, seen)[3].translation)
          .norm(),
      0.0,
      1e-12);
  EXPECT_THROW(Predict(machine, Example()), InputError);
}

}  // namespace
}  // namespace hexcal
