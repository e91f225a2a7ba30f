// SPDX-License-Identifier: MIT
#include "editing/problem/hessian.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/second_order/second_order.h"

// With v the control values, t the free times and z the unknowns, v = v(z) and t = t(z) each by each:
//   d^2 f/dz^2 = diag(v') d^2 f/d(v, t)^2 diag(v') + diag(df/dv v'').
// The clearance of a region is read at a time that moves with the controls, at the rate r: where it is stationary or
// where two faces cross, the value along the way is that of one function Lambda with Lambda_t = 0, so that
//   d^2 f = Lambda_vv + Lambda_vt r^T + r Lambda_tv + Lambda_tt r r^T.

namespace carom::editing_detail {
namespace {

// The seeds of all rows with weight.
struct Readings {
  std::vector<StateSeed> seeds;
  std::vector<int> row;                    // of each seed; that of an objective of one's own comes after all
  std::vector<int> free_time;              // or -1
  std::vector<Eigen::VectorXd> time_rate;  // of the instant, with respect to the controls; empty: it is fixed
};

StateSeed weighted(StateSeed seed, double weight) {
  return seed *= weight;
}

int freeTimeOf(const EditProblem& problem, const Row& row) {
  for (int k = 0; k < problem.times() && !row.overSpan(); ++k)
    if (problem.constraints.freeTimes()[k].constraint == row.constraint) return k;
  return -1;
}

void addObjective(const EditProblem& problem, const RowValues& rows, double weight, Readings& out) {
  if (weight == 0) return;
  if (!rows.objective || !rows.objective->second_order)
    throw NotComputable("second derivatives of the objective are not available");
  for (const StateSeed& seed : rows.objective->seeds) {
    out.seeds.push_back(weighted(seed, weight));
    out.row.push_back(problem.constraints.size());
    out.free_time.push_back(-1);
    out.time_rate.emplace_back();
  }
}

Readings readingsOf(const EditProblem& problem, DerivativeTape& tape, const RowValues& rows,
                    const Eigen::VectorXd& weights, std::span<const ReadingDirection> controls) {
  Readings out;
  for (int i = 0; i < problem.constraints.size(); ++i) {
    if (weights[i] == 0) continue;
    if (!rows.notes[i].second_order)
      throw NotComputable("second derivatives are not available for " + problem.constraints.describeRow(i));
    const Row& row = problem.constraints.rows()[i];
    Eigen::VectorXd time_rate;
    if (row.overSpan()) time_rate = problem.constraints.timeRate(tape, i, controls);
    for (const StateSeed& seed : rows.seeds[i]) {
      out.seeds.push_back(weighted(seed, weights[i]));
      out.row.push_back(i);
      out.free_time.push_back(freeTimeOf(problem, row));
      out.time_rate.push_back(time_rate);
    }
  }
  return out;
}

SeedRates seedRatesOf(const EditProblem& problem, const Motion& motion, const RowValues& rows,
                      const Eigen::VectorXd& weights, double objective_weight, const Readings& readings) {
  return [&, objective_weight](std::span<const BodyStateRate> rates) {
    std::vector<StateSeed> out;
    while (out.size() < rates.size()) {
      const int row = readings.row[out.size()];
      if (row == problem.constraints.size()) {
        const std::span<const BodyStateRate> of_objective = rates.subspan(out.size());
        std::vector<StateSeed> of(of_objective.size());
        if (rows.objective->seed_rates) of = rows.objective->seed_rates(of_objective);
        for (const StateSeed& seed : of) out.push_back(weighted(seed, objective_weight));
        continue;
      }
      const std::span<const BodyStateRate> of_row = rates.subspan(out.size(), rows.seeds[row].size());
      for (const StateSeed& seed : rows.notes[row].seed_rates
                                       ? rows.notes[row].seed_rates(of_row)
                                       : problem.constraints.seedRates(motion, rows.times, row, of_row))
        out.push_back(weighted(seed, weights[row]));
    }
    return out;
  };
}

// H D by control values and free times.
Eigen::MatrixXd assemble(const EditProblem& problem, const Eigen::VectorXd& values, const Readings& readings,
                         const Eigen::MatrixXd& directions, const SecondOrder& second) {
  const Eigen::Index n = problem.controls.size();
  Eigen::MatrixXd HD = Eigen::MatrixXd::Zero(directions.rows(), directions.cols());
  for (Eigen::Index a = 0; a < directions.cols(); ++a) {
    const auto direction = static_cast<std::size_t>(a);
    HD.col(a).head(n) = problem.controls.gather(second.gradient_rates[direction], values);
    HD.col(a).head(n) += problem.controls.gatherRate(second.gradient, values, directions.col(a).head(n));
    for (std::size_t s = 0; s < readings.seeds.size(); ++s) {
      const double rate = second.time_rates[direction][static_cast<Eigen::Index>(s)];
      if (readings.time_rate[s].size() > 0) HD.col(a).head(n) += rate * readings.time_rate[s];
      if (readings.free_time[s] >= 0) HD(n + readings.free_time[s], a) += rate;
    }
  }
  return HD;
}

// How the time of each seed moves along a direction.
Eigen::VectorXd timeRatesAlong(const Readings& readings, const Eigen::VectorXd& direction, Eigen::Index controls) {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(readings.seeds.size()));
  for (Eigen::Index s = 0; s < rates.size(); ++s) {
    const auto seed = static_cast<std::size_t>(s);
    if (readings.time_rate[seed].size() > 0) rates[s] = readings.time_rate[seed].dot(direction.head(controls));
    if (readings.free_time[seed] >= 0) rates[s] = direction[controls + readings.free_time[seed]];
  }
  return rates;
}

}  // namespace

RowsCurvature rowsCurvature(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight,
                            const Eigen::MatrixXd& directions, RatesWanted wanted) {
  problem.leaveIfAbandoned();
  const Eigen::Index n = problem.controls.size();
  std::vector<ReadingDirection> controls;
  for (Eigen::Index j = 0; j < n; ++j)
    controls.push_back({problem.controls.scatter(Eigen::VectorXd::Unit(n, j), values), {}});
  DerivativeTape tape(motion, problem.leaver());
  Readings readings = readingsOf(problem, tape, rows, weights, controls);
  addObjective(problem, rows, objective_weight, readings);
  if (readings.seeds.empty() || directions.size() == 0)
    return {Eigen::MatrixXd::Zero(directions.rows(), directions.cols()), Eigen::VectorXd::Zero(n)};
  std::vector<ReadingDirection> along;
  for (Eigen::Index a = 0; a < directions.cols(); ++a)
    along.push_back({problem.controls.scatter(directions.col(a).head(n), values),
                     timeRatesAlong(readings, directions.col(a), n)});
  const SecondOrder second = secondOrder(
      tape, readings.seeds, seedRatesOf(problem, motion, rows, weights, objective_weight, readings), along, wanted);
  return {assemble(problem, values, readings, directions, second), problem.controls.gather(second.gradient, values)};
}

Eigen::MatrixXd rowsHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight) {
  const Eigen::Index n = problem.controls.size(), all = problem.unknowns();
  const RowsCurvature second =
      rowsCurvature(problem, problem.valuesOf(unknowns), motion, rows, weights, objective_weight,
                    Eigen::MatrixXd::Identity(all, all), RatesWanted::varied);
  const Eigen::VectorXd rates = problem.rates(unknowns);
  Eigen::MatrixXd H = rates.asDiagonal() * second.along.transpose() * rates.asDiagonal();
  H.diagonal().head(n) += second.gradient.cwiseProduct(problem.controls.valueBends(unknowns.head(n)));
  return 0.5 * (H + H.transpose());  // symmetric to rounding already
}

Eigen::MatrixXd validityHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns,
                                const Eigen::VectorXd& weights) {
  const Eigen::Index n = problem.controls.size(), all = problem.unknowns();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(all, all);
  if (problem.validity.size() == 0 || n == 0) return H;
  const Eigen::VectorXd rates = problem.rates(unknowns).head(n);
  H.topLeftCorner(n, n) = rates.asDiagonal() * problem.validity.hessian(problem.controls, weights) * rates.asDiagonal();
  const Eigen::VectorXd gradient =
      problem.validity.jacobian(problem.controls, problem.valuesOf(unknowns)).transpose() * weights;
  H.diagonal().head(n) += gradient.cwiseProduct(problem.controls.valueBends(unknowns.head(n)));
  return H;
}

}  // namespace carom::editing_detail
