// SPDX-License-Identifier: MIT
#include "tests/support/lasting_scenes.h"

#include <cmath>

#include "ode_bridge/ode_contacts.h"

namespace carom::test {
namespace {

const Vec3 kDown(0, 0, -9.81);
constexpr double kLowest = 1e-12;

Body floorAt(double height = 0) { return makePlane("floor", Vec3::UnitZ(), height); }
Body ballAt(const Vec3& position, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  Body ball = makeBall("ball", 0.1, position, velocity);
  ball.angular_velocity = spin;
  return ball;
}
Body on(Body body, const Vec3& axis) {
  body.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), axis);
  return body;
}
Body cylinderAt(const Vec3& position, const Vec3& velocity, const Vec3& spin) {
  Body cylinder = makeBall("cylinder", 0.1, position, velocity);
  cylinder.shape = Cylinder{0.1, 0.3};
  cylinder.angular_velocity = spin;
  return on(cylinder, Vec3::UnitY());
}

Scene bouncesToRoll() { return makeScene(kDown, 0.1, 0.03, {ballAt({0, 0, 0.3}, {2, 0.5, 0}, {3, 1, 2}), floorAt()}); }
Scene bouncesToRest() { return makeScene(kDown, 0.1, 0.5, {ballAt({0, 0, 0.3}, {0, 0, 0}), floorAt()}); }
Scene bouncesOnSlope() {
  return makeScene(downSlope(20), 0.1, 0.05, {ballAt({0, 0, 0.2}, {0.1, 0.7, 0}, {1, 2, 3}), floorAt()});
}
Scene slidesStraight() { return makeScene(kDown, 0.5, 0.3, {ballAt({0, 0, 0.1}, {2, 0, 0}, {0, -40, 7}), floorAt()}); }
Scene slidesRoundABend() { return makeScene(downSlope(10), 0.5, 0.1, {ballAt({0, 0, 0.1}, {0, 2, 0}), floorAt()}); }
Scene floorFirst() { return makeScene(downSlope(10), 0.5, 0.1, {floorAt(), ballAt({0, 0, 0.1}, {0, 2, 0}, {5, 3, 1})}); }
Scene rolls() { return makeScene(downSlope(15), 0.5, 0.4, {ballAt({0, 0, 0.1}, {0.5, 0, 0}, {0, 5, 2}), floorAt()}); }
Scene rollsOffATable() {
  return makeScene(kDown, 0, 0.2,
                   {ballAt({0.3, 0.1, 0.1}, {2, 0.2, 0}), fixedBody(makeBox("table", {2, 2, 0.5}, {0, 0, -0.25})),
                    floorAt(-0.5)});
}
// Past the middle, so that the border is met aslant.
Scene rollsOffARoundTable() {
  Scene scene = rollsOffATable();
  scene.bodies[1].shape = Cylinder{1.1, 0.5};
  scene.bodies[1].position = {0.1, -0.3, -0.25};
  return scene;
}
Scene landsOnATable() {
  Scene scene = rollsOffATable();
  scene.bodies[0].position.z() += 0.1;
  scene.bodies[0].angular_velocity = {1, 2, 3};
  return scene;
}
Scene landsAndBends() {
  return makeScene(downSlope(10), 0, 0.1, {ballAt({0, 0, 0.15}, {0, 2, 0}, {5, 3, 1}), floorAt()});
}
Scene landsAndRolls() { return makeScene(downSlope(15), 0, 0.6, {ballAt({0, 0, 0.3}, {0.5, 0.1, 0}, {0, 5, 2}), floorAt()}); }
Scene blockSlides() { return makeScene(kDown, 0.5, 0.3, {makeBox("block", {.4, .3, .2}, {0, 0, .1}, {1, 0, 0}), floorAt()}); }
Scene blockRoundABend() {
  return makeScene(downSlope(20), 0.5, 0.5, {makeBox("block", {.4, .3, .2}, {0, 0, .1}, {0, 2, 0}), floorAt()});
}
Scene blockStarts() { return makeScene(downSlope(30), 0.5, 0.3, {makeBox("block", {.4, .3, .2}, {0, 0, .1}), floorAt()}); }
Scene cylinderRolls() {
  return makeScene(downSlope(15), 0.5, 0.4, {cylinderAt({0, 0, 0.1}, {0.5, 0, 0}, {0, 5, 0}), floorAt()});
}
Scene wakes() {
  Body cue = makeBall("cue", 0.1, {-0.6, 0.05, 0.1}, {2, 0, 0});
  cue.angular_velocity = {0, 20, 0};
  return makeScene(kDown, 0.7, 0.2, {ballAt({0, 0, 0.1}, {0, 0, 0}), cue, floorAt()});
}

}  // namespace

Vec3 downSlope(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180;
  return 9.81 * Vec3(std::sin(angle), 0, -std::cos(angle));
}

Motion playLasting(const Scene& scene, double duration, const std::vector<Asked>& asked) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.asked = asked;
  options.lowest_bounce = kLowest;
  options.groups = false;  // what would move on others ends the motion: a test of rest sees it
  return simulate(scene, contacts, duration, options);
}

std::vector<DotProductScene> lastingScenes() {
  const auto row = [](const char* name, Scene (*scene)(), double duration, std::vector<Asked> asked = {}) {
    return DotProductScene{name, scene, 1000, {}, std::move(asked), kLowest, duration};
  };
  // Bounces lower than a hundredth of a micrometre have too few digits left for second derivatives to rounding.
  const auto bounces = [&](const char* name, Scene (*scene)(), double duration) {
    DotProductScene made = row(name, scene, duration);
    made.lowest_bounce = 1e-8;
    return made;
  };
  return {
      bounces("lasting_bounces_to_slide", bouncesToRoll, 1),
      bounces("lasting_bounces_to_roll", bouncesToRoll, 3),
      bounces("lasting_bounces_to_rest", bouncesToRest, 1),
      bounces("lasting_bounces_on_slope", bouncesOnSlope, 1.5),
      row("lasting_slides", slidesStraight, 0.5),
      row("lasting_slides_to_roll", slidesStraight, 2),
      row("lasting_slides_round_a_bend", slidesRoundABend, 0.6),
      row("lasting_bend_to_roll", slidesRoundABend, 2),
      row("lasting_no_orientation", slidesRoundABend, 2, {{false, false}, {}}),
      row("lasting_floor_first", floorFirst, 2),
      row("lasting_rolls", rolls, 1),
      row("lasting_rolls_off_a_table", rollsOffATable, 0.75),
      row("lasting_rolls_off_and_lands", rollsOffATable, 1.2),
      row("lasting_rolls_off_a_round_table", rollsOffARoundTable, 0.75),
      row("lasting_rolls_off_a_round_table_and_lands", rollsOffARoundTable, 1.2),
      row("lasting_lands_and_leaves_a_table", landsOnATable, 0.9),
      row("lasting_lands_twice", landsOnATable, 1.4),
      row("lasting_lands_and_bends", landsAndBends, 0.5),
      row("lasting_lands_and_bends_to_roll", landsAndBends, 2),
      row("lasting_lands_and_rolls", landsAndRolls, 1),
      row("lasting_block_slides", blockSlides, 0.25),
      row("lasting_block_stops", blockSlides, 1),
      row("lasting_block_round_a_bend", blockRoundABend, 0.7),
      row("lasting_block_stops_on_slope", blockRoundABend, 1.5),
      row("lasting_block_starts", blockStarts, 1),
      row("lasting_cylinder_rolls", cylinderRolls, 1),
      row("lasting_wakes", wakes, 0.8),
  };
}

}  // namespace carom::test
