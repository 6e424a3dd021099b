// SPDX-License-Identifier: MIT
#include "cli/Suggestion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace allpairs::app {
namespace {

/// A longer word is not a mistyped one.
constexpr std::size_t kLongest = 40;

/// So many letters, dashes included, of the beginning of a word mean it.
constexpr std::size_t kLeastOfCut = 5;

/// The least number of letters to add, leave out or replace (Levenshtein's distance).
std::size_t changesBetween(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const std::size_t replaced = diagonal + (from[i] == to[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string suggestionFor(std::string_view word, const std::vector<std::string>& choices) {
  if (word.size() > kLongest) return {};
  std::string best;
  std::size_t least = 1 + word.size() / 3;  // a third of its letters may be wrong
  for (const std::string& choice : choices) {
    const bool isCut = word.size() >= kLeastOfCut && choice.starts_with(word);
    const std::size_t changes = isCut ? 1 : changesBetween(word, choice);
    if (changes >= least) continue;
    least = changes;
    best = choice;
  }
  return best.empty() ? best : " - did you mean " + best + "?";
}

}  // namespace allpairs::app
