// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "adjoint/impact/contact_part.hpp"
#include "adjoint/motion/motion.h"
#include "adjoint/impact/law.hpp"
#include "adjoint/motion/pair_rules.hpp"

namespace carom::adjoint_detail {

/// An impact of one contact, linearised in fixed sizes: nearly every event of a motion is one (docs/decisions.md has the
/// figures). Its reverse pass is that of EventPass but for rounding.
class SingleImpact {
 public:
  /// Whether an event is such an impact: of doubles, without a tilt, and no contact lasts after it.
  static bool is(const Event& event);

  /// `materials`: the index of each body's material, -1 for none.
  SingleImpact(const Motion& motion, const Event& event, const std::vector<int>& materials);

  using States = std::vector<StateDerivative>;
  using Pair = std::array<StateDerivative, 2>;
  /// See EventPass::pullback. One entry a participant is set.
  Pair pullback(const States& after_bar, const States& read_bar, double time_bar, SceneGradient& scene_bar,
                std::vector<BodyModelDerivative>& model_bar) const;

 private:
  using Vec7 = Eigen::Matrix<double, 7, 1>;
  using Vec12 = Eigen::Matrix<double, 12, 1>;
  struct Side {
    int body, participant;  // -1: a fixed body
  };
  struct Mover {
    int body;
    double sign;  // 1 for a of the contact, -1 for b
    bool moves;   // impulses move it
    bool round;   // its three moments are equal: A is a multiple of 1
    double inverse_mass;
    Mat3 R, A;  // A: inverse inertia in world axes
    Vec3 r, L, omega;
    StateDerivative rate_before, rate_after;
  };

  void throughLaw(const States& after_bar, Pair& bar, SceneGradient& scene_bar,
                  std::vector<BodyModelDerivative>& model_bar) const;
  // Of the velocity of the moving surface; adds to that of the contact.
  void surfacePullback(const Vec3& u_bar, Vec7& contact, Pair& bar, SceneGradient& scene_bar,
                       std::vector<BodyModelDerivative>& model_bar) const;
  // Adjoints of poses and dimensions, to the participants or to the scene.
  template <class SizeA, class SizeB>
  void scatter(const Vec12& pose, const SizeA& size_a, const SizeB& size_b, Pair& bar, SceneGradient& scene_bar) const;

  Side a_, b_;
  std::optional<SurfacePart<double>> surface_;
  ContactJacobian J_;
  int material_a_, material_b_;
  PairRules<double> rules_;
  ContactProblem problem_;
  Vec3 impulse_;
  std::array<Mover, 2> movers_;
  std::size_t count_;
  double guard_rate_ = 0;
};

}  // namespace carom::adjoint_detail
