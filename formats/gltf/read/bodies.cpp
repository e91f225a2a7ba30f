// SPDX-License-Identifier: MIT
// Nodes with physics -> bodies.
#include "formats/gltf/read/bodies.hpp"

#include <algorithm>
#include <set>

#include "adjoint/base/errors.h"

namespace carom::gltf {
namespace {

struct Part {
  CompoundPart shape;  // in the axes of the body's node
  int material = -1;
  CollisionFilter filter;
};

/// A moving body that is being put together from a node and those below it.
struct Draft {
  const PhysicsNode& node;
  Frame world;
  std::vector<Part> parts;
};

struct Entry {
  Body body;
  const PhysicsNode* node = nullptr;  // null for a body that is known
};

class Builder {
 public:
  Builder(const PhysicsFile& file, ShapeMaker& shapes, const Known& known, ImportReport& report)
      : file_(file), shapes_(shapes), known_(known), report_(report) {}

  std::vector<Body> build() {
    for (const PhysicsNode& root : file_.roots) walk(root, Frame(), nullptr, Frame());
    nameAll();
    std::vector<Body> bodies;
    for (auto& entry : entries_)
      if (entry) bodies.push_back(std::move(entry->body));
    return bodies;
  }

 private:
  /// `outer` is the frame of the parent in the world, `outer_in_owner` the same in the axes of the owner's node.
  void walk(const PhysicsNode& node, const Frame& outer, Draft* owner, const Frame& outer_in_owner) {
    const Frame world = inside(outer, node);
    if (const Body* body = known_(node, world)) {
      entries_.push_back(Entry{*body});
      return;
    }
    if (node.animated && (node.motion || node.collider))
      report(node, "its animation is ignored: " + std::string(node.motion && !node.motion->kinematic
                                                                   ? "it moves as it is simulated"
                                                                   : "bodies do not follow animations"));
    if (node.motion && !stands(node)) {
      Draft draft{node, world, {}};
      const std::size_t place = entries_.size();
      entries_.emplace_back();
      Frame here;
      here.stretch = world.stretch;
      if (node.collider) addPart(draft, node, here, axes(node, here));
      for (const PhysicsNode& child : node.children) walk(child, world, &draft, here);
      entries_[place] = finish(draft);
      return;
    }
    if (node.motion) owner = nullptr;
    const Frame in_owner = owner != nullptr ? inside(outer_in_owner, node) : Frame();
    if (node.collider && owner != nullptr) {
      addPart(*owner, node, in_owner, product(outer_in_owner.rotation, product(node.rotation, axes(node, in_owner))));
    } else if (node.collider) {
      addFixed(node, world, product(outer.rotation, product(node.rotation, axes(node, world))));
    }
    for (const PhysicsNode& child : node.children) walk(child, world, owner, in_owner);
  }

  static Quat axes(const PhysicsNode& node, const Frame& frame) { return axesOf(node.collider->shape, frame.stretch); }

  /// Bodies that nothing can move and that do not move by themselves: their colliders become fixed bodies.
  bool stands(const PhysicsNode& node) {
    const Moving& motion = *node.motion;
    const bool moves = !motion.linear.isZero(0) || !motion.angular.isZero(0);
    if (motion.kinematic) return !moves;
    if (motion.mass != 0.0) return false;
    report(node, std::string("bodies of infinite mass (mass 0) are not supported: it is a fixed body here") +
                     (moves ? ", and its velocity is ignored" : ""));
    return true;
  }

  void addPart(Draft& draft, const PhysicsNode& node, const Frame& in_owner, const Quat& orientation) {
    const Moving& motion = *draft.node.motion;
    const bool derives = !motion.kinematic && !(motion.mass && motion.inertia_diagonal);
    auto shape = shapes_.make(node, in_owner.stretch, derives);
    if (!shape) return;
    if (kindOf(*shape).endless) {
      report(node, "its plane is ignored: a moving body cannot be an infinite plane");
      return;
    }
    draft.parts.push_back({{std::move(*shape), in_owner.translation, orientation}, node.collider->material, node.collider->filter});
  }

  void addFixed(const PhysicsNode& node, const Frame& world, const Quat& orientation) {
    auto shape = shapes_.make(node, world.stretch);
    if (!shape) return;
    Body body;
    body.fixed = true;
    body.material = materialName(node.collider->material);
    body.collision_filter = node.collider->filter;
    body.shape = std::move(*shape);
    body.position = world.translation;
    body.orientation = orientation;
    setSurface(body, node, product(world.rotation.conjugate(), orientation));
    entries_.push_back(Entry{check(std::move(body), node), &node});
  }

  /// Of a node that the shape is turned to by `shape_to_node`.
  void setSurface(Body& body, const PhysicsNode& node, const Quat& shape_to_node) {
    if (!node.surfaceMoves()) return;
    if (!body.immovable()) {
      report(node, "its moving surface is ignored: impacts move the body");
      return;
    }
    const Quat to_shape = shape_to_node.conjugate();
    body.surface_velocity = turned(to_shape, node.surface_velocity);
    body.surface_angular_velocity = turned(to_shape, node.surface_angular_velocity);
  }

  /// A lone shape at the node's origin gives the body its axes; others become parts.
  std::optional<Entry> finish(Draft& draft) {
    if (draft.parts.empty()) {
      report(draft.node, "its motion is ignored: it has no collider");
      return std::nullopt;
    }
    Body body;
    body.material = materialOf(draft);
    body.collision_filter = filterOf(draft);
    body.position = draft.world.translation;
    Quat shape_to_node = Quat::Identity();
    if (draft.parts.size() == 1 && draft.parts[0].shape.position.isZero(0)) {
      shape_to_node = draft.parts[0].shape.orientation;
      body.shape = std::move(draft.parts[0].shape.shape);
    } else {
      Compound compound;
      for (Part& part : draft.parts) compound.parts.push_back(std::move(part.shape));
      body.shape = std::move(compound);
    }
    body.orientation = product(draft.world.rotation, shape_to_node);
    try {
      setMotion(body, draft.node, shape_to_node, draft.world, report_);
    } catch (const InputError& error) {
      throw errorAt(draft.node, error.message());
    }
    setSurface(body, draft.node, shape_to_node);
    return Entry{check(std::move(body), draft.node), &draft.node};
  }

  std::string materialOf(const Draft& draft) {
    const int first = draft.parts[0].material;
    for (const Part& part : draft.parts)
      if (materialName(part.material) != materialName(first)) {
        report(draft.node, "its colliders have several physics materials; a body has one here, that of the first (" +
                               (first < 0 ? "none" : "'" + materialName(first) + "'") + ")");
        break;
      }
    return materialName(first);
  }

  CollisionFilter filterOf(const Draft& draft) {
    const CollisionFilter& first = draft.parts[0].filter;
    if (std::any_of(draft.parts.begin(), draft.parts.end(), [&](const Part& part) { return !(part.filter == first); }))
      report(draft.node, "its colliders have several collision filters; a body has one here, that of the first");
    return first;
  }

  std::string materialName(int material) const {
    if (material < 0) return "";
    const FileMaterial& found = file_.materials[static_cast<std::size_t>(material)];
    return found.none ? "" : found.material.name;
  }

  /// Physically possible, as scenes are checked; an error names the node.
  static Body check(Body body, const PhysicsNode& node) {
    Scene scene;
    scene.bodies.push_back(body);
    scene.bodies[0].name = "body";
    scene.bodies[0].material.clear();
    try {
      validate(scene);
    } catch (const InputError& error) {
      constexpr std::string_view kBody = "/bodies/0";
      throw errorAt(node, error.where().substr(kBody.size()) + ": " + error.message());
    }
    return body;
  }

  void nameAll() {
    std::set<std::string> taken;
    for (const auto& entry : entries_)
      if (entry && entry->node == nullptr) taken.insert(entry->body.name);
    for (auto& entry : entries_) {
      if (!entry || entry->node == nullptr) continue;
      std::string name = shortName(entry->node->name);
      if (name.empty()) name = "node-" + std::to_string(entry->node->index);
      entry->body.name = name;
      for (int k = 2; !taken.insert(entry->body.name).second; ++k) entry->body.name = name + "-" + std::to_string(k);
    }
  }

  void report(const PhysicsNode& node, const std::string& sentence) {
    report_.warnings.push_back(node.label() + ": " + sentence);
  }

  const PhysicsFile& file_;
  ShapeMaker& shapes_;
  const Known& known_;
  ImportReport& report_;
  std::vector<std::optional<Entry>> entries_;
};

}  // namespace

std::vector<Body> makeBodies(const PhysicsFile& file, ShapeMaker& shapes, const Known& known, ImportReport& report) {
  return Builder(file, shapes, known, report).build();
}

}  // namespace carom::gltf
