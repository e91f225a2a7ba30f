// SPDX-License-Identifier: MIT
#include "formats/answers/gradient_json.hpp"

#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using Layout = JsonWriter::Layout;

void writeRows(JsonWriter& out, const ConstraintSet& constraints, const RowValues& rows) {
  Eigen::Index i = 0;
  out.objects("rows", constraints.rows(), Layout::line, [&](const Row& row) {
    out.members("constraint", row.constraint, "component", row.name);
    out.members("name", constraints.describeRow(static_cast<int>(i)), "value", rows.values[i], "target", row.target);
    ++i;
    if (row.isRange()) out.members("min", row.lower, "max", row.upper);
  });
}

void writeTimes(JsonWriter& out, const std::vector<ConstrainedTime>& times) {
  out.objects("times", times, Layout::line, [&](const ConstrainedTime& time) {
    out.members("constraint", time.constraint, "from", time.from, "to", time.to, "time", time.time);
  });
}

void writeColumns(JsonWriter& out, const ControlSet& controls, const Eigen::VectorXd& values) {
  int j = 0;
  out.objects("columns", controls.variables(), Layout::line, [&](const Variable& variable) {
    out.members("control", variable.control, "component", variable.component, "name", controls.describeVariable(j));
    out.members("value", values[j]);
    ++j;
  });
}

}  // namespace

std::string gradientJson(const EditProblem& problem, const Eigen::VectorXd& values, const RowsAndJacobian& result,
                         bool reliable, const std::string& message) {
  JsonWriter out;
  out.beginObject();
  writeRows(out, problem.constraints, result.rows);
  writeTimes(out, problem.constraints.constrainedTimes(result.motion, result.rows.times));
  writeColumns(out, problem.controls, values);
  out.key("jacobian").beginArray();
  for (Eigen::Index i = 0; i < result.jacobian.rows(); ++i) out.value(Eigen::VectorXd(result.jacobian.row(i)));
  out.endArray();
  const std::size_t events = problem.constraints.extentIn(result.motion, result.rows.times).events;
  out.members("signature", result.motion.signature(events), "reliable", reliable, "message", message);
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail
