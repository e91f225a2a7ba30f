// SPDX-License-Identifier: MIT
#include "adjoint/group/group_start.hpp"

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// A row of velocities of all members: of one direction at a contact.
Eigen::VectorXd rowOf(const GroupInstant& now, const GroupContact& of, const GroupContactInstant& c, const Vec3& along) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(6 * rowAt(now.members.size()));
  const auto put = [&](int member, double sign) {
    if (member < 0) return;
    const Vec3 r = c.point - now.members[static_cast<std::size_t>(member)].x;
    row.segment<3>(6 * member) = sign * along;
    row.segment<3>(6 * member + 3) = sign * r.cross(along);
  };
  put(of.member_a, 1), put(of.member_b, -1);
  return row;
}

// What of (v, w), or of (x, theta), makes these rows 0, from where they come to `value`.
Eigen::VectorXd undoing(const GroupInstant& now, const std::vector<Eigen::VectorXd>& rows, const std::vector<double>& value) {
  const Index n = rowAt(rows.size()), size = 6 * rowAt(now.members.size());
  Eigen::MatrixXd C(n, size), moved(size, n);
  for (Index i = 0; i < n; ++i) {
    const Eigen::VectorXd& row = rows[static_cast<std::size_t>(i)];
    C.row(i) = row.transpose();
    for (std::size_t m = 0; m < now.members.size(); ++m) {
      moved.block<3, 1>(6 * rowAt(m), i) = now.members[m].inverse_mass * row.segment<3>(6 * rowAt(m));
      moved.block<3, 1>(6 * rowAt(m) + 3, i) = now.members[m].A * row.segment<3>(6 * rowAt(m) + 3);
    }
  }
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(value.data(), n);
  return moved * LeastNormSolve(C * moved, b).y;
}

}  // namespace

std::vector<State> groupStart(const GroupScene& scene, const std::vector<GroupContact>& contacts, std::vector<State> states, double t,
                              int rounds) {
  const std::vector<Vec3> none(contacts.size(), Vec3::Zero());
  if (contacts.empty()) return states;
  for (int round = 0; round < rounds; ++round) {
    const GroupInstant now = instantOf(scene, contacts, states, t, none);
    std::vector<Eigen::VectorXd> rows;
    std::vector<double> gaps;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      rows.push_back(rowOf(now, contacts[k], now.contacts[k], now.contacts[k].n));
      gaps.push_back(now.contacts[k].gap);
    }
    const Eigen::VectorXd move = undoing(now, rows, gaps);
    for (std::size_t m = 0; m < states.size(); ++m) {
      const Vec3 turn = move.segment<3>(6 * rowAt(m) + 3);
      states[m].x += move.segment<3>(6 * rowAt(m));
      if (turn.norm() > 0) states[m].q = (expSO3(turn) * states[m].q).normalized();
    }
  }
  for (int round = 0; round < rounds; ++round) {
    const GroupInstant now = instantOf(scene, contacts, states, t, none);
    std::vector<Eigen::VectorXd> rows;
    std::vector<double> speeds;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const GroupContactInstant& c = now.contacts[k];
      if (!contacts[k].stands()) {
        rows.push_back(rowOf(now, contacts[k], c, c.n));
        speeds.push_back(c.n.dot(c.u));
        continue;
      }
      for (int i = 0; i < 3; ++i) rows.push_back(rowOf(now, contacts[k], c, Vec3::Unit(i))), speeds.push_back(c.u[i]);
    }
    const Eigen::VectorXd change = undoing(now, rows, speeds);
    for (std::size_t m = 0; m < states.size(); ++m) {
      const Mat3 R = states[m].q.toRotationMatrix();
      states[m].v += change.segment<3>(6 * rowAt(m));
      states[m].L += R * scene.members[m].model->inertia.cwiseProduct(R.transpose() * change.segment<3>(6 * rowAt(m) + 3));
    }
  }
  return states;
}

}  // namespace carom::adjoint_detail
