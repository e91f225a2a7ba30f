// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace carom {

/// The whole of a file of at most `limit` bytes. `what` is what is expected there ("a scene document"). Throws
/// FormatError: no such file, a folder, not readable, or longer.
std::string readFile(const std::string& path, const std::string& what, std::size_t limit);

}  // namespace carom
