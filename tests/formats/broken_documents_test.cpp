// SPDX-License-Identifier: MIT
#include "tests/formats/broken_documents.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>

#include "formats/documents/scene_json.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

using formats_test::BrokenDocument;

void expectRefused(const BrokenDocument& broken) {
  SCOPED_TRACE(broken.name);
  const std::string text =
      broken.from.empty() ? broken.text
                          : formats_test::replaced(formats_test::documentWithEverything(), broken.from, broken.text);
  const auto begin = std::chrono::steady_clock::now();
  try {
    parseDocument(text, "broken");
    ADD_FAILURE() << "was read";
  } catch (const FormatError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("broken: ", 0), 0u) << what;
    if (!broken.where.empty()) {
      EXPECT_EQ(error.where(), broken.where) << what;
    }
    for (const std::string& fragment : broken.fragments)
      EXPECT_NE(what.find(fragment), std::string::npos) << what << "\nwithout: " << fragment;
    EXPECT_LT(what.size(), 1000u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    if (std::getenv("CAROM_SHOW_MESSAGES") != nullptr) std::cout << broken.name << ": " << what << '\n';
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(BrokenDocuments, thereAreMany) {
  EXPECT_GE(
      formats_test::brokenTexts().size() + formats_test::brokenMembers().size() + formats_test::brokenEdits().size() +
          formats_test::brokenMeaning().size(),
      60u);
}

TEST(BrokenDocuments, texts) {
  for (const BrokenDocument& broken : formats_test::brokenTexts()) expectRefused(broken);
}

TEST(BrokenDocuments, members) {
  for (const BrokenDocument& broken : formats_test::brokenMembers()) expectRefused(broken);
}

TEST(BrokenDocuments, edits) {
  for (const BrokenDocument& broken : formats_test::brokenEdits()) expectRefused(broken);
}

TEST(BrokenDocuments, shapes) {
  for (const BrokenDocument& broken : formats_test::brokenShapes()) expectRefused(broken);
}

TEST(BrokenDocuments, meaning) {
  for (const BrokenDocument& broken : formats_test::brokenMeaning()) expectRefused(broken);
}

// One error for each value of a large wrong document must not become a flood.
TEST(BrokenDocuments, manyErrorsAtOnce) {
  std::string text = R"({"carom": 1, "bodies": [)";
  for (int i = 0; i < 9000; ++i) text += R"({"name": 1, "shape": {"box": {"size": ["a", "b", "c"]}}, "nmae": 2},)";
  text.back() = ']';
  const auto begin = std::chrono::steady_clock::now();
  try {
    parseDocument(text + "}", "flood");
    FAIL() << "was read";
  } catch (const FormatError& error) {
    EXPECT_EQ(error.where().rfind("/bodies/0/", 0), 0u) << error.what();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

class BrokenFile : public testing::Test {
 protected:
  BrokenFile()
      : folder_(std::filesystem::temp_directory_path() / ("carom-broken-" + std::to_string(std::random_device{}()))) {
    std::filesystem::create_directory(folder_);
  }
  ~BrokenFile() override { std::filesystem::remove_all(folder_); }

  std::string messageFor(const std::string& path) const {
    try {
      readDocument(path);
    } catch (const FormatError& error) {
      EXPECT_EQ(error.file(), path);
      return error.what();
    }
    ADD_FAILURE() << "was read";
    return {};
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

TEST_F(BrokenFile, fiftyMegabytes) {
  std::ofstream(path("large.json")) << formats_test::documentWithEverything();
  std::filesystem::resize_file(path("large.json"), 50 << 20);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(messageFor(path("large.json")),
            path("large.json") + ": found a file of 52428800 bytes, expected at most 16777216 bytes");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200));
}

TEST_F(BrokenFile, truncated) {
  const std::string& whole = formats_test::documentWithEverything();
  for (std::size_t length = 0; length < whole.size(); length += 37) {
    std::ofstream(path("cut.json"), std::ios::trunc) << whole.substr(0, length);
    EXPECT_NE(messageFor(path("cut.json")).find("found the end of the text"), std::string::npos) << length;
  }
}

TEST_F(BrokenFile, missingAndFolder) {
  EXPECT_EQ(messageFor(path("none.json")), path("none.json") + ": found no such file, expected a scene document");
  EXPECT_EQ(messageFor(folder_.string()), folder_.string() + ": found a folder, expected a file");
}

TEST_F(BrokenFile, endlessDevice) {
  if (std::filesystem::exists("/dev/zero")) {
    EXPECT_NE(messageFor("/dev/zero").find("expected at most"), std::string::npos);
  }
}

}  // namespace
}  // namespace carom
