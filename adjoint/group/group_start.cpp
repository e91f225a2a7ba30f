// SPDX-License-Identifier: MIT
#include "adjoint/group/group_start.hpp"

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Rows that depend on others to this share have no part of their own.
constexpr double kDependentRows = 1e-10;

void putRow(const GroupInstant& now, const GroupContact& of, const GroupContactInstant& c, const Vec3& along, Eigen::Index row, Eigen::MatrixXd& C) {
  const auto put = [&](int member, double sign) {
    if (member < 0) return;
    const Vec3 r = c.point - now.members[static_cast<std::size_t>(member)].x;
    C.row(row).segment<3>(6 * member) = sign * along.transpose();
    C.row(row).segment<3>(6 * member + 3) = sign * r.cross(along).transpose();
  };
  put(of.member_a, 1), put(of.member_b, -1);
}

// M^-1 C^T
Eigen::MatrixXd movedBy(const GroupInstant& now, const Eigen::MatrixXd& C) {
  Eigen::MatrixXd moved(C.cols(), C.rows());
  for (std::size_t m = 0; m < now.members.size(); ++m) {
    moved.middleRows<3>(6 * rowAt(m)) = now.members[m].inverse_mass * C.middleCols<3>(6 * rowAt(m)).transpose();
    moved.middleRows<3>(6 * rowAt(m) + 3) = now.members[m].A * C.middleCols<3>(6 * rowAt(m) + 3).transpose();
  }
  return moved;
}

// What of (v, w), or of (x, theta), makes these rows 0, from where they come to `value`.
Eigen::VectorXd undone(const GroupInstant& now, const Eigen::MatrixXd& C, const Eigen::VectorXd& value) {
  const Eigen::MatrixXd moved = movedBy(now, C);
  return moved * LeastNormSolve(C * moved, value).y;
}

}  // namespace

Eigen::MatrixXd gapRows(const GroupInstant& now, const std::vector<GroupContact>& contacts) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(rowAt(contacts.size()), 6 * rowAt(now.members.size()));
  for (std::size_t k = 0; k < contacts.size(); ++k) putRow(now, contacts[k], now.contacts[k], now.contacts[k].n, rowAt(k), C);
  return C;
}

Eigen::MatrixXd speedRows(const GroupInstant& now, const std::vector<GroupContact>& contacts) {
  Index rows = 0, row = 0;
  for (const GroupContact& c : contacts) rows += c.stands() ? 3 : 1;
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(rows, 6 * rowAt(now.members.size()));
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!contacts[k].stands()) putRow(now, contacts[k], now.contacts[k], now.contacts[k].n, row++, C);
    else
      for (int i = 0; i < 3; ++i) putRow(now, contacts[k], now.contacts[k], Vec3::Unit(i), row++, C);
  }
  return C;
}

Eigen::MatrixXd velocityRows(const GroupInstant& now, const std::vector<GroupContact>& contacts, const std::vector<std::size_t>& at) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(3 * rowAt(at.size()), 6 * rowAt(now.members.size()));
  Index row = 0;
  for (const std::size_t k : at)
    for (int i = 0; i < 3; ++i) putRow(now, contacts[k], now.contacts[k], Vec3::Unit(i), row++, C);
  return C;
}

Eigen::MatrixXd undoing(const GroupInstant& now, const Eigen::MatrixXd& C) {
  const Eigen::MatrixXd moved = movedBy(now, C);
  return moved * CompleteOrthogonal(C * moved, kDependentRows).pseudoInverse();
}

std::vector<State> groupStart(const GroupScene& scene, const std::vector<GroupContact>& contacts, std::vector<State> states, double t,
                              int rounds) {
  const std::vector<Vec3> none(contacts.size(), Vec3::Zero());
  if (contacts.empty()) return states;
  for (int round = 0; round < rounds; ++round) {
    const GroupInstant now = instantOf(scene, contacts, states, t, none);
    Eigen::VectorXd gaps(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) gaps[rowAt(k)] = now.contacts[k].gap;
    const Eigen::VectorXd move = undone(now, gapRows(now, contacts), gaps);
    for (std::size_t m = 0; m < states.size(); ++m) {
      const Vec3 turn = move.segment<3>(6 * rowAt(m) + 3);
      states[m].x += move.segment<3>(6 * rowAt(m));
      if (turn.norm() > 0) states[m].q = (expSO3(turn) * states[m].q).normalized();
    }
  }
  for (int round = 0; round < rounds; ++round) {
    const GroupInstant now = instantOf(scene, contacts, states, t, none);
    const Eigen::MatrixXd C = speedRows(now, contacts);
    Eigen::VectorXd speeds(C.rows());
    Index row = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const GroupContactInstant& c = now.contacts[k];
      if (!contacts[k].stands()) speeds[row++] = c.n.dot(c.u);
      else speeds.segment<3>(row) = c.u, row += 3;
    }
    const Eigen::VectorXd change = undone(now, C, speeds);
    for (std::size_t m = 0; m < states.size(); ++m) {
      const Mat3 R = states[m].q.toRotationMatrix();
      states[m].v += change.segment<3>(6 * rowAt(m));
      states[m].L += R * scene.members[m].model->inertia.cwiseProduct(R.transpose() * change.segment<3>(6 * rowAt(m) + 3));
    }
  }
  return states;
}

}  // namespace carom::adjoint_detail
