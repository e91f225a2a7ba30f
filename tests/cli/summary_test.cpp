// SPDX-License-Identifier: MIT
// What simulate prints of many impacts, and how little --quiet prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "cli/impacts.h"
#include "tests/cli/run_command.h"
#include "tests/cli/stacked_boxes.h"

namespace carom::test {
namespace {

using nlohmann::json;

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The rows of the table below a title: the number in the column that `heading` stands above, by the rest before it.
std::map<std::string, long> countsBelow(const std::string& text, const std::string& title) {
  const std::vector<std::string> lines = linesOf(text);
  std::map<std::string, long> counts;
  auto line = std::find_if(lines.begin(), lines.end(), [&](const std::string& l) { return l.starts_with(title); });
  EXPECT_NE(line, lines.end()) << title << " is not in\n" << text;
  if (line == lines.end() || ++line == lines.end()) return counts;
  const std::size_t end = line->find("impacts") + std::string("impacts").size();  // the column stands to the right
  for (++line; line != lines.end() && !line->empty(); ++line) {
    const std::string start = line->substr(0, end);
    const std::size_t number = start.find_last_of(' ') + 1;
    const std::string name = start.substr(2, start.find_last_not_of(' ', number - 1) - 1);
    counts[name] = std::stol(start.substr(number));
  }
  return counts;
}

TEST(Summary, CountsWhatTheEventsSay) {
  const std::string scene = scenePath("pen_500");
  const CommandRun run = runCommand({"simulate", scene});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_LE(linesOf(run.out).size(), 60u);
  std::map<std::string, long> modes, pairs, bodies;
  const json answer = runJson({"simulate", scene});
  for (const json& event : answer["events"]) {
    ++modes[event["mode"]];
    const std::string a = event["bodies"][0], b = event["bodies"][1];
    ++pairs[a + "-" + b];
    for (const std::string& body : {a, b})
      if (body.starts_with("ball")) ++bodies[body];
    ASSERT_FALSE(event.contains("contacts")) << "joint impacts are not counted here";
  }
  EXPECT_EQ(linesOf(run.out)[0], std::to_string(answer["events"].size()) + " impacts in 1 s");
  EXPECT_EQ(countsBelow(run.out, "Impacts by mode"), modes);
  for (const auto& [title, all] : {std::pair{"Pairs with most impacts", pairs}, {"Moving bodies with most", bodies}}) {
    const auto shown = countsBelow(run.out, title);
    EXPECT_EQ(shown.size(), 10u) << title;
    long least = 1000000;
    for (const auto& [name, count] : shown) {
      EXPECT_EQ(all.at(name), count) << name;
      least = std::min(least, count);
    }
    long larger = 0;
    for (const auto& [name, count] : all) larger += count > least;
    EXPECT_LT(larger, 10) << title << ": one of the largest is missing";
  }
}

TEST(Summary, NamesTheFirstAndTheLastImpactAndTheNearestToTheEdge) {
  const std::string scene = scenePath("bowling");
  const std::vector<std::string> few = linesOf(runCommand({"simulate", scene}).out);
  const std::vector<std::string> all = linesOf(runCommand({"simulate", scene, "--impacts"}).out);
  const json events = runJson({"simulate", scene})["events"];
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i]["margin"].get<double>() < events[nearest]["margin"].get<double>()) nearest = i;
  // The rows are those of the whole list, but for the widths of columns.
  const auto words = [](const std::string& line) {
    std::istringstream in(line);
    std::string out;
    for (std::string word; in >> word;) out += word + " ";
    return out;
  };
  const auto heading = std::find_if(few.begin(), few.end(), [](const std::string& line) {
    return line.starts_with("The first impact, ");
  });
  ASSERT_GE(few.end() - heading, 5);
  EXPECT_EQ(words(heading[2]), words(all[2]));
  EXPECT_EQ(words(heading[3]), words(all[2 + nearest]));
  EXPECT_EQ(words(heading[4]), words(all[1 + events.size()]));
}

TEST(Summary, FewImpactsAreListed) {
  const std::string out = runCommand({"simulate", scenePath("dice")}).out;
  EXPECT_EQ(out, runCommand({"simulate", scenePath("dice"), "--impacts"}).out);
  EXPECT_EQ(out.find("by mode"), std::string::npos);
}

TEST(Summary, ImpactsListsAllOfThem) {
  const CommandRun run = runCommand({"simulate", scenePath("pen_500"), "--impacts"});
  EXPECT_EQ(linesOf(run.out).size(), 2 + runJson({"simulate", scenePath("pen_500")})["events"].size() + 1);
  EXPECT_EQ(run.out.find("by mode"), std::string::npos);
}

TEST(Summary, StatesOfManyBodiesAreToldWhenAskedFor) {
  const CommandRun end = runCommand({"simulate", scenePath("pen_500")});
  EXPECT_EQ(end.out.find("State at"), std::string::npos);
  EXPECT_NE(end.out.find("--at 1 prints the state of the 500 moving bodies"), std::string::npos) << end.out;
  const CommandRun asked = runCommand({"simulate", scenePath("pen_500"), "--at", "1"});
  const std::vector<std::string> lines = linesOf(asked.out);
  const auto title = std::find(lines.begin(), lines.end(), "State at 1 s:");
  EXPECT_EQ(lines.end() - title, 502);
}

TEST(Summary, HowAMotionEndsIsSaid) {
  json scene = json::parse(readText(scenePath("pen_500")));
  scene["duration"] = 60;
  addStackedBoxes(scene, 1);
  scene.erase("controls"), scene.erase("constraints");
  const std::string path = writeTemporary("stacked.json", scene.dump());
  const CommandRun run = runCommand({"simulate", path});
  EXPECT_EQ(run.code, 5) << run.err;
  EXPECT_NE(run.out.find("; the motion ends there (unresolved_contact): "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("Impacts by mode"), std::string::npos) << run.out;
}

std::vector<std::string> impacts(int count, const std::string& name) {
  std::vector<std::string> lines;
  for (int i = 0; i < count; ++i) lines.push_back(name + " " + std::to_string(i));
  return lines;
}

std::vector<std::string> sequencesOf(const std::vector<std::string>& before, const std::vector<std::string>& after,
                                     bool all) {
  cli::Interruption interruption;
  cli::Output out(cli::Settings{}, interruption);
  cli::printSequences(out, before, after, all);
  testing::internal::CaptureStdout();
  out.finish();
  return linesOf(testing::internal::GetCapturedStdout());
}

TEST(Sequences, ShortOnesAreListedWhole) {
  const auto before = impacts(50, "a"), after = impacts(49, "b");
  EXPECT_EQ(sequencesOf(before, after, false), sequencesOf(before, after, true));
  EXPECT_EQ(sequencesOf(before, after, false).size(), 2u + 50 + 49);
  EXPECT_EQ(sequencesOf(before, before, false).size(), 1u + 50);
  EXPECT_EQ(sequencesOf({}, {}, false), (std::vector<std::string>{"  impacts, before and after:", "    no impacts"}));
}

TEST(Sequences, LongOnesAreShownWhereTheyPart) {
  auto before = impacts(1000, "a"), after = before;
  EXPECT_EQ(sequencesOf(before, before, false).size(), 1u + 50 + 1);
  after.insert(after.begin() + 700, "new");
  const std::vector<std::string> shown = sequencesOf(before, after, false);
  EXPECT_EQ(shown[0], "  impacts: 1000 before, 1001 after; --impacts lists all");
  EXPECT_EQ(shown[1], "  the first 700 are the same, then before:");
  EXPECT_EQ(shown[2], "    a 700");
  EXPECT_EQ(shown[7], "  and now:");
  EXPECT_EQ(shown[8], "    new");
  EXPECT_EQ(shown.size(), 13u);
  EXPECT_EQ(sequencesOf(before, after, true).size(), 2u + 1000 + 1001);
}

TEST(Sequences, OneMayEndWhereTheyPart) {
  const auto before = impacts(60, "a");
  auto after = before;
  after.resize(58);
  EXPECT_EQ(sequencesOf(before, after, false),
            (std::vector<std::string>{"  impacts: 60 before, 58 after; --impacts lists all",
                                      "  the first 58 are the same, then before:", "    a 58", "    a 59",
                                      "  and now:", "    no more impacts"}));
}

TEST(Sequences, OfACheckAreCutUnlessAllAreAskedFor) {
  const std::string path = scenePath("pen_500");
  const CommandRun few = runCommand({"check", path}), all = runCommand({"check", path, "--impacts"});
  const std::size_t count = runJson({"check", path})["sequence"].size();
  ASSERT_GT(count, 50u);
  EXPECT_NE(few.out.find("    and " + std::to_string(count - 50) + " more; --impacts lists all"), std::string::npos)
      << few.out;
  EXPECT_EQ(linesOf(all.out).size(), linesOf(few.out).size() - 1 + count - 50);
}

TEST(Quiet, PrintsNothingForPeopleButErrors) {
  const std::string scene = scenePath("ball-over-wall"), picture = temporaryPath("quiet.svg");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"simulate", scene}, {"gradient", scene}, {"check", scene}, {"edit", scene},
        {"validate", scene}, {"info", scene}, {"info"}, {"export", scene, "-o", picture}}) {
    std::vector<std::string> quiet = words;
    quiet.push_back("-q");
    const CommandRun run = runCommand(quiet);
    EXPECT_EQ(run.code, 0) << words[0];
    EXPECT_EQ(run.out + run.err, "") << words[0];
  }
  EXPECT_TRUE(std::filesystem::exists(picture));
  EXPECT_EQ(runJson({"validate", scene, "--quiet"})["valid"], true);
  const CommandRun missing = runCommand({"simulate", temporaryPath("missing.json"), "--quiet"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.err.find("no such file"), std::string::npos);
}

TEST(Quiet, LeavesWarningsOut) {
  json scene = json::parse(readText(scenePath("ball-over-wall")));
  addStackedBoxes(scene, 0.5);
  const std::string path = writeTemporary("ends.json", scene.dump());
  EXPECT_NE(runCommand({"simulate", path, "--json"}).err.find("warning"), std::string::npos);
  EXPECT_EQ(runCommand({"simulate", path, "--json", "--quiet"}).err, "");
}

}  // namespace
}  // namespace carom::test
