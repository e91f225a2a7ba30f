// SPDX-License-Identifier: MIT
// A scene parameter has one name: in answers, evaluators, sessions, notes and errors.
#include <gtest/gtest.h>

#include <set>

#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/session.h"
#include "editing/session_numbers.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

TEST(NumberNames, AreTheSameEverywhere) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const std::vector<Control> controls = everyControl();
  Edit edit(scene, contacts, 0.6, controls, {});
  edit.nail("box", 0.5).position(any, any, 0.3);
  std::set<std::string> answer, evaluator, session;
  for (const ChangedNumber& number : edit.solve({.effort = Effort::fast}).changed) answer.insert(number.name);
  const NlpEvaluator program = edit.evaluator();
  for (const NlpVariable& variable : program.variables()) evaluator.insert(variable.name);
  for (const SessionNumber& number : sessionNumbers(scene, controls)) session.insert(number.name);
  EXPECT_EQ(answer, evaluator);
  // a session has the orientation itself, a quaternion; other answers the rotation vector of its change
  EXPECT_EQ(session.erase("orientation.w of 'box'"), 1u);
  EXPECT_EQ(answer, session);
  for (const char* name : {"velocity.x of 'box'", "angular_velocity.z of 'box'", "orientation.y of 'box'", "size.x of 'box'",
                           "mass of 'box'",
                           "inertia.x of 'box'", "gravity.z", "tilt.alpha of 'box' at impact 1"})
    EXPECT_EQ(answer.count(name), 1u) << name;
  EXPECT_EQ(answer.count("elasticity of '" + scene.materials[0].name + "'"), 1u);
}

TEST(NumberNames, OfNotesAndErrorsToo) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit twice(scene, contacts, 0.6, {velocity("box").only({"x"}), velocity("box")}, {});
  try {
    twice.solve();
    ADD_FAILURE() << "the same number twice";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("velocity.x of 'box' varies already in /controls/0"), std::string::npos) << error.what();
  }
  Edit outside(scene, contacts, 0.6, {velocity("box").only({"x"}).within(5, 6)}, {});
  outside.nail("box", 0.5).position(any, any, 0.3);
  const EditResult result = outside.solve({.effort = Effort::fast});
  EXPECT_NE(result.message.find("Velocity.x of 'box' was "), std::string::npos) << result.message;
}

}  // namespace
}  // namespace carom
