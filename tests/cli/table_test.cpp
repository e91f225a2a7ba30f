// SPDX-License-Identifier: MIT
// Tables for people: columns stay in line whatever the script of the names, and colours do not count.
#include <gtest/gtest.h>

#include "cli/table.h"
#include "cli/terminal.h"
#include "cli/units.h"
#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using cli::displayWidth, cli::fitted, cli::printable, cli::Table, cli::unitOf;

TEST(DisplayWidth, IsThatOfTheTerminal) {
  EXPECT_EQ(displayWidth(""), 0u);
  EXPECT_EQ(displayWidth("ball"), 4u);
  EXPECT_EQ(displayWidth("Bälle"), 5u);
  EXPECT_EQ(displayWidth("мяч"), 3u);
  EXPECT_EQ(displayWidth("ボール"), 6u);     // two columns each
  EXPECT_EQ(displayWidth("e\u0301"), 1u);    // an accent of its own stands on the letter before
  EXPECT_EQ(displayWidth("\xff\xfe"), 2u);   // no characters: the terminal shows one sign for each byte
  EXPECT_EQ(displayWidth("a\xe3\x83"), 3u);  // a character that is cut off
}

TEST(DisplayWidth, TextsAreCutBetweenCharacters) {
  EXPECT_EQ(fitted("ball", 10), "ball");
  EXPECT_EQ(fitted("ball", 2), "ba");
  EXPECT_EQ(fitted("ボール", 5), "ボー");
  EXPECT_EQ(fitted("ボール", 0), "");
}

TEST(Printable, NothingMovesTheCursor) {
  EXPECT_EQ(printable("a\033[2Jb\nc\td\x7f"), "a [2Jb c d ");
  EXPECT_EQ(printable("a\u009b2Jb"), "a 2Jb");
  EXPECT_EQ(printable("Bälle ボール"), "Bälle ボール");
}

TEST(Table, ColumnsAreInLine) {
  Table table({"body", ">mass [kg]", "notes"});
  for (const char* name : {"ball", "ボール", "мяч", "e\u0301toile", "a\033[31mred"}) table.row({name, "1.5", "x"});
  table.row({"heavy", "12345678901", ""});
  const std::string text = table.text(false);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.ends_with("x")) continue;
    EXPECT_EQ(displayWidth(line), 2 + 9 + 2 + 11 + 2 + 1u) << line;  // "a [31mred", printable, is the widest name
  }
  EXPECT_EQ(text.find('\033'), std::string::npos);
}

TEST(Table, ColoursAreOnlyAddedToTheHeading) {
  Table table({"body", ">mass [kg]"});
  table.row({"ball", "1"});
  std::string text = table.text(true);
  EXPECT_EQ(text.substr(0, 4), "\033[1m");
  text.erase(0, 4);
  text.erase(text.find("\033[0m"), 4);
  EXPECT_EQ(text, table.text(false));
}

TEST(Table, WideNamesOfADocument) {
  nlohmann::json scene = nlohmann::json::parse(readText(scenePath("two-balls")));
  scene["bodies"][0]["name"] = "ボール";
  scene["bodies"][1]["name"] = "Kugel";
  scene.erase("controls"), scene.erase("constraints");
  const CommandRun run = runCommand({"simulate", writeTemporary("wide.json", scene.dump())});
  EXPECT_EQ(run.code, 0) << run.err;
  std::vector<std::size_t> starts;  // of the second column
  std::istringstream lines(run.out.substr(run.out.find("State at")));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t gap = line.find("  ", 2);
    if (!line.starts_with("  ") || gap == std::string::npos) continue;
    starts.push_back(displayWidth(line.substr(0, line.find_first_not_of(' ', gap))));
  }
  ASSERT_EQ(starts.size(), 3u) << run.out;
  EXPECT_EQ(starts[0], starts[1]);
  EXPECT_EQ(starts[0], starts[2]);
}

TEST(Units, AreThoseOfTheDocumentation) {
  EXPECT_EQ(unitOf("velocity.x of 'hat'"), "m/s");
  EXPECT_EQ(unitOf("angular_velocity.z of 'hat'"), "rad/s");
  EXPECT_EQ(unitOf("position.y of 'hat' at 1 s"), "m");
  EXPECT_EQ(unitOf("orientation.x of 'hat'"), "rad");
  EXPECT_EQ(unitOf("gravity.z"), "m/s^2");
  EXPECT_EQ(unitOf("speed of 'hat' at 1 s"), "m/s");
  EXPECT_EQ(unitOf("kinetic_energy of 'hat' at 1 s"), "J");
  EXPECT_EQ(unitOf("impulse of 'hat' at its impact 1"), "N s");
  EXPECT_EQ(unitOf("height of 'hat' at 1 s"), "m");
  EXPECT_EQ(unitOf("mass of 'hat'"), "kg");
  EXPECT_EQ(unitOf("inertia.x of 'hat'"), "kg m^2");
  EXPECT_EQ(unitOf("size.radius of 'ball'"), "m");
  EXPECT_EQ(unitOf("size.2.1.scale of 'cup'"), "");
  EXPECT_EQ(unitOf("size.scale of 'cup'"), "");
  EXPECT_EQ(unitOf("elasticity of 'rubber'"), "");
  EXPECT_EQ(unitOf("tilt.alpha of 'hat' at impact 1"), "");
  EXPECT_EQ(unitOf("time of 'hat' at its impact 1"), "s");
  EXPECT_EQ(unitOf("inside.+x of 'hat'"), "m");
}

}  // namespace
}  // namespace carom::test
