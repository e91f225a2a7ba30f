// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "explore/worlds/exploration.h"
#include "explore/worlds/world_table.h"

namespace carom {

/// A table as text with commas, RFC 4180: a line of names, then one a world; numbers read back exactly, those that
/// there are none of are empty.
std::string tableCsv(const Exploration& exploration, const WorldTable& table);

}  // namespace carom
