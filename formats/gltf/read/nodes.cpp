// SPDX-License-Identifier: MIT
// Nodes of a glTF document -> PhysicsNode.
#include <algorithm>
#include <cmath>
#include <set>

#include "formats/base/unit.hpp"
#include "formats/gltf/axes.hpp"
#include "formats/gltf/read/parts.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/draco_mesh.hpp"
#include "formats/mesh/meshopt_views.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

constexpr int kDeepest = 500;  // nodes below one another; every level is a call
constexpr const char* kRigidBodies = "KHR_physics_rigid_bodies";

std::string labelOf(int index, const std::string& name) {
  const std::string pointer = index < 0 ? "" : "/nodes/" + std::to_string(index);
  if (name.empty()) return "node " + pointer;
  return "node '" + oneLine(name) + "'" + (pointer.empty() ? "" : " (" + pointer + ")");
}

/// A matrix is a rotation times a scale along the node's axes, as glTF asks; mirrored ones are mirrored in x. In the
/// axes of the file.
void setMatrix(PhysicsNode& node, const JsonPlace& matrix) {
  Mat3 columns;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      columns(static_cast<int>(k), static_cast<int>(i)) = matrix.at(4 * i + k).number();
    node.translation[static_cast<int>(i)] = matrix.at(12 + i).number();
  }
  node.scale = columns.colwise().norm();
  if (!(node.scale.minCoeff() > 0)) fail(matrix.pointer, "a matrix with an empty column", "one that can be inverted");
  if (columns.determinant() < 0) node.scale.x() = -node.scale.x();
  const Mat3 rotation = columns * node.scale.cwiseInverse().asDiagonal();
  constexpr double kFloats = 1e-5;
  if (!((rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff() <= kFloats))
    fail(matrix.pointer, "a matrix that shears", "a rotation with a scale along the axes");
  node.rotation = unitQuaternion(Quat(rotation));
}

Moving readMotion(const JsonPlace& motion) {
  Moving out;
  out.kinematic = motion.booleanOr("isKinematic", false);
  out.mass = motion.findNumber("mass");
  if (out.mass && !(*out.mass >= 0)) fail(motion.pointer + "/mass", numberText(*out.mass), "a number >= 0");
  if (const auto center = motion.findVector("centerOfMass")) out.center_of_mass = zUp(*center);
  out.inertia_diagonal = motion.findVector("inertiaDiagonal");
  if (out.inertia_diagonal && !(out.inertia_diagonal->minCoeff() >= 0))
    fail(motion.pointer + "/inertiaDiagonal", "a negative moment", "numbers >= 0");
  if (out.inertia_diagonal) out.inertia_diagonal = swappedSizes(*out.inertia_diagonal);
  if (const auto q = motion.find("inertiaOrientation")) out.inertia_orientation = zUp(q->quaternion());
  out.linear = zUp(motion.findVector("linearVelocity").value_or(Vec3::Zero()));
  out.angular = zUp(motion.findVector("angularVelocity").value_or(Vec3::Zero()));
  out.gravity_factor = motion.numberOr("gravityFactor", 1);
  return out;
}

std::set<int> animatedNodes(const JsonPlace& document) {
  std::set<int> nodes;
  const auto animations = document.find("animations");
  for (std::size_t i = 0; animations && i < animations->size(); ++i) {
    const auto channels = animations->at(i).find("channels");
    for (std::size_t k = 0; channels && k < channels->size(); ++k)
      if (const auto target = channels->at(k).find("target"))
        if (const auto node = target->find("node"); node && node->value.is_number_unsigned())
          nodes.insert(node->value.get<int>());
  }
  return nodes;
}

class NodeReader {
 public:
  NodeReader(const JsonPlace& document, std::size_t materials, ImportReport& report)
      : document_(document),
        shapes_(document),
        materials_(materials),
        animated_(animatedNodes(document)),
        report_(report) {
    if (const auto nodes = document_.find("nodes")) count_ = nodes->size();
  }

  PhysicsNode read(int index, bool carried = false, int depth = 0) {
    const JsonPlace place = document_.require("nodes").at(static_cast<std::size_t>(index));
    if (depth > kDeepest) fail(place.pointer, "a node below " + std::to_string(kDeepest) + " others", "fewer levels");
    PhysicsNode node;
    node.index = index;
    node.name = place.textOr("name", "");
    node.animated = carried || animated_.count(index) > 0;
    reached_.insert(index);
    if (const auto matrix = place.find("matrix")) {
      setMatrix(node, *matrix);
    } else {
      node.translation = place.findVector("translation").value_or(Vec3::Zero());
      if (const auto q = place.find("rotation")) node.rotation = q->quaternion();
      node.scale = place.findVector("scale").value_or(Vec3::Ones());
    }
    node.translation = zUp(node.translation), node.rotation = zUp(node.rotation), node.scale = swappedSizes(node.scale);
    if (const auto physics = extensionOf(place, kRigidBodies)) readPhysicsOf(node, *physics);
    if (const auto extras = caromExtrasOf(place)) {
      node.surface_velocity = zUp(extras->findVector("surface_velocity").value_or(Vec3::Zero()));
      node.surface_angular_velocity = zUp(extras->findVector("surface_angular_velocity").value_or(Vec3::Zero()));
    }
    reportOthers(node, place);
    if (const auto children = place.find("children"))
      for (std::size_t i = 0; i < children->size(); ++i)
        node.children.push_back(read(children->at(i).index(count_, "nodes"), node.animated && !node.motion, depth + 1));
    return node;
  }

  /// Reports what concerns several nodes, and those that are not in the scene.
  void finish() {
    for (std::size_t i = 0; i < count_; ++i) {
      const JsonPlace place = document_.require("nodes").at(i);
      if (reached_.count(static_cast<int>(i)) > 0 || !extensionOf(place, kRigidBodies)) continue;
      report_.warnings.push_back(nodeAt(static_cast<int>(i)) +
                                 ": its physics is ignored: it is not in the scene that is read");
    }
  }

 private:
  void readPhysicsOf(PhysicsNode& node, const JsonPlace& physics) {
    if (const auto motion = physics.find("motion")) node.motion = readMotion(*motion);
    if (const auto collider = physics.find("collider")) readCollider(node, *collider);
    if (physics.find("trigger")) {
      report_.triggers.push_back(nameOf(node));
      leaveOut(node, "its trigger", "triggers");
    }
    if (const auto joint = physics.find("joint")) {
      report_.joints.push_back(nameOf(node));
      const auto other = joint->find("connectedNode");
      leaveOut(node, "its joint" + (other ? " to " + nodeAt(other->index(count_, "nodes")) : ""), "joints");
    }
  }

  void readCollider(PhysicsNode& node, const JsonPlace& collider) {
    const auto geometry = collider.find("geometry");
    const auto shape = shapes_.read(geometry ? *geometry : collider, node, report_);
    CollisionFilter filter;
    if (const auto index = collider.find("collisionFilter")) filter = readFilter(document_, *index);
    if (!shape) return;
    node.collider = Collider{*shape, -1, filter};
    if (const auto material = collider.find("physicsMaterial"))
      node.collider->material = material->index(materials_, "physicsMaterials");
  }

  void reportOthers(const PhysicsNode& node, const JsonPlace& place) {
    for (const char* name : {"KHR_rigid_bodies", "MSFT_rigid_bodies", "MSFT_physics", "OMI_physics_body",
                             "OMI_physics_joint", "OMI_physics_gravity", "OMI_collider", "EXT_mesh_gpu_instancing"})
      if (extensionOf(place, name)) leaveOut(node, name, "extensions of that name");
  }

  static std::string nameOf(const PhysicsNode& node) {
    return node.name.empty() ? "node-" + std::to_string(node.index) : node.name;
  }

  void leaveOut(const PhysicsNode& node, const std::string& what, const std::string& kind) {
    report_.warnings.push_back(node.label() + ": " + what + " is ignored: " + kind + " are not supported");
  }

  std::string nodeAt(int index) const {
    return labelOf(index, document_.require("nodes").at(static_cast<std::size_t>(index)).textOr("name", ""));
  }

  JsonPlace document_;
  const ShapeList shapes_;
  const std::size_t materials_;
  const std::set<int> animated_;  // nodes
  ImportReport& report_;
  std::size_t count_ = 0;
  std::set<int> reached_;
};

/// Indices of the root nodes of the default scene; of all nodes without a parent where there is no scene.
std::vector<int> rootNodes(const JsonPlace& document) {
  const auto nodes = document.find("nodes");
  const std::size_t count = nodes ? nodes->size() : 0;
  std::vector<int> roots;
  if (const auto scene = defaultScene(document)) {
    const auto list = scene->find("nodes");
    for (std::size_t i = 0; list && i < list->size(); ++i) roots.push_back(list->at(i).index(count, "nodes"));
    return roots;
  }
  std::vector<char> below(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    if (const auto children = nodes->at(i).find("children"))
      for (std::size_t k = 0; k < children->size(); ++k)
        below[static_cast<std::size_t>(children->at(k).index(count, "nodes"))] = 1;
  for (std::size_t i = 0; i < count; ++i)
    if (below[i] == 0) roots.push_back(static_cast<int>(i));
  return roots;
}

/// Extensions that say how a thing looks do not matter here.
void reportRequired(const JsonPlace& document, ImportReport& report) {
  const auto required = document.find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->size(); ++i) {
    const std::string& name = required->at(i).text();
    bool known = (readsDraco() && name == "KHR_draco_mesh_compression") || (readsMeshopt() && name == "EXT_meshopt_compression");
    for (const char* prefix : {"KHR_physics_rigid_bodies", "KHR_implicit_shapes", "KHR_collision_shapes",
                               "OMI_physics_gravity", "OMI_physics_body", "OMI_physics_shape", "OMI_collider", "KHR_mesh_quantization", "KHR_lights_", "KHR_materials_", "KHR_texture_", "EXT_texture_"})
      known = known || name.rfind(prefix, 0) == 0;
    if (!known) report.warnings.push_back("the file requires the extension " + name + ", which is not supported");
  }
}

}  // namespace

std::string PhysicsNode::label() const { return labelOf(index, name); }

InputError errorAt(const PhysicsNode& node, const std::string& sentence) {
  const std::string name = node.name.empty() ? "" : "node '" + oneLine(node.name) + "': ";
  return {"/nodes/" + std::to_string(node.index), name + sentence};
}

std::string shortName(const std::string& name) {
  std::size_t length = 180;  // bytes, of which a document takes 200 characters
  if (name.size() <= length) return name;
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xC0u) == 0x80u) --length;  // within a character
  return name.substr(0, length);
}

std::optional<JsonPlace> defaultScene(const JsonPlace& document) {
  const auto scenes = document.find("scenes");
  if (!scenes || scenes->size() == 0) return std::nullopt;
  const auto chosen = document.find("scene");
  return scenes->at(chosen ? static_cast<std::size_t>(chosen->index(scenes->size(), "scenes")) : 0);
}

PhysicsFile readPhysics(const Json& json, ImportReport& report) {
  const JsonPlace document{json, ""};
  PhysicsFile file;
  reportRequired(document, report);
  file.materials = readMaterials(document, report);
  file.gravity = readGravity(document);
  NodeReader reader(document, file.materials.size(), report);
  for (const int root : rootNodes(document)) file.roots.push_back(reader.read(root));
  reader.finish();
  return file;
}

}  // namespace carom::gltf
