// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// Writes `content` to a new file beside `path` and renames it onto `path`, so that a reader sees the old file or the
/// whole new one. Throws InputError naming the path; the temporary file is removed.
void writeFile(const std::string& path, std::string_view content);

}  // namespace carom
