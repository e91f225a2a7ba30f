// SPDX-License-Identifier: MIT
// carom gradient: the exact derivative of every constrained number by every control number.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/table.h"
#include "cli/units.h"
#include "formats/answers/gradient_json.hpp"

namespace carom::cli {

using namespace adjoint_detail;
using namespace editing_detail;
using namespace formats_detail;

namespace {

struct GradientArguments {
  std::string scene, method = "adjoint";
  MotionArguments motion;
};

/// The worst of all rows, with everything there is to say about it.
Reliability judge(const EditProblem& problem, const std::vector<Reliability>& rows) {
  Reliability all;
  for (const Reliability& row : rows) {
    if (all.reliable && !row.reliable) all = row;
  }
  for (const std::string& note : problem.controls.notes()) all.message += (all.message.empty() ? "" : " ") + note;
  return all;
}

void printGradient(Output& out, const EditProblem& problem, const Eigen::VectorXd& values,
                   const RowsAndJacobian& result, const Reliability& reliability) {
  out.text() << "Derivative of every number that is held (rows) by every number that may vary (columns), "
                "the row's unit by the column's\n";
  Table columns({"column", "control", ">value", "unit"});
  for (int j = 0; j < problem.controls.size(); ++j)
    columns.row({std::to_string(j + 1), problem.controls.describeVariable(j), out.number(values[j]),
                 unitOf(problem.controls.describeVariable(j))});
  out.text() << '\n';
  columns.print(out);

  std::vector<std::string> headings{"held", ">value", ">target", "unit"};
  for (int j = 0; j < problem.controls.size(); ++j) headings.push_back(">by " + std::to_string(j + 1));
  Table rows(headings);
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const Row& row = problem.constraints.rows()[static_cast<std::size_t>(i)];
    std::vector<std::string> cells{problem.constraints.describeRow(i), out.number(result.rows.values[i]),
                                   describeWanted(out, row.target, row.lower, row.upper), unitOf(row.name)};
    for (int j = 0; j < problem.controls.size(); ++j) cells.push_back(out.number(result.jacobian(i, j)));
    rows.row(cells);
  }
  out.text() << '\n';
  rows.print(out);
  for (const HeldTime& held : problem.constraints.heldTimes(result.motion, result.rows.times)) {
    const bool rests = problem.constraints.constraints()[static_cast<std::size_t>(held.constraint)].at.rest;
    out.text() << "  of " << problem.constraints.describeConstraint(held.constraint) << ": at "
               << out.number(held.time) << (rests ? " s\n" : " s, where it is nearest\n");
  }
  out.text() << '\n'
             << (reliability.reliable ? out.styled(Look::good, "Reliable") + ": no impact on the way is near a place "
                                                                             "where derivatives stop.\n"
                                      : out.styled(Look::warning, "Not reliable.") + '\n');
  if (!reliability.message.empty()) out.text() << reliability.message << '\n';
}

Exit gradient(const GradientArguments& options, Output& out) {
  Loaded loaded(out, options.scene, options.motion);
  warnOfOverlaps(out, loaded);
  EditProblem problem = derivativeProblem(loaded);
  const Eigen::VectorXd values = problem.controls.startValues();
  RowsAndJacobian result;
  std::optional<Progress> progress(std::in_place, out, "differentiating");
  result.motion = inFile(loaded.path, [&] { return simulateStoppable(out, problem, values); });
  result.rows = requireRows(loaded.path, problem, result.motion);
  // The adjoint pass walks the impacts that each row depends on, and so knows the margins.
  result.jacobian = jacobianByAdjoint(problem, values, result.motion, result.rows, &result.reliability);
  if (options.method == "tangent") result.jacobian = jacobianByTangent(problem, values, result.motion, result.rows);
  progress.reset();

  const Reliability reliability = judge(problem, result.reliability);
  if (out.json()) {
    out.document(gradientJson(problem, values, result, reliability.reliable, reliability.message));
    if (!reliability.reliable) out.warn("the gradient is not reliable: " + reliability.message);
  } else {
    printGradient(out, problem, values, result, reliability);
  }
  return Exit::done;
}

Action declareGradient(CLI::App& app) {
  const auto options = std::make_shared<GradientArguments>();
  addScene(app, options->scene);
  addMotion(app, options->motion);
  app.add_option("--method", options->method, "adjoint: one reverse pass a row; tangent: one forward pass a control")
      ->check(CLI::IsMember({"adjoint", "tangent"}))
      ->type_name("NAME");
  return [options](Output& out) { return gradient(*options, out); };
}

}  // namespace

const Command kGradientCommand{
    "gradient", "The exact derivative of every constrained number by every control",
    "Derivatives are exact (no differences), through flights, impact times and impact laws, of the scene\n"
    "as written: bounds of the controls do not matter. An orientation row is a component of the world\n"
    "rotation vector log(R R_target^T). The answer warns where an impact on the way is so near grazing,\n"
    "or the boundary of stick and slide, that derivatives mean little.\n"
    "\n"
    "Examples:\n"
    "  carom gradient scene.json\n"
    "  carom gradient scene.json --json | jq .jacobian\n"
    "  carom gradient scene.json --method tangent",
    declareGradient};

}  // namespace carom::cli
