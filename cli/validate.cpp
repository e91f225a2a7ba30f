// SPDX-License-Identifier: MIT
// carom validate: whether a document can be simulated and edited.
#include <CLI/App.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "formats/status_json.h"

namespace carom::cli {
namespace {

/// Everything that other commands could refuse, up to constraints that the motion does not have.
void checkEdit(Loaded& loaded) {
  const Document& document = loaded.document;
  const EditProblem problem = inFile(loaded.path, [&] {
    return EditProblem(document.scene, loaded.contacts, document.duration, document.controls, document.constraints);
  });
  if (document.constraints.empty()) return;
  const Eigen::VectorXd values = problem.controls.startValues();
  const Motion motion = inFile(loaded.path, [&] { return simulateAt(problem, values, problem.horizon); });
  requireRows(loaded.path, problem, motion);
  for (const std::string& note : problem.controls.notes()) Output::warn(note);
}

struct Options {
  std::string scene;
  bool refuse_overlaps = false;
};

Exit validate(const Options& options, Output& out) {
  const std::string& path = options.scene;
  Loaded loaded(path, options.refuse_overlaps);
  warnOfOverlaps(loaded);
  checkEdit(loaded);
  const Document& document = loaded.document;
  const std::string message = "The document is valid.";
  if (out.json()) {
    out.document(validateJson(path, document, message));
  } else {
    const auto count = [](const auto& items, const char* noun) {
      return counted(static_cast<long long>(items.size()), noun);
    };
    const std::size_t bodies = document.scene.bodies.size();
    out.text() << path << ": valid: " << bodies << (bodies == 1 ? " body, " : " bodies, ")
               << count(document.controls, "control") << ", " << count(document.constraints, "constraint") << '\n';
  }
  return Exit::done;
}

Action declare(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  addScene(app, options->scene);
  addRefuseOverlaps(app, options->refuse_overlaps);
  return [options](Output& out) { return validate(*options, out); };
}

}  // namespace

const Command kValidateCommand{
    "validate", "Check a scene document, to the last constraint",
    "Checks the text, every member, the physics (masses, moments, sizes), and that the motion has every\n"
    "impact and time that constraints name. An error says where it is (file and JSON pointer), what was\n"
    "found and what was expected, and ends with 1. Bodies that overlap at the start are a warning, or an\n"
    "error with --refuse-overlaps.\n"
    "\n"
    "Examples:\n"
    "  carom validate scene.json\n"
    "  carom validate scene.json --json",
    declare};

}  // namespace carom::cli
