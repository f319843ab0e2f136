// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/marker_reference.h"

#include <ceres/ceres.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "residuals/marker_residual.h"
#include "residuals/pose_manifold.h"

namespace hexcal {
namespace {

constexpr int kPoseSize = Pose3d::kNumParameters;
constexpr int kDrawSize = 6;
constexpr int kMaxPolishSteps = 10;

class Reference {
 public:
  Reference(const MarkerData& data,
            const Eigen::Vector3d& sigma,
            std::vector<Eigen::VectorXd> start)
      : data_(data), sigma_(sigma), globals_(std::move(start)), ordering_(MakeOrdering()) {
    ceres::Problem::Options options;
    problem_ = std::make_unique<ceres::Problem>(options);
    for (Eigen::VectorXd& block : globals_) {
      ceres::Manifold* manifold = block.size() == kPoseSize ? new PoseManifold : nullptr;
      problem_->AddParameterBlock(block.data(), static_cast<int>(block.size()), manifold);
      ordering_->AddElementToGroup(block.data(), 1);
    }
    nuisances_.resize(data.poses.size());
    for (std::size_t i = 0; i < data.poses.size(); ++i) AddPose(i);
  }

  MarkerReference Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = ordering_;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-15;
    options.parameter_tolerance = 1e-15;
    options.gradient_tolerance = 0.0;
    options.max_num_consecutive_invalid_steps = 100;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, problem_.get(), &summary);
    MarkerReference result;
    result.converged = summary.termination_type == ceres::CONVERGENCE;
    result.message = summary.message;
    Polish();
    problem_->Evaluate({}, &result.squared_norm, nullptr, nullptr, nullptr);
    result.squared_norm *= 2.0;
    result.covariance = Covariance();
    result.parameters = globals_;
    return result;
  }

 private:
  static std::shared_ptr<ceres::ParameterBlockOrdering> MakeOrdering() {
    return std::make_shared<ceres::ParameterBlockOrdering>();
  }

  bool HasTool(const MarkerPose& pose) const { return pose.end > pose.first_tool; }

  // The tracker's pose and the draw of one robot pose share a block, so that no residual has two
  // parameters to eliminate.
  void AddNuisance(std::size_t i) {
    const bool has_tracker = !data_.tracker_is_static;
    const bool has_draw = data_.has_robot_noise && HasTool(data_.poses[i]);
    const int tracker_size = has_tracker ? kPoseSize : 0;
    Eigen::VectorXd& block = nuisances_[i];
    block.setZero(tracker_size + (has_draw ? kDrawSize : 0));
    if (block.size() == 0) return;
    if (has_tracker) data_.poses[i].tracker_from_world.ToParameters(block.data());
    ceres::Manifold* manifold = nullptr;
    if (has_tracker && has_draw)
      manifold = new ceres::ProductManifold<PoseManifold, ceres::EuclideanManifold<kDrawSize>>(
          PoseManifold(), ceres::EuclideanManifold<kDrawSize>());
    else if (has_tracker)
      manifold = new PoseManifold;
    problem_->AddParameterBlock(block.data(), static_cast<int>(block.size()), manifold);
    ordering_->AddElementToGroup(block.data(), 0);
    if (!has_draw) return;
    auto* cost = new ceres::DynamicAutoDiffCostFunction<RobotDrawResidual, 4>(
        new RobotDrawResidual(tracker_size));
    cost->AddParameterBlock(static_cast<int>(block.size()));
    cost->SetNumResiduals(kDrawSize);
    problem_->AddResidualBlock(cost, nullptr, std::vector<double*>{block.data()});
  }

  void AddPose(std::size_t i) {
    const MarkerPose& pose = data_.poses[i];
    AddNuisance(i);
    for (int r = pose.first_base; r < pose.end; ++r)
      AddReading(pose, r < pose.first_tool ? 0 : 1, data_.readings[r], &nuisances_[i]);
  }

  void AddReading(const MarkerPose& pose,
                  int body,
                  const MarkerMean& reading,
                  Eigen::VectorXd* nuisance) {
    const Eigen::Vector3d weight =
        std::sqrt(static_cast<double>(reading.frames)) * sigma_.cwiseInverse();
    std::vector<Eigen::VectorXd*> blocks;
    if (body == 1) blocks = {&globals_[0], &globals_[1]};
    const bool has_draw = body == 1 && data_.has_robot_noise;
    if (!data_.tracker_is_static || has_draw) blocks.push_back(nuisance);
    std::size_t next = 2;
    if (data_.tracker_is_static) blocks.push_back(&globals_[next++]);
    if (body == 1 && data_.bodies[0].is_centroid) ++next;
    if (data_.bodies[body].is_centroid) blocks.push_back(&globals_[next]);

    auto* cost = new MarkerResidual::Cost(new MarkerResidual(data_, pose, body, reading, weight));
    std::vector<double*> pointers;
    for (Eigen::VectorXd* block : blocks) {
      cost->AddParameterBlock(static_cast<int>(block->size()));
      pointers.push_back(block->data());
    }
    cost->SetNumResiduals(3);
    problem_->AddResidualBlock(cost, nullptr, pointers);
  }

  // Gauss-Newton to where only rounding is left: a cost that is flat to 1e-15 leaves the parameters
  // 1e-6 of a sigma apart.
  void Polish() {
    std::vector<double*> blocks;
    problem_->GetParameterBlocks(&blocks);
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMaxPolishSteps; ++k) {
      const Eigen::VectorXd step = Step(blocks);
      const double size = step.cwiseAbs().maxCoeff();
      if (!(size < 0.5 * last)) return;
      last = size;
      Eigen::Index first = 0;
      for (double* block : blocks) {
        Eigen::VectorXd moved(problem_->ParameterBlockSize(block));
        const int dof = problem_->ParameterBlockTangentSize(block);
        const ceres::Manifold* manifold = problem_->GetManifold(block);
        const Eigen::VectorXd part = step.segment(first, dof);
        if (manifold != nullptr)
          manifold->Plus(block, part.data(), moved.data());
        else
          moved = Eigen::Map<const Eigen::VectorXd>(block, dof) + part;
        std::copy_n(moved.data(), moved.size(), block);
        first += dof;
      }
    }
  }

  Eigen::VectorXd Step(const std::vector<double*>& blocks) {
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = blocks;
    std::vector<double> gradient;
    ceres::CRSMatrix rows;
    problem_->Evaluate(options, nullptr, nullptr, &gradient, &rows);
    using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const Eigen::Map<const Sparse> jacobian(rows.num_rows,
                                            rows.num_cols,
                                            static_cast<Eigen::Index>(rows.values.size()),
                                            rows.rows.data(),
                                            rows.cols.data(),
                                            rows.values.data());
    const Eigen::SparseMatrix<double> normal = jacobian.transpose() * jacobian;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt(normal);
    return -ldlt.solve(Eigen::Map<const Eigen::VectorXd>(
        gradient.data(), static_cast<Eigen::Index>(gradient.size())));
  }

  Eigen::MatrixXd Covariance() {
    std::vector<const double*> blocks;
    int size = 0;
    for (const Eigen::VectorXd& block : globals_) {
      blocks.push_back(block.data());
      size += problem_->ParameterBlockTangentSize(block.data());
    }
    ceres::Covariance covariance({});
    if (!covariance.Compute(blocks, problem_.get())) return {};
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix(size, size);
    covariance.GetCovarianceMatrixInTangentSpace(blocks, matrix.data());
    return matrix;
  }

  const MarkerData& data_;
  const Eigen::Vector3d sigma_;
  std::vector<Eigen::VectorXd> globals_, nuisances_;
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
  std::unique_ptr<ceres::Problem> problem_;
};

}  // namespace

MarkerReference SolveMarkerReference(const MarkerData& data,
                                     const Eigen::Vector3d& sigma,
                                     std::vector<Eigen::VectorXd> start) {
  return Reference(data, sigma, std::move(start)).Solve();
}

}  // namespace hexcal
