// SPDX-License-Identifier: MIT
// carom simulate: every impact, and states at the times asked for.
#include <CLI/App.hpp>
#include <cmath>
#include <memory>

#include "adjoint/simulate.h"
#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "formats/json_writer.h"
#include "formats/result_json.h"

namespace carom::cli {
namespace {

struct Options {
  std::string scene;
  std::vector<double> at;
  bool refuse_overlaps = false;
};

std::string contactNames(const Motion& motion, const Event& event) {
  std::string names;
  for (const Contact& contact : event.contacts) {
    const auto nameAt = [&](int body) { return motion.scene->bodies[static_cast<std::size_t>(body)].name; };
    names += (names.empty() ? "" : " + ") + nameAt(contact.a) + "-" + nameAt(contact.b);
  }
  return names;
}

void printEvents(Output& out, const Motion& motion) {
  if (motion.events.empty()) return;
  Table table({">", ">time [s]", "bodies", "mode", "point [m]", "normal", ">elasticity", ">margin"});
  for (std::size_t i = 0; i < motion.events.size(); ++i) {
    const Event& event = motion.events[i];
    const Contact& first = event.contacts.front();
    table.row({std::to_string(i + 1), out.number(event.time), contactNames(motion, event), nameOf(event.mode),
               out.vector(first.at.point), out.vector(first.at.normal), out.number(first.pair.elasticity),
               out.number(event.margins.smallest())});
  }
  table.print(out.text());
}

void printStates(Output& out, const Motion& motion, double time) {
  out.text() << "\nState at " << out.number(time) << " s:\n";
  Table table({"body", "position [m]", "orientation w, x, y, z", "velocity [m/s]", "angular velocity [rad/s]"});
  for (std::size_t i = 0; i < motion.scene->bodies.size(); ++i) {
    const BodyState state = motion.stateAt(static_cast<int>(i), time);
    const Body& body = motion.scene->bodies[i];
    if (body.fixed) continue;
    table.row({body.name, out.vector(state.position),
               out.number(state.orientation.w()) + ", " + out.vector(state.orientation.vec()),
               out.vector(state.velocity), out.vector(state.angular_velocity)});
  }
  table.print(out.text());
}

void printMotion(Output& out, const Motion& motion, const std::vector<double>& at) {
  out.text() << counted(static_cast<long long>(motion.events.size()), "impact") << " in " << out.number(motion.end)
             << " s";
  if (motion.status != MotionStatus::complete)
    out.text() << "; the motion ends there (" << nameOf(motion.status) << "): " << motion.message;
  out.text() << '\n';
  for (const StartOverlap& overlap : motion.overlaps)
    out.text() << describeOverlap(*motion.scene, overlap) << '\n';
  printEvents(out, motion);
  if (at.empty()) printStates(out, motion, motion.end);
  for (const double time : at) printStates(out, motion, time);
}

void requireReached(const Motion& motion, double time) {
  if (time >= 0 && time <= motion.end) return;
  const std::string why = motion.status == MotionStatus::complete ? "" : "; " + motion.message;
  throw InputError("--at", "found the time " + (std::isfinite(time) ? numberText(time) : std::to_string(time)) +
                               ", expected one in [0, " + numberText(motion.end) + "]" + why);
}

Action declare(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  addScene(app, options->scene);
  app.add_option("--at", options->at, "A time to print the state at [s]; may be given more than once")
      ->allow_extra_args(false)
      ->type_name("T");
  addRefuseOverlaps(app, options->refuse_overlaps);
  return [options](Output& out) {
    Loaded loaded(options->scene, options->refuse_overlaps);
    const Motion motion = loaded.simulate();
    for (const double time : options->at) requireReached(motion, time);
    if (out.json()) {
      out.document(motionJson(motion, options->at));
      warnIfEnded(motion);
    } else {
      printMotion(out, motion, options->at);
    }
    return Exit::done;
  };
}

}  // namespace

const Command kSimulateCommand{
    "simulate", "Simulate a scene: every impact, and states at any time",
    "Prints every impact (time, bodies, contact point and normal, mode, and the margin to where\n"
    "derivatives stop) and the state at the end of the motion, or at the times asked for.\n"
    "A motion that cannot be continued ends early: the answer says where, when and why.\n"
    "\n"
    "Examples:\n"
    "  carom simulate scene.json\n"
    "  carom simulate scene.json --at 0.5 --at 1\n"
    "  carom simulate scene.json --at 1 --digits 17\n"
    "  carom simulate scene.json --json | jq .events",
    declare};

}  // namespace carom::cli
