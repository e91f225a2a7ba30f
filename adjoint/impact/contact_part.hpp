// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/motion/motion.h"
#include "adjoint/motion/pair_rules.hpp"
#include "adjoint/scene/surface_motion.hpp"

namespace carom::adjoint_detail {

/// Of the rules of two materials, those that the law goes by: a contact that was captured, or is kept closed, has no
/// elasticity, and one that a motion begins with no friction either.
template <class S>
PairRules<S> inForce(PairRules<S> rules, const Event& event, const Contact& contact) {
  if (contact.captured || contact.kept) rules.elasticity = {};
  if (event.kind == EventKind::placed) rules.friction = {};
  return rules;
}

/// Of a rim that lies flat, whose point follows from how the rim tilts: (gap, normal, point) by the state of the body that has it, and
/// by all else. In doubles alone.
struct RimPart {
  std::size_t participant = 0;
  std::function<Eigen::Matrix<double, 7, 1>(const StateDerivative&, const SceneTangent&, const BodyModelDerivative&)> tangent;
  std::function<StateDerivative(const Eigen::Matrix<double, 7, 1>& bar, SceneGradient&, BodyModelDerivative&)> pullback;
};

/// The surface of one of the bodies of a contact, that moves or could.
template <class S>
struct SurfacePart {
  int body, participant;  // participant -1: a fixed body
  double sign;            // of its velocity in u: 1 for a of the contact, -1 for b
  SurfaceMotion<S> motion;
  V3<S> center;         // of mass, from the body's origin, in world axes
  V3<S> point, normal;  // of the contact
};

/// A contact of an event, linearised.
template <class S>
struct ContactPart {
  struct Side {
    int body, participant;  // participant -1: a fixed body
  };
  Side a, b;
  Eigen::Matrix<S, 7, 1> guard = Eigen::Matrix<S, 7, 1>::Zero();  // weights of (gap, normal, point) in the guard
  // d(gap, normal, point) by (x_a, theta_a, x_b, theta_b) and by the dimensions
  Eigen::Matrix<S, 7, 12> pose;
  Eigen::Matrix<S, 7, Eigen::Dynamic> size_a, size_b;
  std::shared_ptr<const RimPart> rim;  // in place of what is above, but that its first row stays
  bool closes = false;                 // its gap is 0 from here on
  S gap = 0;  // of a contact that persists from here on: 0, with its rates
  std::optional<SurfacePart<S>> surface;
  bool tilted = false;
  Eigen::Matrix<S, 3, 7> tilt;  // d(impulse normal) by (normal, tilt a, tilt b)
  int material_a = -1, material_b = -1;
  PairRules<S> rules;
};

}  // namespace carom::adjoint_detail
