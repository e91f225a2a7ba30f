// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_inputs.hpp"

namespace carom::adjoint_detail {

/// What bodies rest on that moves: from a time on its material goes as one rigid body wherever they touch it. A kinematic
/// body, or a belt that runs straight (docs/equations.md, 11.33).
struct Carrier {
  int body = -1;
  double start = 0;                ///< s
  Support support;                 ///< from there on
  Vec3 normal = Vec3::UnitZ();     ///< of the face that is a belt

  struct Instant {
    Vec3 x = Vec3::Zero();             ///< m, a place of it
    Mat3 turned = Mat3::Identity();    ///< since the start
    Vec3 v = Vec3::Zero(), w = Vec3::Zero();  ///< m/s of x, rad/s; both constant
    Vec3 velocityAt(const Vec3& p) const { return v + w.cross(Vec3(p - x)); }
    Vec3 accelerationAt(const Vec3& p) const { return w.cross(Vec3(w.cross(Vec3(p - x)))); }
  };
  Instant at(double t) const;

  /// Rates of (x, v, w) of the start, or their adjoints.
  struct Derivative {
    Vec3 x = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero();
  };
  Derivative tangent(const Motion& motion, const SceneTangent& dscene) const;
  /// Its adjoint: adds to that of the scene.
  void pullback(const Motion& motion, const Derivative& bar, SceneGradient& scene_bar) const;
  /// How (x, theta) at time t go with those of the start, and with v and w.
  SupportFlow flowTo(double t) const { return SupportFlow::of(support, start, t); }

  /// The same of another motion, from a time on.
  Carrier from(const Motion& motion, double t) const { return {body, t, supportOf(motion, body, t), normal}; }

  bool isBelt() const { return !support.moves(); }
};

/// What carries bodies, of which these contacts with others are known: nothing that moves, one carrier, or several things
/// that go otherwise, and what does not go uniformly.
struct Carried {
  bool alike = true;
  std::optional<Carrier> by;
};
Carried carriedBy(const Motion& motion, const std::vector<const Contact*>& outer, double time);

}  // namespace carom::adjoint_detail
