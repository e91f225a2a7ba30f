// SPDX-License-Identifier: MIT
#include "tests/export/hand_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace carom::export_tests {
namespace {

constexpr double kDuration = 1.2;

BodyState stateOf(const Arc& arc, double t) { return toBodyState(arc.model(), arc.stateAt(t)); }

void bounce(Motion& motion, const Bounce& b) {
  WorldLine& line = motion.world_lines[b.body];
  Arc& last = line.arcs.back();
  last.extendTo(b.time);
  Participant p;
  p.body = b.body;
  p.arc = static_cast<int>(line.arcs.size()) - 1;
  p.impact = p.arc + 1;
  p.before = last.stateAt(b.time);
  Event event;
  event.time = b.time;
  event.participants = {p};
  Contact contact;
  contact.a = b.body, contact.b = b.with;
  contact.at.point = p.before.x - 0.1 * Vec3::UnitZ();
  event.contacts = {contact};

  Body after = motion.scene->bodies[b.body];
  const BodyState state = stateOf(last, b.time);
  after.position = state.position, after.orientation = state.orientation;
  after.velocity = b.velocity, after.angular_velocity = b.angular_velocity;
  const BodyModel& model = (*motion.models)[b.body];
  const Arc next(model, last.tier(), motion.scene->gravity, b.time, startState(after, model));
  line.events.push_back(static_cast<int>(motion.events.size()));
  line.arcs.push_back(next);
  motion.events.push_back(event);
  motion.impacts = motion.event_count = motion.events.size();
}

Body moving(const std::string& name, const Shape& shape, const Vec3& x, const Vec3& v, const Vec3& w) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.mass = 0.7;
  body.position = x, body.velocity = v, body.angular_velocity = w;
  return body;
}

}  // namespace

Motion handMotion(const Scene& scene, double duration, const std::vector<Bounce>& bounces) {
  Motion motion;
  motion.scene = std::make_shared<const Scene>(scene);
  auto models = std::make_shared<std::vector<BodyModel>>();
  for (const Body& body : scene.bodies) models->push_back(modelOf(body));
  motion.models = models;
  motion.plan = makePlan(scene);
  motion.duration = motion.end = duration;
  motion.world_lines.resize(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    motion.world_lines[i].arcs.emplace_back((*models)[i], motion.plan.bodies[i].tier, scene.gravity, 0.0,
                                            startState(scene.bodies[i], (*models)[i]));
  for (const Bounce& b : bounces) bounce(motion, b);
  for (WorldLine& line : motion.world_lines) line.arcs.back().extendTo(duration);
  return motion;
}

Document handDocument() {
  Document document;
  document.duration = kDuration;
  Scene& scene = document.scene;
  scene.materials.push_back({"felt", 0.45, 0.6, 0.1, Combine::average, Combine::multiply});
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  Body wall;
  wall.name = "wall", wall.fixed = true, wall.shape = Box{{0.06, 1.2, 0.35}}, wall.position = {1.3, 0, 0.175};
  scene.bodies = {floor, wall, moving("book", Box{{0.3, 0.2, 0.05}}, {0, 0.1, 0.9}, {2, 0.1, 0.5}, {1.5, 7, 2}),
                  moving("ball <1>", Sphere{0.11}, {0.2, -0.4, 0.6}, {1.5, 0.2, 1}, {0, 12, 3}),
                  moving("top", Box{{0.1, 0.1, 0.2}}, {0.5, 0.5, 1}, {0.6, 0, 2.5}, {2, 0, 30})};
  scene.bodies[2].material = "felt";
  scene.bodies[2].orientation = Quat(0.9, 0.1, -0.4, 0.2).normalized();
  document.controls = {velocity("book"), elasticity("felt").within(0.2, 0.9)};
  document.constraints = {
      {"book", 1.1, {{"position", {2.1, 0.2, 0.6}, Vec3::Zero()}, {"orientation", {1, 0, 0, 0}, Vec3::Zero()}}},
      {"ball <1>", nthImpact(1, "floor"), {{"position", {0.9, any, any}, Vec3::Zero()}}}};
  return document;
}

Motion handMotion() {
  return handMotion(handDocument().scene, kDuration,
                    {{0.41, 2, 0, {1.9, 0.1, 2.9}, {-3, 9, 1}},
                     {0.5, 3, 0, {1.3, 0.1, 2.2}, {1, 11, 0}},
                     {0.98, 2, 0, {1.6, 0, 2.1}, {0.4, -5, 4}}});
}

std::string temporaryPath(const std::string& name) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string test = std::string(info->test_suite_name()) + "-" + info->name();
  std::replace(test.begin(), test.end(), '/', '-');  // tests with parameters have it in their names
  return testing::TempDir() + "carom-" + test + "-" + name;
}

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace carom::export_tests
