// SPDX-License-Identifier: MIT
#include "formats/answers/check_json.hpp"

#include "formats/answers/gradient_json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

using namespace editing_detail;

namespace {

using Layout = JsonWriter::Layout;

void writeEntry(JsonWriter& out, const EditProblem& problem, const DerivativeCheck& check, const char* name,
                const DerivativeCheck::Entry& entry, const Eigen::MatrixXd& other, const char* other_name) {
  out.key(name);
  if (entry.row < 0) {
    out.null();
    return;
  }
  out.beginObject(Layout::line);
  out.members("row", entry.row, "column", entry.column);
  out.members("name",
              problem.constraints.describeRow(entry.row) + " by " + problem.controls.describeVariable(entry.column));
  out.members("adjoint", check.by_adjoint(entry.row, entry.column), other_name, other(entry.row, entry.column));
  out.members("disagreement", entry.disagreement);
  out.endObject();
}

void writeStep(JsonWriter& out, double step, const DifferenceColumn& column) {
  out.beginObject(column.compared ? Layout::line : Layout::block);
  out.members("step", step, "compared", column.compared);
  if (column.compared)
    out.members("scheme", column.scheme, "disagreement", column.disagreement);
  else
    out.members("why", column.why, "sequence_below", column.below, "sequence_above", column.above);
  out.endObject();
}

void writeColumn(JsonWriter& out, const EditProblem& problem, const DerivativeCheck& check, int column) {
  const auto c = static_cast<std::size_t>(column);
  const std::vector<DifferenceColumn>& steps = check.columns[c];
  out.members("control", problem.controls.variables()[c].control, "component", problem.controls.variables()[c].component);
  out.members("name", problem.controls.describeVariable(column));
  std::optional<std::size_t> best;
  if (check.best_step[c] >= 0) best = static_cast<std::size_t>(check.best_step[c]);
  out.members("best_step", best ? std::optional(check.steps[*best]) : std::nullopt);
  out.members("disagreement", best ? std::optional(steps[*best].disagreement) : std::nullopt);
  out.key("steps").beginArray();
  for (std::size_t s = 0; s < check.steps.size(); ++s) writeStep(out, check.steps[s], steps[s]);
  out.endArray();
}

}  // namespace

std::string checkJson(const EditProblem& problem, const DerivativeCheck& check) {
  JsonWriter out;
  out.beginObject();
  out.members("passed", check.passed, "message", check.message, "not_compared", check.not_compared);
  out.members("sequence", check.sequence);
  writeEntry(out, problem, check, "worst_tangent", check.adjoint_tangent, check.by_tangent, "tangent");
  writeEntry(out, problem, check, "worst_differences", check.differences, check.by_differences, "differences");
  int j = 0;
  out.objects("columns", check.columns, Layout::block, [&](const auto&) { writeColumn(out, problem, check, j++); });
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail
