// SPDX-License-Identifier: MIT
#include "studio/recent_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/studio/share_folder.h"

namespace carom::studio {
namespace {

using Names = std::vector<std::string>;

TEST(RecentFiles, AreThoseBelowAFolderThatAreThereTheLastOneFirst) {
  const TestFolder place;
  for (const char* name : {"scenes/a.json", "scenes/b.json", "scenes/more/c.json", "elsewhere/d.json"}) place.write(name, "{}");
  const std::string list = place.path() + "/state/carom/opened", scenes = place.path() + "/scenes";
  const RecentFiles recent(list);
  EXPECT_EQ(recent.below(scenes), Names{}) << "nothing was opened yet";
  for (const char* name : {"scenes/a.json", "scenes/b.json", "elsewhere/d.json", "scenes/more/c.json", "scenes/a.json"})
    recent.add(place.path() + "/" + name);
  EXPECT_EQ(RecentFiles(list).below(scenes), (Names{"a.json", "more/c.json", "b.json"}));
  EXPECT_EQ(recent.below(place.path() + "/elsewhere"), Names{"d.json"});
  place.remove("scenes/a.json");
  EXPECT_EQ(recent.below(scenes), (Names{"more/c.json", "b.json"}));
  recent.add("two\nlines.json");
  EXPECT_EQ(recent.below(scenes).size(), 2u);
  for (int k = 0; k < 300; ++k) recent.add(place.path() + "/gone/" + std::to_string(k));
  EXPECT_EQ(recent.below(scenes), Names{}) << "the oldest are forgotten";
}

TEST(RecentFiles, AreNotKeptWhereThatCannotBe) {
  const TestFolder place;
  place.write("scenes/a.json", "{}");
  place.write("file", "no folder");
  for (const std::string& list : {std::string(), place.path() + "/file/opened"}) {
    const RecentFiles recent(list);
    recent.add(place.path() + "/scenes/a.json");
    EXPECT_EQ(recent.below(place.path() + "/scenes"), Names{});
  }
}

}  // namespace
}  // namespace carom::studio
