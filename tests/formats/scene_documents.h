// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom::formats_test {

/// Text of a file under the root of the sources.
std::string textOf(const std::string& path);
/// Paths of the example scenes, sorted.
std::vector<std::string> exampleScenes();

/// A document that has every member of the format in this version at least once.
const std::string& documentWithEverything();

/// `text` with the only occurrence of `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace carom::formats_test
