// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom::structure {

/// Sentences about a file, or a function in it, that is too long to be read in a sitting: 350 and 60 lines in the
/// product, 450 lines elsewhere.
std::vector<std::string> lengthViolations(const std::string& path, const std::string& text);

}  // namespace carom::structure
