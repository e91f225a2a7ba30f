// SPDX-License-Identifier: MIT
// Edits that cannot be: each ends with a status and a sentence, and nothing is lost.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem_of.hpp"
#include "editing/solve/bounded_least_squares.hpp"
#include "editing/solve/edit_evaluator.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

std::string allOf(const WhyNot& why) {
  std::string text;
  for (const std::string& sentence : why.sentences) text += sentence + "\n";
  return text;
}

/// Not solved, with sentences; what is returned is a motion of the scene that is returned, within the bounds.
void expectNothingLost(const EditResult& r, double duration, ContactSource& contacts) {
  EXPECT_FALSE(r.solved());
  EXPECT_FALSE(r.message.empty());
  EXPECT_EQ(r.message.back(), '.') << r.message;
  const Motion again = simulate(r.scene, contacts, duration);
  EXPECT_EQ(again.signature(), r.motion.signature());
  EXPECT_EQ(r.motion.end, duration);
  for (const ChangedNumber& number : r.changed) EXPECT_TRUE(std::isfinite(number.after)) << number.name;
  EXPECT_TRUE(r.certificate.taken);
  EXPECT_TRUE(r.certificate.deepest_penetration.value_or(1) <= 1e-9);
}

bool helps(const WhyNot& why, const std::string& name, bool solves) {
  for (const WhyNot::Help& help : why.would_help)
    if (help.name == name) return help.solves == solves;
  return false;
}

TEST(BadEdits, ContradictoryNails) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.1).position({any, 0.2, any});
  edit.nail("ball", 0.5).position({0.5, any, 1});
  edit.nail("ball", 0.5).position({0.7, any, any});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::infeasible) << r.message;
  expectNothingLost(r, 0.6, contacts);
  ASSERT_EQ(r.why_not.conflicts.size(), 1u) << allOf(r.why_not);
  EXPECT_EQ(r.why_not.conflicts[0].rows, (std::vector<int>{1, 3})) << allOf(r.why_not);
  EXPECT_NE(allOf(r.why_not).find("cannot be met together"), std::string::npos);
  for (const WhyNot::Help& help : r.why_not.would_help) EXPECT_FALSE(help.solves) << help.name;
}

// Where nails contradict each other steps lead to any spin, and a motion of any spin costs any time and memory.
TEST(BadEdits, PointsTooFarAwayAreNotSimulated) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.6, {angularVelocity("ball")},
                            {Constraint{"ball", 0.5, {Target{"position", {0.5, 0, 1}}}}});
  EditOptions options;
  EditEvaluator evaluator(problem, options);
  ASSERT_TRUE(evaluator.evaluateStart());
  EXPECT_TRUE(evaluator.evaluate(Vec3(0, 0, 900)));
  EXPECT_FALSE(evaluator.evaluate(Vec3(0, 0, 1e12)));
}

TEST(BadEdits, MoreConstrainedThanCanVary) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x"}));
  edit.nail("ball", 0.6).position({-1.2, any, 1.4});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::not_converged) << r.message;
  expectNothingLost(r, 0.6, contacts);
  const WhyNot& why = r.why_not;
  ASSERT_FALSE(why.conflicts.empty());
  EXPECT_EQ(why.rows, 2);
  EXPECT_EQ(why.rank, 1);
  EXPECT_EQ(why.extended_rank, 2);
  // the number that is locked, first of all
  EXPECT_TRUE(helps(why, "velocity.y,z of 'ball'", true)) << allOf(why);
  EXPECT_NE(r.message.find("can be solved when"), std::string::npos) << r.message;
  for (const WhyNot::Help& help : why.would_help) EXPECT_TRUE(help.restores_rank) << help.name;
  // and it is true
  Edit mended(scene, contacts, 0.6);
  mended.vary(velocity("ball").only({"x"}), why.would_help[0].control);
  mended.nail("ball", 0.6).position({-1.2, any, 1.4});
  EXPECT_TRUE(mended.solve().solved()) << why.would_help[0].name;
}

TEST(BadEdits, NothingVaries) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.nail("ball", 0.6).position({-1.2, any, any});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::infeasible);
  expectNothingLost(r, 0.6, contacts);
  ASSERT_EQ(r.why_not.conflicts.size(), 1u);
  EXPECT_NE(allOf(r.why_not).find("To first order no change of the controls meets"), std::string::npos);
  EXPECT_TRUE(helps(r.why_not, "velocity of 'ball'", true)) << allOf(r.why_not);
}

TEST(BadEdits, BoundsInTheWay) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x", "z"}).within(-6, 6));
  edit.nail("ball", 0.6).position({-2, any, 1.5});
  EditOptions options;
  options.sequence = SequencePolicy::stay;
  const EditResult r = edit.solve(options);
  EXPECT_EQ(r.status, EditStatus::not_converged) << r.message;
  expectNothingLost(r, 0.6, contacts);
  ASSERT_FALSE(r.why_not.at_bounds.empty());
  const WhyNot::AtBound& at = r.why_not.at_bounds[0];
  EXPECT_EQ(at.name, "velocity.x of 'ball'");
  EXPECT_TRUE(at.upper);
  EXPECT_EQ(at.bound, 6);
  EXPECT_GT(at.removes, 0.9);
  EXPECT_NEAR(at.change, 4.195652173913, 0.05);  // the closed form needs 10.19...
  EXPECT_NE(allOf(r.why_not).find("Active bounds that hold it back: velocity.x of 'ball'"), std::string::npos) << allOf(r.why_not);
}

TEST(BadEdits, BoundsThatExcludeTheStart) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x"}).within(20, 21));
  edit.nail("ball", 0.2).position({0, any, any});
  const EditResult r = edit.solve();
  expectNothingLost(r, 0.6, contacts);
  EXPECT_NE(r.message.find("outside its bounds, and starts at 20"), std::string::npos) << r.message;
  EXPECT_GE(r.changed[0].after, 20);
  ASSERT_FALSE(r.why_not.at_bounds.empty()) << r.message;
  EXPECT_FALSE(r.why_not.at_bounds[0].upper);
}

TEST(BadEdits, ANailInsideAWall) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.2).position({1.9, any, 0.5});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::infeasible) << r.message;
  expectNothingLost(r, 0.6, contacts);
  ASSERT_EQ(r.why_not.inside.size(), 1u) << r.message;
  EXPECT_EQ(r.why_not.inside[0].solid, "wall");
  EXPECT_EQ(r.message.find("The nail of 'ball' at 0.2 s lies inside 'wall'"), 0u) << r.message;
}

TEST(BadEdits, APoseThatCutsIntoTheFloor) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  for (const double height : {0.12, 0.16}) {  // upright the box is 0.15 above its centre
    Edit edit(scene, contacts, 0.6);
    edit.vary(velocity("box"), angularVelocity("box"), position("box"), orientation("box"));
    edit.nail("box", 0.2).position({0.3, 0, height}).orientation(Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY())));
    const EditResult r = edit.solve();
    EXPECT_EQ(r.why_not.inside.empty(), height > 0.15) << r.message;
    if (height < 0.15) {
      EXPECT_EQ(r.status, EditStatus::infeasible) << r.message;
      expectNothingLost(r, 0.6, contacts);
    }
  }
}

TEST(BadEdits, AnImpactThatVanishesUnderWay) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  // the second impact, off the wall, can come so late only when it does not come within the duration
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x"}));
  edit.nail("ball", nthImpact(1, "wall")).time(0.7);
  const EditResult r = edit.solve();
  expectNothingLost(r, 0.6, contacts);
  EXPECT_NE(allOf(r.why_not).find("does not come within 0.6 s"), std::string::npos) << r.message << allOf(r.why_not);
}

TEST(BadEdits, AConstraintAfterTheEnd) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.7).position({0, 0, 1});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::bad_start);
  EXPECT_NE(r.message.find("after the end"), std::string::npos) << r.message;
  expectNothingLost(r, 0.6, contacts);
  EXPECT_TRUE(r.why_not.sentences.empty());
}

TEST(BadEdits, TargetsThatAreNoNumbers) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  const auto sentence = [&](const std::function<void(Edit&)>& nail) {
    Edit edit(scene, contacts, 0.6);
    edit.vary(velocity("ball"));
    nail(edit);
    try {
      edit.solve();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(sentence([](Edit& e) {
              e.nail("ball", 0.5).position({any, any, any});
            }).find("expected at least one"),
            std::string::npos);
  EXPECT_NE(sentence([](Edit& e) {
              e.nail("ball", 0.5).position({kNaN, 0, any});
            }).find("found NaN, expected a number, or `any`"),
            std::string::npos);
  EXPECT_NE(sentence([](Edit& e) {
              e.nail("ball", kNaN).position({1, 0, 0});
            }).find("expected a time"),
            std::string::npos);
  EXPECT_NE(sentence([](Edit& e) { e.nail("ball", nthImpact(1)).time(kNaN); }).find("NaN"), std::string::npos);
  EXPECT_NE(sentence([](Edit& e) { e.nail("ball", 0.5).orientation(Quat(kNaN, 0, 0, 0)); }).find("NaN"),
            std::string::npos);
  EXPECT_NE(sentence([](Edit& e) {
              e.nail("ball", 0.5).position({INFINITY, 0, 0});
            }).find("infinite"),
            std::string::npos);
}

TEST(BadEdits, OptionsThatMakeNoSense) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.5).position({1, any, any});
  const std::pair<const char*, std::function<void(EditOptions&)>> wrong[] = {
      {"/options/max_iterations: found -1", [](EditOptions& o) { o.max_iterations = -1; }},
      {"/options/time_budget_seconds: found nan", [](EditOptions& o) { o.time_budget_seconds = kNaN; }},
      {"/options/time_budget_seconds: found -2", [](EditOptions& o) { o.time_budget_seconds = -2; }},
      {"/options/tolerance: found 0", [](EditOptions& o) { o.tolerance = 0; }},
      {"/options/tolerance: found nan", [](EditOptions& o) { o.tolerance = kNaN; }},
      {"/options/tolerance: found inf", [](EditOptions& o) { o.tolerance = INFINITY; }},
      {"/options/alternatives: found 0", [](EditOptions& o) { o.alternatives = 0; }},
      {"/options/seed: found -1", [](EditOptions& o) { o.seed = -1; }},
      {"/options/seed: found 1001", [](EditOptions& o) { o.seed = 1001; }},
      {"/options/threads: found -1", [](EditOptions& o) { o.threads = -1; }},
  };
  for (const auto& [sentence, spoil] : wrong) {
    EditOptions options;
    spoil(options);
    try {
      edit.solve(options);
      ADD_FAILURE() << sentence;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(sentence)) << error.what();
    }
  }
  const EditProblem problem = problemOf(edit);
  EXPECT_THROW(problem.controls.sceneAt(Eigen::VectorXd::Zero(2)), InputError) << "of three";
  EXPECT_THROW(problem.controls.sceneAt(Eigen::VectorXd::Constant(3, kNaN)), InputError);
  EXPECT_THROW(problem.controls.valuesOf(Eigen::VectorXd::Zero(4)), InputError);
  EXPECT_THROW(problem.controls.describeVariable(3), InputError);
  EXPECT_THROW(evaluateByAdjoint(problem, Eigen::VectorXd::Zero(2)), InputError);
}

TEST(BadEdits, ExplanationsCanBeLeftOut) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(elasticity("rubber"));
  edit.nail("ball", 0.1).position({any, any, 3});
  EditOptions options;
  options.explain = false;
  EXPECT_TRUE(edit.solve(options).why_not.sentences.empty());
  const EditResult a = edit.solve(), b = edit.solve();
  EXPECT_FALSE(a.why_not.sentences.empty());
  EXPECT_EQ(a.why_not.sentences, b.why_not.sentences);
}

TEST(BoundedLeastSquares, MeetsTheOptimalityConditions) {
  for (int seed = 0; seed < 200; ++seed) {
    std::srand(static_cast<unsigned>(seed));
    const Eigen::Index m = 1 + seed % 7, n = 1 + seed % 9;
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(m, n);
    const Eigen::VectorXd b = 3 * Eigen::VectorXd::Random(m), lower = Eigen::VectorXd::Random(n).array() - 1,
                          upper = Eigen::VectorXd::Random(n).array() + 1;
    const Eigen::VectorXd x = boundedLeastSquares(A, b, lower, upper), slope = A.transpose() * (A * x + b);
    for (Eigen::Index j = 0; j < n; ++j) {
      ASSERT_TRUE(x[j] >= lower[j] && x[j] <= upper[j]) << seed;
      const bool low = x[j] == lower[j], high = x[j] == upper[j];
      EXPECT_TRUE(low    ? slope[j] >= -1e-9
                  : high ? slope[j] <= 1e-9
                         : std::abs(slope[j]) <= 1e-9)
          << "seed " << seed << ", " << j << ": " << slope[j];
    }
  }
}

}  // namespace
}  // namespace carom
