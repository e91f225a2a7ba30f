// SPDX-License-Identifier: MIT
#include "bench/ratios/workloads.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <memory>
#include <stdexcept>
#include <utility>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/second_order/second_order.h"
#include "adjoint/simulate/simulate.h"
#include "bench/drag_scenes.h"
#include "bench/pen.h"
#include "editing/edit.h"
#include "editing/problem/edit_problem.hpp"
#include "editing/problem_of.hpp"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

volatile double sink = 0;  // what is computed is used

// Solutions of linear systems and turned vectors, by Eigen: no code of ours.
void arithmetic() {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Identity() * 7;
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::LinSpaced(-1, 1);
  Quat q = Quat(0.4, 0.3, -0.8, 0.2).normalized();
  for (int i = 0; i < 200; ++i) {
    A(i % 6, (i + 2) % 6) = b[i % 6];
    b = A.partialPivLu().solve(b) + Eigen::Matrix<double, 6, 1>::Constant(0.1 * i);
    q = (q * Quat(1, 0.01 * q.y(), 0.02, -0.01)).normalized();
    b.head<3>() = q * Vec3(b.head<3>());
    b /= b.norm();
  }
  sink = b.sum();
}

// A motion, and one number that depends on all of its bodies: the sum of the coordinates of their places at the end,
// and of the turns of those that turn.
struct Played {
  Scene scene;
  OdeContacts contacts;
  double duration;
  SimulateOptions options;
  Motion motion;
  std::vector<StateSeed> seeds;

  Played(Scene made, double longest, std::size_t impacts = 20000, std::vector<Asked> asked = {})
      : scene(std::move(made)), contacts(scene), duration(longest) {
    options.impact_limit = impacts;
    options.asked = std::move(asked);
    motion = play();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].fixed) continue;
      StateSeed& seed = seeds.emplace_back();
      seed.body = static_cast<int>(i);
      seed.at = Instant::at(motion.end);
      seed.position = Vec3::Ones();
      if (motion.plan.bodies[i].derivative_tier != Tier::none) seed.orientation = Vec3::Ones();
    }
  }
  Motion play() { return simulate(scene, contacts, duration, options); }
};

std::function<void()> simulation(const std::shared_ptr<Played>& p) {
  return [p] { sink = p->play().end; };
}

void addAdjoint(Workloads& out, const std::string& name, const std::shared_ptr<Played>& p) {
  const auto row = [p] {
    DerivativeTape tape(p->motion);
    sink = adjoint(tape, p->seeds).gravity.x();
  };
  out.ratios.push_back({"adjoint row of " + name, row, simulation(p)});
}

void addSecondOrder(Workloads& out, const std::string& name, const std::shared_ptr<Played>& p) {
  std::vector<ReadingDirection> directions;
  for (int k = 0; k < 4; ++k) {
    ReadingDirection& d = directions.emplace_back(ReadingDirection{SceneTangent(p->scene), {}});
    BodyDerivative& body = d.scene.bodies[static_cast<std::size_t>(p->seeds[0].body)];
    (k < 3 ? body.velocity[k] : body.angular_velocity[1]) = 1;
  }
  const auto run = [p, directions] {
    DerivativeTape tape(p->motion);
    sink = secondOrder(tape, p->seeds, {}, directions, RatesWanted::varied).gradient.gravity.x();
  };
  out.ratios.push_back({"second derivatives of " + name, run, simulation(p)});
}

void addSimulation(Workloads& out, const std::string& name, const std::shared_ptr<Played>& p) {
  out.ratios.push_back({"simulation of " + name, simulation(p), arithmetic, 1});
  out.counts.push_back({"steps of " + name, static_cast<double>(p->motion.steps)});
}

Scene onFloor(double elasticity, double friction, Body body) {
  Scene scene;
  scene.materials.push_back({.name = "stuff", .elasticity = elasticity, .friction = friction});
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.material = "stuff", floor.shape = Plane{};
  body.name = "body", body.material = "stuff", body.mass = 1;
  scene.bodies = {floor, body};
  return scene;
}

Scene boxOnFloor() {
  Body box;
  box.shape = Box{{0.3, 0.2, 0.12}};
  box.position = {0, 0, 0.5}, box.velocity = {1, 0.3, -1}, box.angular_velocity = {2, 3, 1};
  return onFloor(0.6, 0.3, box);
}

Scene ballOnFloor(double elasticity, double friction, double height, double speed) {
  Body ball;
  ball.shape = Sphere{0.1};
  ball.position = {0, 0, 0.1 + height}, ball.velocity = {speed, 0, 0};
  return onFloor(elasticity, friction, ball);
}

// Boxes side by side that turn by about so many radians each, without any impact.
Scene flyingBoxes(int count) {
  Scene scene;
  scene.materials.push_back({.name = "stuff", .elasticity = 0.5, .friction = 0.3});
  for (int i = 0; i < count; ++i) {
    Body& box = scene.bodies.emplace_back();
    box.name = "box " + std::to_string(i), box.material = "stuff", box.mass = 1;
    box.shape = Box{{0.3, 0.2, 0.12}};
    box.position = {2.0 * i, 0, 0}, box.angular_velocity = {0.5, 0.7, 0.5 - 0.1 * i};
  }
  return scene;
}

Scene withoutGravity(Scene scene) {
  scene.gravity.setZero();
  return scene;
}

void addScenes(Workloads& out) {
  const auto made = [](Scene scene, double duration, std::size_t impacts = 20000) {
    return std::make_shared<Played>(std::move(scene), duration, impacts);
  };
  constexpr double kForever = 1e3;
  const auto box = made(boxOnFloor(), 0.42);
  addAdjoint(out, "a box with three impacts", box);
  addSecondOrder(out, "a box with three impacts", box);
  addSimulation(out, "a box with three impacts", box);
  addAdjoint(out, "a ball that flies", made(ballOnFloor(0, 0, 2e4, 3), 60));
  addAdjoint(out, "a ball that bounces to rest", made(ballOnFloor(0.95, 0, 1, 0), 60));
  const auto sliding = made(ballOnFloor(0, 0.3, 0, 3), 60);
  addAdjoint(out, "a ball that slides and rolls, and of its turn", sliding);
  const auto place = made(ballOnFloor(0, 0.3, 0, 3), 60);
  place->seeds[0].orientation.setZero();
  addAdjoint(out, "a ball that slides and rolls", place);
  for (const auto& [turn, words] : {std::pair(0.1, "0.1 rad"), std::pair(1.0, "1 rad"), std::pair(30.0, "30 rad")})
    addAdjoint(out, std::string("boxes that fly by ") + words, made(flyingBoxes(5), turn));
  const std::pair<int, int> pens[] = {{2, 1000}, {20, 100}, {20, 1000}, {200, 1000}};
  for (const auto& [bodies, impacts] : pens) {
    const auto pen = made(withoutGravity(penOfBalls(bodies, 1)), kForever, static_cast<std::size_t>(impacts));
    const std::string name = std::to_string(bodies) + " balls with " + std::to_string(impacts) + " impacts";
    addAdjoint(out, name, pen);
    if (bodies == 200) addSimulation(out, name, pen);
  }
  addAdjoint(out, "100 balls that fall", made(penOfBalls(100, 1), kForever, 2000));
  const auto boxes = made(penOfBoxes(20, 1), kForever, 60);
  addAdjoint(out, "20 boxes", boxes);
  addSimulation(out, "20 boxes", boxes);
  addAdjoint(out, "mugs", made(penOfMugs(4, projectFile("examples/assets/mug.obj"), 1), kForever, 8));
}

// A scene document and its edit.
void addEdit(Workloads& out, const std::string& name) {
  const auto document = std::make_shared<Document>(readDocument(projectFile("examples/scenes/") + name + ".json"));
  const auto contacts = std::make_shared<OdeContacts>(document->scene);
  const auto edit = std::make_shared<Edit>(document->scene, *contacts, document->duration, document->controls,
                                           document->constraints);
  const EditProblem problem = problemOf(*edit);
  const auto p = std::make_shared<Played>(document->scene, problem.horizon, 20000, problem.asked);
  addAdjoint(out, name, p);
  addSecondOrder(out, name, p);
  addSimulation(out, name, p);
  EditOptions options;
  options.threads = 1;
  const EditResult result = edit->solve(options);
  if (!result.solved()) throw std::runtime_error("the edit of " + name + " is not solved: " + result.message);
  const auto solve = [document, contacts, edit, options] { sink = edit->solve(options).residual; };
  out.ratios.push_back({"edit of " + name, solve, simulation(p)});
  out.counts.push_back({"iterations of " + name, static_cast<double>(result.iterations)});
}

// The path of a mouse, from the same start every time.
void addDrag(Workloads& out, const DragCase& c) {
  constexpr double kSeconds = 1;
  SessionOptions options;
  options.drag_seconds = 1e3;  // no clock, so that it is the same work
  const auto drag = [c, options](int& simulations) {
    OdeContacts contacts(c.scene);
    EditSession session(c.scene, contacts, c.duration, c.controls, c.nails, options);
    session.grab(c.body, c.at, c.grip);
    const std::vector<Vec3> path = mousePath(session.grabbedPlace(), c.wide, kSeconds, 1);
    for (const Vec3& place : path) simulations += session.dragTo(place).simulations;
    return path.size();
  };
  int simulations = 0;
  const auto updates = static_cast<double>(drag(simulations));
  const auto run = [drag] {
    int counted = 0;
    drag(counted);
    sink = counted;
  };
  out.ratios.push_back({"drag of " + c.name, run, simulation(std::make_shared<Played>(c.scene, c.duration)), updates});
  out.counts.push_back({"simulations of a drag of " + c.name, static_cast<double>(simulations)});
}

}  // namespace

Workloads workloads() {
  Workloads out;
  addScenes(out);
  for (const char* name : {"book-on-shelf", "billiard-three-balls"}) addEdit(out, name);
  for (const DragCase& c : dragCases())
    if (c.name == "ball" || c.name == "box" || c.name == "three bodies") addDrag(out, c);
  return out;
}

}  // namespace carom::bench
