// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carom::structure {

/// Sources by their path from the project root, with '/' between folders.
using Sources = std::map<std::string, std::string>;

/// The first folder of a path from the project root.
std::string folderOf(const std::string& path);

/// Every .h, .hpp and .cpp file of the folders that hold code.
Sources readSources(const std::filesystem::path& root);

/// The files that the text includes, as written, comments left out.
std::vector<std::string> includesOf(const std::string& text);

/// What the layering forbids in one file, a sentence each: who may include whom, where functions whose bits differ by
/// machine may be called, and the longest file.
std::vector<std::string> violations(const std::string& path, const std::string& text);

/// All of them, and what can only be seen in all files together: Ipopt in exactly one file.
std::vector<std::string> violations(const Sources& sources);

}  // namespace carom::structure
