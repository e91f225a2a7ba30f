// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/scene/shape.h"

namespace carom {

/// How the coefficients of two materials combine. If two materials name different rules, the earlier one of average,
/// minimum, maximum, multiply applies (as in glTF's KHR_physics_rigid_bodies).
enum class Combine { average, minimum, maximum, multiply };

/// Contact coefficients of a surface.
struct Material {
  std::string name;                    ///< to which bodies refer
  double elasticity = 0.5;             ///< coefficient of restitution e, in [0, 1]
  double friction = 0.5;               ///< Coulomb coefficient, >= 0; 0 is frictionless
  double tangential_elasticity = 0.0;  ///< coefficient of tangential restitution e_t, in [-1, 1]; always averaged
  Combine combine_elasticity = Combine::average;  ///< rule for e
  Combine combine_friction = Combine::average;    ///< rule for the friction coefficient
  std::string notes = {};  ///< for readers; kept in documents
  bool operator==(const Material&) const = default;  ///< field by field
};

/// Inertia as written: derived from shape and mass; three principal moments about the shape's own axes; or a symmetric
/// matrix in the shape's axes, kept as principal moments and the rotation from principal to shape axes.
struct Inertia {
  /// How it is written.
  enum class Source { derived, moments, matrix };
  Source source = Source::derived;  ///< as read
  Vec3 moments = Vec3::Zero();   ///< kg m^2, unless derived
  Quat axes = Quat::Identity();  ///< p_shape = axes * p_principal; identity unless matrix
  bool operator==(const Inertia&) const = default;  ///< as written

  /// Three principal moments about the axes of the shape, kg m^2.
  static Inertia fromMoments(const Vec3& moments);
  /// Eigendecomposition of a symmetric matrix; a diagonal matrix keeps its order. Throws InputError for entries that
  /// are not finite, and where two that mirror each other differ by more than 1e-12 of the largest.
  static Inertia fromMatrix(const Mat3& matrix);
  /// The tensor in the axes of the shape, kg m^2; 0 if derived.
  Mat3 matrix() const;
};

/// Which bodies a body may collide with, by the names of collision systems (as in glTF's KHR_physics_rigid_bodies).
struct CollisionFilter {
  std::vector<std::string> systems;           ///< that it belongs to
  std::vector<std::string> collide_with;      ///< unless empty: only with bodies that belong to one of these
  std::vector<std::string> not_collide_with;  ///< never with bodies that belong to one of these

  /// No restriction: the body collides with all.
  bool empty() const { return systems.empty() && collide_with.empty() && not_collide_with.empty(); }
  bool operator==(const CollisionFilter&) const = default;  ///< the same names in the same order
};

/// One body as specified. For dynamic bodies exactly one of `mass` and `density` is given.
struct Body {
  std::string name;    ///< unique in a scene
  bool fixed = false;  ///< never moves
  /// Moves at constant velocity and angular velocity, unaffected by impacts. Excludes `fixed`.
  bool kinematic = false;
  double gravity_factor = 1;  ///< factor on the scene's gravity; ignored for fixed and kinematic bodies
  CollisionFilter collision_filter;  ///< which bodies it may collide with
  std::string material;  ///< name of a material; empty means a default Material
  Shape shape = Sphere{};                ///< for collisions, and for mass properties that are derived
  std::optional<double> mass;            ///< kg
  std::optional<double> density;         ///< kg/m^3
  Inertia inertia;                       ///< about the centre of mass
  std::optional<Vec3> center_of_mass;    ///< in the shape's axes, m; default: that of the shape at uniform density
  Vec3 position = Vec3::Zero();          ///< m, world, of the shape's origin
  Quat orientation = Quat::Identity();   ///< shape to world, unit
  Vec3 velocity = Vec3::Zero();          ///< m/s, world, of the centre of mass
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s, world axes
  /// Velocity beta0 and angular velocity w0 of the material of its surface beside its own motion, in the axes and about the
  /// origin of the shape, m/s and rad/s: a belt, a turntable plate. Of fixed and kinematic bodies alone. At a contact at p with
  /// normal n it is the part along the surface of R beta0 + (R w0) x (p - position): (4.6) of docs/equations.md.
  Vec3 surface_velocity = Vec3::Zero();
  Vec3 surface_angular_velocity = Vec3::Zero();  ///< w0, see surface_velocity
  std::string notes = {};                        ///< for readers; kept in documents

  /// Fixed or kinematic: its mass and inertia are ignored.
  bool immovable() const { return fixed || kinematic; }
  /// Whether its surface moves beside the body itself.
  bool surfaceMoves() const { return !surface_velocity.isZero(0) || !surface_angular_velocity.isZero(0); }
  bool operator==(const Body&) const = default;  ///< field by field, as written
};

/// Whether two bodies may collide: at least one of them is dynamic, and the filters of both allow it.
bool mayCollide(const Body& a, const Body& b);

/// Tilt of the contact normal at one impact of one body (docs/equations.md, section 4): the impulse uses n' = (n +
/// alpha t1 + beta t2)/|...|, n pointing from the struck surface towards `body`.
struct Tilt {
  std::string body;           ///< name of the body whose impact it is
  int impact = 1;             ///< n-th impact of that body, 1 = first
  Vec2 value = Vec2::Zero();  ///< (alpha, beta)
  bool operator==(const Tilt&) const = default;  ///< field by field
};

/// All inputs of a simulation: plain data.
struct Scene {
  Vec3 gravity{0, 0, -9.81};  ///< m/s^2
  std::vector<Material> materials;  ///< named by the bodies
  std::vector<Body> bodies;         ///< moving and fixed
  std::vector<Tilt> tilts;          ///< of single impacts
};

/// Index of the named body; throws InputError that lists the existing names.
int bodyIndex(const Scene& scene, const std::string& name);
/// Index of the named material; throws InputError that lists the existing names.
int materialIndex(const Scene& scene, const std::string& name);
/// Index of the material of a body; -1 when it names none. Throws InputError for an unknown body.
int materialIndexOf(const Scene& scene, int body);
/// The material of a body; a default Material when it names none.
const Material& materialOf(const Scene& scene, const Body& body);

/// Throws InputError, with a JSON pointer, for the first invalid input: non-finite numbers, non-positive sizes and
/// masses, impossible moments, non-unit quaternions, duplicate or unknown names, fixed-only shapes that move, fixed
/// bodies that are kinematic, moving surfaces of bodies that impacts move. Bodies that overlap at the start are found by the ContactSource.
void validate(const Scene& scene);

/// Derivatives with respect to the parameters of one body. As a gradient each field holds d(quantity)/d(parameter);
/// as a tangent each holds the rate of change of the parameter. Orientation is a world rotation vector applied on the
/// left.
template <class S>
struct BodyDerivativeOf {
  using Vector = Eigen::Matrix<S, 3, 1>;      ///< three numbers
  Vector position = Vector::Zero();           ///< m
  Vector orientation = Vector::Zero();        ///< rad, a world rotation vector
  Vector velocity = Vector::Zero();           ///< m/s
  Vector angular_velocity = Vector::Zero();   ///< rad/s
  S mass = 0;                                 ///< kg; used where the scene gives the mass
  S density = 0;                              ///< kg/m^3; used where the scene gives the density
  Vector inertia = Vector::Zero();            ///< principal moments; unused when the inertia is derived
  Eigen::Matrix<S, Eigen::Dynamic, 1> size;   ///< the shape's dimensions, in the order of ShapeKind::dimension_names
  Vector surface_velocity = Vector::Zero();          ///< m/s, shape axes; 0 for a body that impacts move
  Vector surface_angular_velocity = Vector::Zero();  ///< rad/s, shape axes; 0 for a body that impacts move
};
/// The coefficients of one material, see BodyDerivativeOf.
template <class S>
struct MaterialDerivativeOf {
  S elasticity = 0;             ///< of e
  S friction = 0;               ///< of mu
  S tangential_elasticity = 0;  ///< of e_t
};
/// All scene parameters, see BodyDerivativeOf.
template <class S>
struct SceneDerivativeOf {
  SceneDerivativeOf() = default;  ///< of a scene without bodies
  /// All zero, with the dimensions of the scene.
  explicit SceneDerivativeOf(const Scene& scene)
      : materials(scene.materials.size()),
        bodies(scene.bodies.size()),
        tilts(scene.tilts.size(), Eigen::Matrix<S, 2, 1>::Zero()) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Shape& shape = scene.bodies[i].shape;
      bodies[i].size.setZero(kindOf(shape).dimensions(shape).size());
    }
  }

  Eigen::Matrix<S, 3, 1> gravity = Eigen::Matrix<S, 3, 1>::Zero();  ///< of Scene::gravity
  std::vector<MaterialDerivativeOf<S>> materials;                   ///< one a material
  std::vector<BodyDerivativeOf<S>> bodies;                          ///< one a body
  std::vector<Eigen::Matrix<S, 2, 1>> tilts;                        ///< one a tilt

  /// Sum of products of all fields, <gradient, tangent>. Throws InputError if the dimensions differ.
  S dot(const SceneDerivativeOf& other) const;
};
/// The sum in doubles.
template <>
double SceneDerivativeOf<double>::dot(const SceneDerivativeOf& other) const;
using BodyDerivative = BodyDerivativeOf<double>;          ///< of one body
using MaterialDerivative = MaterialDerivativeOf<double>;  ///< of one material
using SceneDerivative = SceneDerivativeOf<double>;        ///< of a scene
using SceneGradient = SceneDerivative;                    ///< read as a gradient
using SceneTangent = SceneDerivative;                     ///< read as a tangent

}  // namespace carom
