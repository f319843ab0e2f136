// SPDX-License-Identifier: BSD-3-Clause
// Error over the Cramer-Rao bound of hexcal and of OpenCV, from repeated draws of the noise.
//   accuracy_study [--draws=20000] [--poses=0]
#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "methods.h"

DEFINE_int32(draws, 20000, "draws for each row; of the slow methods a tenth from 1000 poses on");
DEFINE_int32(poses, 0, "this number of poses only");

namespace hexcal {
namespace {

// Root mean square errors over the bound; 1 is the best that can be.
struct OverBound {
  double all_12 = 0.0;                       // sqrt(mean e' B^-1 e / 12)
  Vector12d each;                            // of each parameter
  double rotation = 0.0, translation = 0.0;  // mean over the six of each
  double standard_error = 0.0;               // of all_12
};

OverBound Study(const Method& method, const StudyScene& scene, int draws) {
  const Eigen::LLT<Matrix12d> bound(scene.bound);
  double sum = 0.0, sum_of_squares = 0.0;
  Vector12d squares = Vector12d::Zero();
  for (int i = 0; i < draws; ++i) {
    const Observations drawn = Draw(scene, i);
    const Vector12d error = Error(method.prepare(drawn, scene.truth)(), scene.truth);
    const double normalised = error.dot(Vector12d(bound.solve(error))) / 12.0;
    sum += normalised / draws;
    sum_of_squares += normalised * normalised / draws;
    squares += error.cwiseAbs2() / draws;
  }
  OverBound result;
  result.all_12 = std::sqrt(sum);
  result.standard_error = std::sqrt((sum_of_squares - sum * sum) / draws) / (2.0 * result.all_12);
  const Vector12d ratios = squares.cwiseQuotient(scene.bound.diagonal());
  result.each = ratios.cwiseSqrt();
  result.translation = std::sqrt((ratios.segment<3>(0) + ratios.segment<3>(6)).sum() / 6.0);
  result.rotation = std::sqrt((ratios.segment<3>(3) + ratios.segment<3>(9)).sum() / 6.0);
  return result;
}

void Print(int poses, const char* noise, const std::string& method, int draws, const OverBound& r) {
  fmt::print("| {} | {} | {} | {} | {:.3f} +- {:.3f} | {:.3f} | {:.3f} | {:.3f} to {:.3f} |\n",
             poses,
             noise,
             method,
             draws,
             r.all_12,
             r.standard_error,
             r.translation,
             r.rotation,
             r.each.minCoeff(),
             r.each.maxCoeff());
  std::fflush(stdout);
}

void Run() {
  std::vector<Method> methods = {Hexcal()};
  for (Method& method : OpenCv()) methods.push_back(std::move(method));
  fmt::print(
      "| poses | noise | method | draws | all 12 | translations | rotations | each of the 12 |\n"
      "| ---: | --- | --- | ---: | ---: | ---: | ---: | --- |\n");
  for (const int poses : {10, 60, 1000})
    for (const bool uneven : {false, true}) {
      if (FLAGS_poses != 0 && FLAGS_poses != poses) continue;
      const StudyScene scene =
          MakeStudyScene(poses, uneven ? UnevenNoise() : IsotropicNoise(), 100 + poses);
      for (const Method& method : methods) {
        const bool is_slow = poses >= 1000 && method.name != methods[0].name;
        const int draws = std::max(1, is_slow ? FLAGS_draws / 10 : FLAGS_draws);
        Print(
            poses, uneven ? "1:1:3" : "isotropic", method.name, draws, Study(method, scene, draws));
      }
    }
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  google::InitGoogleLogging(argv[0]);
  hexcal::Run();
}
