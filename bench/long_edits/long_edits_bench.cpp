// SPDX-License-Identifier: MIT
// Edits of motions with 8 to 20 impacts, by several ways: how many are met, with how many simulations, steps and
// seconds, and how small the changes are. Every task can be met: another throw, with the same impacts, meets it.
//   long_edits_bench --csv FILE          one line a task and way
//   long_edits_bench --save FOLDER       one scene document a class, to be tried with `carom edit`

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "bench/edits/dice.h"
#include "bench/machine.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

constexpr double kTolerance = 1e-6;  // of the natural scales; rounding alone grows to 1e-8 of them in the longest
constexpr double kBudget = 2;        // s an edit
constexpr int kImpacts[] = {8, 11, 14, 17, 20};
constexpr int kScenes = 4;  // of each class and number of impacts

Body ballAt(const std::string& name, double radius, const Vec3& place, const Vec3& velocity) {
  Body body;
  body.name = name, body.material = "stuff", body.shape = Sphere{radius}, body.mass = 0.1;
  body.position = place, body.velocity = velocity;
  return body;
}

Body fixedAt(const std::string& name, Shape shape, const Vec3& place = Vec3::Zero()) {
  Body body;
  body.name = name, body.material = "stuff", body.fixed = true, body.shape = std::move(shape), body.position = place;
  return body;
}

Scene emptyScene(double elasticity, double friction, const Vec3& gravity) {
  Scene scene;
  scene.gravity = gravity;
  scene.materials.push_back({.name = "stuff", .elasticity = elasticity, .friction = friction});
  return scene;
}

const Vec3 kDown(0, 0, -9.81);

// A ball that hops along a floor.
Scene bounces(Dice& dice) {
  Scene scene = emptyScene(dice.in(0.9, 0.97), dice.in(0.1, 0.4), kDown);
  scene.bodies = {fixedAt("floor", Plane{}),
                  ballAt("ball", 0.05, {0, 0, dice.in(0.5, 1)}, {dice.in(0.5, 2), dice.in(-0.5, 0.5), dice.in(-1, 1)})};
  scene.bodies.back().angular_velocity = 10 * dice.inCube(1);
  return scene;
}

void addWalls(Scene& scene, double half, bool lids) {
  int number = 0;
  for (int axis = 0; axis < (lids ? 3 : 2); ++axis)
    for (const double side : {-1.0, 1.0})
      scene.bodies.push_back(fixedAt("wall " + std::to_string(++number), Plane{side * Vec3::Unit(axis), -half}));
}

// A ball in a closed box of six walls.
Scene room(Dice& dice) {
  Scene scene = emptyScene(dice.in(0.9, 0.97), dice.in(0.1, 0.4), kDown);
  addWalls(scene, 0.5, true);
  scene.bodies.push_back(ballAt("ball", 0.05, 0.3 * dice.inCube(1), 4 * dice.direction()));
  scene.bodies.back().angular_velocity = 10 * dice.inCube(1);
  return scene;
}

// A ball among fixed round posts, in a plane.
Scene posts(Dice& dice) {
  Scene scene = emptyScene(0.95, 0.1, Vec3::Zero());
  addWalls(scene, 0.5, false);
  for (int i = 0; i < 5; ++i) {
    const double x = i == 0 ? 0 : (i % 2 ? 0.29 : -0.29), y = i == 0 ? 0 : (i < 3 ? 0.29 : -0.29);
    scene.bodies.push_back(fixedAt("post " + std::to_string(i + 1), Sphere{0.1},
                                   {x + dice.in(-0.03, 0.03), y + dice.in(-0.03, 0.03), 0}));
  }
  const double angle = dice.in(0, 2 * std::numbers::pi);
  scene.bodies.push_back(ballAt("ball", 0.03, {-0.42, dice.in(-0.1, 0.1), 0}, {std::cos(angle), std::sin(angle), 0}));
  return scene;
}

// Five balls between four cushions; one of them is struck.
Scene billiard(Dice& dice) {
  Scene scene = emptyScene(0.95, 0.05, Vec3::Zero());
  addWalls(scene, 0.5, false);
  for (int i = 0; i < 4; ++i)
    scene.bodies.push_back(ballAt("ball " + std::to_string(i + 1), 0.05,
                                  {dice.in(-0.05, 0.05) + (i % 2 ? 0.25 : 0), dice.in(-0.05, 0.05) + 0.2 * (i - 1.5), 0},
                                  Vec3::Zero()));
  scene.bodies.push_back(ballAt("ball", 0.05, {-0.4, dice.in(-0.2, 0.2), 0}, {2, dice.in(-0.5, 0.5), 0}));
  return scene;
}

// A box that tumbles over a floor.
Scene tumble(Dice& dice) {
  Scene scene = emptyScene(dice.in(0.8, 0.9), dice.in(0.1, 0.4), kDown);
  scene.bodies = {fixedAt("floor", Plane{}),
                  ballAt("ball", 0.05, {0, 0, dice.in(0.5, 1)}, {dice.in(0.5, 2), dice.in(-0.5, 0.5), dice.in(-1, 1)})};
  Body& box = scene.bodies.back();
  box.shape = Box{{dice.in(0.08, 0.2), dice.in(0.08, 0.2), dice.in(0.08, 0.2)}};
  box.orientation = dice.rotation(), box.angular_velocity = 6 * dice.inCube(1);
  return scene;
}

// A ball down a stair of ten steps.
Scene stairs(Dice& dice) {
  Scene scene = emptyScene(dice.in(0.75, 0.85), dice.in(0.1, 0.4), kDown);
  for (int i = 0; i < 10; ++i)
    scene.bodies.push_back(
        fixedAt("step " + std::to_string(i + 1), Box{{0.3, 1, 0.1}}, {0.3 * i, 0, -0.1 * i - 0.05}));
  scene.bodies.push_back(fixedAt("floor", Plane{Vec3::UnitZ(), -1.05}));
  scene.bodies.push_back(
      ballAt("ball", 0.04, {-0.05, 0, dice.in(0.3, 0.5)}, {dice.in(0.5, 0.9), dice.in(-0.1, 0.1), 0}));
  return scene;
}

struct Class {
  const char* name;
  Scene (*draw)(Dice&);
};
constexpr Class kClasses[] = {{"bounces", bounces},   {"room", room},     {"posts", posts},
                              {"billiard", billiard}, {"tumble", tumble}, {"stairs", stairs}};

struct LongTask {
  std::string name;
  bool far = false;
  int impacts = 0, scene = 0;
  Scene start;
  double duration = 0, growth = 0, hidden = 0;
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
};

double growthOf(const LongTask& task, ContactSource& contacts) {
  const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
  const RowsAndJacobian at = evaluateByAdjoint(problem, problem.controls.startValues());
  if (!at.rows.available) return NAN;
  Eigen::MatrixXd J = at.jacobian * problem.controls.valueRates(Eigen::VectorXd::Zero(at.jacobian.cols())).asDiagonal();
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) /= problem.constraints.rows()[static_cast<std::size_t>(i)].scale;
  return J.cwiseAbs().maxCoeff();
}

// The place of the ball in the flight after so many impacts, as another throw has it. A near one is drawn at most so far
// off as keeps its impacts: farther where the motion is not sensitive. A far one has other impacts.
std::optional<LongTask> draw(const Class& kind, bool far, int impacts, int number, int attempt) {
  Dice dice(static_cast<std::uint64_t>(100 * impacts + number), static_cast<std::uint64_t>(&kind - kClasses),
            static_cast<std::uint64_t>(attempt));
  LongTask task{kind.name, far, impacts, number, kind.draw(dice), 0, 0, 0, {velocity("ball"), elasticity("stuff")}, {}};
  const bool flat = task.start.gravity.isZero();
  task.controls.front() = flat && task.name != "room" ? velocity("ball").only({"x", "y"}) : velocity("ball");
  OdeContacts contacts(task.start);
  const auto count = static_cast<std::size_t>(impacts);
  const Motion start = simulate(task.start, contacts, 30, {count + 1, {}});
  if (start.events.size() < count + 1 || start.events[count].time - start.events[count - 1].time < 0.02)
    return std::nullopt;
  task.duration = 0.5 * (start.events[count - 1].time + start.events[count].time);
  const ControlSet controls(task.start, task.controls);
  Eigen::VectorXd z(controls.size());
  for (double& number_of_z : z) number_of_z = dice.in(-1, 1);
  z *= dice.logIn(0.02, 0.5) / z.norm();
  for (int halved = 0; halved < 20; ++halved, z *= 0.5) {
    const Motion hidden = simulate(controls.sceneAt(controls.valuesOf(z)), contacts, task.duration);
    if (hidden.status != MotionStatus::complete) continue;
    if (far && hidden.signature() == start.signature(count)) return std::nullopt;
    if (!far && hidden.signature() != start.signature(count)) continue;
    const Vec3 place = hidden.stateAt("ball", task.duration).position;
    std::vector<TargetNumber> held = {place.x(), place.y(), place.z()};
    if (flat && task.name != "room") held[2] = any;
    task.constraints = {{"ball", When(task.duration), {{"position", held}}}};
    task.hidden = 0.5 * z.squaredNorm();
    task.growth = growthOf(task, contacts);
    if (!std::isfinite(task.growth)) return std::nullopt;
    return task;
  }
  return std::nullopt;
}

void makeTask(const Class& kind, bool far, int impacts, int number, std::vector<LongTask>& tasks) {
  for (int attempt = 0; attempt < 200; ++attempt) {
    try {
      if (std::optional<LongTask> task = draw(kind, far, impacts, number, attempt)) {
        tasks.push_back(*task);
        return;
      }
    } catch (const InputError&) {
      // bodies overlap: another draw
    }
  }
}

std::vector<LongTask> allTasks() {
  std::vector<LongTask> tasks;
  for (const Class& kind : kClasses)
    for (const bool far : {false, true})
      for (const int impacts : kImpacts)
        for (int number = 0; number < kScenes; ++number) makeTask(kind, far, impacts, number, tasks);
  return tasks;
}

// Counts the motions that are simulated; followed ones (adjoint/simulate/simulate_along.h) are not among them.
class Counted final : public ContactSource {
 public:
  Counted(std::unique_ptr<ContactSource> inner, std::shared_ptr<std::atomic<int>> count)
      : inner_(std::move(inner)), count_(std::move(count)) {}
  void begin(const Scene& scene) override { ++*count_, inner_->begin(scene); }
  std::vector<StartOverlap> overlaps() const override { return inner_->overlaps(); }
  std::optional<double> parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) override {
    return inner_->parting(a, b, arc_a, arc_b, from, until);
  }
  void setPath(int body, const Arc& arc, double from, double until) override {
    inner_->setPath(body, arc, from, until);
  }
  double window(int body, double t) override { return inner_->window(body, t); }
  void neighbours(int body, std::vector<int>& out) override { inner_->neighbours(body, out); }
  std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                             double until) override {
    return inner_->firstImpact(a, b, arc_a, arc_b, from, until);
  }
  std::optional<PredictedImpact> firstImpactBeside(int a, int b, std::span<const FeaturePair> held, Arc& arc_a,
                                                   Arc& arc_b, double from, double until) override {
    return inner_->firstImpactBeside(a, b, held, arc_a, arc_b, from, until);
  }
  std::optional<PredictedImpact> firstImpactOnGround(int a, int b, std::span<const PersistentFeatures> held, Arc& arc_a,
                                                     Arc& arc_b, double from, double until) override {
    return inner_->firstImpactOnGround(a, b, held, arc_a, arc_b, from, until);
  }
  std::span<const int> groundBeside(int body) const override { return inner_->groundBeside(body); }
  std::vector<PlacedContact> placed() const override { return inner_->placed(); }
  std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) override {
    return inner_->touching(a, b, arc_a, arc_b, t, reach);
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return inner_->geometry(); }
  std::unique_ptr<ContactSource> another() const override {
    return std::make_unique<Counted>(inner_->another(), count_);
  }

 private:
  std::unique_ptr<ContactSource> inner_;
  std::shared_ptr<std::atomic<int>> count_;
};

struct Way {
  const char* name;
  EditOptions options;
};

std::vector<Way> ways() {
  const auto way = [](const char* name, SequencePolicy policy, SecondDerivatives derivatives) {
    Way w{name, {}};
    w.options.sequence = policy, w.options.second_derivatives = derivatives;
    w.options.certify = w.options.explain = false;
    w.options.tolerance = kTolerance, w.options.time_budget_seconds = kBudget, w.options.threads = 1;
    return w;
  };
  return {way("within", SequencePolicy::stay, SecondDerivatives::exact),
          way("within; secant", SequencePolicy::stay, SecondDerivatives::secant),
          way("within; limited memory", SequencePolicy::stay, SecondDerivatives::limited_memory),
          way("search", SequencePolicy::prefer_start, SecondDerivatives::exact),
          way("search; secant", SequencePolicy::prefer_start, SecondDerivatives::secant)};
}

// Residuals are those of a scene simulated afresh.
void solve(const LongTask& task, const Way& way, std::FILE* out) {
  auto count = std::make_shared<std::atomic<int>>(0);
  Counted contacts(std::make_unique<OdeContacts>(task.start), count);
  const Edit edit(task.start, contacts, task.duration, task.controls, task.constraints);
  const auto began = std::chrono::steady_clock::now();
  const EditResult result = edit.solve(way.options);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  const int simulations = count->load();
  const Motion afresh = simulate(result.scene, contacts, task.duration);
  const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
  const RowValues rows = problem.constraints.evaluate(afresh);
  const double off = rows.available ? rows.scaled.cwiseAbs().maxCoeff() : INFINITY;
  std::fprintf(out, "%s,%s,%d,%d,%.4g,%.4g,%s,%d,%.3g,%.9g,%d,%d,%.3f\n", task.name.c_str(),
               task.far ? "other impacts" : "same impacts", task.impacts, task.scene,
               task.growth, task.hidden, way.name, off <= kTolerance ? 1 : 0, off,
               result.objective, result.iterations, simulations, ms);
  std::fflush(out);
}

void save(const std::string& folder, const LongTask& task) {
  Document document;
  document.scene = task.start, document.duration = task.duration;
  document.controls = task.controls, document.constraints = task.constraints;
  saveDocument(folder + "/" + task.name + ".json", document);
}

void run(const std::string& what, const std::string& where) {
  const std::vector<LongTask> tasks = allTasks();
  if (what == "--save") {
    for (const LongTask& task : tasks)
      if (task.impacts == 14 && task.scene == 0 && !task.far) save(where, task);
    return;
  }
  if (what != "--csv") throw std::runtime_error("found '" + what + "', expected --csv FILE or --save FOLDER");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(where.c_str(), "w"), std::fclose);
  if (!file) throw std::runtime_error(where + ": cannot be written");
  std::fprintf(file.get(),
               "# met: to %g of the natural scales, by a fresh simulation, within %g s; growth: largest entry of the "
               "dimensionless Jacobian at the start; hidden: half the square of a change that meets it\n"
               "class,target,impacts,scene,growth,hidden,way,met,residual,change,steps,simulations,ms\n",
               kTolerance, kBudget);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (const Way& way : ways()) solve(tasks[i], way, file.get());
    std::fprintf(stderr, "\r%zu of %zu ", i + 1, tasks.size());
  }
  std::fprintf(stderr, "\n");
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("expected --csv FILE or --save FOLDER");
    carom::bench::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "long_edits_bench: %s\n", error.what());
    return 1;
  }
}
