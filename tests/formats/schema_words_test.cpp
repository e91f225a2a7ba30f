// SPDX-License-Identifier: MIT
// The schema against the page of scene documents: what an editor shows and what a person reads must not fall behind
// what the program takes.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "editing/problem/controls/control_kinds.hpp"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "tests/formats/scene_documents.h"

namespace carom {

using namespace editing_detail;

namespace {

using Json = nlohmann::ordered_json;

Json readSchema(const std::string& name) {
  return Json::parse(formats_test::textOf(projectFile("formats/documents/") + name));
}

/// Every node with properties, by its JSON pointer.
void collectObjects(const Json& node, const std::string& pointer, std::map<std::string, Json>& objects) {
  if (node.is_object() && node.contains("properties") && node["properties"].is_object() && node.contains("type"))
    objects[pointer] = node["properties"];
  if (!node.is_structured()) return;
  for (const auto& item : node.items()) collectObjects(item.value(), pointer + "/" + item.key(), objects);
}

/// Rows of the first table below each heading of the page, by heading; a row is known by the word of its first cell.
using Table = std::map<std::string, std::string>;
std::map<std::string, std::vector<Table>> tablesOf(const std::string& page) {
  std::map<std::string, std::vector<Table>> tables;
  std::istringstream lines(page);
  std::string line, heading;
  bool in_table = false;
  const std::regex row(R"(\| `([^`]+)` \|.*)");
  std::smatch match;
  while (std::getline(lines, line)) {
    if (line.starts_with("#")) heading = line.substr(line.find(' ') + 1);
    if (!line.starts_with("|")) {
      in_table = false;
      continue;
    }
    if (!in_table) tables[heading].emplace_back();
    in_table = true;
    if (std::regex_match(line, match, row)) tables[heading].back()[match[1]] = line;
  }
  return tables;
}

struct Told {
  std::string pointer, heading;
};

// Where the page tells of the members of each object of the schema.
const std::vector<Told> kTold = {
    {"", "The document"},
    {"/definitions/material", "Materials"},
    {"/definitions/material/properties/combine", "combine"},
    {"/definitions/body", "Bodies"},
    {"/definitions/body/properties/collision_filter", "Collision filters"},
    {"/definitions/shape", "Shapes"},
    {"/definitions/sphere", "sphere"},
    {"/definitions/box", "box"},
    {"/definitions/plane", "plane"},
    {"/definitions/capsule", "capsule"},
    {"/definitions/cylinder", "cylinder"},
    {"/definitions/cone", "cone"},
    {"/definitions/hull", "hull"},
    {"/definitions/mesh", "mesh"},
    {"/definitions/part", "Parts"},
    {"/definitions/tilt", "Tilts"},
    {"/definitions/control", "Controls"},
    {"/definitions/distribution", "Distributions"},
    {"/definitions/distribution/properties/normal", "normal"},
    {"/definitions/distribution/properties/log_normal", "log_normal"},
    {"/definitions/distribution/properties/uniform", "uniform"},
    {"/definitions/constraint", "Constraints"},
    {"/definitions/constraint/properties/at/anyOf/1", "at"},
    {"/definitions/constraint/properties/time/anyOf/1", "times"},
    {"/definitions/constraint/properties/point", "point"},
    {"/definitions/range", "Ranges"},
    {"/definitions/constraint/properties/distance", "distance"},
    {"/definitions/constraint/properties/closest_approach", "closest_approach"},
    {"/definitions/impact_of", "after and before"},
    {"/definitions/region", "Regions"},
};

TEST(SchemaWords, everyMemberIsDescribedToEditors) {
  for (const char* name : {"scene.schema.json", "journal.schema.json"}) {
    std::map<std::string, Json> objects;
    collectObjects(readSchema(name), "", objects);
    EXPECT_GE(objects.size(), 3u);
    for (const auto& [pointer, properties] : objects)
      for (const auto& member : properties.items()) {
        const std::string description = member.value().value("description", "");
        EXPECT_GE(description.size(), 3u) << name << " " << pointer << "/properties/" << member.key();
      }
  }
}

TEST(SchemaWords, thePageTellsEveryMemberOfEveryObjectAndNoOther) {
  std::map<std::string, Json> objects;
  collectObjects(readSchema("scene.schema.json"), "", objects);
  const auto tables = tablesOf(formats_test::textOf(projectFile("docs/scenes.md")));
  for (const Told& told : kTold) {
    SCOPED_TRACE("docs/scenes.md, " + told.heading);
    ASSERT_TRUE(objects.contains(told.pointer)) << told.pointer;
    ASSERT_TRUE(tables.contains(told.heading));
    std::set<std::string> in_page, in_schema;
    for (const auto& row : tables.at(told.heading).front()) in_page.insert(row.first);
    for (const auto& member : objects.at(told.pointer).items()) in_schema.insert(member.key());
    EXPECT_EQ(in_page, in_schema);
    objects.erase(told.pointer);
  }
  for (const auto& [pointer, properties] : objects)
    ADD_FAILURE() << "docs/scenes.md has no table for the members of " << pointer << "; add it, and a row to this test";
}

TEST(SchemaWords, thePageTellsTheSameDefaults) {
  std::map<std::string, Json> objects;
  collectObjects(readSchema("scene.schema.json"), "", objects);
  const auto tables = tablesOf(formats_test::textOf(projectFile("docs/scenes.md")));
  const std::regex stated(R"(default (\[[^\]]*\]|-?[0-9.]+|average|false)(;|$))");
  int compared = 0;
  for (const Told& told : kTold) {
    for (const auto& member : objects.at(told.pointer).items()) {
      const std::string description = member.value().value("description", "");
      const std::string& row = tables.at(told.heading).front().at(member.key());
      std::smatch match;
      if (std::regex_search(description, match, stated)) {
        EXPECT_NE(row.find("`" + match[1].str() + "`"), std::string::npos) << match[0] << " is not in: " << row;
        ++compared;
      }
      EXPECT_EQ(description.ends_with("required"), row.find("| required |") != std::string::npos) << description << row;
    }
  }
  EXPECT_GE(compared, 18);
}

TEST(SchemaWords, thePageTellsEveryChoice) {
  const Json schema = readSchema("scene.schema.json");
  const std::string page = formats_test::textOf(projectFile("docs/scenes.md"));
  const auto kinds = tablesOf(page).at("Controls").at(1);
  std::set<std::string> in_page, in_schema, in_program;
  for (const auto& row : kinds) in_page.insert(row.first);
  for (const Json& word : schema["definitions"]["control"]["properties"]["vary"]["enum"])
    in_schema.insert(word.get<std::string>());
  for (const ControlKind* kind : controlKinds()) in_program.insert(kind->word);
  in_page.erase("vary");  // the table's own heading
  EXPECT_EQ(in_page, in_schema);
  EXPECT_EQ(in_program, in_schema);
  for (const Json& rule : schema["definitions"]["combine"]["enum"])
    EXPECT_NE(page.find("`" + rule.get<std::string>() + "`"), std::string::npos) << rule;
}

// What a document leaves out is what the schema says it is.
TEST(SchemaWords, defaultsAreThoseOfTheProgram) {
  const std::string least = R"({ "carom": 1, "materials": { "m": {} }, "bodies": [
    { "name": "f", "shape": { "plane": { "normal": [0, 0, 1] } }, "fixed": true },
    { "name": "b", "mass": 2, "shape": { "compound": [ { "hull": { "points": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]] } } ] } } ],
    "controls": [ { "vary": "velocity", "body": "b" } ] })";
  const std::string whole =
      R"({ "carom": 1, "gravity": [0, 0, -9.81], "duration": 1,
    "materials": { "m": { "elasticity": 0.5, "friction": 0.5, "tangential_elasticity": 0,
      "combine": { "elasticity": "average", "friction": "average" } } }, "bodies": [
    { "name": "f", "shape": { "plane": { "normal": [0, 0, 1], "offset": 0 } }, "fixed": true,
      "position": [0, 0, 0], "orientation": [1, 0, 0, 0], "velocity": [0, 0, 0], "angular_velocity": [0, 0, 0],
      "surface_velocity": [0, 0, 0], "surface_angular_velocity": [0, 0, 0] },
    { "name": "b", "mass": 2, "fixed": false, "shape": { "compound": [ { "position": [0, 0, 0], "orientation": [1, 0, 0, 0],
        "hull": { "points": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]], "scale": 1 } } ] },
      "position": [0, 0, 0], "orientation": [1, 0, 0, 0], "velocity": [0, 0, 0], "angular_velocity": [0, 0, 0],
      "surface_velocity": [0, 0, 0], "surface_angular_velocity": [0, 0, 0] } ],
    "controls": [ { "vary": "velocity", "body": "b", "components": ["x", "y", "z"], "weight": 1 } ] })";
  Document a = parseDocument(least, "least"), b = parseDocument(whole, "whole");
  EXPECT_EQ(b.controls[0].components, (std::vector<std::string>{"x", "y", "z"}));
  b.controls[0].components.clear();  // all of them: the same thing
  EXPECT_EQ(writeDocument(a), writeDocument(b));
}

TEST(SchemaWords, everyExampleNamesItselfAndTheSchema) {
  for (const std::string& path : formats_test::exampleScenes()) {
    const Document document = readDocument(path);
    EXPECT_EQ(document.schema, "../../formats/documents/scene.schema.json") << path;
    EXPECT_FALSE(document.name.empty()) << path;
  }
}

}  // namespace
}  // namespace carom
