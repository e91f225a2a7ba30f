// SPDX-License-Identifier: MIT
// What it costs to model more than a scene needs: the tier of flight that carom picks against the next richer ones, the
// law without friction against that with it, and events recorded or not. And what `carom info` says of scenes.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/error.h"
#include "examples/support/project_file.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

// Apart by this, moments count as different (symmetryAxis): it forces the next tier, and changes the motion no more
// than rounding does.
constexpr double kSplit = 2e-15;
constexpr int kRounds = 40;
constexpr double kBudget = 0.003;       // s, of a rung in a round
constexpr double kNoFriction = 1e-200;  // forces the law with friction

struct Case {
  std::string name;
  Scene scene;
  double duration;
  bool orientation;  // is asked for
};

Case spinningBall() {
  Case c{"ball with friction", emptyScene(0.8, 0.3), 1.5, true};
  Body ball = movingBody("ball", Sphere{0.1}, {0, 0, 0.8}, {1, 0.5, 0});
  ball.angular_velocity = {5, -20, 8};
  c.scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0), ball};
  return c;
}

Case frictionlessBall() {
  Case c = spinningBall();
  c.name = "ball without friction";
  c.scene.materials[0].friction = 0;
  c.orientation = false;
  return c;
}

Case tumbling(const std::string& name, const Shape& shape) {
  Case c{name, emptyScene(0.6, 0), 0.9, true};
  Body body = movingBody(name, shape, {0, 0, 0.8}, {1, 0.3, -1});
  body.orientation = Quat(0.9, 0.2, -0.3, 0.1).normalized();
  body.angular_velocity = {4, 6, 2};
  c.scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0), body};
  return c;
}

Case poolBreak() {
  for (const ChartScene& scene : speedScenes())
    if (scene.name == "pool break") return {scene.name, scene.make(), scene.duration, false};
  throw std::logic_error("there is no pool break");
}

// Moments written apart by rounding, so that the tier is this one.
Scene withTier(Scene scene, Tier tier) {
  for (Body& body : scene.bodies) {
    if (body.fixed) continue;
    const Vec3 I = modelOf(body).inertia;
    const int axis = std::clamp(symmetryAxis(I), 0, 2);
    Vec3 split = I;
    if (tier == Tier::symmetric) split[2] *= 1 + kSplit;
    if (tier == Tier::triaxial) split[(axis + 1) % 3] *= 1 + kSplit, split[(axis + 2) % 3] *= 1 - kSplit;
    body.inertia = Inertia::fromMoments(split);
  }
  return scene;
}

class Ladder {
 public:
  Ladder(Csv& csv, Progress& progress, const Case& c) : csv_(csv), progress_(progress), case_(c) {}

  // All rungs are timed in turn, several times: the ratios are of one and the same minute.
  void add(const std::string& what, const std::string& model, const Scene& scene, const SimulateOptions& options) {
    rungs_.push_back({what, model, scene, options, {}, {}, 1e300, 1e300});
  }

  void measure() {
    for (Rung& r : rungs_) r.contacts = std::make_unique<OdeContacts>(r.scene);
    for (int round = 0; round < kRounds; ++round)
      for (Rung& r : rungs_) {
        progress_.next(case_.name + ", " + r.model);
        r.simulate = std::min(
            r.simulate,
            bestSeconds([&] { r.motion = simulate(r.scene, *r.contacts, case_.duration, r.options); }, kBudget, 1000));
        if (r.options.record_events)
          r.gradient =
              std::min(r.gradient, bestSeconds([&] { (void)adjoint(r.motion, seeds(r.scene)); }, kBudget, 1000));
      }
    for (const Rung& r : rungs_) {
      if (r.motion.status != MotionStatus::complete)
        throw std::runtime_error(case_.name + ", " + r.model + ": " + r.motion.message);
      const std::size_t moving = r.scene.bodies.size() - 1;
      csv_.row({r.what, case_.name, r.model, std::string(nameOf(r.motion.plan.bodies[moving].tier)),
                std::string(nameOf(r.motion.plan.bodies[moving].derivative_tier)), r.motion.impacts, r.simulate,
                r.simulate / rungs_[0].simulate, r.options.record_events ? r.gradient : NAN,
                r.options.record_events ? r.gradient / rungs_[0].gradient : NAN, difference(r), bytes(r.motion)});
    }
  }

 private:
  struct Rung {
    std::string what, model;
    Scene scene;
    SimulateOptions options;
    std::unique_ptr<OdeContacts> contacts;
    Motion motion;
    double simulate, gradient;
  };

  // The sum of the coordinates of all moving bodies at the end.
  std::vector<StateSeed> seeds(const Scene& scene) const {
    std::vector<StateSeed> seeds;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].fixed) continue;
      StateSeed& seed = seeds.emplace_back();
      seed.body = static_cast<int>(i);
      seed.at = Instant::at(case_.duration);
      seed.position = Vec3::Ones();
    }
    return seeds;
  }

  // Of the ends of the two motions: metres, or where no orientation is asked for of the centres alone.
  double difference(const Rung& r) const {
    States found = statesAt(r.motion, case_.duration);
    const States expected = statesAt(rungs_[0].motion, case_.duration);
    if (!case_.orientation)
      for (std::size_t i = 0; i < found.size(); ++i) found[i].orientation = expected[i].orientation;
    return stateError(r.scene, found, expected);
  }

  static std::size_t bytes(const Motion& motion) {
    std::size_t sum = motion.events.capacity() * sizeof(Event);
    for (const Event& e : motion.events)
      sum += e.contacts.capacity() * sizeof(Contact) + e.participants.capacity() * sizeof(Participant);
    for (const WorldLine& line : motion.world_lines)
      sum += line.arcs.capacity() * sizeof(Arc) + line.events.capacity() * sizeof(int);
    return sum;
  }

  Csv& csv_;
  Progress& progress_;
  const Case& case_;
  std::vector<Rung> rungs_;
};

SimulateOptions asking(const Case& c, bool orientation, bool inertia, bool record = true) {
  SimulateOptions options;
  options.asked.assign(c.scene.bodies.size(), Asked{orientation, inertia});
  options.record_events = record;
  return options;
}

void tiers(Csv& csv, Progress& progress, const Case& c) {
  Ladder ladder(csv, progress, c);
  ladder.add("flight", "chosen", c.scene, asking(c, c.orientation, true));
  const Body& last = c.scene.bodies.back();
  const int axis = symmetryAxis(modelOf(last).inertia);
  if (!c.orientation) ladder.add("flight", "orientation carried", c.scene, asking(c, true, true));
  if (axis == -1) ladder.add("flight", "symmetric tier", withTier(c.scene, Tier::symmetric), asking(c, true, false));
  if (axis < 3) {
    ladder.add("flight", "triaxial tier", withTier(c.scene, Tier::triaxial), asking(c, true, false));
    Scene written = withTier(c.scene, Tier::none);
    ladder.add("flight", "moments vary one by one", written, asking(c, true, true));
  }
  ladder.measure();
}

void law(Csv& csv, Progress& progress, const Case& c) {
  Ladder ladder(csv, progress, c);
  ladder.add("law", "chosen", c.scene, asking(c, c.orientation, true));
  Scene forced = c.scene;
  forced.materials[0].friction = kNoFriction;
  ladder.add("law", "law with friction", forced, asking(c, c.orientation, true));
  ladder.measure();
}

void recording(Csv& csv, Progress& progress, const Case& c) {
  Ladder ladder(csv, progress, c);
  ladder.add("recording", "events recorded", c.scene, asking(c, c.orientation, true));
  ladder.add("recording", "paths alone", c.scene, asking(c, c.orientation, true, false));
  ladder.measure();
}

// The value of a member that stands on a line of its own; empty: not this line.
std::string member(const std::string& line, const std::string& name) {
  const std::string key = "\"" + name + "\": \"";
  const std::size_t at = line.find(key);
  if (at == std::string::npos) return {};
  std::string value = line.substr(at + key.size());
  value.resize(value.rfind('"'));
  std::replace(value.begin(), value.end(), ',', ';');
  return value;
}

// One row for every kind of body that a scene has, of `carom info --json`.
void info(Csv& csv, const std::string& scene) {
  const std::string command = std::string(CAROM_COMMAND) + " info --json " + projectFile("examples/scenes/") + scene + ".json";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::vector<std::vector<std::string>> seen;
  std::vector<std::string> row;
  char text[4096];
  bool in_bodies = true;
  int bodies = 0;
  while (std::fgets(text, sizeof text, pipe.get())) {
    const std::string line = text;
    if (line.find("\"pairs\"") != std::string::npos) in_bodies = false;
    if (!in_bodies) continue;
    for (const char* name : {"shape", "tier", "why", "derivative_tier", "derivative_why"})
      if (std::string value = member(line, name); !value.empty()) row.push_back(value);
    if (row.size() < 5) continue;
    ++bodies;
    if (row[2] != "fixed: it does not move" && std::find(seen.begin(), seen.end(), row) == seen.end())
      seen.push_back(row);
    row.clear();
  }
  if (bodies == 0) throw std::runtime_error("no bodies in what '" + command + "' printed");
  for (const std::vector<std::string>& r : seen)
    csv.row({"info", scene, r[0], r[1], r[3], r[2], r[4], NAN, NAN, NAN, NAN, NAN});
}

}  // namespace

void measure(Csv& csv) {
  csv.note(
      "what flight: chosen first, then richer tiers, forced by moments written 2e-15 apart; moments vary one by one:");
  csv.note("written moments, whose derivatives need the triaxial tier. what law: friction 0, then 1e-200");
  csv.note("simulate, gradient: least seconds of one, rungs in turn; ratios over the first rung of the same scene");
  csv.note("difference: of the states at the end from the first rung's, m; bytes: of events and arcs");
  csv.note("what info: scene, shape, tier, derivative tier and the two reasons, from `carom info --json`");
  csv.columns({"what", "scene", "model", "tier", "derivative_tier", "impacts", "simulate", "simulate_ratio", "gradient",
               "gradient_ratio", "difference", "bytes"});
  const Case capsule = tumbling("capsule", Capsule{0.06, 0.3}), box = tumbling("box", Box{{0.3, 0.2, 0.12}});
  Progress progress(kRounds * 34);
  for (const Case& c : {frictionlessBall(), spinningBall(), capsule, poolBreak()}) tiers(csv, progress, c);
  for (const Case& c : {frictionlessBall(), capsule, box, poolBreak()}) law(csv, progress, c);
  for (const Case& c : {frictionlessBall(), capsule, box, poolBreak()}) recording(csv, progress, c);
  for (const char* scene : {"billiard-three-balls", "two-balls", "pen_500", "ball-into-cup", "hat", "book-on-shelf",
                            "mug", "dice", "bowling", "spinning-top", "only-causes"})
    info(csv, scene);
}

}  // namespace carom::charts
