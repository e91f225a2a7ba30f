// SPDX-License-Identifier: MIT
// Edits that end before they are done: by time, by work, by whoever watches.

#include "editing/edit.h"

#include <gtest/gtest.h>

#include <stop_token>

#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

TEST(Edit, OutOfTimeReturnsTheBest) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", 0.9).position({1, 1, 0.4});
  EditOptions options;
  options.time_budget_seconds = 0;
  const EditResult r = edit.solve(options);
  EXPECT_EQ(r.status, EditStatus::out_of_time) << r.message;
  expectHonest(r, 0.9, contacts);
}

TEST(Edit, TheCallbackSeesProgressAndCancels) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", 0.9).position({1.4, 0.4, 0.4});
  int calls = 0;
  EditOptions options;
  options.progress = [&](const EditProgress& progress) {
    EXPECT_EQ(progress.iteration, ++calls);
    return false;
  };
  const EditResult r = edit.solve(options);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(r.status == EditStatus::cancelled || r.solved()) << r.message;
}

TEST(Edit, AStopKeepsTheBestSoFar) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", 0.9).position({1.4, 0.4, 0.4});
  EditOptions options;
  std::stop_source at_once;
  at_once.request_stop();
  options.stop = at_once.get_token();
  const EditResult none = edit.solve(options);
  EXPECT_EQ(none.status, EditStatus::cancelled);
  EXPECT_EQ(none.objective, 0);
  EXPECT_NE(none.message.find("cancelled"), std::string::npos) << none.message;
  const double start = none.scaled_residual;
  double before = start;
  for (const int after : {1, 2, 4}) {
    std::stop_source source;
    options.stop = source.get_token();
    options.progress = [&](const EditProgress& progress) {
      if (progress.iteration == after) source.request_stop();
      return true;
    };
    const EditResult r = edit.solve(options);
    EXPECT_TRUE(r.status == EditStatus::cancelled || r.solved()) << r.message;
    EXPECT_LE(r.iterations, after + 1);
    EXPECT_EQ(r.motion.status, MotionStatus::complete) << "the best is simulated to its end";
    EXPECT_LE(r.scaled_residual, before);
    before = r.scaled_residual;
  }
  EXPECT_LT(before, start);
}

TEST(Edit, AStepLimitThatTheStartDoesNotKeepIsABadStart) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"));
  edit.nail("box", 0.9).position({1.4, 0.4, 0.4});
  EditOptions options;
  options.step_limit = 1;
  const EditResult r = edit.solve(options);
  EXPECT_EQ(r.status, EditStatus::bad_start);
  EXPECT_NE(r.message.find("after 1 steps, the limit"), std::string::npos) << r.message;
}

}  // namespace
}  // namespace carom
