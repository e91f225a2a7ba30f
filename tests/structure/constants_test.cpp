// SPDX-License-Identifier: MIT
// The constants of the search stand in one table of docs/editing.md, as the code has them.
#include "tests/structure/constants.h"

#include <gtest/gtest.h>

#include "examples/support/project_file.h"
#include "tests/structure/phrases.h"

namespace carom::structure {
namespace {

TEST(SearchConstants, AreThoseOfTheTable) {
  const std::string page = readProse(projectFile(".")).at("docs/editing.md");
  ASSERT_GE(toldConstants(page).size(), 80u);
  for (const std::string& violation : constantViolations(page, readSources(projectFile(".")))) ADD_FAILURE() << violation;
}

TEST(SearchConstants, PlantedDifferencesAreFound) {
  const std::string head = "| constant | file | value | what it trades |\n| --- | --- | --- | --- |\n";
  const Sources sources = {
      {"editing/strategy/a.cpp", "constexpr double kOne = 1e-4, kTwo[] = {1,\n    0.5};\nstruct S {\n  int most = 30;\n};\n"},
      {"editing/strategy/effort.cpp",
       "constexpr SearchPlan kFast{.rounds = 1, .stopping = {.least = 2}};\nconstexpr SearchPlan kNormal{.rounds = 3};\n"
       "constexpr SearchPlan kThorough{.rounds = 4, .stopping = {.least = 5}};\n"},
      {"editing/session/b.cpp", "constexpr int kElsewhere = 1;\n"}};
  const std::string good = head + "| `kOne`, `kTwo` | `a.cpp` | 1e-4; {1, 0.5} | why |\n| `most` | `a.cpp` | 30 | why |\n" +
                           "| `rounds` | `effort.cpp` | 1; 3; 4 | why |\n| `least` | `effort.cpp` | 2; -; 5 | why |\n";
  EXPECT_TRUE(constantViolations(good, sources).empty());
  EXPECT_EQ(constantViolations(good + "| `kNone` | `a.cpp` | 1 | why |\n", sources),
            (std::vector<std::string>{"the table says kNone = 1, a.cpp says ''"}));
  EXPECT_EQ(constantViolations(head + "| `kOne` | `a.cpp` | 1e-3 | why |\n", sources),
            (std::vector<std::string>{"the table says kOne = 1e-3, a.cpp says '1e-4'", "the table has no row for kTwo of a.cpp"}));
}

}  // namespace
}  // namespace carom::structure
