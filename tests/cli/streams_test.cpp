// SPDX-License-Identifier: MIT
// "-" for standard input and output: the same answers as by file, and nothing else on standard output.
#include <gtest/gtest.h>

#include <filesystem>

#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "tests/cli/run_command.h"
#include "tests/cli/short_session.h"

namespace carom::test {
namespace {

using nlohmann::json;

std::string quoted(const std::string& path) { return "'" + path + "'"; }

/// Runs a command with a file as its standard input.
CommandRun fed(const std::string& input, const std::string& command) {
  return runShell("carom " + command + " < " + quoted(input));
}

std::string scene() { return scenePath("ball-over-wall"); }

TEST(StandardInput, GivesTheAnswersOfTheFile) {
  for (const std::string command : {"simulate", "gradient", "check"})
    EXPECT_EQ(fed(scene(), command + " - --json").out, runCommand({command, scene(), "--json"}).out) << command;
  for (const std::string command : {"validate", "info"}) {
    std::string expected = runCommand({command, scene()}).out;
    expected.replace(expected.find(scene()), scene().size(), "<stdin>");
    EXPECT_EQ(fed(scene(), command + " -").out, expected);
  }
  EXPECT_EQ(json::parse(fed(scene(), "validate - --json").out)["file"], "<stdin>");
  json read = json::parse(fed(scene(), "edit - --json").out), expected = runJson({"edit", scene()});
  for (json* answer : {&read, &expected}) answer->erase("milliseconds");
  EXPECT_EQ(read, expected);
}

TEST(StandardInput, MayBeAPipe) {
  const CommandRun run = runShell("cat " + quoted(scene()) + " | carom validate -");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("<stdin>: valid: ", 0), 0u) << run.out;
}

TEST(StandardInput, ErrorsNameIt) {
  const std::string typo = writeTemporary("typo.json", R"({"carom": 1, "bodis": []})");
  const CommandRun run = fed(typo, "simulate -");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("carom: <stdin>: ", 0), 0u) << run.err;
  const json error = json::parse(fed(typo, "simulate - --json").out)["error"];
  EXPECT_EQ(error["file"], "<stdin>");
  EXPECT_EQ(error["pointer"], "/bodis");
  EXPECT_EQ(fed("/dev/null", "simulate -").code, 1);
  EXPECT_NE(fed("/dev/null", "import - -o x.json").err.find("<stdin>"), std::string::npos);
  EXPECT_NE(fed(typo, "replay -").err.find("<stdin>"), std::string::npos);
  EXPECT_EQ(fed("/dev/zero", "simulate -").code, 1);  // ends: too long
}

TEST(StandardInput, FilesAreSoughtInTheCurrentFolder) {
  const std::string path = scenePath("ball_in_cup");
  ASSERT_NE(readText(path).find("\"file\""), std::string::npos);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const CommandRun there = runShell("cd " + quoted(folder) + " && carom simulate - --json < " + quoted(path));
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_EQ(there.out, runCommand({"simulate", path, "--json"}).out);
  const std::string elsewhere = temporaryPath("elsewhere");
  std::filesystem::create_directories(elsewhere);
  const CommandRun lost = runShell("cd " + quoted(elsewhere) + " && carom simulate - < " + quoted(path));
  EXPECT_EQ(lost.code, 1);
  EXPECT_NE(lost.err.find("no such file"), std::string::npos) << lost.err;
}

TEST(StandardInput, IsReadOnce) {
  EXPECT_EQ(fed(scene(), "export - --before - --format svg -o -").code, 2);
  const CommandRun run = fed(scene(), "export " + quoted(scene()) + " --before - --format svg -o -");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("<?xml", 0), 0u);
}

TEST(StandardOutput, OfAnEditIsItsDocument) {
  const std::string file = temporaryPath("edited.json");
  ASSERT_EQ(runCommand({"edit", scene(), "-o", file}).code, 0);
  const CommandRun run = runCommand({"edit", scene(), "-o", "-"});
  EXPECT_EQ(run.code, 0);
  // But for "$schema", which is told from where the document is.
  json printed = json::parse(run.out), saved = json::parse(readText(file));
  for (json* document : {&printed, &saved}) document->erase("$schema");
  EXPECT_EQ(printed, saved);
  EXPECT_NE(run.err.find("velocity.x of 'ball'"), std::string::npos) << "text for people: " << run.err;
  EXPECT_EQ(runCommand({"edit", scene(), "-o", "-", "--quiet"}).err, "");
}

TEST(StandardOutput, FilesAreNamedFromTheCurrentFolder) {
  const std::string path = scenePath("mug-on-mark");
  const std::string folder = std::filesystem::path(path).parent_path().parent_path().string();
  const CommandRun run =
      runShell("cd " + quoted(folder) + " && carom edit scenes/mug-on-mark.json -o - | carom info -");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("<stdin>: ", 0), 0u) << run.out;
}

TEST(StandardOutput, StaysEmptyWhereAnEditFails) {
  json scene_json = json::parse(readText(scenePath("two-balls")));
  scene_json["constraints"][0]["position"] = {0, 0, 5000};
  scene_json["controls"] = {{{"vary", "elasticity"}, {"material", scene_json["materials"].begin().key()}}};
  const CommandRun run = runCommand({"edit", writeTemporary("no-way.json", scene_json.dump()), "-o", "-"});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("Nothing was written."), std::string::npos) << run.err;
}

TEST(StandardOutput, TakesOneThingAlone) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"edit", scene(), "-o", "-"}, {"export", scene(), "-o", "-", "--format", "csv"}}) {
    const json error = runJson(words, 2)["error"];
    EXPECT_NE(error["message"].get<std::string>().find("--json and -o -"), std::string::npos) << error;
  }
  EXPECT_EQ(runCommand({"edit", scene(), "-o", "-", "--alternatives", "2"}).code, 2);
}

TEST(StandardOutput, OfAnExportIsTheFile) {
  for (const std::string format : {"glb", "gltf", "py", "csv"}) {
    const std::string file = temporaryPath("streamed." + format);
    ASSERT_EQ(runCommand({"export", scene(), "-o", file}).code, 0);
    const CommandRun run = runCommand({"export", scene(), "-o", "-", "--format", format});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, readText(file)) << format;
    EXPECT_EQ(run.err, "");
  }
  const CommandRun picture = runCommand({"export", scene(), "-o", "-", "--format", "svg"});
  const std::string name = json::parse(readText(scene())).value("name", "ball-over-wall");
  EXPECT_NE(picture.out.find("<title id=\"title\">" + name.substr(0, 10)), std::string::npos);
  EXPECT_NE(picture.out.find("</svg>"), std::string::npos);
}

TEST(StandardOutput, NeedsToKnowTheFormat) {
  const CommandRun run = runCommand({"export", scene(), "-o", "-"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("--format"), std::string::npos) << run.err;
  EXPECT_EQ(runCommand({"export", scene(), "-o", "-", "--format", "obj"}).code, 2);
  const std::string file = temporaryPath("without-extension");
  EXPECT_EQ(runCommand({"export", scene(), "-o", file, "--format", "csv"}).code, 0);
  EXPECT_EQ(readText(file).rfind("time [s],", 0), 0u);
}

TEST(StandardOutput, BinaryFilesAreKeptFromATerminal) {
  const CommandRun run = runOnTerminal(Terminal::out, {"export", scene(), "-o", "-", "--format", "glb"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("terminal"), std::string::npos) << run.err;
  EXPECT_EQ(runOnTerminal(Terminal::out, {"export", scene(), "-o", "-", "--format", "csv"}).code, 0);
}

TEST(StandardStreams, PassDocumentsOn) {
  const std::string path = temporaryPath("passed.glb");
  const CommandRun run = runShell("carom edit " + quoted(scene()) + " -o - -q | carom export - --format glb -o - " +
                                  "| carom import - -o - | carom validate -");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.rfind("<stdin>: valid: ", 0), 0u) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST(StandardStreams, JournalsAreReadAndTheirEndWritten) {
  const std::string journal = temporaryPath("journal.json");
  saveJournal(journal, {shortSession(), ""});
  const CommandRun run = fed(journal, "replay - -o -");
  EXPECT_EQ(run.code, 0) << run.err;
  const Document end = parseDocument(run.out, "the end");
  EXPECT_EQ(end.scene.bodies.size(), 2u);
  EXPECT_NE(run.err.find("slowest [ms]"), std::string::npos) << run.err;
  const json answer = json::parse(fed(journal, "replay - --json").out);
  EXPECT_EQ(answer["file"], "<stdin>");
}

TEST(StandardStreams, MeshesNeedAFile) {
  const std::string glb = temporaryPath("mesh.glb");
  const std::string path = scenePath("mug");
  ASSERT_EQ(runCommand({"export", path, "-o", glb}).code, 0);
  const CommandRun run = runCommand({"import", glb, "-o", "-"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("carom: <stdout>: /bodies/", 0), 0u) << run.err;
  EXPECT_NE(run.err.find("after -o"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace carom::test
