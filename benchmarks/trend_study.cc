// SPDX-License-Identifier: BSD-3-Clause
// How often hexcal history trend calls a machine out of control that is in it, and how soon it sees
// a drift: the tables of docs/history.md.
//   trend_study [MACHINES]     (2000 of each kind)
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <random>

#include "estimator/mount_trend.h"

namespace hexcal {
namespace {

constexpr double kDay = 86400.0;
constexpr int kJudged = 10;   // records after the baseline
constexpr int kDrifting = 2;  // base.dz
constexpr int kMostRecords = 40;

class Machine {
 public:
  explicit Machine(std::mt19937_64* rng) : rng_(*rng) {
    // Unequal and correlated, of a calibration's size, m and rad.
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < i; ++j) factor_(i, j) = 3e-5 * normal_(rng_);
      factor_(i, i) = (i % 6 < 3 ? 4e-5 : 2e-4) * (1 + 0.1 * i);
    }
    covariance_ = factor_ * factor_.transpose();
  }

  double sigma(int i) const { return std::sqrt(covariance_(i, i)); }

  // Of mounts that are moved by so much.
  DatedMounts Calibrate(double day, const Vector12d& moved) {
    const Vector12d d = moved + factor_ * Draw();
    DatedMounts record;
    record.time = kDay * day;
    record.known.covariance = covariance_;
    record.known.determined.fill(true);
    record.known.mounts = {Plus(Pose3d(), Vector6d(d.head(6))),
                           Plus(Pose3d(), Vector6d(d.tail(6)))};
    return record;
  }

  Vector12d Draw() {
    Vector12d draw;
    for (int i = 0; i < 12; ++i) draw[i] = normal_(rng_);
    return draw;
  }

 private:
  std::mt19937_64& rng_;
  std::normal_distribution<double> normal_;
  Matrix12d factor_ = Matrix12d::Zero(), covariance_;
};

void PrintFalseAlarms(int machines, std::mt19937_64* rng) {
  fmt::print("mounts move   baseline   out of control     level    moving   drift at 1 %\n");
  for (const double between : {0.0, 0.5, 1.0, 10.0})
    for (const int baseline : {1, 3, 5, 10}) {
      long judged = 0, out = 0, level = 0, moving = 0, drifting = 0;
      for (int m = 0; m < machines; ++m) {
        Machine machine(rng);
        std::vector<DatedMounts> records;
        for (int k = 0; k < baseline + kJudged; ++k) {
          Vector12d moved = between * machine.Draw();
          for (int i = 0; i < 12; ++i) moved[i] *= machine.sigma(i);
          records.push_back(machine.Calibrate(k, moved));
        }
        TrendOptions options;
        options.baseline = baseline;
        const MountTrend trend = TrendOf(records, options);
        for (const TrendPoint& point : trend.points) {
          judged += point.is_judged;
          out += !point.is_in_control;
          level += !point.level.is_in_control;
          moving += !point.moving.is_in_control;
        }
        drifting += trend.drift && trend.drift->p_value < 0.01;
      }
      const auto share = [judged](long count) {
        return 100.0 * static_cast<double>(count) / static_cast<double>(judged);
      };
      fmt::print("{:>5} sigma   {:>8}   {:>12.2f} %   {:>5.2f} %   {:>5.2f} %   {:>10.2f} %\n",
                 between,
                 baseline,
                 share(out),
                 share(level),
                 share(moving),
                 100.0 * static_cast<double>(drifting) / machines);
    }
}

void PrintDelay(int machines, std::mt19937_64* rng) {
  double sum = 0.0;
  int by_20 = 0;
  for (int m = 0; m < machines; ++m) {
    Machine machine(rng);
    std::vector<DatedMounts> records;
    for (int k = 0; k < kMostRecords; ++k) {
      Vector12d moved = Vector12d::Zero();
      moved[kDrifting] = 0.5 * k * machine.sigma(kDrifting);
      records.push_back(machine.Calibrate(k, moved));
    }
    const MountTrend trend = TrendOf(records);
    int k = 0;
    while (k < kMostRecords && trend.points[k].is_in_control) ++k;
    sum += k + 1;
    by_20 += k < 20;
  }
  fmt::print(
      "\na drift of half a sigma a record: first out of control at record {:.1f}, by the 20th in "
      "{} "
      "of {}\n",
      sum / machines,
      by_20,
      machines);
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  int machines = 2000;
  if (argc > 1) std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), machines);
  std::mt19937_64 rng(1);
  hexcal::PrintFalseAlarms(machines, &rng);
  hexcal::PrintDelay(machines, &rng);
}
