// SPDX-License-Identifier: BSD-3-Clause
#include "config/nearest_word.h"

#include <fmt/format.h>

#include <algorithm>

namespace hexcal {
namespace {

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// The only known word that begins with this one, if three letters or more are there; two, if only
// one letter is missing.
std::string_view OnlyContinuation(std::string_view word,
                                  const std::vector<std::string_view>& known) {
  if (word.size() < 2) return {};
  const std::size_t longest = word.size() == 2 ? 3 : std::string_view::npos;
  const auto begins = [word, longest](std::string_view candidate) {
    return candidate.size() <= longest && candidate.substr(0, word.size()) == word;
  };
  const auto first = std::find_if(known.begin(), known.end(), begins);
  if (first == known.end() || std::any_of(first + 1, known.end(), begins)) return {};
  return *first;
}

// The only known word of three letters in which two stand in this order, the first one first.
std::string_view OnlyWithOneMore(std::string_view word,
                                 const std::vector<std::string_view>& known) {
  if (word.size() != 2) return {};
  const auto has_more = [word](std::string_view candidate) {
    return candidate.size() == 3 && candidate[0] == word[0] && candidate[2] == word[1];
  };
  const auto first = std::find_if(known.begin(), known.end(), has_more);
  if (first == known.end() || std::any_of(first + 1, known.end(), has_more)) return {};
  return *first;
}

}  // namespace

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t cost = Lower(a[i - 1]) == Lower(b[j - 1]) ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + cost});
      if (i > 1 && j > 1 && Lower(a[i - 1]) == Lower(b[j - 2]) &&
          Lower(a[i - 2]) == Lower(b[j - 1]))
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string NearestWord(std::string_view word, const std::vector<std::string_view>& known) {
  constexpr std::size_t kLongest = 100;  // no key is so long; keeps a hostile one cheap
  if (word.size() > kLongest) return "";
  std::string_view nearest;
  std::size_t least = word.size() / 3 + 1;
  for (const std::string_view candidate : known) {
    const std::size_t distance = EditDistance(word, candidate);
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  if (nearest.empty()) nearest = OnlyContinuation(word, known);
  return std::string(nearest.empty() ? OnlyWithOneMore(word, known) : nearest);
}

std::string DidYouMean(std::string_view word, const std::vector<std::string_view>& known) {
  const std::string nearest = NearestWord(word, known);
  return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest);
}

}  // namespace hexcal
