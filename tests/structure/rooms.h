// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_rules.h"

namespace carom::structure {

/// Rooms that include one another, directly or over others: a header and its source of one path are one room. Only
/// circles of more than one room, the largest first; the rooms of each in order.
std::vector<std::vector<std::string>> circles(const Sources& sources);

/// Circles of more than two rooms in the product's folders that are not known yet, a sentence each.
std::vector<std::string> circleViolations(const Sources& sources);

}  // namespace carom::structure
