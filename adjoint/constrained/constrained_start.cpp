// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_start.hpp"

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

Rows gapRows(const ConstrainedInstant& now) {
  Rows G(now.contacts.size(), 6);
  for (std::size_t k = 0; k < now.contacts.size(); ++k) {
    const ContactInstant<double>& c = now.contacts[k];
    G.row(static_cast<Eigen::Index>(k)) << c.n.transpose(), c.r.cross(c.n).transpose();
  }
  return G;
}

namespace {

// (C M^-1 C^T)^+ and M^-1 C^T.
Eigen::MatrixXd inverseMass(const ConstrainedInstant& now, const Rows& C, Eigen::Matrix<double, 6, Eigen::Dynamic>& moved) {
  moved = C.transpose();
  moved.topRows<3>() *= now.body.inverse_mass;
  moved.bottomRows<3>() = now.body.A * C.transpose().bottomRows<3>();
  const Eigen::MatrixXd K = C * moved;
  return LeastNormSolve(K, Eigen::VectorXd::Zero(K.rows())).inverse;
}

// Of each contact, of the impulses in the rows of constrainedRows.
void addImpulses(const ConstrainedInstant& now, const std::vector<PersistentContact>& contacts, const Eigen::VectorXd& rows,
                 std::vector<Vec3>& sum) {
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    sum[k] += contacts[k].stands() ? Vec3(rows.segment<3>(at)) : Vec3(rows[at] * now.contacts[k].n);
    at += contacts[k].stands() ? 3 : 1;
  }
}

}  // namespace

Rows constrainedRows(const ConstrainedInstant& now, const std::vector<PersistentContact>& contacts) {
  Eigen::Index rows = 0;
  for (const PersistentContact& c : contacts) rows += c.stands() ? 3 : 1;
  Rows C(rows, 6);
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactInstant<double>& c = now.contacts[k];
    if (contacts[k].stands()) {
      C.block<3, 3>(at, 0).setIdentity();
      C.block<3, 3>(at, 3) = -skew(c.r);
      at += 3;
    } else {
      C.row(at++) << c.n.transpose(), c.r.cross(c.n).transpose();
    }
  }
  return C;
}

Eigen::VectorXd supportSpeeds(const ConstrainedInstant& now, const std::vector<PersistentContact>& contacts) {
  Eigen::VectorXd speeds(3 * static_cast<Eigen::Index>(contacts.size()));
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const ContactInstant<double>& c = now.contacts[k];
    if (contacts[k].stands()) {
      speeds.segment<3>(at) = c.support_velocity;
      at += 3;
    } else {
      speeds[at++] = c.n.dot(c.support_velocity);
    }
  }
  speeds.conservativeResize(at);
  return speeds;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> undoing(const ConstrainedInstant& now, const Rows& C) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> moved;
  const Eigen::MatrixXd inverse = inverseMass(now, C, moved);
  return moved * inverse;
}

State constrainedStart(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, State state, double t, int rounds,
                std::vector<Vec3>* stopped) {
  const std::vector<Vec3> none(contacts.size(), Vec3::Zero());
  if (stopped) *stopped = none;
  for (int round = 0; round < rounds; ++round) {
    const ConstrainedInstant now = instantOf(scene, contacts, state, t, none);
    Eigen::VectorXd gaps(contacts.size());
    const Pose own{state.x, scene.model->shapeToWorld(state.q.toRotationMatrix())};
    for (std::size_t k = 0; k < contacts.size(); ++k)
      gaps[static_cast<Eigen::Index>(k)] = scene.contact(contacts[k], k, own, {}, t).at.gap;
    const Eigen::Matrix<double, 6, 1> move = -undoing(now, gapRows(now)) * gaps;
    const Vec3 turn = move.tail<3>();
    state.x += move.head<3>();
    if (turn.norm() > 0) state.q = (expSO3(turn) * state.q).normalized();
  }
  for (int round = 0; round < rounds; ++round) {
    const ConstrainedInstant now = instantOf(scene, contacts, state, t, none);
    const Rows C = constrainedRows(now, contacts);
    Eigen::Matrix<double, 6, 1> velocity;
    velocity << now.body.v, now.body.omega;
    Eigen::Matrix<double, 6, Eigen::Dynamic> moved;
    const Eigen::VectorXd impulse = -(inverseMass(now, C, moved) * (C * velocity - supportSpeeds(now, contacts)));
    const Eigen::Matrix<double, 6, 1> change = moved * impulse;
    if (stopped) addImpulses(now, contacts, impulse, *stopped);
    const Mat3 R = state.q.toRotationMatrix();
    state.v += change.head<3>();
    state.L += R * scene.model->inertia.cwiseProduct(R.transpose() * change.tail<3>());
  }
  return state;
}

}  // namespace carom::adjoint_detail
