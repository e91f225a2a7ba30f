// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Contacts of one body along their normals: columns of (n, r x n), n towards the body, and how an impulse of 1 along
/// each moves it, (n/m, A (r x n)).
struct NormalContacts {
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows, moved;

  NormalContacts(const BodyModel& model, const State& state, int body, const std::vector<const Contact*>& contacts)
      : rows(6, contacts.size()) {
    const Mat3 A = model.mobilityWorld(state.q.toRotationMatrix());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Vec3 n = (contacts[k]->a == body ? 1.0 : -1.0) * contacts[k]->at.normal;
      rows.col(static_cast<Eigen::Index>(k)) << n, (contacts[k]->at.point - state.x).cross(n);
    }
    moved = rows;
    moved.topRows<3>() *= model.inverse_mass;
    moved.bottomRows<3>() = A * rows.bottomRows<3>();
  }
  /// N^T K N
  Eigen::MatrixXd mobility() const { return rows.transpose() * moved; }
};

}  // namespace carom::adjoint_detail
