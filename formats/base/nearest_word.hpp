// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace carom::formats_detail {

/// The candidate that `word` is most likely a misspelling of: the one with the fewest letters to add, leave out, change
/// or swap with their neighbour (optimal string alignment, case aside), the first of them where several are as near.
/// None where all are other words: at most 1 + size / 6 letters may differ, and fewer than the candidate has. Of words
/// that begin alike one is near where the longer one only goes on ("angular" of "angular_velocity").
std::optional<std::string> nearestWord(std::string_view word, std::span<const std::string> candidates);

}  // namespace carom::formats_detail
