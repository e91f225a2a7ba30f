// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// What an impact law sees: contacts k with unit normals n_k (b to a), relative velocities u_k before the impact and
/// the matrix K of 3x3 blocks with u+ = u + K P for impulses P (on a). All in world axes, in any kind of number.
template <class S>
struct ImpactProblemOf {
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> K;  ///< 3N x 3N, kg^-1
  Eigen::Matrix<S, Eigen::Dynamic, 1> u;               ///< 3N, m/s
  std::vector<Eigen::Matrix<S, 3, 1>> normal;          ///< N
  std::vector<PairCoefficientsOf<S>> pair;             ///< N
  /// A kinematic body takes part: u need not be in the range of what impulses can change.
  bool driven = false;
  /// Contacts, none or one entry each, with n.u = 0 before that keep n.u = 0 as an equation: their impulse may pull, and
  /// is without friction where it does.
  std::vector<char> held;

  int contacts() const { return static_cast<int>(normal.size()); }
};
using ImpactProblem = ImpactProblemOf<double>;

/// Tangent or adjoint of an ImpactProblem, field by field.
template <class S>
struct ImpactProblemDerivativeOf {
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> K;
  Eigen::Matrix<S, Eigen::Dynamic, 1> u;
  std::vector<Eigen::Matrix<S, 3, 1>> normal;
  std::vector<PairCoefficientsOf<S>> pair;

  explicit ImpactProblemDerivativeOf(int contacts) : normal(static_cast<std::size_t>(contacts)) {
    K.setZero(3 * contacts, 3 * contacts);
    u.setZero(3 * contacts);
    for (auto& n : normal) n.setZero();
    pair.resize(normal.size());
  }
};
using ImpactProblemDerivative = ImpactProblemDerivativeOf<double>;

/// What became of a contact: no impulse keeps it; it is on its cone, or without friction; it is inside, where friction
/// does all it can (u_t+ = 0 without elasticities).
enum class ContactOutcome : char { off, slides, sticks };

/// Impulses, and the branch that was taken.
template <class S>
struct ImpactSolutionOf {
  Eigen::Matrix<S, Eigen::Dynamic, 1> P;  ///< 3N, N s, on a
  ImpactMode mode = ImpactMode::frictionless;
  double stick_slip_margin = 1;  ///< see Margins
  std::vector<ContactOutcome> outcome;  ///< N
  std::vector<char> closed;             ///< N: n.u+ = 0 by the branch, as e = 0 or it is held
  bool loses_digits = false;            ///< derivatives do, in doubles
};
using ImpactSolution = ImpactSolutionOf<double>;

/// The same for one contact, of fixed size.
template <class S>
struct ContactProblemOf {
  Eigen::Matrix<S, 3, 3> K;
  Eigen::Matrix<S, 3, 1> u, normal;
  PairCoefficientsOf<S> pair;
};
using ContactProblem = ContactProblemOf<double>;
/// The only contact of a problem.
template <class S>
ContactProblemOf<S> onlyContact(const ImpactProblemOf<S>& p) {
  return {p.K, p.u, p.normal[0], p.pair[0]};
}

}  // namespace carom::adjoint_detail
