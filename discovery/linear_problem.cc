// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/linear_problem.h"

#include <unordered_map>

namespace hexcal {
namespace {

Eigen::MatrixXd Rows(const Eigen::MatrixXd& m, const std::vector<int>& rows) {
  Eigen::MatrixXd some(rows.size(), m.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(i) = m.row(rows[i]);
  return some;
}

}  // namespace

LinearProblem LinearProblem::Restricted(const std::vector<int>& some) const {
  LinearProblem part;
  part.poses = static_cast<int>(some.size());
  std::vector<int> pose_rows, shape_rows;
  std::unordered_map<int, int> new_pose;
  for (std::size_t i = 0; i < some.size(); ++i) {
    new_pose[some[i]] = static_cast<int>(i);
    for (int axis = 0; axis < 6; ++axis) pose_rows.push_back(6 * some[i] + axis);
    if (!shape_freedom.empty()) part.shape_freedom.push_back(shape_freedom[some[i]]);
    if (!shape_basis.empty()) part.shape_basis.push_back(shape_basis[some[i]]);
  }
  for (std::size_t row = 0; row < shape_pose.size(); ++row) {
    const auto found = new_pose.find(shape_pose[row]);
    if (found == new_pose.end()) continue;
    shape_rows.push_back(static_cast<int>(row));
    part.shape_pose.push_back(found->second);
  }
  part.error = Rows(error, pose_rows);
  part.nuisance = Rows(nuisance, pose_rows);
  part.columns = std::make_shared<Eigen::MatrixXd>(Rows(*columns, pose_rows));
  part.shape_error = Rows(shape_error, shape_rows);
  part.shape_nuisance = Rows(shape_nuisance, shape_rows);
  part.shape_columns = std::make_shared<Eigen::MatrixXd>(Rows(*shape_columns, shape_rows));
  part.shape_trend = Rows(shape_trend, shape_rows);
  part.shape_of = shape_of;
  for (const std::vector<Matrix6d>& component : components) {
    part.components.emplace_back();
    for (const int pose : some) part.components.back().push_back(component[pose]);
  }
  part.least_factor = least_factor;
  part.scale = scale;
  part.forms = forms;
  part.families = families;
  return part;
}

LinearProblem LinearProblem::With(const std::vector<int>& added) const {
  LinearProblem more = *this;
  Eigen::Index extra = 0;
  for (const int f : added) extra += forms[f].size;
  Eigen::Index at = nuisance.cols();
  more.nuisance.conservativeResize(Eigen::NoChange, at + extra);
  more.shape_nuisance.conservativeResize(Eigen::NoChange, at + extra);
  for (const int f : added)
    for (int k = forms[f].first; k < forms[f].first + forms[f].size; ++k, ++at) {
      more.nuisance.col(at) = columns->col(k);
      if (shape_of[k] >= 0)
        more.shape_nuisance.col(at) = shape_columns->col(shape_of[k]);
      else
        more.shape_nuisance.col(at).setZero();
    }
  return more;
}

LinearProblem LinearProblem::Only(const std::vector<int>& some) const {
  LinearProblem one = *this;
  Form form;
  for (const int f : some) form.size += forms[f].size;
  Eigen::MatrixXd picked(error.size(), form.size);
  one.scale.resize(form.size);
  one.shape_of.assign(form.size, -1);
  std::vector<Eigen::VectorXd> shapes;
  Eigen::Index at = 0;
  for (const int f : some)
    for (int k = forms[f].first; k < forms[f].first + forms[f].size; ++k, ++at) {
      picked.col(at) = columns->col(k);
      one.scale[at] = scale[k];
      if (shape_of[k] < 0) continue;
      one.shape_of[at] = static_cast<int>(shapes.size());
      shapes.emplace_back(shape_columns->col(shape_of[k]));
    }
  Eigen::MatrixXd shape(shape_error.size(), static_cast<Eigen::Index>(shapes.size()));
  for (std::size_t k = 0; k < shapes.size(); ++k) shape.col(k) = shapes[k];
  one.columns = std::make_shared<Eigen::MatrixXd>(std::move(picked));
  one.shape_columns = std::make_shared<Eigen::MatrixXd>(std::move(shape));
  one.forms = {form};
  one.families = {Family{}};
  return one;
}

}  // namespace hexcal
