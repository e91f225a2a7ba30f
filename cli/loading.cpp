#include "cli/loading.h"

#include <cmath>

#include "adjoint/simulate.h"
#include "cli/output.h"
#include "formats/json_writer.h"
#include "formats/scene_json.h"

namespace carom::cli {

namespace {

int impactsOf(const Motion& motion, int body, int with) {
  int count = 0;
  while (motion.findImpact(body, count + 1, with)) ++count;
  return count;
}

/// Why a motion does not have a constraint: found and expected.
std::string describeMissing(const Motion& motion, const Constraint& constraint) {
  const When& at = constraint.at;
  const std::string end = numberText(motion.end) + " s";
  std::string reason = motion.status == MotionStatus::complete ? "" : "; " + motion.message;
  if (at.impact == 0) return "found " + numberText(at.time) + ", expected a time up to " + end + reason;
  const int with = at.with.empty() ? -1 : bodyIndex(*motion.scene, at.with);
  const int count = impactsOf(motion, bodyIndex(*motion.scene, constraint.body), with);
  return "found impact " + std::to_string(at.impact) + (at.with.empty() ? "" : " with '" + at.with + "'") + " of '" +
         constraint.body + "', expected one that comes: it has " + (count == 0 ? "none" : std::to_string(count)) +
         " within " + end + reason;
}

}  // namespace

Loaded::Loaded(const std::string& file)
    : path(file), document(readDocument(file)), contacts(inFile(file, [&] { return OdeContacts(document.scene); })) {}

Motion Loaded::simulate() {
  return inFile(path, [&] { return carom::simulate(document.scene, contacts, document.duration); });
}

void warnIfEnded(const Motion& motion) {
  if (motion.status != MotionStatus::complete) Output::warn("the motion ended early: " + motion.message);
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
      if (control.vary != "tilt") control.max.clear();  // the cone of a tilt is no bound of its components
    }
    return EditProblem(document.scene, loaded.contacts, document.duration, unbounded, document.constraints);
  });
}

RowValues requireRows(const std::string& path, const EditProblem& problem, const Motion& motion) {
  RowValues rows = problem.constraints.evaluate(motion);
  if (rows.available) return rows;
  int first = 0;
  while (first + 1 < problem.constraints.size() && !std::isnan(rows.values[first])) ++first;
  const int constraint = problem.constraints.rows()[static_cast<std::size_t>(first)].constraint;
  throw FormatError(path, "/constraints/" + std::to_string(constraint) + "/at",
                    describeMissing(motion, problem.constraints.constraints()[static_cast<std::size_t>(constraint)]));
}

}  // namespace carom::cli
