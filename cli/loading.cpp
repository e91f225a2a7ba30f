// SPDX-License-Identifier: MIT
#include "cli/loading.h"

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "editing/problem/controls/control_kinds.hpp"
#include "editing/problem/rows/refined_times.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::cli {

using namespace adjoint_detail;
using namespace editing_detail;
using namespace formats_detail;

namespace {

int impactsOf(const Motion& motion, int body, int with) {
  int count = 0;
  while (motion.findImpact(body, count + 1, with)) ++count;
  return count;
}

std::string whyEnded(const Motion& motion) {
  return motion.status == MotionStatus::complete ? "" : "; " + motion.message;
}

/// Where in its constraint a region is, and that the motion ends before its time does.
std::pair<std::string, std::string> describeMissingRegion(const Motion& motion, const Constraint& constraint,
                                                          int index) {
  const auto chosen = static_cast<std::size_t>(index);
  const Region& region = constraint.regions[chosen];
  int before = 0, all = 0;  // of its side
  for (std::size_t i = 0; i < constraint.regions.size(); ++i) {
    if (constraint.regions[i].side != region.side) continue;
    ++all;
    if (i < chosen) ++before;
  }
  std::string place = region.side == Region::Side::avoid ? "/avoid" : "/inside";
  if (all > 1) place += "/" + std::to_string(before);
  if (region.during) place += "/during/1";
  const std::string found = region.during ? numberText(region.during->second) : "a region of the whole motion";
  return {place, "found " + found + ", expected a time up to " + numberText(motion.end) + " s" + whyEnded(motion)};
}

/// Why a motion does not have a constraint: found and expected.
std::string describeMissing(const Motion& motion, const Constraint& constraint) {
  const When& at = constraint.at;
  const std::string end = numberText(motion.end) + " s";
  const std::string reason = whyEnded(motion);
  if (at.impact == 0) {
    const double time = at.span ? at.span->first : at.time;
    return "found " + numberText(time) + ", expected a time up to " + end + reason;
  }
  const int with = at.with.empty() ? -1 : bodyIndex(*motion.scene, at.with);
  const int count = impactsOf(motion, bodyIndex(*motion.scene, constraint.body), with);
  return "found impact " + std::to_string(at.impact) + (at.with.empty() ? "" : " with '" + at.with + "'") + " of '" +
         constraint.body + "', expected one that comes: it has " + (count == 0 ? "none" : std::to_string(count)) +
         " within " + end + reason;
}

Document readScene(const Output& out, const std::string& file) {
  const Progress progress(out, "reading");
  return readSceneFrom(file);
}

}  // namespace

Loaded::Loaded(const Output& out, const std::string& file, const MotionArguments& arguments)
    : path(nameOfInput(file)),
      document(readScene(out, file)),
      contacts(inFile(path, [&] {
        const Progress progress(out, "searching for overlaps");
        WorkCount work(arguments.step_limit, {}, nullptr);
        try {
          return OdeContacts(document.scene, &work);
        } catch (const WorkEnded&) {
          throw InputError("/bodies", "found so many bodies near each other that finding their overlaps takes more than " +
                                          std::to_string(arguments.step_limit) +
                                          " steps, expected fewer, or a higher "
                                          "--step-limit");
        }
      })),
      step_limit(arguments.step_limit) {
  if (arguments.strict && !document.repairs.empty()) {
    const FileRepair& first = document.repairs.front();
    throw FormatError(path, "/bodies", "found " + first.file + " in need of repair (" + first.what +
                                           "), expected meshes to be taken as they are, or no --strict");
  }
  for (const FileRepair& repair : document.repairs) out.warn(repair.file + " was repaired: " + repair.what);
  const std::vector<StartOverlap> overlaps = contacts.overlaps();
  if (arguments.refuse_overlaps && !overlaps.empty()) inFile(path, [&] { refuseOverlap(document.scene, overlaps.front()); });
}

void warnOfOverlaps(const Output& out, const Loaded& loaded) {
  for (const StartOverlap& overlap : loaded.contacts.overlaps())
    out.warn(describeOverlapAtStart(loaded.document.scene, overlap));
}

Motion Loaded::simulate(const Output& out) {
  Progress progress(out, "simulating");
  const Interruption::Stoppable stoppable(out.interruption());
  SimulateOptions options;
  options.step_limit = step_limit;
  options.stop = stoppable.token();
  options.progress = [&](const SimulateProgress& at) {
    progress.show(Output::brief(at.time) + " s of " + Output::brief(document.duration) + " s, " +
                  counted(at.impacts, "impact") + ", " + std::to_string(at.steps) + " steps");
  };
  return inFile(path, [&] { return carom::simulate(document.scene, contacts, document.duration, options); });
}

void requireNotStopped(const Motion& motion) {
  if (motion.status == MotionStatus::stopped) throw Interrupted("the motion was " + motion.message);
}

void warnIfEnded(const Output& out, const Motion& motion) {
  if (motion.status != MotionStatus::complete) out.warn("the motion ended early: " + motion.message);
}

Exit exitOf(const Motion& motion) {
  return motion.status == MotionStatus::complete ? Exit::done : Exit::ended_early;
}

EditProblem derivativeProblem(Loaded& loaded) {
  return inFile(loaded.path, [&] {
    const Document& document = loaded.document;
    if (document.controls.empty()) throw InputError("/controls", "found none, expected at least one");
    if (document.constraints.empty()) throw InputError("/constraints", "found none, expected at least one");
    const ControlSet checked(document.scene, document.controls);
    std::vector<Control> unbounded = document.controls;
    for (Control& control : unbounded) {
      control.min.clear();
      // the cone of a tilt is no bound of its components
      if (findControlKind(control.vary)->owner != OwnerKind::impact) control.max.clear();
    }
    std::vector<Constraint> rows = document.constraints;
    for (Constraint& constraint : rows) constraint.soft.reset();  // their errors have derivatives, too
    EditProblem problem(document.scene, loaded.contacts, document.duration, unbounded, rows);
    problem.step_limit = loaded.step_limit;
    return problem;
  });
}

Motion simulateStoppable(const Output& out, EditProblem& problem, const Eigen::VectorXd& values) {
  const Interruption::Stoppable stoppable(out.interruption());
  problem.stop = stoppable.token();
  Motion motion = simulateAt(problem, values, problem.horizon);
  problem.stop = {};
  requireNotStopped(motion);
  return motion;
}

RowValues requireRows(const std::string& path, const EditProblem& problem, const Motion& motion) {
  RowValues rows = problem.constraints.evaluate(motion, refinedTimes(problem.constraints, motion));
  if (rows.available) return rows;
  const std::vector<Constraint>& held = problem.constraints.constraints();
  for (std::size_t i = 0; i < held.size(); ++i) {  // what has no number may be what is not there
    const char* word = held[i].hits                ? "/hits"
                       : !held[i].sequence.empty() ? "/sequence"
                       : held[i].at.rest           ? "/at/rest"
                                                   : "";
    if (*word && !rows.lacking.empty() && rows.lacking.front().constraint == static_cast<int>(i))
      throw FormatError(path, "/constraints/" + std::to_string(i) + word, rows.lacking.front().sentence);
  }
  int first = 0;
  while (first + 1 < problem.constraints.size() && !std::isnan(rows.values[first])) ++first;
  const Row& row = problem.constraints.rows()[static_cast<std::size_t>(first)];
  const Constraint& constraint = problem.constraints.constraints()[static_cast<std::size_t>(row.constraint)];
  const std::string where = "/constraints/" + std::to_string(row.constraint);
  if (row.region >= 0) {
    const auto [place, reason] = describeMissingRegion(motion, constraint, row.region);
    throw FormatError(path, where + place, reason);
  }
  if (row.overSpan()) throw FormatError(path, where + "/closest_approach", rows.message);
  throw FormatError(path, where + "/at" + (constraint.at.span ? "/between/0" : ""),
                    describeMissing(motion, constraint));
}

}  // namespace carom::cli
