// SPDX-License-Identifier: MIT
// The search across impact sequences on several threads. Under ThreadSanitizer by the preset `thread`; the same bits on
// any number of threads are held by tests/editing/sequence_test.cpp.

#include <gtest/gtest.h>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

// A box thrown at a step that it must clear: all samples of the search simulate boxes against boxes.
Scene boxBeforeStep() {
  Scene scene;
  Material felt;
  felt.name = "felt", felt.elasticity = 0.6, felt.friction = 0.3;
  scene.materials = {felt};
  Body floor, step, box;
  floor.name = "floor", floor.fixed = true, floor.material = "felt", floor.shape = Plane{Vec3::UnitZ(), 0};
  step.name = "step", step.fixed = true, step.material = "felt", step.shape = Box{Vec3(0.1, 2, 0.8)};
  step.position = Vec3(1.5, 0, 0.4);
  box.name = "box", box.material = "felt", box.shape = Box{Vec3(0.1, 0.16, 0.07)}, box.mass = 0.4;
  box.position = Vec3(0, 0, 0.6), box.velocity = Vec3(4, 0, 1), box.angular_velocity = Vec3(1, 3, 2);
  scene.bodies = {floor, step, box};
  return scene;
}

TEST(ParallelSearch, GivesWhatOneThreadGives) {
  const Scene scene = boxBeforeStep();
  std::vector<EditResult> results;
  for (const int threads : {1, 4}) {
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 0.9);
    edit.vary(velocity("box"), angularVelocity("box"));
    edit.nail("box", 0.9).position({2.6, any, 0.5});
    EditOptions options;
    options.threads = threads;
    results.push_back(edit.solve(options));
  }
  EXPECT_EQ(results[0].status, EditStatus::solved_sequence_changed) << results[0].message;
  EXPECT_EQ(results[1].status, results[0].status);
  EXPECT_EQ(results[1].objective, results[0].objective);
  EXPECT_EQ(results[1].scene.bodies[2].velocity, results[0].scene.bodies[2].velocity);
  EXPECT_EQ(results[1].scene.bodies[2].angular_velocity, results[0].scene.bodies[2].angular_velocity);
}

}  // namespace
}  // namespace carom
