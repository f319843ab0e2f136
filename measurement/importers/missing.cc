// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/missing.h"

#include <algorithm>
#include <cmath>
#include <string>
namespace hexcal {
namespace {

constexpr double kBadBelow = -3.0e28;  // NDI's own test

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace

bool IsMissing(double value) { return std::isnan(value) || value < kBadBelow; }

bool IsMissing(std::string_view cell) {
  constexpr std::string_view kWords[] = {"nan", "-nan", "missing", "disabled"};
  if (cell.empty()) return true;
  if (cell.size() > 8) return false;
  return std::find(std::begin(kWords), std::end(kWords), Lower(cell)) != std::end(kWords);
}

}  // namespace hexcal
