// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/structure/source_rules.h"

namespace carom::structure {

/// Sentences about includes of one file that go up in the layers of its library: a sub-folder includes itself and those
/// that stand before it in the list of its library. What stands in no sub-folder is on top of all of them, unless the
/// list says where ("." is the folder itself).
std::vector<std::string> layerViolations(const std::string& path, const std::string& text);

/// A room is a header and the source file of the same name. Circles of more than two rooms that include one another, in
/// the folders of the product: each as its rooms in alphabetical order.
std::vector<std::vector<std::string>> circles(const Sources& sources);

}  // namespace carom::structure
