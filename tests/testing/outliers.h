// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include "estimator/observations.h"
#include "testing/random.h"

namespace hexcal::testing {

// So many different numbers below n, sorted.
template <typename Rng>
std::vector<std::size_t> DrawIndices(Rng& rng, std::size_t count, std::size_t n) {
  std::vector<std::size_t> indices(n);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) std::swap(indices[i], indices[i + rng() % (n - i)]);
  indices.resize(count);
  std::sort(indices.begin(), indices.end());
  return indices;
}

// Moves a measured pose by so many sigmas in a random direction: its position, its orientation, or
// each of both.
enum class Spoilt { kPosition, kOrientation, kBoth };

template <typename Rng>
void Spoil(Rng& rng, Spoilt what, double sigmas, const NoiseLevels& levels, Observation* row) {
  Vector6d move;
  move << sigmas * levels.position * Normal(rng, 3).normalized(),
      sigmas * levels.orientation * Normal(rng, 3).normalized();
  if (what == Spoilt::kPosition) move.tail<3>().setZero();
  if (what == Spoilt::kOrientation) move.head<3>().setZero();
  row->world_from_tool = Plus(row->world_from_tool, move);
}

// Gross outliers: each of these poses by up to 100 sigma, any of the three ways.
template <typename Rng>
void SpoilGrossly(Rng& rng,
                  const std::vector<std::size_t>& indices,
                  const NoiseLevels& levels,
                  std::vector<Observation>* rows) {
  for (const std::size_t i : indices)
    Spoil(rng, static_cast<Spoilt>(rng() % 3), Uniform(rng, 0.0, 100.0), levels, &(*rows)[i]);
}

}  // namespace hexcal::testing
