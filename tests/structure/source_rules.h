// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carom::structure {

/// Sources by their path from the project root, with '/' between folders.
using Sources = std::map<std::string, std::string>;

/// Every .h, .hpp and .cpp file of the folders that hold code.
Sources readSources(const std::filesystem::path& root);

/// An include as a path from the project root: "../formats/x.h" in editing/a.cpp means formats/x.h.
std::string resolved(const std::string& path, const std::string& include);

/// "adjoint" of "adjoint/scene/scene.h".
std::string folderOf(const std::string& path);

/// The files that the text includes, as written, comments left out.
std::vector<std::string> includesOf(const std::string& text);

/// What is forbidden in one file, a sentence each: who may include whom (folders, layers, private headers), where
/// functions whose bits differ by machine may be called, and what is too long.
std::vector<std::string> violations(const std::string& path, const std::string& text);

/// All of them, and what can only be seen in all files together: Ipopt in exactly one file, circles of includes, and
/// types that are defined twice.
std::vector<std::string> violations(const Sources& sources);

}  // namespace carom::structure
