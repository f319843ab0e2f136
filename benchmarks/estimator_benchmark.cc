// SPDX-License-Identifier: BSD-3-Clause
// hexcal, OpenCV and a plain Ceres problem on the same poses in one run: time of a whole
// calibration (processor time), peak memory beside the poses as
// given, error over the Cramer-Rao bound. Prints tables and
// writes them as JSON.
//   estimator_benchmark [--most_poses=1000000] [--seconds=2] [--json=estimator_benchmark.json]
#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "methods.h"
#include "peak_memory.h"

DEFINE_int32(most_poses, 1000000, "largest number of poses");
DEFINE_double(seconds, 2.0, "least time spent on each figure");
DEFINE_string(json, "", "file for the results, if any");

namespace hexcal {
namespace {

constexpr int kFewestRepeats = 3, kMostRepeats = 2000;
// Draws for the error over the bound: fewer where there are more poses.
constexpr int kMostDraws = 200;
constexpr int kDrawnPoses = 200000;
constexpr int kThousands = 10000;  // small calibrations in a row

// Processor time of all threads: what one core would take, whatever else the machine does.
double Seconds(const std::function<void()>& work) {
  const auto now = [] {
    timespec t;
    CHECK_EQ(clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t), 0);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

// Of one method on one number of poses.
struct Figures {
  std::string method;
  int poses = 0, repeats = 0, draws = 0;
  double fastest = 0.0, median = 0.0;  // s
  std::size_t peak_bytes = 0;
  double over_bound = 0.0;  // root mean square error / sqrt(Cramer-Rao bound), over the 12
};

void Time(const Calibration& calibrate, Figures* figures) {
  std::vector<double> times;
  double total = 0.0;
  calibrate();
  while (static_cast<int>(times.size()) < kFewestRepeats ||
         (total < FLAGS_seconds && static_cast<int>(times.size()) < kMostRepeats)) {
    times.push_back(Seconds([&] { calibrate(); }));
    total += times.back();
  }
  std::sort(times.begin(), times.end());
  figures->repeats = static_cast<int>(times.size());
  figures->fastest = times.front();
  figures->median = times[times.size() / 2];
}

void Compare(const Method& method, const StudyScene& scene, Figures* figures) {
  const int poses = static_cast<int>(scene.exact.size());
  figures->draws = std::clamp(kDrawnPoses / poses, 1, kMostDraws);
  double sum = 0.0;
  for (int i = 0; i < figures->draws; ++i) {
    const Observations drawn = Draw(scene, i);
    const Vector12d error = Error(method.prepare(drawn, scene.truth)(), scene.truth);
    sum += (error.array().square() / scene.bound.diagonal().array()).mean() / figures->draws;
  }
  figures->over_bound = std::sqrt(sum);
}

Figures Measure(const Method& method, const StudyScene& scene) {
  Figures figures;
  figures.method = method.name;
  figures.poses = static_cast<int>(scene.exact.size());
  {
    const Observations drawn = Draw(scene, 0);
    const Calibration calibrate = method.prepare(drawn, scene.truth);
    Time(calibrate, &figures);
  }
  {
    const Observations drawn = Draw(scene, 0);
    figures.peak_bytes = PeakMemory([&] { method.prepare(drawn, scene.truth)(); });
  }
  Compare(method, scene, &figures);
  return figures;
}

nlohmann::json Report(const std::vector<Figures>& of_one_size) {
  nlohmann::json rows;
  for (const Figures& f : of_one_size) {
    const double over_packed = f.median / of_one_size[0].median;
    const double over_whole = f.median / of_one_size[1].median;
    const double bytes = static_cast<double>(f.peak_bytes);
    fmt::print(
        "| {} | {} | {:.3g} | {:.3g} | {:.0f} | {:.2f} | {:.2f} | {:.3g} | {:.0f} | {:.3f} |\n",
        f.poses,
        f.method,
        1e3 * f.fastest,
        1e3 * f.median,
        1e9 * f.median / f.poses,
        over_packed,
        over_whole,
        bytes / 1e6,
        bytes / f.poses,
        f.over_bound);
    rows.push_back({{"method", f.method},
                    {"poses", f.poses},
                    {"repeats", f.repeats},
                    {"fastest_s", f.fastest},
                    {"median_s", f.median},
                    {"ns_per_pose", 1e9 * f.median / f.poses},
                    {"time_over_hexcal_packed", over_packed},
                    {"time_over_hexcal", over_whole},
                    {"peak_bytes", f.peak_bytes},
                    {"bytes_per_pose", bytes / f.poses},
                    {"draws", f.draws},
                    {"error_over_bound", f.over_bound}});
  }
  std::fflush(stdout);
  return rows;
}

// Calibrations of 60 poses one after another, a hundred different draws.
nlohmann::json ManySmallOnes(const Method& method, const StudyScene& scene) {
  std::vector<Observations> draws;
  std::vector<Calibration> calibrations;
  for (int i = 0; i < 100; ++i) draws.push_back(Draw(scene, i));
  for (const Observations& drawn : draws)
    calibrations.push_back(method.prepare(drawn, scene.truth));
  const double seconds = Seconds([&] {
    for (int i = 0; i < kThousands; ++i) calibrations[i % calibrations.size()]();
  });
  fmt::print("\n{} calibrations of {} poses by {}: {:.2f} s\n",
             kThousands,
             scene.exact.size(),
             method.name,
             seconds);
  return {{"method", method.name},
          {"calibrations", kThousands},
          {"poses", scene.exact.size()},
          {"seconds", seconds}};
}

void Run() {
  std::vector<Method> methods = {HexcalPacked(), Hexcal(), HexcalPackedFull(), HexcalFull()};
  for (Method& method : OpenCv()) methods.push_back(std::move(method));
  methods.push_back(PlainCeres());
  nlohmann::json json;
  fmt::print(
      "| poses | method | fastest, ms | median, ms | ns a pose | over packed | over hexcal | peak, "
      "MB | bytes a pose | error / bound |\n| ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: "
      "| ---: | ---: |\n");
  for (const int poses : {10, 60, 1000, 10000, 100000, 1000000}) {
    if (poses > FLAGS_most_poses) continue;
    const StudyScene scene = MakeStudyScene(poses, IsotropicNoise(), 1);
    std::vector<Figures> figures;
    for (const Method& method : methods) figures.push_back(Measure(method, scene));
    for (nlohmann::json& row : Report(figures)) json["methods"].push_back(std::move(row));
  }
  const StudyScene small = MakeStudyScene(60, IsotropicNoise(), 1);
  for (const Method& method : {HexcalPacked(), Hexcal()})
    json["many"].push_back(ManySmallOnes(method, small));
  if (!FLAGS_json.empty()) {
    std::ofstream file(FLAGS_json);
    file << json.dump(2) << "\n";
    CHECK(file.good()) << FLAGS_json;
  }
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  google::InitGoogleLogging(argv[0]);
  FLAGS_minloglevel = google::GLOG_ERROR;
  hexcal::Run();
}
