// SPDX-License-Identifier: MIT
// State error at the end against wall time per simulated second: carom (as it is, and along a known impact sequence
// with other models of flight) beside engines of fixed steps.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulate_along.h"
#include "bench/charts/chart.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/error.h"
#include "bench/charts/frozen_flights.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/replayed.h"

namespace carom::charts {
namespace {

constexpr double kLongest = 10;  // s: a run that would take more is left out
const std::vector<double> kSteps = logSpaced(1e-2, 1e-6, 9);

// Fifty digits along the sequence of impacts; the states are rounded to doubles at the very end.
States exactEnd(const Scene& scene, const Motion& motion) {
  const reference::Reference reference(scene, reference::sequenceOf(motion));
  States states;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    states.push_back(reference.stateAt(static_cast<int>(i), motion.end));
  return states;
}

class Comparison {
 public:
  Comparison(Csv& csv, Progress& progress, const ChartScene& row)
      : csv_(csv), progress_(progress), row_(row), scene_(row.make()), contacts_(scene_) {
    motion_ = simulate(scene_, contacts_, row.duration);
    if (motion_.status != MotionStatus::complete || motion_.events.size() != static_cast<std::size_t>(row.impacts))
      throw std::runtime_error(row.name + " has " + std::to_string(motion_.events.size()) + " impacts, expected " +
                               std::to_string(row.impacts) + ": " + motion_.message);
    exact_ = exactEnd(scene_, motion_);
  }

  void carom() {
    progress_.next(row_.name + ", carom");
    write("carom", 0, bestSeconds([&] { motion_ = simulate(scene_, contacts_, row_.duration); }, 0.3, 100000),
          statesAt(motion_, row_.duration));
    MotionAlong again;
    const double seconds =
        bestSeconds([&] { again = simulateAlong(motion_, scene_, motion_.geometry, row_.duration); }, 0.3, 100000);
    write("carom along", 0, seconds, statesAt(again.motion, row_.duration));
  }

  void flights(const FlightModel& model) {
    for (const double step : model.adaptive ? logSpaced(1e-3, 1e-15, 9) : kSteps) {
      progress_.next(row_.name + ", " + model.name);
      States end;
      const double seconds = bestSeconds([&] { end = endByModel(motion_, model, step); });
      write(model.name, step, seconds, end);
    }
  }

  void engine(const EngineKind& kind) {
    double seconds = 0;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      progress_.next(row_.name + ", " + kind.name + " at " + Cell(kSteps[i]).text);
      const double expected = i > 0 ? seconds * kSteps[i - 1] / kSteps[i] : 0;
      if (expected > kLongest) {
        csv_.note("left out: " + row_.name + " with " + kind.name + " at " + Cell(kSteps[i]).text +
                  " would take about " + Cell(std::round(expected)).text + " s");
        continue;
      }
      States end;
      const double from = now();
      seconds = play(kind, kSteps[i], end);
      while (now() - from < 0.1) seconds = std::min(seconds, play(kind, kSteps[i], end));
      write(kind.name, kSteps[i], seconds, end);
    }
  }

 private:
  // Seconds that the steps take, without setting up the world.
  double play(const EngineKind& kind, double dt, States& states) const {
    const auto engine = kind.make(scene_, dt);
    const long steps = std::lround(row_.duration / dt);
    const double from = now();
    for (long i = 0; i < steps; ++i) engine->step();
    const double seconds = now() - from;
    // what is left of the duration where it is no multiple of the step, as free flight of the centre
    const double rest = row_.duration - static_cast<double>(steps) * dt;
    states.clear();
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      states.push_back(engine->state(static_cast<int>(i)));
      BodyState& s = states.back();
      if (scene_.bodies[i].fixed) continue;
      s.position += rest * s.velocity;
      const Vec3 turn = 0.5 * rest * s.angular_velocity;
      s.orientation = (Quat(1, turn.x(), turn.y(), turn.z()) * s.orientation).normalized();
    }
    return seconds;
  }

  void write(const std::string& method, double step, double seconds, const States& end) {
    csv_.row({row_.name, method, step, seconds / row_.duration, stateError(scene_, end, exact_)});
  }

  Csv& csv_;
  Progress& progress_;
  const ChartScene& row_;
  Scene scene_;
  OdeContacts contacts_;
  Motion motion_;
  States exact_;
};

}  // namespace

void measure(Csv& csv) {
  csv.note(
      "error: metres that the worst point of the worst body is off at the end, against the same motion in 50 digits");
  csv.note("step: seconds; of Fehlberg 7(8) the error allowed in one step, rad; 0: there is none");
  csv.columns({"scene", "method", "step", "seconds_per_simulated_second", "error"});
  const auto steps = static_cast<int>(kSteps.size());
  Progress progress(4 + 4 * static_cast<int>(engines().size()) * steps + 2 * 4 * steps);
  for (const ChartScene& row : speedScenes()) {
    Comparison comparison(csv, progress, row);
    comparison.carom();
    const bool turns = row.name.find("box") != std::string::npos;
    if (turns)
      for (const FlightModel& model : flightModels()) comparison.flights(model);
    for (const EngineKind& kind : engines()) comparison.engine(kind);
  }
}

}  // namespace carom::charts
