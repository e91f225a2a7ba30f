// SPDX-License-Identifier: MIT
#include "bench/edits/serve.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <istream>
#include <limits>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/edits/checks.h"
#include "bench/edits/outcome.h"
#include "editing/problem/jacobian.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

std::string text(double value) {
  if (!std::isfinite(value)) return "null";
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

template <class Vector>
std::string list(const Vector& values) {
  std::string out;
  for (Eigen::Index i = 0; i < values.size(); ++i) out += (i > 0 ? "," : "") + text(values[i]);
  return "[" + out + "]";
}

constexpr const char* kNone = "{\"available\":false}";

// One task that is asked about.
class Served {
 public:
  explicit Served(Task task)
      : task_(std::move(task)),
        contacts_(task_.start),
        problem_(task_.start, contacts_, task_.duration, task_.controls, task_.constraints) {}

  const Task& task() const { return task_; }
  ContactSource& contacts() { return contacts_; }
  int numbers() const { return problem_.unknowns(); }

  std::string describe(double best) const {
    Eigen::VectorXd lower(problem_.constraints.size()), upper(lower.size());
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      const Row& row = problem_.constraints.rows()[static_cast<std::size_t>(i)];
      lower[i] = row.lower / row.scale, upper[i] = row.upper / row.scale;
    }
    return "{\"numbers\":" + std::to_string(numbers()) + ",\"times\":" + std::to_string(problem_.times()) +
           ",\"lower\":" + list(problem_.lower()) + ",\"upper\":" + list(problem_.upper()) +
           ",\"row_lower\":" + list(lower) + ",\"row_upper\":" + list(upper) +
           ",\"hidden_changes\":" + list(hiddenChanges()) + ",\"hidden\":" + text(task_.hidden_objective) +
           ",\"best\":" + text(best) + "}";
  }

  std::string rows(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd values = problem_.valuesOf(y);
    const Motion motion = simulateAt(problem_, values, problem_.duration);
    const RowValues rows = problem_.times() > 0 ? problem_.constraints.evaluate(motion, problem_.timesOf(y))
                                                : problem_.constraints.evaluate(motion);
    if (!rows.available) return kNone;
    Eigen::MatrixXd J(rows.values.size(), numbers());
    J << jacobianByAdjoint(problem_, values, motion, rows), jacobianByTimes(problem_, motion, rows);
    J = J * problem_.rates(y).asDiagonal();
    Eigen::VectorXd scaled = rows.values;
    std::string jacobian;
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
      const double scale = problem_.constraints.rows()[static_cast<std::size_t>(i)].scale;
      scaled[i] /= scale, J.row(i) /= scale;
      jacobian += (i > 0 ? "," : "") + list(J.row(i));
    }
    return "{\"available\":true,\"rows\":" + list(scaled) + ",\"jacobian\":[" + jacobian + "]}";
  }

  Outcome judged(const Eigen::VectorXd& y) {
    Outcome outcome;
    outcome.residual = std::numeric_limits<double>::infinity();
    try {
      judge(task_, contacts_, problem_.valuesOf(y), outcome);
    } catch (const std::exception&) {
      outcome.met = false;  // bodies overlap, or spin too fast for their motion to be worked out
    }
    return outcome;
  }

 private:
  Eigen::VectorXd hiddenChanges() const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(numbers());
    for (int j = 0; j < problem_.controls.size(); ++j)
      y[j] = changeOf(problem_.controls.variables()[static_cast<std::size_t>(j)], task_.hidden_values[j]);
    return y;
  }

  Task task_;
  OdeContacts contacts_;
  EditProblem problem_;
};

std::string rowsOrNone(const Served& served, const Eigen::VectorXd& y) {
  try {
    return served.rows(y);
  } catch (const std::exception&) {
    return kNone;
  }
}

std::string describe(const Outcome& o) {
  return std::string("{\"met\":") + (o.met ? "true" : "false") + ",\"objective\":" + text(o.objective) +
         ",\"residual\":" + text(o.residual) + "}";
}

Eigen::VectorXd readChanges(std::istream& in, int numbers) {
  Eigen::VectorXd y(numbers);
  for (double& number : y)
    if (!(in >> number)) throw std::runtime_error("expected " + std::to_string(numbers) + " changes");
  return y;
}

}  // namespace

void serve(std::uint64_t seed, std::istream& in, std::ostream& out, BestKnown& best) {
  std::unique_ptr<Served> served;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string request, name;
    words >> request;
    if (request == "task") {
      int index = 0;
      if (!(words >> index)) throw std::runtime_error("found '" + line + "', expected task INDEX");
      served = std::make_unique<Served>(makeTask(seed, index));
      out << served->describe(best.of(served->task()));
    } else if (served && request == "rows") {
      out << rowsOrNone(*served, readChanges(words, served->numbers()));
    } else if (served && request == "judge") {
      out << describe(served->judged(readChanges(words, served->numbers())));
    } else if (served && request == "offer" && words >> name) {
      const Outcome outcome = served->judged(readChanges(words, served->numbers()));
      if (outcome.met) best.offer(served->task(), outcome.objective, name), best.save();
      out << describe(outcome);
    } else {
      throw std::runtime_error("found '" + line + "', expected task INDEX, then rows, judge or offer");
    }
    out << std::endl;
  }
}

}  // namespace carom::bench
