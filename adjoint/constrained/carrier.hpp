// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/constrained/constrained_inputs.hpp"

namespace carom::adjoint_detail {

/// What bodies rest on that moves: from a time on its material goes as one rigid body wherever they touch it
/// (docs/equations.md, 11.33). A kinematic body, a face whose surface runs straight or turns about its normal, or several of
/// these that translate alike.
struct Carrier {
  /// One of these bodies.
  struct Part {
    int body = -1;
    Support support;                  ///< from the start on
    Vec3 normal = Vec3::UnitZ();      ///< of the face that is touched, in shape axes
    double height = 0;                ///< m, of the face above the shape's origin

    Vec3 normalInWorld() const { return support.pose.R * normal; }
    Vec3 origin() const { return support.pose.x - support.pose.R * support.center; }  ///< of the shape, at the start
    Vec3 surfaceVelocity() const;  ///< m/s, of the material at the origin, seen from the body
    Vec3 surfaceSpin() const;      ///< rad/s
  };
  double start = 0;  ///< s
  std::vector<Part> parts;

  struct Instant {
    Vec3 x = Vec3::Zero();             ///< m, a place of it
    Vec3 moved = Vec3::Zero();         ///< m, since the start
    Mat3 turned = Mat3::Identity();    ///< since the start
    Vec3 v = Vec3::Zero(), w = Vec3::Zero();  ///< m/s of x, rad/s; w is constant
    Vec3 a = Vec3::Zero();             ///< m/s^2 of x
    Vec3 velocityAt(const Vec3& p) const { return v + w.cross(Vec3(p - x)); }
    Vec3 accelerationAt(const Vec3& p) const { return a + w.cross(Vec3(w.cross(Vec3(p - x)))); }
  };
  Instant at(double t) const;

  /// The same of another motion, from a time on.
  Carrier from(const Motion& motion, double t) const;

  bool has(int body) const;
  /// A surface of it moves on the body that it is of.
  bool isBelt() const;
};

/// "'left' and 'right'".
std::string namesOf(const Motion& motion, const Carrier& carrier);

/// What carries bodies, of which these contacts with others are known: nothing that moves, one carrier, or several things
/// that go otherwise, and what does not go uniformly.
struct Carried {
  bool alike = true;
  std::optional<Carrier> by;
  std::vector<const Contact*> passing;  ///< of the contacts, those with surfaces that pass below them: the ends of belts
};
Carried carriedBy(const Motion& motion, const std::vector<const Contact*>& outer, double time);

}  // namespace carom::adjoint_detail
