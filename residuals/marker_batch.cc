// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/marker_batch.h"

#include <algorithm>
#include <thread>

#include "residuals/marker_pose.h"

namespace hexcal {
namespace {

// Poses whose sums are taken together, whatever the threads.
constexpr int kChunk = 256;

// work(chunk) for every chunk, by some threads.
template <typename Work>
void ForEachChunk(int chunks, int threads, const Work& work) {
  const int used = std::max(1, std::min(threads, chunks));
  const auto run = [&](int first) {
    for (int chunk = first; chunk < chunks; chunk += used) work(chunk);
  };
  std::vector<std::thread> others;
  for (int k = 1; k < used; ++k) others.emplace_back(run, k);
  run(0);
  for (std::thread& thread : others) thread.join();
}

NormalEquations Nothing(int size) {
  NormalEquations nothing;
  nothing.normal.setZero(size, size);
  nothing.gradient.setZero(size);
  return nothing;
}

}  // namespace

MarkerBatch::MarkerBatch(const MarkerData& data, const Eigen::Vector3d& sigma, int threads)
    : data_(data), layout_(data), sigma_(sigma), threads_(threads) {}

NormalEquations MarkerBatch::Evaluate(double const* const* parameters) const {
  const MarkerUnknowns unknowns = layout_.Unknowns(data_, parameters);
  const int poses = static_cast<int>(data_.poses.size());
  const int chunks = (poses + kChunk - 1) / kChunk;
  std::vector<NormalEquations> sums(chunks, Nothing(layout_.size));
  ForEachChunk(chunks, threads_, [&](int chunk) {
    const int end = std::min(poses, (chunk + 1) * kChunk);
    for (int i = chunk * kChunk; i < end; ++i) {
      const MarkerPoseLikelihood pose(data_, sigma_, unknowns, data_.poses[i]);
      PoseTerms terms;
      pose.Eliminate(&terms);
      pose.AddReduced(terms, layout_, &sums[chunk]);
    }
  });
  NormalEquations total = Nothing(layout_.size);
  for (const NormalEquations& sum : sums) {
    total.normal += sum.normal;
    total.gradient += sum.gradient;
    total.squared_norm += sum.squared_norm;
    total.position_squares += sum.position_squares;
    total.orientation_squares += sum.orientation_squares;
    total.poses += sum.poses;
  }
  return total;
}

MarkerFit MarkerBatch::FitAt(double const* const* parameters,
                             const Eigen::MatrixXd& inverse) const {
  const MarkerUnknowns unknowns = layout_.Unknowns(data_, parameters);
  MarkerFit fit;
  fit.misfits.resize(data_.readings.size());
  int tools = 0;
  for (const MarkerPose& row : data_.poses) {
    const MarkerPoseLikelihood pose(data_, sigma_, unknowns, row);
    PoseTerms terms;
    const MarkerNuisance nuisance = pose.Eliminate(&terms);
    pose.ForEachMisfit(nuisance,
                       [&](int i, const Eigen::Vector3d& misfit) { fit.misfits[i] = misfit; });
    fit.tracker_from_world.push_back(nuisance.tracker_from_world);
    fit.squared_readings += terms.squared - terms.squared_draw;
    fit.squared_draws += terms.squared_draw;
    fit.draw_freedom += pose.DrawFreedom(terms, layout_, inverse);
    fit.tool_variance += pose.ToolCovariance(terms).diagonal();
    tools += pose.HasTool() ? 1 : 0;
  }
  fit.tool_variance /= tools;
  return fit;
}

}  // namespace hexcal
