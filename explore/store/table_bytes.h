// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "explore/worlds/world_table.h"

namespace carom {

/// A table as bytes, little-endian and without gaps (docs/explore.md): "CAROMWT1"; uint32 numbers, rows, boxes, 1 with
/// derivatives or else 0; uint64 worlds; the columns in the order of WorldTable; the 64-bit FNV-1a hash of all before
/// it.
std::string tableBytes(const WorldTable& table);

/// The table of such bytes; nothing where they are damaged, cut short, or something else.
std::optional<WorldTable> tableOfBytes(std::string_view bytes);

}  // namespace carom
