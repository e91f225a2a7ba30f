// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/contact_part.hpp"
#include "adjoint/impact/directed_solve.hpp"
#include "adjoint/impact/impact_pass.hpp"

namespace carom::adjoint_detail {

/// Contacts that last keep their gaps at 0 whatever varies: after an event that begins them, the poses move as little as
/// possible, as measured by the masses (11.13 of docs/equations.md),
///   dq <- dq - M^-1 G^T (G M^-1 G^T)^+ dgap,  dgap = G dq + the gaps' own change with the scene.
template <class S>
class PoseProjection {
 public:
  PoseProjection() = default;
  PoseProjection(const std::vector<ContactPart<S>>& parts, const ImpactInputs<S>& in) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (parts[k].closes) lasting_.push_back(k);
    if (lasting_.empty()) return;
    const auto n = static_cast<Eigen::Index>(lasting_.size()), poses = 6 * static_cast<Eigen::Index>(in.bodies.size());
    G_ = MatrixOf<S>::Zero(n, poses);
    for (Eigen::Index k = 0; k < n; ++k) {
      const ContactPart<S>& part = parts[lasting_[static_cast<std::size_t>(k)]];
      Eigen::Index at = 0;
      for (const auto& side : {part.a, part.b}) {
        if (side.participant >= 0) G_.template block<1, 6>(k, 6 * side.participant) = part.pose.template block<1, 6>(0, at);
        at += 6;
      }
    }
    moved_ = MatrixOf<S>::Zero(poses, n);
    for (std::size_t i = 0; i < in.bodies.size(); ++i) {
      const auto& b = in.bodies[i];
      if (b.kinematic) continue;
      const auto row = 6 * static_cast<Eigen::Index>(i);
      const M3<S> A = b.R * b.D * b.R.transpose();
      moved_.template middleRows<3>(row) = b.inverse_mass * G_.template middleCols<3>(row).transpose();
      moved_.template middleRows<3>(row + 3) = A * G_.template middleCols<3>(row + 3).transpose();
    }
    inverse_ = LeastNorm<S>(MatrixOf<S>(G_ * moved_), VectorOf<S>(VectorOf<S>::Zero(n))).inverse;
  }

  /// Contacts of the event whose gaps are closed.
  const std::vector<std::size_t>& lasting() const { return lasting_; }

  /// Moves the poses of the participants, where the gaps of `lasting()` have these tangents.
  void apply(const VectorOf<S>& gaps, std::vector<StateDerivativeOf<S>>& after) const {
    const VectorOf<S> move = moveOf(gaps);
    for (std::size_t i = 0; i < after.size(); ++i) {
      after[i].x += move.template segment<3>(6 * static_cast<Eigen::Index>(i));
      after[i].theta += move.template segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
    }
  }
  /// m = -M^-1 G^T K^+ gap, by which poses move.
  VectorOf<S> moveOf(const VectorOf<S>& gaps) const { return -(moved_ * (inverse_ * gaps)); }

  /// Turns do not commute with the turn of a move m, which has nothing but rates. Adjoints of poses exp(m) q by q, for a
  /// share of 1, and by m, for a share of 1/2: theta_bar - share m x theta_bar.
  static std::vector<StateDerivativeOf<S>> turnedBack(std::vector<StateDerivativeOf<S>> after_bar, const VectorOf<S>& move,
                                                      double share) {
    for (std::size_t i = 0; i < after_bar.size(); ++i) {
      const V3<S> turn = move.template segment<3>(6 * static_cast<Eigen::Index>(i) + 3);
      after_bar[i].theta -= share * V3<S>(turn.cross(after_bar[i].theta));
    }
    return after_bar;
  }

  /// What the step has of the adjoint of its rows and of M^-1: nothing but rates, as the gaps have no values. With
  /// y = K^+ gap, p = K^+ G M^-1 q_bar and K = G M^-1 G^T:
  ///   G_bar = p (M^-1 G^T y)^T - y (M^-1 (q_bar - G^T p))^T,  M^-1_bar = -(q_bar - G^T p) (G^T y)^T.
  struct Bars {
    MatrixOf<S> rows;               // of G
    VectorOf<S> held, pushed;       // q_bar - G^T p, G^T y
  };
  Bars bars(const VectorOf<S>& gaps, const std::vector<StateDerivativeOf<S>>& after_bar,
            const ImpactInputs<S>& in) const {
    const VectorOf<S> q_bar = posesOf(after_bar), y = inverse_ * gaps, p = inverse_ * (moved_.transpose() * q_bar);
    Bars out;
    out.held = q_bar - G_.transpose() * p;
    out.pushed = G_.transpose() * y;
    out.rows = p * (moved_ * y).transpose() - y * mobile(in, out.held).transpose();
    return out;
  }

  /// The adjoints of the gaps of `lasting()`.
  VectorOf<S> pullback(const std::vector<StateDerivativeOf<S>>& after_bar) const {
    return -(inverse_ * (moved_.transpose() * posesOf(after_bar)));
  }

 private:
  VectorOf<S> posesOf(const std::vector<StateDerivativeOf<S>>& states) const {
    VectorOf<S> poses(moved_.rows());
    for (std::size_t i = 0; i < states.size(); ++i)
      poses.template segment<6>(6 * static_cast<Eigen::Index>(i)) << states[i].x, states[i].theta;
    return poses;
  }
  // M^-1 q
  static VectorOf<S> mobile(const ImpactInputs<S>& in, const VectorOf<S>& q) {
    VectorOf<S> out = VectorOf<S>::Zero(q.size());
    for (std::size_t i = 0; i < in.bodies.size(); ++i) {
      const auto& b = in.bodies[i];
      if (b.kinematic) continue;
      const auto row = 6 * static_cast<Eigen::Index>(i);
      out.template segment<3>(row) = b.inverse_mass * q.template segment<3>(row);
      out.template segment<3>(row + 3) = b.R * (b.D * (b.R.transpose() * q.template segment<3>(row + 3)));
    }
    return out;
  }

  std::vector<std::size_t> lasting_;
  MatrixOf<S> G_, moved_, inverse_;  // rows of the gaps by the poses; M^-1 G^T; (G M^-1 G^T)^+
};

}  // namespace carom::adjoint_detail
