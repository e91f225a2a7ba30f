// SPDX-License-Identifier: MIT
#include "adjoint/group/group_start_derivative.hpp"

#include "adjoint/group/group_rates.hpp"
#include "adjoint/group/group_start.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

// Below this share of a large acceleration a slip that begins has none: the contact came to the limit of friction there.
constexpr double kNoStart = 1e-9;

// Accelerations of slips that begin, in the rows of speedRows.
Eigen::VectorXd rateOfBeginningSlips(const GroupPath& path, Eigen::Index rows) {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(rows);
  const GroupInstant now = path.instantAt(path.start());
  GroupForces forces;
  forces.solve(path.contacts(), now, path.redundant());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const GroupContact& c = path.contacts()[k];
    if (c.begins) rate.segment<3>(row) = forces.slipRate(k);
    row += c.stands() ? 3 : 1;
  }
  return rate;
}

// What is 0 at a start, by all inputs: gaps, and speeds in the rows of speedRows.
struct StartRates {
  MatrixXd gaps, speeds;
};

StartRates startRates(const GroupPath& path, const GroupInputs& inputs, GroupRates& rates, Eigen::Index rows) {
  const std::vector<GroupContact>& contacts = path.contacts();
  StartRates out{MatrixXd(contacts.size(), inputs.count), MatrixXd(rows, inputs.count)};
  rates.each([&](const GroupLanes& lanes, int first, int count) {
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      Eigen::Index row = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        const GroupLanes::Contact& c = lanes.contacts[k];
        out.gaps(rowAt(k), first + lane) = c.gap.rate[at];
        if (contacts[k].stands()) {
          out.speeds.block<3, 1>(row, first + lane) = ratesOf(c.u, at);
          row += 3;
        } else {
          out.speeds(row++, first + lane) = c.n.dot(c.u).rate[at];
        }
      }
    }
  });
  return out;
}

}  // namespace

GroupStartDerivative groupStartDerivative(const GroupPath& path, const GroupInputs& inputs) {
  const std::vector<State>& states = path.startStates();
  GroupRates rates(path.scene(), path.contacts(), inputs, states, path.start(), followSlips(path));
  const GroupInstant& now = rates.now();
  const MatrixXd gaps = gapRows(now, path.contacts()), speeds = speedRows(now, path.contacts());
  const StartRates at_start = startRates(path, inputs, rates, speeds.rows());
  GroupStartDerivative out{MatrixXd::Zero(inputs.states(), inputs.count), Eigen::RowVectorXd::Zero(inputs.count), {}};
  MatrixXd& D = out.state;
  D.leftCols(inputs.states()).setIdentity();
  if (path.contacts().empty()) return out;
  const MatrixXd moved = undoing(now, gaps) * at_start.gaps;
  for (std::size_t m = 0; m < states.size(); ++m) D.middleRows<6>(12 * rowAt(m)) -= moved.middleRows<6>(6 * rowAt(m));
  const Eigen::VectorXd slip_rate = rateOfBeginningSlips(path, speeds.rows());
  if (slip_rate.norm() > kNoStart * path.scene().pull())
    out.time = -(slip_rate.transpose() * inputs.chained(at_start.speeds, D)) / slip_rate.squaredNorm();
  if (!out.time.isZero(0)) {
    D += path.ratesAt(path.start()) * out.time;
    if (std::ranges::any_of(path.scene().with, &Support::moves)) out.shift = timeShift(path.scene(), inputs, path.start());
  }
  MatrixXd left = inputs.chained(at_start.speeds, D);
  out.addShift(at_start.speeds, left);
  const MatrixXd undone = undoing(now, speeds) * left;
  for (std::size_t m = 0; m < states.size(); ++m) {
    const Mat3 R = states[m].q.toRotationMatrix();
    D.middleRows<3>(12 * rowAt(m) + 6) -= undone.middleRows<3>(6 * rowAt(m));
    D.middleRows<3>(12 * rowAt(m) + 9) -=
        R * path.scene().members[m].model->inertia.asDiagonal() * R.transpose() * undone.middleRows<3>(6 * rowAt(m) + 3);
  }
  return out;
}

}  // namespace carom::adjoint_detail
