// SPDX-License-Identifier: MIT
// carom import: answers, files beside the document, errors, and what is written over.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "formats/gltf/read/import_gltf.h"
#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Names = std::vector<std::string>;

std::string sample(const std::string& name) { return projectFile("tests/import/data/") + name; }

json minimal() {
  return json::parse(R"({
    "asset": {"version": "2.0"},
    "extensions": {"KHR_implicit_shapes": {"shapes": [{"type": "sphere", "sphere": {"radius": 0.1}}]}},
    "nodes": [{"name": "ball", "extensions": {"KHR_physics_rigid_bodies": {
      "motion": {"mass": 1}, "collider": {"geometry": {"shape": 0}}}}}]
  })");
}

TEST(Import, WritesTheDocumentAndTheMeshesBesideIt) {
  const std::string output = temporaryPath("shapes.json");
  const CommandRun run = runCommand({"import", sample("shapes.gltf"), "-o", output});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out, "Written: " + output + " (13 bodies, 1 material, 6 mesh files)\n");
  EXPECT_NE(run.err.find("carom: warning: node 'Lamp' (/nodes/14): its trigger is ignored"), std::string::npos)
      << run.err;
  const Document document = readDocument(output);
  EXPECT_EQ(document.scene.bodies.size(), 13u);
  EXPECT_EQ(document.duration, 1);
}

TEST(Import, AnswersInJson) {
  const std::string output = temporaryPath("answer.json");
  const json answer = runJson({"import", sample("shapes.gltf"), "-o", output, "--duration", "2.5"});
  EXPECT_EQ(membersOf(answer), (Names{"bodies", "constraints", "controls", "file", "joints", "materials", "meshes", "triggers", "warnings"}));
  EXPECT_EQ(answer["file"], output);
  EXPECT_EQ(answer["bodies"], 13);
  EXPECT_EQ(answer["materials"], 1);
  EXPECT_EQ(answer["controls"], 0);
  EXPECT_EQ(answer["constraints"], 0);
  ASSERT_EQ(answer["meshes"].size(), 6u);
  for (const json& mesh : answer["meshes"])
    EXPECT_TRUE(fs::is_regular_file(fs::path(output).parent_path() / mesh.get<std::string>())) << mesh;
  const Imported imported = importGltf(sample("shapes.gltf"));
  for (const std::string& warning : imported.report.warnings)
    EXPECT_EQ(std::count(answer["warnings"].begin(), answer["warnings"].end(), warning), 1) << warning;
  EXPECT_EQ(readDocument(output).duration, 2.5);
}

TEST(Import, ReadsWhatExportWrites) {
  for (const std::string& name : sceneNames()) {
    const std::string written = temporaryPath(name + ".glb"), output = temporaryPath(name + "-again.json");
    ASSERT_EQ(runCommand({"export", scenePath(name), "-o", written}).code, 0) << name;
    const CommandRun run = runCommand({"import", written, "-o", output});
    EXPECT_EQ(run.code, 0) << name;
    EXPECT_EQ(run.err, "") << name;
    if (readText(scenePath(name)).find("\"file\"") == std::string::npos) {  // mesh files are written afresh
      Document document = readDocument(scenePath(name));
      document.schema.clear();  // where an editor finds it beside that file
      EXPECT_EQ(writeDocument(readDocument(output)), writeDocument(document)) << name;
    }
    for (const char* command : {"simulate", "gradient"})
      EXPECT_EQ(runCommand({command, output, "--json"}).out, runCommand({command, scenePath(name), "--json"}).out)
          << command << " " << name;
  }
}

TEST(Import, OverlapsAreWarningsAndTheSceneIsWritten) {
  json file = minimal();
  file["nodes"].push_back(file["nodes"][0]);
  file["nodes"][1]["translation"] = {0.15, 0, 0};
  const std::string path = writeTemporary("overlap.gltf", file.dump()), output = temporaryPath("overlap.json");
  const json answer = runJson({"import", path, "-o", output});
  ASSERT_EQ(answer["warnings"].size(), 1u);
  EXPECT_NE(answer["warnings"][0].get<std::string>().find("overlap by"), std::string::npos)
      << answer;
  EXPECT_TRUE(fs::exists(output));
}

TEST(Import, WritesOverADocumentWholeOrNotAtAll) {
  const std::string output = writeTemporary("kept.json", "what was there");
  const std::string broken = writeTemporary("broken.gltf", "{\"asset\": {}}");
  EXPECT_EQ(runCommand({"import", broken, "-o", output}).code, 1);
  EXPECT_EQ(readText(output), "what was there");
  EXPECT_EQ(runCommand({"import", sample("materials.gltf"), "-o", output}).code, 0);
  EXPECT_EQ(readDocument(output).scene.bodies.size(), 5u);
  const std::string first = readText(output);
  EXPECT_EQ(runCommand({"import", sample("materials.gltf"), "-o", output}).code, 0);
  EXPECT_EQ(readText(output), first);
}

TEST(Import, DoesNotWriteOverTheFileItReads) {
  const std::string path = writeTemporary("same.gltf", minimal().dump());
  const CommandRun run = runCommand({"import", path, "-o", path});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("found the file that is read, expected another one"), std::string::npos) << run.err;
  EXPECT_EQ(readText(path), minimal().dump());
}

TEST(Import, ErrorsNameFileAndPlace) {
  json file = minimal();
  file["nodes"][0]["extensions"]["KHR_physics_rigid_bodies"]["motion"]["mass"] = -3;
  const std::string mass = writeTemporary("mass.gltf", file.dump());
  file = minimal();
  file["nodes"][0]["scale"] = {1, 2, 3};
  const std::string scale = writeTemporary("scale.gltf", file.dump());
  struct Row {
    std::string path, pointer, message;
  };
  for (const Row& row :
       {Row{temporaryPath("missing.glb"), "", "no such file"}, Row{writeTemporary("text.glb", "hello"), "", "line 1"},
        Row{writeTemporary("none.gltf", R"({"asset": {"version": "2.0"}})"), "", "no body"},
        Row{mass, "/nodes/0/extensions/KHR_physics_rigid_bodies/motion/mass", "-3"},
        Row{scale, "/nodes/0", "node 'ball'"}}) {
    const std::string output = temporaryPath("never.json");
    const CommandRun run = runCommand({"import", row.path, "-o", output});
    EXPECT_EQ(run.code, 1) << row.path;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("carom: " + row.path + ": "), std::string::npos) << run.err;
    const json answer = runJson({"import", row.path, "-o", output}, 1);
    EXPECT_EQ(answer["error"]["file"], row.path);
    EXPECT_EQ(answer["error"]["pointer"], row.pointer);
    EXPECT_NE(answer["error"]["message"].get<std::string>().find(row.message), std::string::npos) << answer;
    EXPECT_FALSE(fs::exists(output));
  }
}

TEST(Import, OutputThatCannotBeWritten) {
  for (const char* name : {"materials.gltf", "shapes.gltf"}) {  // without and with mesh files
    const json answer = runJson({"import", sample(name), "-o", temporaryPath("no-such-folder") + "/out.json"}, 1);
    EXPECT_NE(answer["error"]["file"].get<std::string>().find("no-such-folder/out"), std::string::npos) << answer;
    EXPECT_FALSE(fs::exists(temporaryPath("no-such-folder")));
  }
}

TEST(Import, WrongUsageEndsWithTwo) {
  for (const Names& words :
       {Names{"import"}, Names{"import", sample("shapes.gltf")}, Names{"import", "-o", "a.json"},
        Names{"import", "a.glb", "b.glb", "-o", "c.json"}, Names{"import", "a.glb", "-o", "c.json", "--duration", "0"},
        Names{"import", "a.glb", "-o", "c.json", "--duration", "soon"}}) {
    const CommandRun run = runCommand(words);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(membersOf(runJson(words, 2)), Names{"error"});
  }
}

TEST(Import, ExplainsItself) {
  const CommandRun help = runCommand({"import", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* part : {"Examples:\n  carom import", "--json", "KHR_physics_rigid_bodies", "joints, triggers"})
    EXPECT_NE(help.out.find(part), std::string::npos) << part;
  EXPECT_NE(runCommand({"--help"}).out.find("  import"), std::string::npos);
}

}  // namespace
}  // namespace carom::test
