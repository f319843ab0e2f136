// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/number.h"

namespace hexcal::testing {

// A nonlinear regression problem of the NIST Statistical Reference Datasets.
struct NistProblem {
  Eigen::VectorXd starts[2];
  Eigen::VectorXd certified, certified_sigma;
  double certified_squares = 0.0;  // residual sum of squares
  Eigen::VectorXd y;
  Eigen::MatrixXd x;  // one row a predictor, one column an observation
};

// The numbers of a line of words, or nothing where one of the words is none.
inline std::optional<std::vector<double>> AllNumbers(std::istringstream words) {
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    const std::optional<double> number = ParseDouble(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

// Reads one of NIST's own files: "b1 = start1 start2 value sigma" a parameter, the sum of squares,
// and from the line "Data: y x" on one observation a line.
inline NistProblem ReadNistProblem(const std::string& path) {
  std::vector<std::vector<double>> parameters, rows;
  NistProblem problem;
  std::ifstream file(path);
  int data_lines = 0;  // the first of two only says where the others are
  for (std::string line; std::getline(file, line);) {
    const std::size_t equals = line.find('=');
    const std::string kSquares = "Residual Sum of Squares:";
    if (line.rfind("Data:", 0) == 0) {
      ++data_lines;
    } else if (line.rfind(kSquares, 0) == 0) {
      problem.certified_squares =
          AllNumbers(std::istringstream(line.substr(kSquares.size())))->at(0);
    } else if (data_lines == 2) {
      const auto row = AllNumbers(std::istringstream(line));
      if (row && row->size() > 1) rows.push_back(*row);
    } else if (equals != std::string::npos) {
      const auto numbers = AllNumbers(std::istringstream(line.substr(equals + 1)));
      if (numbers && numbers->size() == 4) parameters.push_back(*numbers);
    }
  }
  if (parameters.empty() || rows.empty()) throw std::runtime_error(path + ": no NIST problem");
  const auto column = [](const std::vector<std::vector<double>>& table, int k) {
    Eigen::VectorXd v(table.size());
    for (std::size_t i = 0; i < table.size(); ++i) v[i] = table[i].at(k);
    return v;
  };
  problem.starts[0] = column(parameters, 0), problem.starts[1] = column(parameters, 1);
  problem.certified = column(parameters, 2), problem.certified_sigma = column(parameters, 3);
  problem.y = column(rows, 0);
  problem.x.resize(rows[0].size() - 1, rows.size());
  for (int k = 0; k < problem.x.rows(); ++k) problem.x.row(k) = column(rows, k + 1).transpose();
  return problem;
}

}  // namespace hexcal::testing
