// SPDX-License-Identifier: BSD-3-Clause
// Where the time goes between a dataset's files and its calibration, without the writing of
// results. Wall clock.
//   csv_phases dataset.yaml
#include <fmt/format.h>
#include <glog/logging.h>

#include <chrono>

#include "estimator/calibrate.h"
#include "measurement/dataset.h"

namespace hexcal {
namespace {

void Run(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const Dataset dataset = ReadDataset(path, true);
  const double read = seconds();
  const Observations observations = MakeObservations(dataset);
  const double made = seconds();
  const Estimate estimate = Calibrate(observations, {}, {});
  const double calibrated = seconds();
  CHECK(estimate.IsTrustworthy()) << estimate.message;
  fmt::print("{} poses: {:.2f} s read, {:.2f} s paired, {:.2f} s calibrated, {:.2f} s in all\n",
             observations.items.size(),
             read,
             made - read,
             calibrated - made,
             calibrated);
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  CHECK_EQ(argc, 2) << "usage: csv_phases dataset.yaml";
  hexcal::Run(argv[1]);
}
