// SPDX-License-Identifier: MIT
#include "tests/formats/broken_documents.h"

#include "tests/formats/scene_documents.h"

namespace carom::formats_test {
namespace {

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string depthBomb() { return R"({"carom": 1, "bodies": )" + repeated("[", 200000); }

std::string manyValues() { return R"({"carom": 1, "bodies": [)" + repeated("1,", 1000000) + "1]}"; }

std::string manyMembers() {
  std::string text = R"({"carom": 1, "materials": {)";
  for (int i = 0; i < 100000; ++i) text += "\"m" + std::to_string(i) + "\": {},";
  return text + R"("last": {}}, "bodies": [{"name": "b", "mass": 1, "shape": {"sphere": {"radius": 1}}}]})";
}

std::string longText() { return R"({"carom": 1, "duration": ")" + repeated("long ", 100000) + "\"}"; }

}  // namespace

std::vector<BrokenDocument> brokenTexts() {
  const std::string& whole = documentWithEverything();
  return {
      {"empty", "", "", "line 1, column 1", {"found the end of the text", "expected"}},
      {"blank", "", "  \n ", "line 2, column 2", {"found the end of the text"}},
      {"truncated",
       "",
       whole.substr(0, whole.size() / 2),
       "",
       {"line ", "found the end of the text", "expected the rest"}},
      {"truncatedText", "", R"({"carom": 1, "bodies": [{"na)", "", {"found the end of the text"}},
      {"notJson", "", "carom 1", "line 1, column 1", {"found \"carom\"", "expected valid JSON"}},
      {"missingComma",
       "\"duration\": 2.5,",
       "\"duration\": 2.5",
       "line 5, column 13",
       {"found \"materials\"", "expected valid JSON"}},
      {"trailingComma", "\"value\": [0, 0.1] }", "\"value\": [0, 0.1], }", "", {"found \"}\"", "expected valid JSON"}},
      {"twoDocuments", "", whole + "{}", "", {"found \"{\"", "expected valid JSON"}},
      {"comment", "", "// a scene\n" + whole, "line 1, column 1", {"expected valid JSON"}},
      {"singleQuotes", "\"duration\"", "'duration'", "line 4, column 3", {"expected valid JSON"}},
      {"nan", "\"duration\": 2.5", "\"duration\": NaN", "line 4, column 15", {"found NaN", "no infinity and no NaN"}},
      {"infinity",
       "\"duration\": 2.5",
       "\"duration\": -Infinity",
       "line 4, column 16",
       {"found -Infinity", "no infinity"}},
      {"overflow",
       "\"mass\": 0.4",
       "\"mass\": 1e400",
       "/bodies/3/mass",
       {"found 1e400", "a number that a double can hold", "line 20"}},
      {"overflowInArray", "[0.01, -0.02]", "[0.01, -1e999]", "/tilts/0/value/1", {"found -1e999"}},
      {"leadingZero", "\"duration\": 2.5", "\"duration\": 02.5", "", {"expected valid JSON"}},
      {"hexadecimal", "\"duration\": 2.5", "\"duration\": 0x10", "", {"expected valid JSON"}},
      {"badUtf8", "\"name\": \"crate\"", "\"name\": \"cr\xff\xfe\"", "", {"line ", "expected valid JSON", "UTF-8"}},
      {"controlCharacter", "\"name\": \"crate\"", "\"name\": \"cr\nate\"", "", {"line ", "control character"}},
      {"depthBomb", "", depthBomb(), "", {"more than 48 levels of nesting", "expected fewer"}},
      {"manyValues", "", manyValues(), "", {"more than 400000 values"}},
      {"manyMembers", "", manyMembers(), "", {"expected", "10000 materials"}},
      {"longText", "", longText(), "/duration", {"found \"long long", "...\"", "expected a number > 0"}},
      {"twiceInBody",
       "\"mass\": 0.4,",
       "\"mass\": 0.4, \"mass\": 0.5,",
       "/bodies/3/mass",
       {"found the member \"mass\" a second time", "every member once"}},
      {"twiceAtTop",
       "\"duration\": 2.5",
       "\"duration\": 2.5, \"carom\": 1",
       "/carom",
       {"found the member \"carom\" a second time"}},
      {"twiceMaterial",
       "\"wood\": { \"el",
       "\"felt\": {}, \"wood\": { \"el",
       "/materials/felt",
       {"found the member \"felt\" a second time"}},
      {"notAnObject", "", "[1, 2]", "", {"found [1, 2]", "expected an object that begins with \"carom\": 1"}},
      {"null", "", "null", "", {"found null", "expected an object"}},
      {"noVersion", "", R"({"bodies": []})", "", {"found no member \"carom\"", "\"carom\": 1"}},
      {"noVersionBeforeAllElse", "", R"({"nonsense": 2})", "", {"found no member \"carom\""}},
      {"otherVersion", "\"carom\": 1", "\"carom\": 2", "/carom", {"found 2", "expected 1"}},
      {"versionAsText", "\"carom\": 1", "\"carom\": \"1\"", "/carom", {"found \"1\"", "expected 1"}},
      {"largeText",
       "",
       std::string(50 << 20, ' '),
       "",
       {"found a text of 52428800 bytes", "expected at most 16777216 bytes"}},
  };
}

}  // namespace carom::formats_test
