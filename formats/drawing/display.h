// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"

namespace carom {

/// Triangles of a body for drawing, in the axes of its shape, counter-clockwise seen from outside: round shapes are
/// inscribed, hulls and meshes as they are, compounds part by part.
struct DisplayMesh {
  std::vector<float> positions;          ///< m, x y z of each vertex
  std::vector<float> normals;            ///< x y z of each vertex, unit
  std::vector<std::uint32_t> triangles;  ///< three vertices each
  std::vector<std::uint32_t> accent;     ///< triangles of a second shade, which show the rotation of a round body

  bool operator==(const DisplayMesh&) const = default;  ///< the same numbers in the same order
};

/// The mesh that pictures and glTF files show of a body. An endless plane becomes a square of the given half width
/// [m] about its point nearest to the origin of the body. Throws InputError for an invalid body and a half width that
/// is not positive.
DisplayMesh displayMesh(const Scene& scene, int body, double plane_half_width);

/// The path of a body for drawing: enough to evaluate any time of the motion without a simulator.
///
/// Its centre of mass at time t, by the last of `arcs` that does not begin after t and s = t - time:
///   x(t) = position + velocity s + acceleration s^2/2 + third s^3 + fourth s^4 + fifth s^5.
/// Its orientation by the two `turns` about t and spherical interpolation (slerp), before the first and after the last
/// that one itself. The origin of its shape is then x(t) - q(t) center.
struct DisplayTrack {
  /// Start of a polynomial, valid up to the next key or the end of the motion. Flights, rest, rolling and straight
  /// slides are exact parabolas. A curved slide, where friction rotates with the slip, is subdivided: between keys,
  /// which have the motion's position, velocity and acceleration, the polynomial is within 1e-9 m of it.
  struct ArcKey {
    double time = 0;                   ///< s
    Vec3 position = Vec3::Zero();      ///< m, of the centre of mass; of a fixed body its shape's origin
    Vec3 velocity = Vec3::Zero();      ///< m/s
    Vec3 acceleration = Vec3::Zero();  ///< m/s^2, by gravity and contacts
    Vec3 third = Vec3::Zero();         ///< m/s^3; this and the next are 0 except on curved slides
    Vec3 fourth = Vec3::Zero();        ///< m/s^4
    Vec3 fifth = Vec3::Zero();         ///< m/s^5

    bool isParabola() const;                         ///< third, fourth and fifth are 0
    Vec3 positionAt(double t) const;                 ///< m, of the centre of mass
    Vec3 velocityAt(double t) const;                 ///< m/s
    /// Neither a bool nor a character is a time.
    template <NoTime T>
    Vec3 positionAt(T t) const = delete;
    /// The same.
    template <NoTime T>
    Vec3 velocityAt(T t) const = delete;
    bool operator==(const ArcKey&) const = default;  ///< the same numbers
  };
  /// An orientation, shape to world.
  struct TurnKey {
    float time = 0;  ///< s; the orientation is that of this very time
    float w = 1;     ///< real part of the unit quaternion
    float x = 0;     ///< imaginary parts of it
    float y = 0;     ///< y
    float z = 0;     ///< z

    bool operator==(const TurnKey&) const = default;  ///< the same numbers
  };

  std::vector<ArcKey> arcs;    ///< at least one, times strictly increasing
  /// At least one, times strictly increasing; neighbours lie in one hemisphere and about 1 rad apart at most.
  std::vector<TurnKey> turns;
  Vec3 center = Vec3::Zero();  ///< of mass, in the axes of the shape, m

  bool operator==(const DisplayTrack&) const = default;  ///< the same keys
};

/// The track of a body, whose orientation is within `turn_tolerance` [rad] of the motion. Throws InputError for an
/// invalid body, a tolerance that is not positive, and a body that would need more than 2 million keys.
DisplayTrack displayTrack(const Motion& motion, int body, double turn_tolerance = 2e-3);

}  // namespace carom
