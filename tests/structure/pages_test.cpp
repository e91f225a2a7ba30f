// SPDX-License-Identifier: MIT
// The pages: README is short, links lead somewhere, every page is in the index, sources that are named exist.
#include "tests/structure/pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "examples/support/project_file.h"
#include "tests/structure/phrases.h"
#include "tests/structure/source_rules.h"

namespace carom::structure {
namespace {

constexpr long kLongestReadme = 150;

Pages allPages() {
  Pages pages;
  for (auto& [path, text] : readProse(projectFile(".")))
    if (path.ends_with(".md")) pages[path] = text;
  return pages;
}

TEST(Documentation, ReadmeIsReadInOneSitting) {
  const std::string readme = allPages().at("README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), kLongestReadme);
}

TEST(Documentation, LinksLeadSomewhere) {
  const Pages pages = allPages();
  ASSERT_GE(pages.size(), 20u);
  for (const std::string& dead : deadLinks(pages, [](const std::string& path) { return std::filesystem::exists(projectFile(path)); }))
    ADD_FAILURE() << dead;
}

TEST(Documentation, EveryPageIsInTheIndex) {
  for (const std::string& missing : pagesNotIndexed(allPages())) ADD_FAILURE() << missing;
}

// But for the changelog, and notes on the work itself.
TEST(Documentation, PagesOpenWithAnExample) {
  Pages pages = allPages();
  for (const char* path : {"CHANGELOG.md", "docs/progress.md"}) pages.erase(path);
  for (const std::string& page : pagesWithoutExample(pages)) ADD_FAILURE() << page;
  EXPECT_EQ(pagesWithoutExample({{"a.md", "# A\n\n![p](p.svg)\n"}, {"b.md", "# B\nwords\n"}}),
            (std::vector<std::string>{"b.md opens without an example or a picture"}));
}

// The changelog tells of what was.
TEST(Documentation, SourcesThatAreNamedExist) {
  Pages pages = allPages();
  pages.erase("CHANGELOG.md");
  std::vector<std::string> paths;
  for (const auto& [path, text] : readSources(projectFile("."))) paths.push_back(path);
  for (const std::string& lost : lostSources(pages, paths)) ADD_FAILURE() << lost;
}

// The version of CMake is that of the latest release in the changelog, and of the citation, which has its date, too.
TEST(Documentation, VersionsAgree) {
  const auto found = [](const std::string& file, const std::string& pattern) {
    std::ifstream in(projectFile(file));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::smatch match;
    return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "none in " + file;
  };
  const std::string version = found("CMakeLists.txt", "project\\(carom VERSION ([\\d.]+)");
  EXPECT_EQ(found("CHANGELOG.md", "\n## ([\\d.]+)"), version);
  EXPECT_EQ(found("CITATION.cff", "\nversion: ([\\d.]+)"), version);
  EXPECT_EQ(found("CHANGELOG.md", "\n## [\\d.]+ \\(([\\d-]+)\\)"), found("CITATION.cff", "\ndate-released: ([\\d-]+)"));
}

TEST(Documentation, DecisionsAreShort) {
  for (const std::string& violation : decisionViolations(allPages().at("docs/decisions.md"))) ADD_FAILURE() << violation;
}

TEST(Documentation, PlantedLongDecisionsAreFound) {
  const auto entries = [](int count) {
    std::string page = "# Decisions\n\n## Area\n";
    for (int i = 1; i <= count; ++i) page += "\n" + std::to_string(i) + ". **Title.** Why.\n";
    return page;
  };
  const std::string line = "   so\n";
  EXPECT_TRUE(decisionViolations(entries(60)).empty());
  EXPECT_EQ(decisionViolations(entries(61)).size(), 1u);
  EXPECT_TRUE(decisionViolations(entries(1) + line + line + line + line + "\n## Next\n" + line + line).empty());
  EXPECT_EQ(decisionViolations(entries(1) + line + line + line + line + line).size(), 1u);
  EXPECT_TRUE(decisionViolations(entries(1) + std::string(140, 'x') + "\n").empty());
  EXPECT_EQ(decisionViolations(entries(1) + std::string(141, 'x') + "\n").size(), 1u);
  EXPECT_EQ(decisionViolations("1. **One.**\n3. **Three.**\n").size(), 1u);
  EXPECT_EQ(decisionViolations("# Decisions\n").size(), 1u);
}

TEST(Documentation, PlantedDeadLinksAreFound) {
  const Pages pages = {
      {"README.md", "[a](docs/a.md) [b](docs/b.md) [c](docs/a.md#two-words) [d](docs/a.md#three) [e](https://x.y/z)\n"},
      {"docs/a.md", "# A\n## Two, *words*!\n```\n[code](nowhere.md)\n# not a heading\n```\n`[code](nowhere.md)` [f](#a) [g](#b) "
                    "[h](../README.md)\n"}};
  const auto exists = [&](const std::string& path) { return pages.contains(path); };
  EXPECT_EQ(deadLinks(pages, exists), (std::vector<std::string>{
                                          "README.md links to docs/b.md, where there is no file",
                                          "README.md links to docs/a.md#three, where there is no such heading",
                                          "docs/a.md links to #b, where there is no such heading"}));
}

TEST(Documentation, AnchorsAreThoseOfGitHub) {
  EXPECT_EQ(anchorsOf("# What a change costs\n## `at`\n## [Pictures](p.md) & more\n## Twice\n## Twice\n# Main {#main}\n"),
            (std::set<std::string>{"what-a-change-costs", "at", "pictures--more", "twice", "twice-1", "main"}));
}

TEST(Documentation, PlantedLostPagesAndSourcesAreFound) {
  const Pages pages = {{"docs/index.md", "[a](a.md#x)\n"}, {"docs/a.md", "`editing/a.cpp`, `a.cpp`, `b.cpp`, `gaps/a.cpp`\n"}, {"docs/b.md", ""}};
  EXPECT_EQ(pagesNotIndexed(pages), (std::vector<std::string>{"docs/index.md does not link to docs/b.md"}));
  EXPECT_EQ(lostSources(pages, {"editing/a.cpp"}),
            (std::vector<std::string>{"docs/a.md names b.cpp, which there is not", "docs/a.md names gaps/a.cpp, which there is not"}));
}

}  // namespace
}  // namespace carom::structure
