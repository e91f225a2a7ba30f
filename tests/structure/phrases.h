// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carom::structure {

/// A phrase that must not be written, and what the field says in its place.
struct Phrase {
  std::string text, better;
};

/// From the lines "phrase | better" of tests/structure/phrases.txt. Throws std::runtime_error for a line without either.
std::vector<Phrase> readPhrases(const std::string& list);

/// What people read: the pages (*.md) and, in the folders of the product, sources, the page of the studio and schemas. By
/// path from the root of the project.
std::map<std::string, std::string> readProse(const std::filesystem::path& root);

/// A sentence for each place of a phrase in the text, whatever the case of letters, the ends of lines and the marks of
/// comments in between.
std::vector<std::string> phrasesIn(const std::string& path, const std::string& text, const std::vector<Phrase>& phrases);

}  // namespace carom::structure
