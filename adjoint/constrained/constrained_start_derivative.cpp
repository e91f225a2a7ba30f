// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_start_derivative.hpp"

#include "adjoint/constrained/constrained_rates.hpp"
#include "adjoint/constrained/constrained_start.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::MatrixXd;

// Below this share of gravity a slip that begins has no acceleration: the contact came to the limit of friction there.
constexpr double kNoStart = 1e-9;

// Accelerations of slips that begin, in the rows of constrainedRows.
Eigen::VectorXd rateOfBeginningSlips(const ConstrainedPath& path, Eigen::Index rows) {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(rows);
  const ConstrainedInstant now = path.instantAt(path.start());
  const ConstrainedDynamics forces(now.body, now.contacts, path.redundant());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const PersistentContact& c = path.contacts()[k];
    if (c.begins) rate.segment<3>(row) = forces.slipRate(k);
    row += c.stands() ? 3 : 1;
  }
  return rate;
}

// What the impulses that took away what was left of speeds do to v and L: they turn with the normals of contacts that
// slide, and act where the contacts are. How large they are follows from the speeds, which stay 0.
struct Stopped {
  V3<ConstrainedLanes::Number> v = V3<ConstrainedLanes::Number>::Zero(), L = V3<ConstrainedLanes::Number>::Zero();
};

Stopped stoppedBy(const ConstrainedPath& path, const ConstrainedLanes& lanes) {
  Stopped sum;
  for (std::size_t k = 0; k < path.stopped().size(); ++k) {
    const PersistentContact& c = path.contacts()[k];
    const Vec3& p = path.stopped()[k];
    const auto& n = lanes.contacts[k].n;
    V3<ConstrainedLanes::Number> impulse = p.cast<ConstrainedLanes::Number>();
    if (!c.stands()) impulse = n * ConstrainedLanes::Number(p.dot(valuesOf(n)));
    sum.v += impulse * lanes.body.inverse_mass;
    sum.L += lanes.contacts[k].r.cross(impulse);
  }
  return sum;
}

// The same by all inputs: rows (v, L).
MatrixXd stoppedRates(const ConstrainedPath& path, const ConstrainedInputs& inputs, ConstrainedRates& rates) {
  MatrixXd out(6, inputs.count);
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    const Stopped stopped = stoppedBy(path, lanes);
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      out.col(first + lane) << ratesOf(stopped.v, at), ratesOf(stopped.L, at);
    }
  });
  return out;
}

// What is 0 at a start, by all inputs.
struct StartRates {
  MatrixXd gaps, speeds;  // of contacts, and in the rows of constrainedRows
};

StartRates startRates(const ConstrainedPath& path, const ConstrainedInputs& inputs, ConstrainedRates& rates, Eigen::Index rows) {
  const std::vector<PersistentContact>& contacts = path.contacts();
  StartRates out{MatrixXd(contacts.size(), inputs.count), MatrixXd(rows, inputs.count)};
  rates.each([&](const ConstrainedLanes& lanes, int first, int count) {
    for (int lane = 0; lane < count; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      Eigen::Index row = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        out.gaps(static_cast<Eigen::Index>(k), first + lane) = lanes.gap[k].rate[at];
        const auto& c = lanes.contacts[k];
        const auto u = lanes.body.relativeVelocity(c);
        if (contacts[k].stands()) {
          out.speeds.block<3, 1>(row, first + lane) = ratesOf(u, at);
          row += 3;
        } else {
          out.speeds(row++, first + lane) = c.n.dot(u).rate[at];
        }
      }
    }
  });
  return out;
}

// Takes a change of speeds at contacts back out of v and L.
void undoSpeeds(const ConstrainedPath& path, const ConstrainedInstant& now, const MatrixXd& change, MatrixXd& D) {
  const MatrixXd undone = undoing(now, constrainedRows(now, path.contacts())) * change;
  const Mat3 R = path.stateAt(path.start()).q.toRotationMatrix();
  D.middleRows<3>(6) -= undone.topRows<3>();
  D.bottomRows<3>() -= R * path.scene().model->inertia.asDiagonal() * R.transpose() * undone.bottomRows<3>();
}

MatrixXd startAsGiven(const ConstrainedInputs& inputs) {
  MatrixXd D = MatrixXd::Zero(12, inputs.count);
  D.leftCols<12>().setIdentity();
  return D;
}

}  // namespace

ConstrainedStartDerivative constrainedStartDerivative(const ConstrainedPath& path, const ConstrainedInputs& inputs) {
  ConstrainedRates rates(path.scene(), path.contacts(), inputs, path.stateAt(path.start()), path.start(), followSlips(path),
                         path.beginsFlat());
  const ConstrainedInstant& now = rates.now();
  const Eigen::Index rows = constrainedRows(now, path.contacts()).rows();
  const StartRates at_start = startRates(path, inputs, rates, rows);
  ConstrainedStartDerivative out{startAsGiven(inputs), ConstrainedRow::Zero(inputs.count), {}};
  MatrixXd& D = out.state;
  D.topRows<6>() -= undoing(now, gapRows(now)) * at_start.gaps;
  const Eigen::VectorXd slip_rate = rateOfBeginningSlips(path, rows);
  if (slip_rate.norm() > kNoStart * path.scene().gravity.norm())
    out.time = -(slip_rate.transpose() * ConstrainedInputs::chained(at_start.speeds, D)) / slip_rate.squaredNorm();
  if (!out.time.isZero(0)) {
    D += asVector(path.rateAt(path.start())) * out.time;
    if (path.scene().isCarried()) out.shift = timeShift(path.scene(), inputs, path.start());
  }
  MatrixXd speeds = ConstrainedInputs::chained(at_start.speeds, D);
  out.addShift(at_start.speeds, speeds);
  undoSpeeds(path, now, speeds, D);
  return out;
}

MatrixXd constrainedStop(const ConstrainedPath& path, const ConstrainedInputs& inputs) {
  ConstrainedRates rates(path.scene(), path.contacts(), inputs, path.stateAt(path.start()), path.start(), followSlips(path),
                         path.beginsFlat());
  const ConstrainedInstant& now = rates.now();
  const StartRates at_start = startRates(path, inputs, rates, constrainedRows(now, path.contacts()).rows());
  MatrixXd D = startAsGiven(inputs);
  D.bottomRows<6>() += stoppedRates(path, inputs, rates);
  undoSpeeds(path, now, ConstrainedInputs::chained(at_start.speeds, D), D);
  return D;
}

}  // namespace carom::adjoint_detail
