// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_stream.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace hexcal {
namespace {

constexpr std::size_t kChunkBlocks = 256;  // 1024 poses
// Fewer poses than this for a thread are not worth starting it.
constexpr std::size_t kChunksPerThread = 8;

// work(i) for all i below count, each once, by up to so many threads.
void ForEach(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(run);
  run();
  for (std::thread& thread : others) thread.join();
}

}  // namespace

PoseStream::PoseStream(const PoseBatch& batch,
                       const PoseWeights& weights,
                       RobustLoss loss,
                       int threads)
    : batch_(batch), weights_(weights), loss_(loss), threads_(threads) {}

template <typename Sums>
Sums PoseStream::SumChunks(const BaseAndTool& mounts,
                           const std::function<Sums(const PassInput&)>& pass) const {
  const std::size_t blocks = batch_.blocks().size();
  const std::size_t chunks = (blocks + kChunkBlocks - 1) / kChunkBlocks;
  const bool common = weights_.kind() != PoseWeights::Kind::kPerPose;
  const auto input_of = [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunkBlocks, last = std::min(first + kChunkBlocks, blocks);
    const std::size_t rest = batch_.size() % kLanes;
    const bool partial = last == blocks && rest != 0;
    return PassInput{&batch_.blocks()[first],
                     common ? &weights_.common() : &weights_.blocks()[first],
                     common,
                     static_cast<int>(last - first),
                     partial ? static_cast<int>(rest) : kLanes,
                     &mounts,
                     &loss_};
  };
  if (chunks == 1) return pass(input_of(0));
  std::vector<Sums> sums(chunks);
  const std::size_t threads = std::clamp<std::size_t>(
      chunks / kChunksPerThread, 1, static_cast<std::size_t>(std::max(threads_, 1)));
  ForEach(chunks, threads, [&](std::size_t i) { sums[i] = pass(input_of(i)); });
  Sums total = sums[0];
  for (std::size_t i = 1; i < chunks; ++i) total.Add(sums[i]);
  return total;
}

IsotropicSums PoseStream::PartsAt(const BaseAndTool& mounts) const {
  return SumChunks<IsotropicSums>(mounts, [this](const PassInput& input) {
    return PassIsotropic(input, weights_.position(), weights_.orientation());
  });
}

PoseMoments PoseStream::Moments() const {
  Pose3d base_from_platform, world_from_tool;
  batch_.Get(0, &base_from_platform, &world_from_tool);
  return SumChunks<PoseMoments>({}, [&](const PassInput& input) {
    return PassMoments(input, world_from_tool.translation, base_from_platform.translation);
  });
}

NormalEquations PoseStream::At(const BaseAndTool& mounts) const {
  if (weights_.kind() == PoseWeights::Kind::kIsotropic)
    return Weighted(PartsAt(mounts), weights_.position(), weights_.orientation(), batch_.size());
  const WeightedSums sums = SumChunks<WeightedSums>(mounts, &PassWeighted);
  return {sums.normal,
          sums.gradient,
          sums.totals.rho,
          sums.totals.position_squares,
          sums.totals.orientation_squares,
          static_cast<long>(batch_.size())};
}

NormalEquations PoseStream::Evaluate(double const* const* parameters) const {
  return At({Pose3d::FromParameters(parameters[0]), Pose3d::FromParameters(parameters[1])});
}

NormalEquations Weighted(const IsotropicSums& sums,
                         double position_weight,
                         double orientation_weight,
                         std::size_t poses) {
  const auto component = [](const IsotropicSums::Part& part) {
    return VarianceComponent{part.normal, part.gradient, part.squares, 3.0 * part.weights};
  };
  return {position_weight * sums.position.normal + orientation_weight * sums.orientation.normal,
          position_weight * sums.position.gradient + orientation_weight * sums.orientation.gradient,
          sums.totals.rho,
          sums.totals.position_squares,
          sums.totals.orientation_squares,
          static_cast<long>(poses),
          {component(sums.position), component(sums.orientation)}};
}

}  // namespace hexcal
