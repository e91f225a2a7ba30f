// SPDX-License-Identifier: MIT
// carom edit: solves the edit of a document.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/impacts.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "cli/table.h"
#include "cli/units.h"
#include "editing/edit.h"
#include "editing/problem/edit_problem.hpp"
#include "editing/problem_of.hpp"
#include "formats/answers/edit_json.hpp"

namespace carom::cli {

using namespace formats_detail;
using namespace adjoint_detail;
using namespace editing_detail;

namespace {

struct EditArguments {
  std::string scene, output;
  int iterations = EditOptions{}.max_iterations;
  double seconds = EditOptions{}.time_budget_seconds;
  bool same_sequence = false, impacts = false;
  MotionArguments motion;
  int alternatives = 1, threads = 0, seed = 0;
  std::string effort = "normal";
};

/// Whole percents, as shares are compared by eye.
std::string percent(double share) {
  const long whole = std::lround(100 * share);
  return whole == 0 && share > 0 ? "<1 %" : std::to_string(whole) + " %";
}

/// Fitted numbers have a standard deviation in place of their share of the change.
void printNumbers(Output& out, const std::vector<ChangedNumber>& changed, bool fitted = false) {
  Table table({"control", ">before", "", ">after", ">change", "unit", fitted ? ">std. deviation" : ">share"});
  const auto last = [&](const ChangedNumber& number) {
    if (!fitted) return percent(number.share);
    return number.standard_deviation ? out.rounded(*number.standard_deviation) : std::string("-");
  };
  for (const ChangedNumber& number : changed)
    table.row({number.name, out.roundedBeside(number.before, number.after), "->",
               out.roundedBeside(number.after, number.before), out.rounded(number.after - number.before),
               unitOf(number.name), last(number)});
  if (!table.empty()) table.print(out);
}

/// A value on its target reads as the target does, which is as it was written.
std::string valueBesideTarget(const Output& out, const ConstrainedNumber& number) {
  const bool on_target =
      number.lower == number.upper && std::abs(number.error) <= 1e-6 * std::max(1e-3, std::abs(number.target));
  return on_target ? out.number(number.target) : out.roundedBeside(number.value, number.target);
}

void printConstrained(Output& out, const char* heading, const std::vector<ConstrainedNumber>& numbers) {
  Table table({heading, ">value", ">target", ">error", "unit"});
  for (const ConstrainedNumber& number : numbers)
    table.row({number.name, valueBesideTarget(out, number),
               describeWanted(out, number.target, number.lower, number.upper), out.rounded(number.error),
               unitOf(number.name)});
  if (!table.empty()) table.print(out);
}

void printFit(Output& out, const Fit& fit) {
  if (fit.rows == 0) return;
  out.text() << "  fit: sum of squares " << out.rounded(fit.sum_of_squares) << " of " << counted(fit.rows, "error");
  if (fit.deviation) out.text() << ", standard deviation of one " << out.rounded(*fit.deviation) << " natural scales";
  out.text() << '\n';
  if (!fit.message.empty()) out.text() << "  " << fit.message << '\n';
}

void printResiduals(Output& out, const EditResult& result) {
  printConstrained(out, "constraint", result.residuals);
  printConstrained(out, "soft constraint", result.soft_residuals);
  printFit(out, result.fit);
  for (const MetTime& met : result.times) out.text() << "  " << met.name << ": at " << out.rounded(met.time) << " s\n";
}

void printCertificate(Output& out, const Certificate& certificate) {
  if (!certificate.taken) return;
  out.text() << "  certificate: energy drifts by " << Output::brief(certificate.energy_drift) << " and grows by "
             << Output::brief(certificate.energy_gain) << " at impacts";
  if (certificate.deepest_penetration)
    out.text() << ", bodies overlap by " << Output::brief(*certificate.deepest_penetration) << " m";
  out.text() << ", derivatives pass " << counted(certificate.reliability.events, "impact") << " with a margin of "
             << Output::brief(certificate.reliability.smallest_margin) << '\n';
  if (!certificate.signature_event.empty()) out.text() << "  nearest boundary of the impact sequence: " << certificate.signature_event << '\n';
}

void printResult(Output& out, const EditResult& result, bool all_impacts) {
  printNumbers(out, result.changed, result.fit.rows > 0);
  out.text() << '\n';
  printResiduals(out, result);
  const bool in_seconds = result.milliseconds >= 1000;
  out.text() << '\n'
             << counted(result.iterations, "iteration") << ", "
             << Output::brief(in_seconds ? result.milliseconds / 1000 : result.milliseconds) << (in_seconds ? " s\n" : " ms\n");
  if (result.status != EditStatus::infeasible) {  // there nothing has changed, and the motion of the start is not the answer
    printSequences(out, result.sequence_before, result.sequence_after, all_impacts);
    printCertificate(out, result.certificate);
  }
  const char* heading = "  reasons:\n";
  for (const std::string& sentence : result.why_not.sentences) {
    if (result.message.find(sentence) != std::string::npos) continue;
    out.text() << heading << "    " << sentence << '\n';
    heading = "";
  }
  if (result.solved()) out.text() << out.styled(Look::good, nameOf(result.status)) << ": " << result.message << '\n';
}

/// What other impacts a solution has up to the last constraint.
void printChanges(Output& out, const std::vector<SequenceChange>& changes) {
  constexpr int kMost = 10;
  int count = 0;
  for (const SequenceChange& change : changes)
    if (change.matters && ++count <= kMost) out.text() << "  " << change.sentence << '\n';
  if (count > kMost) out.text() << "  " << counted(count - kMost, "more difference") << '\n';
}

void printAlternatives(Output& out, const EditResult& result) {
  for (std::size_t i = 0; i < result.alternatives.size(); ++i) {
    const EditAlternative& other = result.alternatives[i];
    out.text() << "\nSolution " << i + 2 << ": change " << out.roundedBeside(other.objective, result.objective)
               << " (solution 1: " << out.roundedBeside(result.objective, other.objective) << "), largest error "
               << out.rounded(other.residual) << '\n';
    if (other.much_dearer) out.text() << "  It costs more than " << kMuchDearer << " times as much as solution 1.\n";
    printNumbers(out, other.changed);
    printChanges(out, other.sequence_changes);
  }
}

/// OUT.json for the first solution, OUT-2.json, OUT-3.json, ... for the others.
std::string fileOfSolution(const std::string& output, std::size_t number) {
  if (number == 1) return output;
  std::filesystem::path path(output);
  const std::string name = path.stem().string() + "-" + std::to_string(number) + path.extension().string();
  return path.replace_filename(name).string();
}

/// Of an edit that was stopped, the best so far is worth a file, if it is other than the start.
bool isWorthWriting(const EditResult& result) {
  return result.met || (result.status == EditStatus::cancelled && result.objective > 0);
}

/// Writes the solutions; the files that were written.
std::vector<std::string> saveSolutions(Output& out, const Document& document, const EditResult& result,
                                       const std::string& output) {
  if (output.empty() || !isWorthWriting(result)) return {};
  std::vector<std::string> files;
  const auto write = [&](const Scene& scene) {
    Document edited = document;
    edited.scene = scene;
    files.push_back(fileOfSolution(output, files.size() + 1));
    saveSceneTo(out, files.back(), edited);
  };
  write(result.scene);
  for (const EditAlternative& other : result.alternatives) write(other.scene);
  return files;
}

Effort effortOf(const std::string& word) {
  return word == "fast" ? Effort::fast : word == "thorough" ? Effort::thorough : Effort::normal;
}

EditResult solve(const Output& out, Loaded& loaded, const EditArguments& options) {
  Progress progress(out, "solving");
  const Interruption::Stoppable stoppable(out.interruption());
  EditOptions edit_options;
  edit_options.max_iterations = options.iterations;
  edit_options.time_budget_seconds = options.seconds;
  edit_options.alternatives = options.alternatives;
  edit_options.threads = options.threads;
  edit_options.seed = options.seed;
  edit_options.effort = effortOf(options.effort);
  edit_options.step_limit = options.motion.step_limit;
  edit_options.stop = stoppable.token();
  if (options.same_sequence) edit_options.sequence = SequencePolicy::stay;
  edit_options.progress = [&](const EditProgress& at) {
    progress.show("iteration " + std::to_string(at.iteration) + ", largest error " + Output::brief(at.violation) +
                  " of the natural scales, change " + Output::brief(at.objective));
    return true;
  };
  const Document& document = loaded.document;
  return inFile(loaded.path, [&] {
    const Edit edit(document.scene, loaded.contacts, document.duration, document.controls, document.constraints);
    EditResult result = edit.solve(edit_options);
    // A target that the motion does not have is an error of the document, not an outcome of the search.
    if (result.status == EditStatus::bad_start) {
      EditProblem problem = problemOf(edit);
      problem.step_limit = options.motion.step_limit;
      const Motion motion = simulateAt(problem, problem.controls.startValues(), problem.horizon);
      requireRows(loaded.path, problem, motion);
    }
    return result;
  });
}

/// What went wrong, and what follows for the file.
std::string describeFailure(const EditResult& result, const std::string& output, bool written) {
  const std::string sentence = std::string(nameOf(result.status)) + ": " + result.message;
  if (output.empty()) return sentence;
  const std::string best = result.met ? "best solution so far" : "nearest point so far, which does not meet the constraints,";
  if (written) return sentence + " The " + best + (isStandard(output) ? " was written." : " is in " + output + ".");
  return sentence + " " + (isStandard(output) ? "Nothing" : output) + " was " + (isStandard(output) ? "" : "not ") +
         "written.";
}

Exit edit(const EditArguments& options, Output& out) {
  if (isStandard(options.output)) {
    if (options.alternatives > 1) throw UsageError("--alternatives needs a file for each solution, not -o -");
    out.reserveForContent();
  }
  for (std::size_t k = 1; !options.output.empty() && k <= static_cast<std::size_t>(options.alternatives); ++k)
    requireOutput(fileOfSolution(options.output, k));
  Loaded loaded(out, options.scene, options.motion);
  warnOfOverlaps(out, loaded);
  const EditResult result = solve(out, loaded, options);
  const std::vector<std::string> files = saveSolutions(out, loaded.document, result, options.output);
  if (out.json()) {
    out.document(editJson(result, files));
  } else {
    printResult(out, result, options.impacts);
    printAlternatives(out, result);
    if (result.solved())
      for (const std::string& file : files) sayWritten(out, file);
  }
  const bool stopped = out.interruption().signal() != 0;
  if (!result.solved()) out.fail(describeFailure(result, options.output, !files.empty()));
  if (stopped) return exitOf(out.interruption());
  return result.solved() ? Exit::done : Exit::not_solved;
}

Action declareEdit(CLI::App& app) {
  const auto options = std::make_shared<EditArguments>();
  addScene(app, options->scene);
  addMotion(app, options->motion);
  addOutput(app, options->output, "Write the scene with its new values here; - for standard output", "OUT.json");
  app.add_option("--iterations", options->iterations, "Maximum number of iterations (default: 10000)")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  app.add_option("--seconds", options->seconds, "Time limit in seconds (default: none)")->check(positiveNumber())->type_name("T");
  app.add_flag("--same-sequence", options->same_sequence, "Keep the impact sequence of the scene");
  app.add_flag("--impacts", options->impacts, "List all impacts; more than 50 are summarised otherwise");
  app.add_option("--alternatives", options->alternatives, "Number of distinct solutions to search for (default: 1)")
      ->check(CLI::Range(1, 100))
      ->type_name("K");
  app.add_option("--effort", options->effort,
                 "Work limit of the search for a smaller change: fast, normal or thorough (default: normal)")
      ->check(CLI::IsMember({"fast", "normal", "thorough"}))
      ->type_name("E");
  app.add_option("--seed", options->seed, "Seed of the sample sequence of the search (default: 0)")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  app.add_option("--threads", options->threads, "Threads of the search (default: all cores); does not affect the result")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  return [options](Output& out) { return edit(*options, out); };
}

}  // namespace

const Command kEditCommand{
    "edit", "Find the smallest change of the controls that meets the constraints",
    "Prints every control before and after with its share of the cost, every constrained quantity with\n"
    "its error, and the impacts before and after (of more than 50 only where they differ, unless\n"
    "--impacts). Numbers have three digits, or as many as distinguish before from after; --json has all.\n"
    "The edited scene is simulated again: the errors are those of its motion.\n"
    "OUT.json is written atomically, only if all constraints are met; the input is unchanged unless -o\n"
    "names it. Ctrl-C ends the search: the best point so far is verified, printed and written, even if\n"
    "it does not meet them; its status is cancelled, and the exit code 130; a second Ctrl-C ends it at\n"
    "once. With --alternatives further solutions go to OUT-2.json, OUT-3.json, ...: each has another\n"
    "impact sequence, or clearly different numbers; the smallest change comes first; those that cost\n"
    "more than ten times as much come last and are marked. Exits with 3 and a message if the\n"
    "constraints cannot be met.\n"
    "\n"
    "Examples:\n"
    "  carom edit scene.json\n"
    "  carom edit scene.json -o edited.json && carom export edited.json -o edited.glb\n"
    "  carom edit scene.json -o - | carom export - --format svg -o edited.svg\n"
    "  carom edit scene.json --json | jq .changed\n"
    "  carom edit scene.json --same-sequence --seconds 2\n"
    "  carom edit scene.json --alternatives 3 -o edited.json",
    declareEdit};

}  // namespace carom::cli
