// SPDX-License-Identifier: MIT
// Points of one evaluator in several threads: the same bits as in one. Under ThreadSanitizer by the preset `thread`.

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/stopping_contacts.h"

namespace carom {
namespace {

Scene boxAboveFloor() {
  Scene scene;
  Material felt;
  felt.name = "felt", felt.elasticity = 0.6, felt.friction = 0.3;
  scene.materials = {felt};
  Body floor, box;
  floor.name = "floor", floor.fixed = true, floor.material = "felt", floor.shape = Plane{Vec3::UnitZ(), 0};
  box.name = "box", box.material = "felt", box.shape = Box{Vec3(0.1, 0.16, 0.07)}, box.mass = 0.4;
  box.position = Vec3(0, 0, 0.6), box.velocity = Vec3(4, 0, 1), box.angular_velocity = Vec3(1, 3, 2);
  scene.bodies = {floor, box};
  return scene;
}

/// Of which there is no second one: how many use it at a time is watched.
class LoneContacts : public testing_sessions::StoppingContacts {
 public:
  using StoppingContacts::StoppingContacts;
  std::unique_ptr<ContactSource> another() const override { return nullptr; }
};

struct Derived {
  Eigen::VectorXd values, gradient;
  Eigen::MatrixXd jacobian, hessian;
};

Derived readAll(const NlpPoint& point) {
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(point.values().size());
  return {point.values(), point.gradient().entries, point.jacobian().entries, point.hessian(1, weights)};
}

TEST(NlpEvaluatorThreads, GiveTheBitsOfOneThread) {
  const Scene scene = boxAboveFloor();
  OdeContacts shareable(scene);
  testing_sessions::StopAfter none;
  LoneContacts lone(shareable, none);
  for (ContactSource* contacts : {static_cast<ContactSource*>(&shareable), static_cast<ContactSource*>(&lone)}) {
    Edit edit(scene, *contacts, 0.5);
    edit.vary(velocity("box"), angularVelocity("box"));
    edit.nail("box", 0.5).position({1.5, any, 0.5});
    const NlpEvaluator program = edit.evaluator();
    const NlpPoint shared = program.at(program.start());
    constexpr int kPoints = 6;
    std::vector<Derived> alone(kPoints), together(kPoints), of_shared(kPoints);
    const auto at = [&](int i) -> Eigen::VectorXd {
      return program.start() + 1e-3 * i * Eigen::VectorXd::Ones(program.start().size());
    };
    for (int i = 0; i < kPoints; ++i) alone[static_cast<std::size_t>(i)] = readAll(program.at(at(i)));
    std::atomic<int> next = 0;
    {
      std::vector<std::jthread> threads;
      for (int t = 0; t < 3; ++t)
        threads.emplace_back([&] {
          for (int i; (i = next++) < kPoints;) {
            together[static_cast<std::size_t>(i)] = readAll(program.at(at(i)));
            of_shared[static_cast<std::size_t>(i)] = readAll(shared);
          }
        });
    }
    for (std::size_t i = 0; i < kPoints; ++i) {
      EXPECT_EQ(together[i].values, alone[i].values);
      EXPECT_EQ(together[i].gradient, alone[i].gradient);
      EXPECT_EQ(together[i].jacobian, alone[i].jacobian);
      EXPECT_EQ(together[i].hessian, alone[i].hessian);
      EXPECT_EQ(of_shared[i].jacobian, alone[0].jacobian);
      EXPECT_EQ(of_shared[i].hessian, alone[0].hessian);
    }
  }
}

}  // namespace
}  // namespace carom
