// SPDX-License-Identifier: MIT
// A miss by no more than the last digits of the controls move it is told as such, and no other.
#include "editing/strategy/last_digits.hpp"

#include <gtest/gtest.h>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace editing_detail;
using namespace testing_scenes;

std::string told(double miss) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const double x = simulate(scene, contacts, 0.2).stateAt("box", 0.2).position.x();
  const Constraint nail{"box", 0.2, {{"position", {x + miss, any, any}}}};
  const EditProblem problem(scene, contacts, 0.6, {velocity("box")}, {nail});
  const EditOptions options;
  EditEvaluator evaluator(problem, options);
  return lastDigits(evaluator, *evaluator.evaluateStart());
}

TEST(LastDigits, AreToldWhereTheyDecide) {
  EXPECT_NE(told(1e-16).find("which have 16 digits: the motion is so sensitive that the last one of them moves it by"), std::string::npos);
  EXPECT_EQ(told(1e-9), "");
  EXPECT_EQ(told(0.1), "");
}

}  // namespace
}  // namespace carom
