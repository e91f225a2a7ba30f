// SPDX-License-Identifier: MIT
#include "editing/problem/hessian.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/second_order/second_order.h"
#include "editing/problem/rows/region_way.hpp"

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
  std::vector<Eigen::VectorXd> time_rate;  // of the instant by the controls; empty: it stays
};

StateSeed weighted(StateSeed seed, double weight) {
  return seed *= weight;
}

int freeTimeOf(const EditProblem& problem, const Row& row) {
  for (int k = 0; k < problem.times() && row.region < 0; ++k)
    if (problem.constraints.freeTimes()[k].constraint == row.constraint) return k;
  return -1;
}

// How the instant of a clearance moves with the controls.
Eigen::VectorXd clearanceTimeRate(const Clearance& c, DerivativeTape& tape,
                                  std::span<const ReadingDirection> controls) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(controls.size()));
  if (c.keeps == Clearance::Keeps::place) return {};
  const Motion& motion = tape.motion();
  const int k = motion.arcAt(c.seed.body, c.time);
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(c.seed.body)].arcs[static_cast<std::size_t>(k)];
  const Vec3 v = arc.velocityAt(c.time), n = c.seed.center_of_mass;
  const double bend = n.dot(accelerationAt(arc, c.time)) + v.dot(c.bend * v);  // of the clearance by the time
  for (std::size_t j = 0; j < controls.size(); ++j) {
    const BodyStateRate d = tangent(tape, controls[j].scene).at(c.seed.body, Instant::at(c.time));
    const auto at = static_cast<Eigen::Index>(j);
    if (c.keeps == Clearance::Keeps::two_faces) {
      r[at] = -c.between.dot(d.center_of_mass) / c.between.dot(v);
    } else {
      r[at] = -(n.dot(d.velocity) + v.dot(c.bend * d.center_of_mass)) / bend;
    }
  }
  return r;
}

void addObjective(const EditProblem& problem, const RowValues& rows, double weight, Readings& out) {
  if (weight == 0) return;
  if (!rows.objective || !rows.objective->second_order)
    throw NotComputable("second derivatives are not known of the objective");
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
      throw NotComputable("second derivatives are not known of " + problem.constraints.describeRow(i));
    const Row& row = problem.constraints.rows()[i];
    Eigen::VectorXd time_rate;
    if (row.region >= 0)
      time_rate = clearanceTimeRate(*problem.constraints.clearance(tape.motion(), i), tape, controls);
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

// By control values and free times.
Eigen::MatrixXd assemble(const EditProblem& problem, const Eigen::VectorXd& values, const Readings& readings,
                         const SecondOrder& second) {
  const Eigen::Index n = problem.controls.size(), all = problem.unknowns();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(all, all);
  for (Eigen::Index a = 0; a < all; ++a) {
    const auto direction = static_cast<std::size_t>(a);
    H.row(a).head(n) = problem.controls.gather(second.gradient_rates[direction], values);
    if (a < n) H.row(a).head(n) += problem.controls.gatherRate(second.gradient, values, Eigen::VectorXd::Unit(n, a));
    for (std::size_t s = 0; s < readings.seeds.size(); ++s) {
      const double rate = second.time_rates[direction][static_cast<Eigen::Index>(s)];
      if (readings.time_rate[s].size() > 0) H.row(a).head(n) += rate * readings.time_rate[s];
      if (readings.free_time[s] >= 0) H(a, n + readings.free_time[s]) += rate;
    }
  }
  return H;
}

}  // namespace

Eigen::MatrixXd rowsHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight) {
  const Eigen::Index n = problem.controls.size(), all = problem.unknowns();
  const Eigen::VectorXd values = problem.valuesOf(unknowns);
  std::vector<ReadingDirection> directions;
  for (Eigen::Index j = 0; j < n; ++j)
    directions.push_back({problem.controls.scatter(Eigen::VectorXd::Unit(n, j), values), {}});
  DerivativeTape tape(motion);
  Readings readings = readingsOf(problem, tape, rows, weights, directions);
  addObjective(problem, rows, objective_weight, readings);
  if (readings.seeds.empty() || all == 0) return Eigen::MatrixXd::Zero(all, all);
  const auto count = static_cast<Eigen::Index>(readings.seeds.size());
  for (Eigen::Index a = 0; a < all; ++a) {
    if (a >= n) directions.push_back({SceneTangent(*motion.scene), {}});
    Eigen::VectorXd& time = directions[static_cast<std::size_t>(a)].time;
    time = Eigen::VectorXd::Zero(count);
    for (Eigen::Index s = 0; s < count; ++s) {
      const auto ss = static_cast<std::size_t>(s);
      if (a < n && readings.time_rate[ss].size() > 0) time[s] = readings.time_rate[ss][a];
      if (a >= n && readings.free_time[ss] == a - n) time[s] = 1;
    }
  }
  const SecondOrder second = secondOrder(tape, readings.seeds, seedRatesOf(problem, motion, rows, weights, objective_weight, readings), directions,
                                          RatesWanted::varied);
  const Eigen::VectorXd rates = problem.rates(unknowns);
  Eigen::MatrixXd H = rates.asDiagonal() * assemble(problem, values, readings, second) * rates.asDiagonal();
  H.diagonal().head(n) +=
      problem.controls.gather(second.gradient, values).cwiseProduct(problem.controls.valueBends(unknowns.head(n)));
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
