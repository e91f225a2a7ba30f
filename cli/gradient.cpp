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
#include "editing/problem/jacobian.hpp"
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
  out.text() << "Jacobian: derivative of each constrained quantity (rows) with respect to each control (columns), "
                "in the row's unit per the column's\n";
  Table columns({"column", "control", ">value", "unit"});
  for (int j = 0; j < problem.controls.size(); ++j)
    columns.row({std::to_string(j + 1), problem.controls.describeVariable(j), out.number(values[j]),
                 unitOf(problem.controls.describeVariable(j))});
  out.text() << '\n';
  columns.print(out);

  std::vector<std::string> headings{"constraint", ">value", ">target", "unit"};
  for (int j = 0; j < problem.controls.size(); ++j) headings.push_back(">d/d(" + std::to_string(j + 1) + ")");
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
  for (const ConstrainedTime& time : problem.constraints.constrainedTimes(result.motion, result.rows.times)) {
    const bool rests = problem.constraints.constraints()[static_cast<std::size_t>(time.constraint)].at.rest;
    out.text() << "  of " << problem.constraints.describeConstraint(time.constraint) << ": at "
               << out.number(time.time) << (rests ? " s\n" : " s, where its error is smallest\n");
  }
  out.text() << '\n'
             << (reliability.reliable ? out.styled(Look::good, "Reliable") + ": no impact is near a point where "
                                                                             "derivatives do not exist.\n"
                                      : out.styled(Look::warning, "Unreliable.") + '\n');
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
    if (!reliability.reliable) out.warn("the gradient is unreliable: " + reliability.message);
  } else {
    printGradient(out, problem, values, result, reliability);
  }
  return Exit::done;
}

Action declareGradient(CLI::App& app) {
  const auto options = std::make_shared<GradientArguments>();
  addScene(app, options->scene);
  addMotion(app, options->motion);
  app.add_option("--method", options->method, "adjoint: one reverse pass per row; tangent: one forward pass per control")
      ->check(CLI::IsMember({"adjoint", "tangent"}))
      ->type_name("NAME");
  return [options](Output& out) { return gradient(*options, out); };
}

}  // namespace

const Command kGradientCommand{
    "gradient", "Exact derivatives of all constrained quantities with respect to all controls",
    "Derivatives are exact (no differences), through flights, impact times and impact laws, of the scene\n"
    "as written: bounds of the controls are ignored. An orientation row is a component of the world\n"
    "rotation vector log(R R_target^T). The answer warns if an impact is so near to grazing, or to the\n"
    "boundary between sticking and sliding, that derivatives are unreliable.\n"
    "\n"
    "Examples:\n"
    "  carom gradient scene.json\n"
    "  carom gradient scene.json --json | jq .jacobian\n"
    "  carom gradient scene.json --method tangent",
    declareGradient};

}  // namespace carom::cli
