// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_rules.h"

namespace carom::structure {

/// Sentences about a file of a library that has layers: those of its includes that stand above it, and files that belong
/// to no layer.
std::vector<std::string> layerViolations(const std::string& path, const std::string& text);

}  // namespace carom::structure
