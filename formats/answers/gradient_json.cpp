// SPDX-License-Identifier: MIT
#include "formats/answers/gradient_json.hpp"

#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using Layout = JsonWriter::Layout;

void writeRows(JsonWriter& out, const ConstraintSet& constraints, const RowValues& rows) {
  out.key("rows").beginArray();
  for (int i = 0; i < constraints.size(); ++i) {
    const Row& row = constraints.rows()[static_cast<std::size_t>(i)];
    out.beginObject(Layout::line);
    out.key("constraint").integer(row.constraint);
    out.key("component").text(row.name);
    out.key("value").number(rows.values[i]);
    out.key("target").number(row.target);
    if (row.isRange()) out.key("min").number(row.lower).key("max").number(row.upper);
    out.endObject();
  }
  out.endArray();
}

void writeTimes(JsonWriter& out, const ConstraintSet& constraints, const RowValues& rows) {
  out.key("times").beginArray();
  for (std::size_t k = 0; k < constraints.freeTimes().size(); ++k) {
    const FreeTime& free = constraints.freeTimes()[k];
    out.beginObject(Layout::line);
    out.key("constraint").integer(free.constraint);
    out.key("from").number(free.from);
    out.key("to").number(free.to);
    out.key("time").number(rows.times[static_cast<Eigen::Index>(k)]);
    out.endObject();
  }
  out.endArray();
}

void writeColumns(JsonWriter& out, const ControlSet& controls, const Eigen::VectorXd& values) {
  out.key("columns").beginArray();
  for (int j = 0; j < controls.size(); ++j) {
    out.beginObject(Layout::line);
    out.key("control").integer(controls.variables()[static_cast<std::size_t>(j)].control);
    out.key("component").text(columnName(controls, j));
    out.key("value").number(values[j]);
    out.endObject();
  }
  out.endArray();
}

}  // namespace

std::string columnName(const ControlSet& controls, int variable) {
  const Variable& v = controls.variables()[static_cast<std::size_t>(variable)];
  const std::string word = controls.controls()[static_cast<std::size_t>(v.control)].kind->word;
  return v.component == "value" ? word : word + "." + v.component;
}

std::string gradientJson(const EditProblem& problem, const Eigen::VectorXd& values, const RowsAndJacobian& result,
                         bool reliable, const std::string& message) {
  JsonWriter out;
  out.beginObject();
  writeRows(out, problem.constraints, result.rows);
  writeTimes(out, problem.constraints, result.rows);
  writeColumns(out, problem.controls, values);
  out.key("jacobian").beginArray();
  for (Eigen::Index i = 0; i < result.jacobian.rows(); ++i) {
    const Eigen::VectorXd row = result.jacobian.row(i).transpose();
    out.numbers({row.data(), static_cast<std::size_t>(row.size())});
  }
  out.endArray();
  out.key("signature")
      .text(result.motion.signature(problem.constraints.extentIn(result.motion, result.rows.times).events));
  out.key("reliable").boolean(reliable);
  out.key("message").text(message);
  out.endObject();
  return out.take();
}

}  // namespace carom::formats_detail
