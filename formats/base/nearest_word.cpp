// SPDX-License-Identifier: MIT
#include "formats/base/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace carom::formats_detail {
namespace {

constexpr std::size_t kLongestWord = 60;  // what is longer is no slip of the pen
constexpr std::size_t kBeginning = 4;     // letters by which a word is known

char lowerLetter(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Number of letters to add, leave out, change or swap with their neighbour.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lowerLetter(a[i - 1]) == lowerLetter(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

bool beginsWith(std::string_view word, std::string_view beginning) {
  return word.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), word.begin(),
                    [](char a, char b) { return lowerLetter(a) == lowerLetter(b); });
}

}  // namespace

std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t best = 2 + word.size() / 6;  // as many changes make another word
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestWord + best) continue;
    const std::size_t distance = editDistance(word, candidate);
    if (distance < best && distance < candidate.size()) best = distance, nearest = candidate;
  }
  if (nearest) return nearest;
  for (const std::string& candidate : candidates) {
    const std::string_view shorter = word.size() < candidate.size() ? word : std::string_view(candidate);
    const std::string_view longer = word.size() < candidate.size() ? std::string_view(candidate) : word;
    if (shorter.size() >= kBeginning && beginsWith(longer, shorter)) return candidate;
  }
  return nearest;
}

}  // namespace carom::formats_detail
