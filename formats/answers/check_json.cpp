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
  out.key("row").integer(entry.row);
  out.key("column").integer(entry.column);
  out.key("name").text(problem.constraints.describeRow(entry.row) + " by " +
                       problem.controls.describeVariable(entry.column));
  out.key("adjoint").number(check.by_adjoint(entry.row, entry.column));
  out.key(other_name).number(other(entry.row, entry.column));
  out.key("disagreement").number(entry.disagreement);
  out.endObject();
}

void writeColumn(JsonWriter& out, const EditProblem& problem, const DerivativeCheck& check, int column) {
  const auto c = static_cast<std::size_t>(column);
  const int best = check.best_step[c];
  out.beginObject();
  out.key("control").integer(problem.controls.variables()[c].control);
  out.key("component").text(columnName(problem.controls, column));
  out.key("best_step");
  best < 0 ? out.null() : out.number(check.steps[static_cast<std::size_t>(best)]);
  out.key("disagreement");
  best < 0 ? out.null() : out.number(check.columns[c][static_cast<std::size_t>(best)].disagreement);
  out.key("steps").beginArray();
  for (std::size_t s = 0; s < check.steps.size(); ++s) {
    const DifferenceColumn& one = check.columns[c][s];
    out.beginObject(one.compared ? Layout::line : Layout::block);
    out.key("step").number(check.steps[s]);
    out.key("compared").boolean(one.compared);
    if (one.compared) {
      out.key("scheme").text(one.scheme);
      out.key("disagreement").number(one.disagreement);
    } else {
      out.key("why").text(one.why);
      out.key("sequence_below").texts(one.below);
      out.key("sequence_above").texts(one.above);
    }
    out.endObject();
  }
  out.endArray().endObject();
}

}  // namespace

std::string checkJson(const EditProblem& problem, const DerivativeCheck& check) {
  JsonWriter out;
  out.beginObject();
  out.key("passed").boolean(check.passed);
  out.key("message").text(check.message);
  out.key("not_compared").integer(check.not_compared);
  out.key("sequence").texts(check.sequence);
  writeEntry(out, problem, check, "worst_tangent", check.adjoint_tangent, check.by_tangent, "tangent");
  writeEntry(out, problem, check, "worst_differences", check.differences, check.by_differences, "differences");
  out.key("columns").beginArray();
  for (int j = 0; j < problem.controls.size(); ++j) writeColumn(out, problem, check, j);
  out.endArray();
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail
