// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom::formats_test {

/// A document that must be refused: `text` itself when `from` is empty, else documentWithEverything() with the only
/// occurrence of `from` replaced by `text`.
struct BrokenDocument {
  const char* name;
  std::string from, text;
  std::string where;                   ///< FormatError::where()
  std::vector<std::string> fragments;  ///< parts of FormatError::what()
};

std::vector<BrokenDocument> brokenTexts();    ///< not JSON, or not within its limits
std::vector<BrokenDocument> brokenMembers();  ///< of the schema, in what is simulated
std::vector<BrokenDocument> brokenEdits();    ///< of the schema, in controls and constraints
std::vector<BrokenDocument> brokenShapes();   ///< of the schema, and what a shape must be
std::vector<BrokenDocument> brokenMeaning();  ///< what the schema cannot say

}  // namespace carom::formats_test
