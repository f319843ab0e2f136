// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/rotation_angles.h"

namespace hexcal {
namespace {

// Nearer to the gimbal than this, and than so many standard deviations of the rotation, rx and rz
// cannot be told apart.
constexpr double kGimbalCosine = 1e-6;
constexpr double kGimbalSigmas = 3.0;
constexpr const char* kRowNames[6] = {"x", "y", "z", "rx", "ry", "rz"};

// "0.0123" with as many decimals as two digits of sigma need.
int Decimals(double sigma) {
  if (!(sigma > 0) || !std::isfinite(sigma)) return 6;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 1, 9);
}

std::string ValueText(double value, double sigma, bool determined, const char* unit) {
  if (!determined) return fmt::format("{:>14.4f} {:<4} {:<13}", value, unit, "undetermined");
  if (!std::isfinite(sigma))
    return fmt::format("{:>14.4f} {:<4} {:<13}", value, unit, "at the gimbal");
  const int decimals = Decimals(sigma);
  return fmt::format("{:>14.{}f} {:<4} ± {:<11.{}f}", value, decimals, unit, sigma, decimals);
}

// The six numbers of a mount, mm and mrad, and whether each is determined.
struct MountRows {
  Vector6d value, sigma;
  std::array<bool, 6> determined;
};

MountRows Rows(const Pose3d& pose, const Estimate& estimate, int first) {
  MountRows rows;
  rows.value = 1e3 * VectorFromPose(pose);
  rows.sigma = 1e3 * PoseVectorSigma(pose, estimate.covariance.block<6, 6>(first, first));
  std::copy_n(
      DeterminedNumbers(estimate.observability).begin() + first, 6, rows.determined.begin());
  return rows;
}

// One number where the axes are equal, else three.
std::string SigmaText(const Eigen::Vector3d& sigma) {
  if (sigma.isConstant(sigma.x(), 0.0)) return fmt::format("{:.4g}", 1e3 * sigma.x());
  return fmt::format("{:.4g} {:.4g} {:.4g}", 1e3 * sigma.x(), 1e3 * sigma.y(), 1e3 * sigma.z());
}

std::string Summary(const Estimate& e) {
  std::string text = fmt::format("  left over      {:.4g} mm and {:.4g} mrad RMS (RMSPE, RMSOE)\n",
                                 1e3 * e.rmspe,
                                 1e3 * e.rmsoe);
  text += fmt::format("  noise          {:.4g} mm and {:.4g} mrad a coordinate, {}\n",
                      1e3 * e.noise.position,
                      1e3 * e.noise.orientation,
                      e.noise.estimated ? "estimated from what is left over" : "as stated");
  if (e.noise.assumed != NoiseSide::kTracker)
    text += fmt::format("                 of {}\n",
                        e.noise.assumed == NoiseSide::kBoth ? "tracker and robot" : "the robot");
  if (e.noise.marker)
    text += fmt::format("  marker noise   {} mm a reading\n", SigmaText(*e.noise.marker));
  text += fmt::format("  chi-square     {:.5g} with {} degrees of freedom (noise scale {:.3f})\n",
                      e.chi_square,
                      e.degrees_of_freedom,
                      e.noise_scale);
  if (e.least_squares)
    text += fmt::format(
        "  least squares  {:.5g} with {} of the same poses, none weighted down (noise scale "
        "{:.3f})\n",
        e.least_squares->chi_square,
        e.least_squares->degrees_of_freedom,
        e.least_squares->Scale());
  const double condition = e.observability.condition_number;
  text += fmt::format("  condition      {} of the scaled Jacobian\n",
                      std::isfinite(condition) ? fmt::format("{:.3g}", condition) : "infinite");
  return text;
}

// "1 of 40 poses, left out:" and a line for each, but for those that would fill the screen.
std::string OutlierLines(const Estimate& e) {
  constexpr std::size_t kMaxLines = 10;
  if (e.outliers.empty()) return "";
  const bool rejected = std::any_of(
      e.poses.begin(), e.poses.end(), [](const PoseResult& pose) { return pose.weight == 0.0; });
  std::string text = fmt::format("  outliers       {} of {} poses, {}\n",
                                 e.outliers.size(),
                                 e.poses.size(),
                                 rejected ? "left out" : "used all the same");
  for (std::size_t i = 0; i < std::min(e.outliers.size(), kMaxLines); ++i)
    text += fmt::format("  {:<14} {}\n", "  pose " + e.outliers[i].label, e.outliers[i].reason);
  if (e.outliers.size() > kMaxLines)
    text += fmt::format("    {} more, in result.json\n", e.outliers.size() - kMaxLines);
  return text;
}

}  // namespace

Matrix6d PoseVectorByMotion(const Pose3d& a_from_b) {
  const Eigen::Matrix3d rotation = a_from_b.rotation.toRotationMatrix();
  Matrix6d j = Matrix6d::Zero();
  j.topLeftCorner<3, 3>() = rotation;
  j.bottomRightCorner<3, 3>() = AnglesByTurn(AnglesFromRotation(rotation));
  return j;
}

std::array<bool, 12> DeterminedNumbers(const Observability& observability) {
  std::array<bool, 12> determined;
  for (int block = 0; block < 12; block += 3) {
    const auto first = observability.determined.begin() + block;
    const bool all = std::all_of(first, first + 3, [](bool d) { return d; });
    std::fill_n(determined.begin() + block, 3, all);
  }
  return determined;
}

Vector6d PoseVectorSigma(const Pose3d& a_from_b, const Matrix6d& covariance) {
  const Matrix6d j = PoseVectorByMotion(a_from_b);
  Vector6d sigma = (j * covariance * j.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  const double pitch = AnglesFromRotation(a_from_b.rotation.toRotationMatrix()).y();
  const double turn = std::sqrt(covariance.diagonal().tail<3>().maxCoeff());
  if (std::abs(std::cos(pitch)) < std::max(kGimbalCosine, kGimbalSigmas * turn))
    sigma.tail<3>().setConstant(std::numeric_limits<double>::infinity());
  return sigma;
}

std::string ResultTable(const ResultHeader& header, const Estimate& estimate) {
  const MountRows base = Rows(estimate.mounts.world_from_base, estimate, 0);
  const MountRows tool = Rows(estimate.mounts.platform_from_tool, estimate, 6);
  std::string how =
      header.error.empty() ? header.solver : header.solver + " (" + header.error + ")";
  how += header.residual == "marker" ? " by markers" : " by poses";
  std::string text = fmt::format("{}: {} poses, {}, {} after {} iterations\n\n",
                                 header.dataset,
                                 estimate.poses.size(),
                                 how,
                                 estimate.converged ? "converged" : "NOT CONVERGED",
                                 estimate.iterations.size() - 1);
  text += fmt::format("  {:<4}{:<36}{}\n", "", "base in world (T_B^W)", "tool on platform (T_T^A)");
  for (int i = 0; i < 6; ++i) {
    const char* unit = i < 3 ? "mm" : "mrad";
    const std::string row =
        fmt::format("  {:<3}{} {}",
                    kRowNames[i],
                    ValueText(base.value[i], base.sigma[i], base.determined[i], unit),
                    ValueText(tool.value[i], tool.sigma[i], tool.determined[i], unit));
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "\n" + Summary(estimate) + OutlierLines(estimate);
}

}  // namespace hexcal
