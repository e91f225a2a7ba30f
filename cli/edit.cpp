// carom edit: solves the edit of a document.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "editing/edit.h"
#include "formats/edit_json.h"
#include "formats/scene_json.h"

namespace carom::cli {
namespace {

struct Options {
  std::string scene, output;
  int iterations = EditOptions{}.max_iterations;
  double seconds = EditOptions{}.time_budget_seconds;
  bool same_sequence = false;
};

void printChanges(Output& out, const EditResult& result) {
  Table table({"control", ">before", "", ">after", ">change"});
  for (const ChangedNumber& number : result.changed)
    table.row({number.name, out.number(number.before), "->", out.number(number.after),
               out.number(number.after - number.before)});
  if (!table.empty()) table.print(out.text());
}

void printResiduals(Output& out, const EditResult& result) {
  Table table({"held", ">value", ">target", ">error"});
  for (const HeldNumber& number : result.residuals)
    table.row({number.name, out.number(number.value), out.number(number.target), out.number(number.error)});
  if (!table.empty()) table.print(out.text());
}

void printLines(Output& out, const char* heading, const std::vector<std::string>& lines) {
  out.text() << heading << '\n';
  for (const std::string& line : lines) out.text() << "    " << line << '\n';
  if (lines.empty()) out.text() << "    no impacts\n";
}

void printResult(Output& out, const EditResult& result) {
  printChanges(out, result);
  out.text() << '\n';
  printResiduals(out, result);
  out.text() << '\n'
             << counted(result.iterations, "iteration") << ", " << Output(false, 3).number(result.milliseconds)
             << " ms, largest error " << out.number(result.residual) << '\n';
  if (result.sequence_before == result.sequence_after) {
    printLines(out, "  impacts, before and after:", result.sequence_before);
  } else {
    printLines(out, "  impacts before:", result.sequence_before);
    printLines(out, "  impacts after:", result.sequence_after);
  }
  out.text() << nameOf(result.status) << ": " << result.message << '\n';
}

EditResult solve(Loaded& loaded, const Options& options) {
  Progress progress;
  EditOptions edit_options;
  edit_options.max_iterations = options.iterations;
  edit_options.time_budget_seconds = options.seconds;
  if (options.same_sequence) edit_options.sequence = SequencePolicy::stay;
  edit_options.progress = [&](const EditProgress& at) {
    const Output numbers(false, 3);
    progress.show("iteration " + std::to_string(at.iteration) + ", largest error " + numbers.number(at.violation) +
                  " of the natural scales, change " + numbers.number(at.objective));
    return true;
  };
  const Document& document = loaded.document;
  return inFile(loaded.path, [&] {
    const Edit edit(document.scene, loaded.contacts, document.duration, document.controls, document.constraints);
    EditResult result = edit.solve(edit_options);
    // A target that the motion does not have is an error of the document, not an outcome of the search.
    if (result.status == EditStatus::bad_start) {
      const EditProblem problem = edit.problem();
      const Motion motion = simulateAt(problem, problem.controls.startValues(), problem.horizon);
      requireRows(loaded.path, problem, motion);
    }
    return result;
  });
}

Exit edit(const Options& options, Output& out) {
  Loaded loaded(options.scene);
  const EditResult result = solve(loaded, options);
  const std::string output = result.solved() ? options.output : "";
  if (!output.empty()) {
    Document edited = loaded.document;
    edited.scene = result.scene;
    saveDocument(output, edited);
  }
  if (out.json()) {
    out.document(editJson(result, output));
  } else {
    printResult(out, result);
    if (!output.empty()) out.text() << "Written: " << output << '\n';
  }
  if (result.solved()) return Exit::done;
  std::cerr << "carom: " << result.message << '\n';
  if (!options.output.empty()) std::cerr << "carom: " << options.output << " was not written\n";
  return Exit::not_solved;
}

Action declare(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  addScene(app, options->scene);
  app.add_option("-o,--output", options->output, "Write the scene with its new values here")->type_name("OUT.json");
  app.add_option("--iterations", options->iterations, "Give up after so many, 200 if not given")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  app.add_option("--seconds", options->seconds, "Give up after so long")->check(positiveNumber())->type_name("T");
  app.add_flag("--same-sequence", options->same_sequence, "Stay within the scene's impact sequence");
  return [options](Output& out) { return edit(*options, out); };
}

}  // namespace

const Command kEditCommand{
    "edit", "Find the smallest change of the controls that meets the constraints",
    "Prints every control before and after, every constrained number with its error, and the impacts\n"
    "before and after. The result is simulated afresh: its errors are those of the edited scene.\n"
    "OUT.json is written only when all constraints are met, whole or not at all; the input stays as it\n"
    "is unless -o names it. Ends with 3 and a sentence where the constraints cannot be met.\n"
    "\n"
    "Examples:\n"
    "  carom edit scene.json\n"
    "  carom edit scene.json -o edited.json && carom export edited.json -o edited.glb\n"
    "  carom edit scene.json --json | jq .changed\n"
    "  carom edit scene.json --same-sequence --seconds 2",
    declare};

}  // namespace carom::cli
