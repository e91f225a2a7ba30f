// SPDX-License-Identifier: MIT
// Every number of every example document replaced by numbers and words that it should not be: load, simulate,
// differentiate. Never a crash, an exception of another kind or a NaN; always a status or an error with a sentence.
//
// A run takes a sample; CAROM_TEST_SCALE multiplies it (1000: everything), CAROM_TEST_SEED runs one case, which every
// failure names.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/problem/jacobian.hpp"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"

namespace carom::test {

using namespace editing_detail;

namespace {

using nlohmann::json;

constexpr int kCases = 300;
constexpr std::size_t kStepLimit = 100'000;
constexpr std::size_t kMostNumbers = 400;  // of one document: in larger ones one of several alike is taken
constexpr const char* kInstead[] = {"0",     "-0.0",  "5e-324", "-5e-324", "1e-310", "1e20",  "-1e20", "1e-20",
                                    "1e160", "-1e160", "1e-160", "NaN",     "1e999",  "\"text\"", "null"};
constexpr std::size_t kWays = std::size(kInstead);

struct Place {
  std::string scene;
  json::json_pointer pointer;
};

const std::map<std::string, json>& documents() {
  static const std::map<std::string, json> all = [] {
    std::map<std::string, json> read;
    for (const std::string& name : sceneNames()) read[name] = json::parse(readText(scenePath(name)));
    return read;
  }();
  return all;
}

void collect(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& numbers) {
  if (value.is_number()) numbers.push_back(at);
  if (value.is_object())
    for (const auto& [name, member] : value.items()) collect(member, at / name, numbers);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], at / i, numbers);
}

std::vector<std::vector<Place>> placesOfDocuments() {
  std::vector<std::vector<Place>> places;
  for (const auto& [name, document] : documents()) {
    std::vector<json::json_pointer> numbers;
    collect(document, json::json_pointer(), numbers);
    auto& of = places.emplace_back();
    const std::size_t stride = 1 + numbers.size() / kMostNumbers;
    for (std::size_t i = 0; i < numbers.size(); i += stride) of.push_back({name, numbers[i]});
  }
  return places;
}

class Trial {
 public:
  explicit Trial(std::map<std::string, int>& outcomes) : outcomes_(outcomes) {}

  void run(const Place& place, const std::string& instead) {
    json document = documents().at(place.scene);
    document[place.pointer] = "@instead@";
    std::string text = document.dump();
    const std::string mark = "\"@instead@\"";
    text.replace(text.find(mark), mark.size(), instead);
    try {
      check(text);
    } catch (const InputError& error) {
      EXPECT_GT(std::string(error.what()).size(), 10u);
      ++outcomes_["error"];
    } catch (const NotComputable& error) {
      EXPECT_GT(std::string(error.what()).size(), 10u);
      ++outcomes_["derivative not computable"];
    } catch (const WorkEnded&) {
      ++outcomes_["overlaps beyond the limit"];
    }
  }

 private:
  void check(const std::string& text) {
    const Document document = parseDocument(text, "document", projectFile("examples/scenes"));
    WorkCount work(kStepLimit, {}, nullptr);
    OdeContacts contacts(document.scene, &work);
    SimulateOptions options;
    options.step_limit = kStepLimit;
    const Motion motion = simulate(document.scene, contacts, document.duration, options);
    checkMotion(motion);
    ++outcomes_[nameOf(motion.status)];
    if (document.controls.empty() || document.constraints.empty()) return;
    std::vector<Constraint> exact = document.constraints;
    for (Constraint& constraint : exact) constraint.soft.reset();
    EditProblem problem(document.scene, contacts, document.duration, document.controls, exact);
    problem.step_limit = kStepLimit;
    const Eigen::VectorXd values = problem.controls.startValues();
    const Motion edited = simulateAt(problem, values, problem.horizon);
    const RowValues rows = problem.constraints.evaluate(edited);
    if (!rows.available) {
      EXPECT_FALSE(rows.message.empty());
      return;
    }
    std::vector<Reliability> reliability;
    const Eigen::MatrixXd J = jacobianByAdjoint(problem, values, edited, rows, &reliability);
    ++outcomes_["differentiated"];
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      if (J.row(i).allFinite()) continue;
      const Reliability& r = reliability[static_cast<std::size_t>(i)];
      EXPECT_FALSE(r.reliable) << "row " << i << ": " << J.row(i);
      EXPECT_FALSE(r.message.empty());
    }
  }

  static void checkMotion(const Motion& motion) {
    EXPECT_FALSE(motion.message.empty());
    EXPECT_TRUE(motion.end >= 0 && motion.end <= motion.duration) << motion.end;
    double before = 0;
    for (const Event& event : motion.events) {
      EXPECT_TRUE(event.time >= before && event.time <= motion.end) << event.time;
      before = event.time;
      for (const Contact& c : event.contacts)
        EXPECT_TRUE(c.at.point.allFinite() && c.at.normal.allFinite() && c.impulse.allFinite());
    }
    for (std::size_t b = 0; b < motion.world_lines.size(); ++b)
      for (const double t : {0.0, 0.5 * motion.end, motion.end}) {
        const BodyState s = motion.stateAt(static_cast<int>(b), t);
        EXPECT_TRUE(s.position.allFinite() && s.velocity.allFinite() && s.orientation.coeffs().allFinite() &&
                    s.angular_velocity.allFinite())
            << "body " << b << " at " << t;
      }
  }

  std::map<std::string, int>& outcomes_;
};

TEST(Differential, EveryNumberOfEveryExampleReplaced) {
  const auto places = placesOfDocuments();
  std::size_t all = 0;
  for (const auto& of : places) all += of.size() * kWays;
  const char* scale = std::getenv("CAROM_TEST_SCALE");
  const char* only = std::getenv("CAROM_TEST_SEED");
  const std::size_t cases = std::min(all, static_cast<std::size_t>(kCases * (scale ? std::max(0.01, std::atof(scale)) : 1.0)));
  std::map<std::string, int> outcomes;
  Trial trial(outcomes);
  double slowest = 0;
  std::string slowest_case;
  const auto runCase = [&](std::size_t number) {
    std::size_t way = number % kWays, rest = number / kWays;
    const Place* place = nullptr;
    for (const auto& of : places) {
      if (rest < of.size()) {
        place = &of[rest];
        break;
      }
      rest -= of.size();
    }
    const std::string name = place->scene + place->pointer.to_string() + " = " + kInstead[way];
    SCOPED_TRACE(name + " (CAROM_TEST_SEED=" + std::to_string(number) + ")");
    const auto began = std::chrono::steady_clock::now();
    EXPECT_NO_THROW(trial.run(*place, kInstead[way]));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (seconds > slowest) slowest = seconds, slowest_case = name;
  };
  if (only) return runCase(std::strtoull(only, nullptr, 10) % all);
  if (cases == all)
    for (std::size_t i = 0; i < all; ++i) runCase(i);
  std::uint64_t state = 20240607;
  const auto random = [&](std::size_t n) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(state >> 33) % n;
  };
  // a document first, then a number of it: those with many numbers do not take the whole sample
  for (std::size_t i = 0; cases < all && i < cases; ++i) {
    const std::size_t chosen = random(places.size());
    std::size_t number = random(places[chosen].size());
    for (std::size_t k = 0; k < chosen; ++k) number += places[k].size();
    runCase(number * kWays + random(kWays));
  }
  std::cout << cases << " of " << all << " cases, the slowest " << slowest << " s: " << slowest_case << '\n';
  for (const auto& [what, count] : outcomes) std::cout << "  " << what << ": " << count << '\n';
  EXPECT_GT(outcomes["error"], 0);
  EXPECT_GT(outcomes["complete"], 0);
}

}  // namespace
}  // namespace carom::test
