// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/history/store.h"
#include "testing/random.h"

namespace hexcal::testing {

// A calibration of that dataset with readings of its own: mounts and covariance of a hexapod's
// size, by number.
inline HistoryRecord AnyRecord(const std::string& dataset, int i) {
  HistoryRecord record;
  record.revision = "0123456789ab";
  record.written = "2026-11-23T02:03:0" + std::to_string(i % 10) + "Z";
  record.author = {"user", "host", "operator"};
  record.version = "hexcal 0.1.0";
  record.command = "calibrate";
  record.dataset = dataset;
  record.inputs = {{"dataset.yaml", Sha256("a" + std::to_string(i))}};
  record.readings_sha256 = Sha256("r" + std::to_string(i));
  record.settings = {{"solver", "nonlinear"}, {"out", "out"}};
  record.solver = "nonlinear";
  record.residual = "pose";
  record.is_converged = record.is_trusted = true;
  record.poses = 60;
  record.known.mounts.world_from_base.translation = {0.1 + 1e-5 * i, 0.2, 0.3};
  record.known.mounts.platform_from_tool.translation = {0.01, -0.02, 1.0 / 3.0};
  record.known.covariance.diagonal().setConstant(1e-10 / 3.0);
  record.known.covariance(0, 1) = record.known.covariance(1, 0) = 1e-11;
  record.known.determined.fill(true);
  record.noise = {4e-5, 3e-4, false, {}, NoiseSide::kTracker};
  record.chi_square = 348.5;
  record.degrees_of_freedom = 348;
  record.rmspe = 7e-5;
  record.rmsoe = 5e-4;
  record.warning_count = 1;
  record.warnings = {"one \"warning\""};
  record.result_sha256 = Sha256("result" + std::to_string(i));
  return record;
}

inline std::string Append(const std::string& path, const HistoryRecord& record) {
  PendingRecord pending(path, record);
  pending.Commit();
  return pending.hash();
}

}  // namespace hexcal::testing
