// SPDX-License-Identifier: MIT
// carom simulate: every impact, and states at the times asked for.
#include <CLI/App.hpp>
#include <cmath>
#include <memory>

#include "adjoint/simulate/simulate.h"
#include "cli/command.h"
#include "cli/impacts.h"
#include "cli/lasting_contacts.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/table.h"
#include "formats/answers/result_json.hpp"
#include "formats/drawing/motion_extent.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct SimulateArguments {
  std::string scene;
  std::vector<double> at;
  bool impacts = false;
  MotionArguments motion;
};

constexpr std::size_t kMostStates = 50;  // of bodies, at the end of a motion that was not asked for

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
  table.print(out);
}

void printEnd(Output& out, const Motion& motion) {
  const std::size_t moving = movingCount(*motion.scene);
  if (moving <= kMostStates) return printStates(out, motion, motion.end);
  out.text() << "--at " << numberText(motion.end) << " prints the state of the " << moving
             << " moving bodies at the end.\n";
}

void printMotion(Output& out, const Motion& motion, const SimulateArguments& arguments,
                 const std::vector<double>& times) {
  out.text() << counted(motion.impacts, "impact") << " in " << out.number(motion.end) << " s";
  if (motion.status != MotionStatus::complete)
    out.text() << "; " << out.styled(Look::warning, "the motion ends there") << " (" << nameOf(motion.status)
               << "): " << motion.message;
  out.text() << '\n';
  for (const StartOverlap& overlap : motion.overlaps)
    out.text() << describeOverlap(*motion.scene, overlap) << '\n';
  if (arguments.impacts || toldEvents(motion).size() <= kMostListed)
    printImpacts(out, motion);
  else
    printImpactSummary(out, motion);
  printLastingContacts(out, motion, arguments.impacts);
  if (times.empty()) printEnd(out, motion);
  for (const double time : times) printStates(out, motion, time);
}

void requireReached(const Motion& motion, double time) {
  if (time >= 0 && time <= motion.end) return;
  const std::string why = motion.status == MotionStatus::complete ? "" : "; " + motion.message;
  throw InputError("--at", "found the time " + (std::isfinite(time) ? numberText(time) : std::to_string(time)) +
                               ", expected one in [0, " + numberText(motion.end) + "]" + why);
}

/// Of a motion that was stopped, those that it came to.
std::vector<double> timesWithin(const Motion& motion, std::vector<double> times) {
  std::erase_if(times, [&](double time) { return !(time >= 0 && time <= motion.end); });
  return times;
}

Action declareSimulate(CLI::App& app) {
  const auto options = std::make_shared<SimulateArguments>();
  addScene(app, options->scene);
  app.add_option("--at", options->at, "Time at which to print the state [s]; may be repeated")
      ->allow_extra_args(false)
      ->type_name("T");
  app.add_flag("--impacts", options->impacts, "List all impacts; more than 50 are summarised otherwise");
  addMotion(app, options->motion);
  return [options](Output& out) {
    Loaded loaded(out, options->scene, options->motion);
    const Motion motion = loaded.simulate(out);
    const bool stopped = motion.status == MotionStatus::stopped;
    for (const double time : options->at)
      if (!stopped) requireReached(motion, time);
    const std::vector<double> times = timesWithin(motion, options->at);
    if (out.json()) {
      out.document(motionJson(motion, times));
      warnIfEnded(out, motion);
    } else {
      printMotion(out, motion, *options, times);
    }
    return stopped ? exitOf(out.interruption()) : exitOf(motion);
  };
}

}  // namespace

const Command kSimulateCommand{
    "simulate", "Simulate a scene: every impact, and states at any time",
    "Prints every impact (time, bodies, contact point and normal, mode, and margin: the distance from\n"
    "where derivatives do not exist), persistent contacts (which bodies rest, slide, roll, pivot and ride on\n"
    "what, from when to when), and the state at the end or at given times. Bounces lower than a millionth\n"
    "of a body are not reported as impacts; --json has them. More than 50 impacts are summarised by mode,\n"
    "pair and body, unless --impacts.\n"
    "A motion that cannot be continued ends early: the answer says where, when and why, and the exit code\n"
    "is 5. So does one that exceeds --step-limit, or that Ctrl-C stops (exit code 130).\n"
    "\n"
    "Examples:\n"
    "  carom simulate scene.json\n"
    "  carom simulate scene.json --at 0.5 --at 1\n"
    "  carom simulate scene.json --at 1 --digits 17\n"
    "  carom simulate scene.json --impacts | grep floor\n"
    "  carom simulate scene.json --json | jq .events",
    declareSimulate};

}  // namespace carom::cli
