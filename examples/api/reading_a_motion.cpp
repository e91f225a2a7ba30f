// SPDX-License-Identifier: MIT
// A box and a ball fall onto a floor: how the bodies are computed, where their paths are, what happens at an impact.
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  Body floor, box, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  box.name = "box", box.shape = Box{{0.2, 0.3, 0.4}}, box.mass = 1, box.position = {0, 0, 0.6};
  box.angular_velocity = {3, 1, 0.5};
  ball.name = "ball", ball.shape = Sphere{0.1}, ball.mass = 0.5, ball.position = {1, 0, 0.5};
  scene.bodies = {floor, box, ball};

  SimulateOptions options;
  options.impact_limit = 3;
  options.step_limit = 1'000'000;
  std::size_t reports = 0;
  options.progress = [&](const SimulateProgress&) { ++reports; };  // of a longer motion, for a progress bar
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1, options);

  std::printf("%s: %s\n", nameOf(motion.status), motion.message.c_str());
  for (const StartOverlap& overlap : motion.overlaps) std::printf("overlap of %d and %d\n", overlap.a, overlap.b);
  if (motion.status == MotionStatus::not_computable) return 1;
  const Plan& plan = motion.plan;
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const BodyPlan& how = plan.bodies[i];
    std::printf("%-5s rotates by tier %s: %s\n", scene.bodies[i].name.c_str(), nameOf(how.tier), how.why);
  }

  const WorldLine& line = motion.world_lines[1];  // of the box
  for (const Arc& arc : line.arcs) {
    const State& state = arc.startState();
    const Kinematics now = arc.kinematicsAt(arc.start());
    std::printf("from %.6f s on at z = %.6f m, %.6f rad/s\n", arc.start(), state.x.z(), now.w.norm());
  }
  const Event& event = motion.events[static_cast<std::size_t>(line.events[0])];
  const Participant* box_then = event.find(1);
  const Contact& contact = event.contacts[0];
  const Margins& margins = event.margins;
  const PairCoefficients& pair = contact.pair;
  std::printf("impact %d of the box: %s with e = %.1f, %.6f N s along the normal, margin %.3f\n", box_then->impact,
              event.mode == ImpactMode::slide ? "slides" : nameOf(event.mode), pair.elasticity,
              contact.impulse_normal.dot(contact.impulse), margins.smallest());
  std::printf("its law is that of %s\n", lawOf(pair) == Law::friction ? "friction" : "no friction");

  // What is not asked need not be followed: without its orientation the box would be a point that bounces.
  options.asked = {Asked{}, Asked{}, Asked{.orientation = false, .inertia = false}};
  const Tier tier = makePlan(scene, options.asked).bodies[2].tier;
  std::printf("ball  %s\n", nameOf(tier));
  std::printf("box at 0.3 s: z = %.9f m\n", motion.stateAt("box", 0.3).position.z());
}
