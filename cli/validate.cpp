// SPDX-License-Identifier: MIT
// carom validate: whether a document can be simulated and edited.
#include <CLI/App.hpp>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "formats/answers/status_json.hpp"

namespace carom::cli {

using namespace formats_detail;
using namespace adjoint_detail;
using namespace editing_detail;

namespace {

/// Everything that other commands could refuse, up to constraints that the motion does not have.
void checkEdit(const Output& out, Loaded& loaded) {
  std::optional<Progress> progress(std::in_place, out, "checking");
  const Document& document = loaded.document;
  EditProblem problem = inFile(loaded.path, [&] {
    return EditProblem(document.scene, loaded.contacts, document.duration, document.controls, document.constraints);
  });
  if (document.constraints.empty()) return;
  problem.step_limit = loaded.step_limit;
  const Eigen::VectorXd values = problem.controls.startValues();
  const Motion motion = inFile(loaded.path, [&] { return simulateStoppable(out, problem, values); });
  requireRows(loaded.path, problem, motion);
  progress.reset();
  for (const std::string& note : problem.controls.notes()) out.warn(note);
}

struct ValidateArguments {
  std::string scene;
  MotionArguments motion;
};

Exit validate(const ValidateArguments& options, Output& out) {
  const std::string& path = options.scene;
  Loaded loaded(out, path, options.motion);
  warnOfOverlaps(out, loaded);
  checkEdit(out, loaded);
  const Document& document = loaded.document;
  const std::string message = "The document is valid.";
  if (out.json()) {
    out.document(validateJson(loaded.path, document, message));
  } else {
    out.text() << loaded.path << ": " << out.styled(Look::good, "valid") << ": "
               << counted(document.scene.bodies.size(), "body", "bodies") << ", "
               << counted(document.controls.size(), "control") << ", "
               << counted(document.constraints.size(), "constraint") << '\n';
  }
  return Exit::done;
}

Action declareValidate(CLI::App& app) {
  const auto options = std::make_shared<ValidateArguments>();
  addScene(app, options->scene);
  addMotion(app, options->motion);
  return [options](Output& out) { return validate(*options, out); };
}

}  // namespace

const Command kValidateCommand{
    "validate", "Validate a scene document completely",
    "Checks the text, every member, the physics (masses, moments, sizes), and that the motion has every\n"
    "impact and time used by constraints. An error gives the place (file and JSON pointer), what was\n"
    "found and what was expected; the exit code is 1. Bodies that overlap at the start are a warning, or an\n"
    "error with --refuse-overlaps.\n"
    "\n"
    "Examples:\n"
    "  carom validate scene.json\n"
    "  carom validate scene.json --json",
    declareValidate};

}  // namespace carom::cli
