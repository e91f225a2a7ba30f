// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/scene/shape.h"

namespace carom {

/// How the coefficients of two materials become the pair's. Where two materials name different rules, the
/// earlier one of average, minimum, maximum, multiply holds (as in glTF's KHR_physics_rigid_bodies).
enum class Combine { average, minimum, maximum, multiply };

struct Material {
  std::string name;
  double elasticity = 0.5;             ///< coefficient of restitution e, in [0, 1]
  double friction = 0.5;               ///< Coulomb coefficient, >= 0; 0 is frictionless
  double tangential_elasticity = 0.0;  ///< e_t, in [-1, 1]; always combined by average
  Combine combine_elasticity = Combine::average;
  Combine combine_friction = Combine::average;
  std::string notes = {};  ///< for people; kept in documents
};

/// Inertia as written: derived from shape and mass; three principal moments about the shape's own axes; or a symmetric
/// matrix in the shape's axes, kept as principal moments and the rotation from principal to shape axes.
struct Inertia {
  enum class Source { derived, moments, matrix };
  Source source = Source::derived;
  Vec3 moments = Vec3::Zero();   ///< kg m^2, unless derived
  Quat axes = Quat::Identity();  ///< p_shape = axes * p_principal; identity unless matrix

  static Inertia fromMoments(const Vec3& moments);
  /// Eigen-decomposition of a symmetric matrix; axes that already are principal keep their order. Throws InputError for
  /// entries that are not finite.
  static Inertia fromMatrix(const Mat3& matrix);
  Mat3 matrix() const;
};

/// With whom a body may collide, by the names of systems that bodies belong to (as in glTF's KHR_physics_rigid_bodies).
struct CollisionFilter {
  std::vector<std::string> systems;           ///< that it belongs to
  std::vector<std::string> collide_with;      ///< unless empty: only with bodies that belong to one of these
  std::vector<std::string> not_collide_with;  ///< never with bodies that belong to one of these

  bool empty() const { return systems.empty() && collide_with.empty() && not_collide_with.empty(); }
  bool operator==(const CollisionFilter&) const = default;
};

/// One body as written. For bodies that move freely exactly one of `mass` and `density` is given.
struct Body {
  std::string name;
  bool fixed = false;
  /// Moves at its constant velocity and constant angular velocity, whatever strikes it. Not together with `fixed`.
  bool kinematic = false;
  double gravity_factor = 1;  ///< share of the scene's gravity that acts on it; nothing acts on what nothing moves
  CollisionFilter collision_filter;
  std::string material;  ///< name of a material; empty means a default Material
  Shape shape = Sphere{};
  std::optional<double> mass;            ///< kg
  std::optional<double> density;         ///< kg/m^3
  Inertia inertia;                       ///< about the centre of mass
  std::optional<Vec3> center_of_mass;    ///< in the shape's axes, m; without it the shape's own, of uniform density
  Vec3 position = Vec3::Zero();          ///< m, world, of the shape's origin
  Quat orientation = Quat::Identity();   ///< shape to world, unit
  Vec3 velocity = Vec3::Zero();          ///< m/s, world, of the centre of mass
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s, world axes
  std::string notes = {};                ///< for people; kept in documents

  /// No impact moves it: its mass and its inertia have no part in the motion.
  bool immovable() const { return fixed || kinematic; }
};

/// Whether two bodies ever collide: at least one of them can be moved by impacts, and the filters of both let them.
bool mayCollide(const Body& a, const Body& b);

/// Tilt of the collision normal at one impact of one body (equation 4 of docs/equations.md): the impulse uses
/// n' = (n + alpha t1 + beta t2)/|...|, n pointing out of the surface that was struck towards `body`.
struct Tilt {
  std::string body;
  int impact = 1;             ///< n-th impact of that body, 1 = first
  Vec2 value = Vec2::Zero();  ///< (alpha, beta)
};

/// Everything that causes a motion: plain, constant data.
struct Scene {
  Vec3 gravity{0, 0, -9.81};  ///< m/s^2
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Tilt> tilts;
};

/// Index of the named body or material; throws InputError that lists the names there are.
int bodyIndex(const Scene& scene, const std::string& name);
int materialIndex(const Scene& scene, const std::string& name);
/// Index of the material of a body; -1 when it names none. Throws InputError for a body that is not there.
int materialIndexOf(const Scene& scene, int body);
/// The material of a body; a default Material when it names none.
const Material& materialOf(const Scene& scene, const Body& body);

/// Throws InputError, with the JSON pointer of the place, for the first thing that is not physically meaningful:
/// non-finite numbers, non-positive sizes and masses, impossible moments, non-unit quaternions, names used twice or
/// unknown, fixed-only shapes that move, fixed bodies that are kinematic. Bodies that overlap at the start are found by the ContactSource.
void validate(const Scene& scene);

/// One set of numbers with the fields of a Scene. Read as a gradient each holds d(quantity)/d(field); read as a tangent
/// each holds the rate at which the field varies. Orientation is a world rotation vector applied on the left.
struct BodyDerivative {
  Vec3 position = Vec3::Zero(), orientation = Vec3::Zero(), velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
  double mass = 0, density = 0;  ///< only the one that the scene gives is used
  Vec3 inertia = Vec3::Zero();   ///< principal moments; unused when the inertia is derived
  Eigen::VectorXd size;          ///< the shape's dimensions, in the order of ShapeKind::dimension_names
};
struct MaterialDerivative {
  double elasticity = 0, friction = 0, tangential_elasticity = 0;
};
struct SceneDerivative {
  SceneDerivative() = default;
  /// All zero, with as many entries as the scene has.
  explicit SceneDerivative(const Scene& scene);

  Vec3 gravity = Vec3::Zero();
  std::vector<MaterialDerivative> materials;
  std::vector<BodyDerivative> bodies;
  std::vector<Vec2> tilts;

  /// Sum of products of all fields, <gradient, tangent>. Throws InputError where the other is of another scene's size.
  double dot(const SceneDerivative& other) const;
};
using SceneGradient = SceneDerivative;
using SceneTangent = SceneDerivative;

}  // namespace carom
