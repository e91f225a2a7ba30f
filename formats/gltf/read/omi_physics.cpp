// SPDX-License-Identifier: MIT
// OMI_physics_body, OMI_physics_shape and OMI_collider -> KHR_physics_rigid_bodies and KHR_implicit_shapes.
#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include "formats/gltf/read/other_physics.hpp"
#include "formats/json/json_place.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/gltf_geometry.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

constexpr const char* kKhronosBody = "KHR_physics_rigid_bodies";
constexpr const char* kOmiBody = "OMI_physics_body";
constexpr const char* kOmiShape = "OMI_physics_shape";
constexpr const char* kOmiCollider = "OMI_collider";

/// OMI has the height of a capsule with its caps, Khronos without.
Json capsuleOf(const JsonPlace& shape) {
  const double radius = shape.numberOr("radius", 0.5), height = shape.numberOr("height", 2);
  const double between = height - 2 * radius;
  if (!(between >= 0)) fail(shape.pointer + "/height", numberText(height), "at least twice the radius");
  if (between == 0) return {{"type", "sphere"}, {"sphere", {{"radius", radius}}}};
  return {{"type", "capsule"}, {"capsule", {{"height", between}, {"radiusBottom", radius}, {"radiusTop", radius}}}};
}

/// The members of a shape are in one named after its type; those of OMI_collider, before, beside the type.
Json shapeOf(const JsonPlace& shape, bool flat = false) {
  std::string type = shape.require("type").text();
  static const Json kNothing = Json::object();
  const auto found = flat ? std::optional(shape) : shape.find(type.c_str());
  const JsonPlace content = found ? *found : JsonPlace{kNothing, shape.pointer};
  if (type == "capsule") return capsuleOf(content);
  if (type == "cylinder") {
    const double radius = content.numberOr("radius", 0.5);
    return {{"type", type}, {type, {{"height", content.numberOr("height", 2)}, {"radiusBottom", radius}, {"radiusTop", radius}}}};
  }
  if (type == "hull") type = "convex";  // its name before
  if (flat && type == "box" && content.find("extents"))
    fail(content.pointer + "/extents",
         "a box of an early draft, in which \"extents\" are whole lengths here and half lengths there",
         "\"size\", the whole lengths");
  return {{"type", type}, {type, content.value}};
}

/// The member of a motion, in the file's axes of the world, in the axes of the node.
void turnIntoNode(Json& motion, const JsonPlace& from, const char* member, const Mat3& node_to_world) {
  const auto written = from.findVector(member);
  if (!written) return;
  const Vec3 own = node_to_world.transpose() * *written;
  motion[member] = {own.x(), own.y(), own.z()};
}

/// Nothing for a static body. Before there was a member "motion" its members were those of the body, and a type "rigid".
std::optional<Json> motionOf(const JsonPlace& body, const Mat3& node_to_world) {
  const auto nested = body.find("motion");
  if (!nested && !body.find("type")) return std::nullopt;
  const JsonPlace from = nested ? *nested : body;
  const std::string type = from.textOr("type", "dynamic");
  if (type == "static" || type == "trigger") return std::nullopt;
  Json motion = Json::object();
  if (type == "kinematic" || type == "character") {
    motion["isKinematic"] = true;
  } else if (type == "dynamic" || type == "rigid" || type == "vehicle") {
    motion["mass"] = from.numberOr("mass", 1);
  } else {
    fail(from.pointer + "/type", quotedText(type), "static, kinematic or dynamic");
  }
  for (const char* member : {"centerOfMass", "inertiaOrientation", "gravityFactor"})
    if (const auto value = from.find(member)) motion[member] = value->value;
  const auto moments = from.findVector("inertiaDiagonal");
  if (moments && !moments->isZero(0)) motion["inertiaDiagonal"] = from.require("inertiaDiagonal").value;  // 0: derived
  turnIntoNode(motion, from, "linearVelocity", node_to_world);
  turnIntoNode(motion, from, "angularVelocity", node_to_world);
  return motion;
}

Json bodyOf(const JsonPlace& body, std::size_t first_shape, std::size_t shapes, const Mat3& node_to_world) {
  Json out = Json::object();
  if (auto motion = motionOf(body, node_to_world)) out["motion"] = std::move(*motion);
  if (const auto collider = body.find("collider")) {
    const int shape = collider->require("shape").index(shapes, "shapes");
    out["collider"] = {{"geometry", {{"shape", first_shape + static_cast<std::size_t>(shape)}}}};
  }
  if (const auto trigger = body.find("trigger")) out["trigger"] = trigger->value;
  return out;
}

/// The shapes that come from other extensions, behind those of KHR_implicit_shapes.
struct AddedShapes {
  std::size_t first = 0, count = 0;               ///< of OMI_physics_shape
  std::size_t first_collider = 0, colliders = 0;  ///< of OMI_collider
  std::vector<char> is_trigger;                   ///< of each of the latter
};

std::optional<JsonPlace> listIn(const JsonPlace& document, const char* extension, const char* list) {
  const auto found = extensionOf(document, extension);
  return found ? found->find(list) : std::nullopt;
}

AddedShapes addShapes(const JsonPlace& document, Json& list) {
  AddedShapes added{.first = list.size()};
  if (const auto shapes = listIn(document, kOmiShape, "shapes"))
    for (; added.count < shapes->size(); ++added.count) list.push_back(shapeOf(shapes->at(added.count)));
  added.first_collider = list.size();
  const auto colliders = listIn(document, kOmiCollider, "colliders");
  for (; colliders && added.colliders < colliders->size(); ++added.colliders) {
    const JsonPlace collider = colliders->at(added.colliders);
    list.push_back(shapeOf(collider, true));
    added.is_trigger.push_back(collider.booleanOr("isTrigger", false));
  }
  return added;
}

/// Adds the collider, or the trigger, of a node to the physics that it has in Khronos' words. One of the first draft, which
/// has its members in the node, does not say whether its sizes are halves: it is left, and reported as ignored.
bool addCollider(const JsonPlace& node, const AddedShapes& shapes, Json& physics) {
  const auto written = extensionOf(node, kOmiCollider);
  const auto index = written ? written->find("collider") : std::nullopt;
  if (!index) return false;
  const auto collider = static_cast<std::size_t>(index->index(shapes.colliders, "colliders"));
  physics[shapes.is_trigger[collider] ? "trigger" : "collider"] = {{"geometry", {{"shape", shapes.first_collider + collider}}}};
  return true;
}

/// Rotations of all nodes that are reached, in the world.
void turnAll(const tinygltf::Model& model, int node, const Mat3& above, std::vector<Mat3>& turns) {
  struct Visit {
    int node;
    Mat3 above;
  };
  std::vector<Visit> visits{{node, above}};
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    const auto index = static_cast<std::size_t>(visit.node);
    turns[index] = visit.above * nodeTransform(model.nodes[index], pointerTo("/nodes", index)).rotation();
    for (const int child : model.nodes[index].children) visits.push_back({child, turns[index]});
  }
}

}  // namespace

Json withKhronosPhysics(Json document, const tinygltf::Model& model) {
  const Json written = document;
  const JsonPlace place{written, ""};
  const auto nodes = place.find("nodes");
  bool any = false;
  for (std::size_t i = 0; nodes && i < nodes->size(); ++i)
    any = any || extensionOf(nodes->at(i), kOmiBody) || extensionOf(nodes->at(i), kOmiCollider);
  if (!any) return document;
  Json& list = document["extensions"]["KHR_implicit_shapes"]["shapes"];
  if (!list.is_array()) list = Json::array();
  const AddedShapes shapes = addShapes(place, list);
  std::vector<Mat3> turns(model.nodes.size(), Mat3::Identity());
  if (!model.scenes.empty())
    for (const int root : model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes)
      turnAll(model, root, Mat3::Identity(), turns);
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    const auto body = extensionOf(nodes->at(i), kOmiBody);
    if (!body && !extensionOf(nodes->at(i), kOmiCollider)) continue;
    Json& extensions = document["nodes"][i]["extensions"];
    if (extensions.contains(kKhronosBody)) continue;  // and reported as ignored
    Json physics = body ? bodyOf(*body, shapes.first, shapes.count, turns[i]) : Json::object();
    if (addCollider(nodes->at(i), shapes, physics)) extensions.erase(kOmiCollider);
    extensions.erase(kOmiBody);
    if (!physics.empty()) extensions[kKhronosBody] = std::move(physics);
  }
  return document;
}

}  // namespace carom::gltf
