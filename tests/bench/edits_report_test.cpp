// SPDX-License-Identifier: MIT
// What edits_bench says of its tasks: its summary, and the answers that it gives to other programs.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "bench/edits/report.h"
#include "bench/edits/serve.h"

namespace carom::bench {
namespace {

Task taskOf(int index, double hidden_objective) {
  Task task;
  task.index = index, task.wanted = wantedOf(index), task.hidden_objective = hidden_objective;
  return task;
}

Outcome outcomeOf(bool met, EditStatus status, double objective, double milliseconds) {
  Outcome o;
  o.met = met, o.status = status, o.objective = objective, o.milliseconds = milliseconds;
  o.claimed = status == EditStatus::solved;
  return o;
}

TEST(Summary, CountsWhatIsMetAndHowSmallTheChangesAre) {
  std::vector<Task> tasks = {taskOf(0, 1), taskOf(1, 1), taskOf(400, 1), taskOf(401, 1)};
  tasks[3].miss = std::numeric_limits<double>::infinity();
  const carom::bench::Run run{
      nullptr,
      {outcomeOf(true, EditStatus::solved, 1, 1), outcomeOf(true, EditStatus::solved, 1.5, 2),
       outcomeOf(true, EditStatus::not_converged, 3, 4), outcomeOf(false, EditStatus::infeasible, 0, 8)}};
  const BestKnown best("");
  const Summary s = summarise(tasks, run, best);
  EXPECT_EQ(s.tasks, 4);
  EXPECT_EQ(s.met, 75);
  EXPECT_EQ(s.lacking, 0);
  EXPECT_EQ(s.infeasible, 1);
  EXPECT_EQ(s.met_not_claimed, 1);
  EXPECT_EQ(s.claimed_not_met, 0);
  EXPECT_EQ(s.median_ms, 2);
  EXPECT_EQ(s.longest_ms, 8);
  EXPECT_EQ(s.worst_ratio, 3);
  EXPECT_EQ(s.median_ratio, 1.5);
  EXPECT_NEAR(s.above_1, 200. / 3, 1e-12);
  EXPECT_NEAR(s.above_2, 100. / 3, 1e-12);
  const Summary none = summarise(tasks, run, best, [](const Task&) { return false; });
  EXPECT_EQ(none.tasks, 0);
  EXPECT_TRUE(std::isnan(none.met));
}

std::vector<nlohmann::json> answersTo(const std::string& requests) {
  std::istringstream in(requests);
  std::ostringstream out;
  BestKnown best("");
  serve(1, in, out, best);
  std::istringstream lines(out.str());
  std::vector<nlohmann::json> answers;
  for (std::string line; std::getline(lines, line);) answers.push_back(nlohmann::json::parse(line));
  return answers;
}

std::string listed(const nlohmann::json& numbers, double factor = 1) {
  std::ostringstream out;
  out.precision(17);
  for (const auto& number : numbers) out << ' ' << factor * number.get<double>();
  return out.str();
}

TEST(Serve, GivesRowsAndTheirDerivatives) {
  for (int index : {0, 300}) {
    const std::string task = "task " + std::to_string(index) + "\n";
    const nlohmann::json facts = answersTo(task)[0];
    const std::string hidden = listed(facts["hidden_changes"]);
    const auto answers = answersTo(task + "judge" + hidden + "\nrows" + hidden + "\n");
    EXPECT_TRUE(answers[1]["met"]) << answers[1];
    EXPECT_NEAR(answers[1]["objective"], facts["hidden"], 1e-12 * facts["hidden"].get<double>());
    const nlohmann::json& at = answers[2];
    ASSERT_TRUE(at["available"]);
    ASSERT_EQ(at["rows"].size(), facts["row_lower"].size());
    ASSERT_EQ(at["jacobian"][0].size(), facts["numbers"]);
    // along the first change, by differences
    constexpr double kStep = 1e-6;
    nlohmann::json ahead = facts["hidden_changes"], behind = ahead;
    ahead[0] = ahead[0].get<double>() + kStep, behind[0] = behind[0].get<double>() - kStep;
    const auto sides = answersTo(task + "rows" + listed(ahead) + "\nrows" + listed(behind) + "\n");
    for (std::size_t i = 0; i < at["rows"].size(); ++i) {
      EXPECT_NEAR(at["rows"][i], facts["row_lower"][i], 1e-9);
      const double rate = (sides[1]["rows"][i].get<double>() - sides[2]["rows"][i].get<double>()) / (2 * kStep);
      const double exact = at["jacobian"][i][0];
      EXPECT_TRUE(std::abs(rate - exact) <= 1e-5 * (1 + std::abs(exact))) << rate << " " << exact;
    }
  }
}

TEST(Serve, SaysWhenAMotionLacksARow) {
  int lacking = kThrownTasks;
  while (wantedOf(lacking).family != Family::hit) ++lacking;
  const std::string task = "task " + std::to_string(lacking) + "\n";
  const nlohmann::json facts = answersTo(task)[0];
  const auto answers = answersTo(task + "rows" + listed(facts["hidden_changes"], 0) + "\njudge" +
                                 listed(facts["hidden_changes"], 0) + "\n");
  EXPECT_FALSE(answers[1]["available"]);
  EXPECT_FALSE(answers[2]["met"]);
  EXPECT_TRUE(answers[2]["residual"].is_null());
}

TEST(Serve, RefusesWhatItDoesNotUnderstand) {
  for (const char* requests : {"rows 1 2 3\n", "task\n", "task 0\nrows 1\n", "task 0\noffer\n", "hello\n"})
    EXPECT_THROW(answersTo(requests), std::runtime_error) << requests;
  EXPECT_THROW(answersTo("task 100000\n"), std::out_of_range);
}

}  // namespace
}  // namespace carom::bench
