#include "cli/loading.h"

#include <CLI/App.hpp>
#include <cmath>

#include "adjoint/simulate.h"
#include "cli/output.h"
#include "formats/scene_json.h"

namespace carom::cli {

void addScene(CLI::App& app, std::string& path) {
  app.add_option("scene", path, "The scene document")->required()->type_name("S.json");
}

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
    if (document.controls.empty()) throw InputError("/controls", "found none, expected at least one number that varies");
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

void requireRows(const std::string& path, const EditProblem& problem, const RowValues& rows) {
  if (rows.available) return;
  int constraint = 0;
  for (int i = problem.constraints.size() - 1; i >= 0; --i)
    if (std::isnan(rows.values[i])) constraint = problem.constraints.rows()[static_cast<std::size_t>(i)].constraint;
  throw FormatError(path, "/constraints/" + std::to_string(constraint) + "/at", rows.message);
}

}  // namespace carom::cli
