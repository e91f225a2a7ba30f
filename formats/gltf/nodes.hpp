// SPDX-License-Identifier: MIT
// Private to formats/*.cpp. What a glTF file says about physics (KHR_physics_rigid_bodies, KHR_implicit_shapes), in its
// own words but in our axes: z up, for the axes of every node too (frame.hpp), so that round shapes lie along z and
// planes face z. Every node is in the axes of its parent.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/scene/scene.h"
#include "formats/gltf/import_report.h"
#include "formats/json/json.hpp"

namespace carom::gltf {

using namespace formats_detail;

/// A capsule or cylinder along z. Heights of capsules are between the centres of their ends.
struct Tapered {
  bool capsule = false;
  double height = 0.5, bottom = 0.25, top = 0.25;  ///< m; radii at -z and +z
};

/// A plane through the origin that faces +z; infinite where it has no size.
struct Sheet {
  std::optional<double> size_x, size_y;  ///< m
  bool double_sided = false;
};

/// The triangles of a mesh, or of the meshes at a node and below it, in the axes of that node.
struct MeshShape {
  int mesh = -1, node = -1;  ///< one of them
  bool convex = false;       ///< their convex hull is meant
};

using ColliderShape = std::variant<Sphere, Box, Tapered, Sheet, MeshShape>;

struct Collider {
  ColliderShape shape;
  int material = -1;  ///< index, -1 for none
  CollisionFilter filter = {};
};

/// The member `motion`. Vectors are in the axes of the node; velocities are not scaled with it.
struct Moving {
  bool kinematic = false;
  std::optional<double> mass;                          ///< kg; 0 means infinite
  std::optional<Vec3> center_of_mass;                  ///< m
  std::optional<Vec3> inertia_diagonal;                ///< kg m^2; 0 means infinite
  Quat inertia_orientation = Quat::Identity();         ///< principal to node axes
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  ///< m/s of the centre of mass, rad/s
  double gravity_factor = 1;
};

struct PhysicsNode {
  int index = -1;  ///< in the file
  std::string name;
  Vec3 translation = Vec3::Zero();
  Quat rotation = Quat::Identity();
  Vec3 scale = Vec3::Ones();
  std::optional<Moving> motion;
  std::optional<Collider> collider;
  /// Of its moving surface, in the axes of the node and about its origin: ours, in the extras of the node. m/s, rad/s.
  Vec3 surface_velocity = Vec3::Zero(), surface_angular_velocity = Vec3::Zero();
  bool animated = false;  ///< itself, or a node above that it moves along with
  std::vector<PhysicsNode> children;

  bool surfaceMoves() const { return !surface_velocity.isZero(0) || !surface_angular_velocity.isZero(0); }
  /// "node 'door' (/nodes/3)", for messages.
  std::string label() const;
};

/// An error at a node: its pointer, and a sentence that begins with its name.
InputError errorAt(const PhysicsNode& node, const std::string& sentence);

/// A name as a document takes it: cut between characters where it is long, with room for a number behind it.
std::string shortName(const std::string& name);

struct FileMaterial {
  Material material;
  bool none = false;  ///< stands for bodies that name no material
};

struct PhysicsFile {
  std::vector<PhysicsNode> roots;  ///< of the default scene
  std::vector<FileMaterial> materials;
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
};

/// Reads the default scene of a document that has passed checkGltf. What is there but not supported is listed in the
/// report by name. Throws InputError with the JSON pointer for values of the wrong kind and indices out of range.
PhysicsFile readPhysics(const Json& document, ImportReport& report);

/// Values below are the same when they differ by no more than this, relative to the length of their vector.
inline constexpr double kSame = 1e-12;

/// Whether two nodes have the same motion, collider and children with physics, number by number (kSame); materials are
/// compared by name. The nodes' own names and poses are not compared.
bool samePhysics(const PhysicsNode& a, const std::vector<FileMaterial>& materials_a, const PhysicsNode& b,
                 const std::vector<FileMaterial>& materials_b);
/// Whether they are in the same place and turned alike. An infinite plane may lie anywhere in itself.
bool samePlace(const PhysicsNode& a, const PhysicsNode& b);
bool sameMaterial(const Material& a, const Material& b);

}  // namespace carom::gltf
