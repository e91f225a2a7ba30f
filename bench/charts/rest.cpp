// SPDX-License-Identifier: MIT
// Contact that lasts, beside closed forms: a ball that slides and then rolls down a slope, a block that slides to rest,
// and a ball that bounces and slides to rest. Error of the place against wall time; then 60 s more, with the energy.

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/error.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr long double kGravity = 9.81L, kRadius = 0.1L, kBallSpeed = 1;
constexpr double kLong = 60;     // s, of the long runs
constexpr double kLongStep = 1e-3;  // s, of the engines there
const std::vector<double> kSteps = logSpaced(1e-2, 1e-5, 7);

// Everything happens along x, so that the axes of ODE's friction are those of the motion.
struct Place {
  long double x = 0, z = 0, speed = 0, falling = 0, spin = 0;  // of the centre; -dz/dt; about y
};

struct RestScene {
  std::string name;
  double seen;  // s: the block and the bouncing ball are at rest by then
  Scene (*make)();
  Place (*exactAt)(long double t);
};

Scene onFloor(double elasticity, double friction, const Vec3& gravity, Body body) {
  Scene scene = emptyScene(elasticity, friction, gravity);
  scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0), std::move(body)};
  return scene;
}

// A slope of 20 degrees, in its own axes.
constexpr double kSlope = 20 * M_PI / 180, kSlopeFriction = 0.2;

Scene ballDownASlope() {
  const auto g = static_cast<double>(kGravity);
  return onFloor(0, kSlopeFriction, {g * std::sin(kSlope), 0, -g * std::cos(kSlope)},
                 movingBody("ball", Sphere{0.1}, {0, 0, 0.1}, {1, 0, 0}));
}

Place downTheSlope(long double t) {
  const long double along = kGravity * std::sin(static_cast<long double>(kSlope));
  const long double rub = kSlopeFriction * kGravity * std::cos(static_cast<long double>(kSlope));
  const long double slides = std::min(t, kBallSpeed / (3.5L * rub - along)), rolls = t - slides;
  const long double speed = kBallSpeed + (along - rub) * slides, push = along * 5 / 7;
  Place at{slides * (kBallSpeed + speed) / 2 + rolls * (speed + push * rolls / 2), kRadius, speed + push * rolls, 0, 0};
  at.spin = rolls > 0 ? at.speed / kRadius : 2.5L * rub * slides / kRadius;
  return at;
}

constexpr long double kBlockSpeed = 2, kBlockFriction = 0.3L;

Scene slidingBlock() {
  return onFloor(0, static_cast<double>(kBlockFriction), {0, 0, -static_cast<double>(kGravity)},
                 movingBody("block", Box{{0.4, 0.3, 0.2}}, {0, 0, 0.1}, {static_cast<double>(kBlockSpeed), 0, 0}));
}

Place ofTheBlock(long double t) {
  const long double rub = kBlockFriction * kGravity, slides = std::min(t, kBlockSpeed / rub);
  return {slides * (kBlockSpeed - rub * slides / 2), 0.1L, kBlockSpeed - rub * slides, 0, 0};
}

// Spun back just so much that it neither rolls on nor comes back: m r v + I w about its contact is 0 all the time.
constexpr long double kHeight = 1, kBounce = 0.5L, kBounceFriction = 0.05L;

Scene bouncingBall() {
  Body ball = movingBody("ball", Sphere{0.1}, {0, 0, 1.1}, {1, 0, 0});
  ball.angular_velocity = {0, -25, 0};
  return onFloor(static_cast<double>(kBounce), static_cast<double>(kBounceFriction),
                 {0, 0, -static_cast<double>(kGravity)}, ball);
}

// Every impact slides, and takes mu (1 + e) w of the speed along the floor, where w is that of the arrival.
Place ofTheBounces(long double t) {
  Place at{0, kRadius, kBallSpeed, 0, 0};
  long double arrival = std::sqrt(2 * kGravity * kHeight), from = 0, leaves = 0, height = kHeight;
  long double lasts = arrival / kGravity;  // of the flight from `from` on
  for (; t > from + lasts && arrival > 1e-18L; arrival *= kBounce, height = 0) {
    at.x += at.speed * lasts, from += lasts;
    at.speed -= kBounceFriction * (1 + kBounce) * arrival;
    leaves = kBounce * arrival, lasts = 2 * leaves / kGravity;
  }
  const long double flown = std::min(t - from, lasts);
  const bool flies = t - from < lasts;
  if (flies) {
    at.x += at.speed * flown, at.z += height + flown * (leaves - kGravity * flown / 2);
    at.falling = kGravity * flown - leaves;
  } else {
    const long double rub = kBounceFriction * kGravity, slides = std::min(t - from, at.speed / rub);
    at.x += slides * (at.speed - rub * slides / 2), at.speed -= rub * slides;
  }
  at.spin = -2.5L * at.speed / kRadius;
  return at;
}

const std::vector<RestScene>& restScenes() {
  static const std::vector<RestScene> scenes = {{"ball down a slope", 2, ballDownASlope, downTheSlope},
                                                {"sliding block", 2, slidingBlock, ofTheBlock},
                                                {"bouncing ball", 3, bouncingBall, ofTheBounces}};
  return scenes;
}

States exactStates(const RestScene& row, const Scene& scene, double t) {
  const Place at = row.exactAt(t);
  States states = startOf(scene);
  states[1].position = {static_cast<double>(at.x), 0, static_cast<double>(at.z)};
  states[1].velocity = {static_cast<double>(at.speed), 0, -static_cast<double>(at.falling)};
  states[1].angular_velocity = {0, static_cast<double>(at.spin), 0};
  return states;
}

States statesOf(const Engine& engine, const Scene& scene) {
  States states;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) states.push_back(engine.state(static_cast<int>(i)));
  return states;
}

// A block stands on four corners, where dWorldStep without CFM stops it anywhere.
std::vector<EngineKind> restEngines() {
  std::vector<EngineKind> kinds = engines();
  for (EngineKind& kind : kinds)
    if (kind.name == "ODE") kind = odeStepWithDefaultCfm();
  return kinds;
}

class Comparison {
 public:
  Comparison(Csv& csv, Progress& progress, const RestScene& row)
      : csv_(csv), progress_(progress), row_(row), scene_(row.make()) {}

  void carom() {
    progress_.next(row_.name + ", carom");
    OdeContacts contacts(scene_);
    Motion motion;
    const double seconds = bestSeconds([&] { motion = simulate(scene_, contacts, row_.seen); }, 0.3, 100000);
    if (motion.status == MotionStatus::complete)
      write("seen", "carom", 0, row_.seen, seconds / row_.seen, statesAt(motion, row_.seen));
    else
      csv_.note("carom does not play '" + row_.name + "': " + motion.message);
    const double from = now();
    motion = simulate(scene_, contacts, kLong);
    const double whole = now() - from;
    for (const double t : times())
      if (t <= motion.end) write("lasting", "carom", 0, t, whole / kLong, statesAt(motion, t));
  }

  void engine(const EngineKind& kind) {
    for (const double step : kSteps) {
      progress_.next(row_.name + ", " + kind.name + " at " + Cell(step).text);
      States end;
      const double from = now();
      double seconds = seen(kind, step, end);
      while (now() - from < 0.1) seconds = std::min(seconds, seen(kind, step, end));
      const double reached = step * static_cast<double>(std::lround(row_.seen / step));
      write("seen", kind.name, step, reached, seconds / reached, end);
    }
    const auto engine = kind.make(scene_, kLongStep);
    long done = 0;
    const double from = now();
    for (const double t : times()) {
      for (; done < std::lround(t / kLongStep); ++done) engine->step();
      const double reached = kLongStep * static_cast<double>(done);
      write("lasting", kind.name, kLongStep, reached, (now() - from) / reached, statesOf(*engine, scene_));
    }
  }

 private:
  // In the middle between two multiples of the engines' step nothing would be known of them.
  std::vector<double> times() const {
    std::vector<double> all = logSpaced(0.02, kLong, 30);
    all.push_back(row_.seen);
    std::sort(all.begin(), all.end());
    for (double& t : all) t = kLongStep * std::round(t / kLongStep);
    return all;
  }

  // Seconds that the steps take, without setting up the world.
  double seen(const EngineKind& kind, double step, States& end) const {
    const auto engine = kind.make(scene_, step);
    const long steps = std::lround(row_.seen / step);
    const double from = now();
    for (long i = 0; i < steps; ++i) engine->step();
    const double seconds = now() - from;
    end = statesOf(*engine, scene_);
    return seconds;
  }

  void write(const char* part, const std::string& method, double step, double t, double seconds, const States& found) {
    const States exact = exactStates(row_, scene_, t);
    const Vec3 off = found[1].position - exact[1].position;
    if (t <= row_.seen) off_ = off;
    // of the energy that the body has had at hand: at the start, and what it has fallen since
    const double right = energy(scene_, exact), start = energy(scene_, startOf(scene_));
    const double speed = (found[1].velocity - exact[1].velocity).norm();
    double scale = start + modelOf(scene_.bodies[1]).mass * scene_.gravity.dot(exact[1].position);
    if (!(scale > 0)) scale = start;
    csv_.row({part, row_.name, method, step, t, seconds, off.norm(), (off - off_).norm(), speed,
              (energy(scene_, found) - right) / scale});
  }

  Csv& csv_;
  Progress& progress_;
  const RestScene& row_;
  Scene scene_;
  Vec3 off_;  // where the centre is, from where it should be, when it is seen
};

}  // namespace

void measure(Csv& csv) {
  csv.note("seen: the end of the motion, at rest but for the ball down a slope, by steps; lasting: 60 s at one step");
  csv.note("error: distance of the centre from where the closed form has it, m; speed: of its velocity, m/s");
  csv.note("drift: how far the centre has moved since the time at which it is seen beyond what it should have, m");
  csv.note("energy: what is too much of it, over what the body began with and gained by falling");
  csv.note("ODE: here with its default CFM of 1e-10; with 0 dWorldStep has no answer for a block on four corners");
  csv.columns({"part", "scene", "method", "step", "time", "seconds_per_simulated_second", "error", "drift", "speed",
               "energy"});
  Progress progress(static_cast<int>(restScenes().size() * (1 + engines().size() * kSteps.size())));
  for (const RestScene& row : restScenes()) {
    Comparison comparison(csv, progress, row);
    comparison.carom();
    for (const EngineKind& kind : restEngines()) comparison.engine(kind);
  }
}

}  // namespace carom::charts
