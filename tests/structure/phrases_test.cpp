// SPDX-License-Identifier: MIT
// Phrases that read as if translated do not return: tests/structure/phrases.txt has them.
#include "tests/structure/phrases.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "examples/support/project_file.h"

namespace carom::structure {
namespace {

std::vector<Phrase> listedPhrases() {
  std::ifstream in(projectFile("tests/structure/phrases.txt"));
  return readPhrases({std::istreambuf_iterator<char>(in), {}});
}

TEST(Phrases, DoNotReturn) {
  const std::vector<Phrase> phrases = listedPhrases();
  ASSERT_FALSE(phrases.empty());
  const auto prose = readProse(projectFile("."));
  for (const char* path : {"README.md", "docs/editing.md", "editing/edit.h", "cli/command_line.cpp", "studio/page/index.html"})
    ASSERT_TRUE(prose.contains(path)) << path;
  for (const auto& [path, text] : prose)
    for (const std::string& found : phrasesIn(path, text, phrases)) ADD_FAILURE() << found;
}

// Every listed phrase is found where it is planted: broken by the end of a line, in a comment, with a capital.
TEST(Phrases, PlantedOnesAreFound) {
  for (const Phrase& phrase : listedPhrases()) {
    std::string broken = phrase.text;
    broken[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(broken[0])));
    if (const std::size_t blank = broken.find(' '); blank != std::string::npos) broken.replace(blank, 1, "\n  /// ");
    const std::vector<std::string> found = phrasesIn("a.h", "\n/// " + broken + ".\n", {phrase});
    ASSERT_EQ(found.size(), 1u) << phrase.text;
    EXPECT_TRUE(found[0].starts_with("a.h:2 says")) << found[0];
    EXPECT_TRUE(phrasesIn("a.h", "/// " + phrase.better + "\n", {phrase}).empty()) << phrase.text;
  }
}

TEST(Phrases, LinesWithoutBetterAreRefused) {
  EXPECT_EQ(readPhrases("# a comment\n\none | two\n").size(), 1u);
  EXPECT_THROW(readPhrases("one\n"), std::runtime_error);
  EXPECT_THROW(readPhrases("one |  \n"), std::runtime_error);
}

}  // namespace
}  // namespace carom::structure
