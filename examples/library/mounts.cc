// SPDX-License-Identifier: BSD-3-Clause
// mounts DATASET: base and tool with their standard deviations, in m and rad.
#include <cstdio>

#include "config/input_error.h"
#include "estimator/calibrate.h"
#include "estimator/observations.h"
#include "measurement/dataset.h"

namespace {

void Print(const char* name, const hexcal::Pose3d& pose, const hexcal::Vector6d& sigma) {
  const Eigen::Vector3d& p = pose.translation;
  std::printf("%s %.6f %.6f %.6f", name, p.x(), p.y(), p.z());
  for (int i = 0; i < 6; ++i) std::printf(" %.2g", sigma[i]);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const hexcal::Dataset dataset = hexcal::ReadDataset(argv[1], true);
    const hexcal::Estimate estimate =
        hexcal::Calibrate(hexcal::MakeObservations(dataset), std::nullopt, {});
    const hexcal::Vector12d sigma = estimate.covariance.diagonal().cwiseSqrt();
    Print("base", estimate.mounts.world_from_base, sigma.head<6>());
    Print("tool", estimate.mounts.platform_from_tool, sigma.tail<6>());
    return estimate.IsTrustworthy() ? 0 : 4;
  } catch (const hexcal::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
