// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hidden/trial.h"

namespace hexcal::hidden {

// A share with its 95 % interval after Wilson.
struct Share {
  int hits = 0, of = 0;
  double Value() const { return of == 0 ? 0.0 : static_cast<double>(hits) / of; }
  double Low() const;
  double High() const;
};
std::string Text(const Share& share);  // "93.2 % [88.1, 96.2] of 155"

// of: which trials count, null for all.
Share Count(const std::vector<Trial>& trials,
            const std::function<bool(const Trial&)>& is_hit,
            const std::function<bool(const Trial&)>& of = nullptr);

// Order statistic of the numbers that are not NaN; NaN where there is none.
double Quantile(std::vector<double> numbers, double share);

// The names that were found first, by the true one: how often each.
std::string ConfusionTable(const std::vector<Trial>& trials);

nlohmann::ordered_json AsJson(const Trial& trial);

}  // namespace hexcal::hidden
