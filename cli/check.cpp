// SPDX-License-Identifier: MIT
// carom check: the derivatives by adjoint and by tangent, beside differences over a sweep of steps.
#include <CLI/App.hpp>
#include <algorithm>
#include <memory>

#include "cli/check_differences.h"
#include "cli/command.h"
#include "cli/impacts.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/table.h"

namespace carom::cli {

using namespace adjoint_detail;
using namespace editing_detail;
using namespace formats_detail;

namespace {

struct CheckArguments {
  std::string scene;
  bool impacts = false;
  MotionArguments motion;
};

constexpr std::size_t kMostDifferences = 20;  // sequences that differ, in text; --json has all

std::string line(const std::vector<std::string>& sequence, std::size_t k) {
  return k < sequence.size() ? sequence[k] : "no more impacts";
}

/// The first impact in which the sequence on one side is not that of the scene itself; empty when there is none.
std::string firstDifference(const std::vector<std::string>& side, const std::vector<std::string>& sequence) {
  const std::size_t longest = std::max(side.size(), sequence.size());
  for (std::size_t k = 0; k < longest; ++k) {
    if (k < side.size() && k < sequence.size() && side[k] == sequence[k]) continue;
    return "impact " + std::to_string(k + 1) + " is " + line(side, k) + ", not " + line(sequence, k);
  }
  return "";
}

void printSteps(Output& out, const EditProblem& problem, const DerivativeCheck& check) {
  out.text() << "\nCentral differences, by step (of each control's natural scale):\n";
  Table table({">step", ">columns compared", ">worst disagreement", "worst column"});
  for (std::size_t s = 0; s < check.steps.size(); ++s) {
    int compared = 0, worst = -1;
    for (std::size_t j = 0; j < check.columns.size(); ++j) {
      const DifferenceColumn& column = check.columns[j][s];
      if (!column.compared) continue;
      ++compared;
      const bool worse =
          worst < 0 || !(column.disagreement <= check.columns[static_cast<std::size_t>(worst)][s].disagreement);
      if (worse) worst = static_cast<int>(j);
    }
    const bool any_compared = worst >= 0;
    table.row({out.number(check.steps[s]), std::to_string(compared) + " of " + std::to_string(check.columns.size()),
               any_compared ? out.number(check.columns[static_cast<std::size_t>(worst)][s].disagreement) : "-",
               any_compared ? problem.controls.describeVariable(worst) : "-"});
  }
  table.print(out);
}

void printColumns(Output& out, const EditProblem& problem, const DerivativeCheck& check) {
  out.text() << "\nEvery column at its best step:\n";
  Table table({"control", ">best step", ">disagreement", "scheme"});
  for (int j = 0; j < problem.controls.size(); ++j) {
    const auto c = static_cast<std::size_t>(j);
    const int best = check.best_step[c];
    if (best < 0) {
      table.row({problem.controls.describeVariable(j), "-", "-", "not compared: " + check.columns[c].back().why});
      continue;
    }
    const auto s = static_cast<std::size_t>(best);
    table.row({problem.controls.describeVariable(j), out.number(check.steps[s]),
               out.number(check.columns[c][s].disagreement), check.columns[c][s].scheme});
  }
  table.print(out);
}

void printComparison(Output& out, const EditProblem& problem, const DerivativeCheck& check, bool all_impacts) {
  out.text() << "\nImpact sequence up to the last constraint:\n";
  printSequence(out, check.sequence, all_impacts);
  std::size_t differing = 0;
  std::ostringstream lines;
  for (int j = 0; j < problem.controls.size(); ++j) {
    for (std::size_t s = 0; s < check.steps.size(); ++s) {
      const DifferenceColumn& column = check.columns[static_cast<std::size_t>(j)][s];
      if (column.compared || ++differing > kMostDifferences) continue;
      lines << "  " << problem.controls.describeVariable(j) << ", step " << out.number(check.steps[s]) << ": "
            << column.why << '\n';
      const std::string below = firstDifference(column.below, check.sequence);
      const std::string above = firstDifference(column.above, check.sequence);
      if (!below.empty()) lines << "    below: " << below << '\n';
      if (!above.empty()) lines << "    above: " << above << '\n';
    }
  }
  out.text() << (differing == 0 ? "It is the same on both sides of every step.\n"
                                : "Not compared, because a motion on one side has another sequence:\n")
             << lines.str();
  if (differing > kMostDifferences) out.text() << "  and " << differing - kMostDifferences << " more\n";
}

void printEntry(Output& out, const EditProblem& problem, const DerivativeCheck& check, const char* other_name,
                const DerivativeCheck::Entry& entry, const Eigen::MatrixXd& other) {
  if (entry.row < 0) return;
  out.text() << "Worst entry, adjoint against " << other_name << ": " << out.number(entry.disagreement)
             << " of its column's scale\n  " << problem.constraints.describeRow(entry.row) << " with respect to "
             << problem.controls.describeVariable(entry.column) << ": "
             << Output::full(check.by_adjoint(entry.row, entry.column)) << " against "
             << Output::full(other(entry.row, entry.column)) << '\n';
}

Exit check(const CheckArguments& arguments, Output& out) {
  Loaded loaded(out, arguments.scene, arguments.motion);
  warnOfOverlaps(out, loaded);
  EditProblem problem = derivativeProblem(loaded);
  const Eigen::VectorXd values = problem.controls.startValues();
  const Motion motion = inFile(loaded.path, [&] { return simulateStoppable(out, problem, values); });
  requireRows(loaded.path, problem, motion);
  DerivativeCheck result;
  {
    Progress progress(out, "checking");
    result = checkDerivatives(problem, values, [&](const std::string& text) { progress.show(text); });
  }
  if (out.json()) {
    out.document(checkJson(problem, result));
  } else {
    printComparison(out, problem, result, arguments.impacts);
    printSteps(out, problem, result);
    printColumns(out, problem, result);
    out.text() << '\n';
    printEntry(out, problem, result, "tangent", result.adjoint_tangent, result.by_tangent);
    printEntry(out, problem, result, "differences", result.differences, result.by_differences);
    if (result.passed) out.text() << out.styled(Look::good, result.message) << '\n';
  }
  if (result.passed) return Exit::done;
  out.fail(result.message);
  return Exit::check_failed;
}

Action declareCheck(CLI::App& app) {
  const auto arguments = std::make_shared<CheckArguments>();
  addScene(app, arguments->scene);
  addMotion(app, arguments->motion);
  app.add_flag("--impacts", arguments->impacts, "List all impacts, not only the first 50");
  return [arguments](Output& out) { return check(*arguments, out); };
}

}  // namespace

const Command kCheckCommand{
    "check", "Compare adjoint, tangent and finite-difference derivatives of a scene",
    "Computes the Jacobian of `carom gradient` by the adjoint pass, the tangent pass, and central\n"
    "differences over a sweep of steps. Differences are compared only if the motions on both sides have\n"
    "the impact sequence of the scene. Exits with 4 if adjoint and tangent disagree by more than 1e-12, or\n"
    "differences at their best step by more than 1e-6, relative to the scale of the column, and by more\n"
    "than the rounding of cancelling terms: 20 times the change of the entry in scenes whose numbers\n"
    "differ in their last digits. If that excuses more than 5 % of the nonzero entries, a whole row, or\n"
    "more than 1 % of a column, there is no verdict, and it exits with 4, too. Columns that cannot be\n"
    "compared at any step are listed, and do not fail the check as long as others can.\n"
    "\n"
    "Examples:\n"
    "  carom check scene.json\n"
    "  carom check scene.json --json | jq .worst_differences",
    declareCheck};

}  // namespace carom::cli
