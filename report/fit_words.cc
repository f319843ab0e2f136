// SPDX-License-Identifier: BSD-3-Clause
#include "report/fit_words.h"

#include <fmt/format.h>

namespace hexcal {

std::string SolverWords(const ResultHeader& header) {
  std::string words = header.solver;
  if (header.error == "paper") words += " with the paper's error (equal weights)";
  if (header.error == "twist") words += " with the twist error (weights by the noise)";
  return words + (header.residual == "marker" ? ", by the readings of all markers" : ", by poses");
}

std::string LossWords(const ResultHeader& header) {
  const double scale = header.loss.scale;
  switch (header.loss.kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      return fmt::format(
          "Huber's: a pose counts less the further beyond {:.4g} standard deviations (of all six "
          "numbers together) it is off",
          scale);
    case LossKind::kCauchy:
      return fmt::format(
          "Cauchy's, of scale {:.4g}: a pose counts half that is as many standard deviations (of "
          "all six numbers together) off, and ever less beyond",
          scale);
    case LossKind::kTukey:
      return fmt::format(
          "Tukey's: a pose counts less the further it is off, and nothing from {:.4g} standard "
          "deviations (of all six numbers together) on",
          scale);
  }
  return "none: every pose that is used counts by its noise alone";
}

std::string CovarianceWords(const ResultHeader& header) {
  if (header.is_sandwich) return "by how the residuals of the poses really scatter (sandwich)";
  if (header.loss.kind != LossKind::kNone)
    return "by the noise, the loss and the size of the residuals (Huber 1981, 7.6)";
  return "by the noise, to first order";
}

}  // namespace hexcal
