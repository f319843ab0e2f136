// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace hexcal::hidden {
namespace {

constexpr double kNormalQuantile = 1.959963984540054;

// Centre of Wilson's interval, and its half width times sign.
double WilsonEnd(const Share& share, double sign) {
  if (share.of == 0) return sign < 0 ? 0.0 : 1.0;
  const double n = share.of, p = share.Value(), z2 = kNormalQuantile * kNormalQuantile;
  const double half = kNormalQuantile * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return (p + z2 / (2 * n) + sign * half) / (1 + z2 / n);
}

}  // namespace

double Share::Low() const { return std::max(0.0, WilsonEnd(*this, -1.0)); }
double Share::High() const { return std::min(1.0, WilsonEnd(*this, 1.0)); }

std::string Text(const Share& share) {
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}] of {}",
                     100 * share.Value(),
                     100 * share.Low(),
                     100 * share.High(),
                     share.of);
}

Share Count(const std::vector<Trial>& trials,
            const std::function<bool(const Trial&)>& is_hit,
            const std::function<bool(const Trial&)>& of) {
  Share share;
  for (const Trial& trial : trials) {
    if (of && !of(trial)) continue;
    ++share.of;
    share.hits += is_hit(trial);
  }
  return share;
}

double Quantile(std::vector<double> numbers, double share) {
  numbers.erase(
      std::remove_if(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }),
      numbers.end());
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(numbers.begin(), numbers.end());
  const double place = share * static_cast<double>(numbers.size() - 1);
  return numbers[static_cast<std::size_t>(std::lround(place))];
}

std::string ConfusionTable(const std::vector<Trial>& trials) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Trial& trial : trials)
    for (const std::string& truth : trial.truth)
      ++counts[truth][trial.found.empty() ? trial.verdict : trial.found[0].name];
  std::string text = "| hidden | sets | named first |\n| --- | --- | --- |\n";
  for (const auto& [truth, names] : counts) {
    std::vector<std::pair<int, std::string>> order;
    int all = 0;
    for (const auto& [name, count] : names) {
      order.push_back({-count, name});
      all += count;
    }
    std::sort(order.begin(), order.end());
    text += fmt::format("| {} | {} |", truth, all);
    for (const auto& [count, name] : order) text += fmt::format(" {} {}", name, -count);
    text += " |\n";
  }
  return text;
}

nlohmann::ordered_json AsJson(const Trial& trial) {
  nlohmann::ordered_json json;
  json["cell"] = trial.cell;
  json["case"] = trial.name;
  json["truth"] = trial.truth;
  json["carriers"] = trial.carriers;
  json["verdict"] = trial.verdict;
  json["found"] = nlohmann::json::array();
  for (const Found& found : trial.found)
    json["found"].push_back({{"name", found.name},
                             {"index", found.index},
                             {"could_also_be", found.could_also_be},
                             {"p_value", found.p_value}});
  json["first_p"] = trial.first_p;
  json["seconds"] = trial.seconds;
  json["before"] = trial.before;
  json["after"] = trial.after;
  json["oracle"] = trial.oracle;
  json["noise"] = trial.noise;
  if (!trial.error.empty()) json["error"] = trial.error;
  return json;
}

}  // namespace hexcal::hidden
