// SPDX-License-Identifier: MIT
// The scene document inside a glTF file: writing it, and taking from it what the file still says.
#include "formats/gltf/read/left_document.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/documents/scene_json.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/gltf/read/parts.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

namespace {

using tinygltf::Value;

constexpr std::string_view kMeshes = "#/meshes/";

// tinygltf drops a null from an array; a NaN it writes as null, which is how a document leaves a component free.
Value valueOf(const Json& json) {
  if (json.is_null()) return Value(std::numeric_limits<double>::quiet_NaN());
  if (json.is_boolean()) return Value(json.get<bool>());
  if (json.is_string()) return Value(json.get<std::string>());
  if (json.is_number_integer() && std::abs(json.get<double>()) < 1e9) return Value(json.get<int>());
  if (json.is_number()) return Value(json.get<double>());
  if (json.is_array()) {
    Value::Array items;
    for (const auto& item : json) items.push_back(valueOf(item));
    return Value(items);
  }
  Value::Object members;
  for (const auto& [key, item] : json.items()) members[key] = valueOf(item);
  return Value(members);
}

// The members of a glTF object have no order here, but the targets of a constraint have: their names stand beside them.
constexpr const char* kOrder = "constraint_members";

void noteOrder(Json& document) {
  const auto constraints = document.find("constraints");
  if (constraints == document.end() || constraints->empty()) return;
  Json order = Json::array();
  for (const Json& constraint : *constraints) {
    Json names = Json::array();
    for (const auto& member : constraint.items()) names.push_back(member.key());
    order.push_back(std::move(names));
  }
  document[kOrder] = std::move(order);
}

/// Takes the order out and puts members into it; those that it does not name come last.
void restoreOrder(Json& document) {
  const auto found = document.find(kOrder);
  if (found == document.end()) return;
  const Json order = *found;
  document.erase(kOrder);
  const auto constraints = document.find("constraints");
  if (!order.is_array() || constraints == document.end() || !constraints->is_array()) return;
  for (std::size_t i = 0; i < constraints->size() && i < order.size(); ++i) {
    Json& constraint = (*constraints)[i];
    if (!constraint.is_object() || !order[i].is_array()) continue;
    Json sorted = Json::object();
    for (const Json& name : order[i])
      if (name.is_string() && constraint.contains(name.get<std::string>()))
        sorted[name.get<std::string>()] = constraint[name.get<std::string>()];
    for (const auto& member : constraint.items())
      if (!sorted.contains(member.key())) sorted[member.key()] = member.value();
    constraint = std::move(sorted);
  }
}

/// The meshes of the file in place of files.
class FileMeshes : public SurfaceFiles {
 public:
  FileMeshes(std::size_t count, gltf::ShapeMaker& shapes, SurfaceMeshes& meshes)
      : SurfaceFiles(""), count_(count), shapes_(shapes), meshes_(meshes) {}

  std::shared_ptr<const Surface> find(const std::string& file, const std::string& where, bool convex) override {
    std::size_t index = 0;
    while (index < count_ && meshReference(static_cast<int>(index)) != file) ++index;
    if (index == count_) fail(where, quotedText(file), "one of the " + std::to_string(count_) + " meshes of the file");
    const auto mesh = static_cast<int>(index);
    auto surface = shapes_.surfaceOf({mesh, -1, convex});
    meshes_[surface.get()] = mesh;
    return surface;
  }

 private:
  std::size_t count_;
  gltf::ShapeMaker& shapes_;
  SurfaceMeshes& meshes_;
};

}  // namespace

std::string meshReference(int mesh) { return std::string(kMeshes) + std::to_string(mesh); }

Value documentOf(const Document& document, const Scene& scene, const SurfaceMeshes& meshes) {
  Document whole = document;
  whole.scene = scene;
  whole.schema.clear();  // found from a document's own folder
  for (Body& body : whole.scene.bodies)
    for (const shapes::SurfaceUse& use : shapes::surfacesOf(body.shape))
      use.file = meshReference(meshes.at(&use.surface));
  Json json = parseJson(writeDocument(whole));
  for (auto member = json.begin(); member != json.end();)  // tinygltf would write an empty list as null
    member = member->is_structured() && member->empty() ? json.erase(member) : std::next(member);
  noteOrder(json);
  return valueOf(json);
}

}  // namespace carom::formats_detail

namespace carom::gltf {

using namespace formats_detail;

namespace {

template <class Vector>
bool near(const Vector& a, const Vector& b) {
  return (a - b).cwiseAbs().maxCoeff() <= kSame * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

bool samePose(const Frame& world, const PhysicsNode& expected) {
  if (!near(world.stretch, Mat3(Mat3::Identity()))) return false;
  PhysicsNode found = expected;
  found.translation = world.translation, found.rotation = world.rotation;
  return samePlace(found, expected);
}

}  // namespace

LeftDocument::LeftDocument(const Json& document, std::size_t mesh_count, ShapeMaker& shapes, ImportReport& report)
    : report_(report) {
  const auto scene = defaultScene(JsonPlace{document, ""});
  const auto left = scene ? caromExtrasOf(*scene) : std::nullopt;
  if (!left) return;
  try {
    read(left->value, mesh_count, shapes);
  } catch (const InputError& error) {
    edit_ = Json();
    has_scene_ = false;
    report_.warnings.push_back("the scene document that carom left in the file cannot be read (" + left->pointer +
                               error.what() + "); the bodies are read from the physics of the nodes");
  }
}

void LeftDocument::read(const Json& json, std::size_t mesh_count, ShapeMaker& shapes) {
  Json whole = json;
  restoreOrder(whole);
  has_scene_ = whole.contains("bodies");
  if (!has_scene_) {  // older files hold the edit alone
    whole["carom"] = 1;
    whole["bodies"] = treeOf(R"([{"name": "none", "fixed": true, "shape": {"plane": {"normal": [0, 0, 1]}}}])");
  }
  requireSchema(whole);
  if (has_scene_) {
    FileMeshes files(mesh_count, shapes, meshes_);
    scene_ = readScene(whole, files);
    for (Body& body : scene_.bodies)  // mesh references mean nothing elsewhere
      for (const shapes::SurfaceUse& use : shapes::surfacesOf(body.shape)) use.file.clear();
    validate(scene_);
  }
  edit_ = std::move(whole);
}

std::vector<FileMaterial> LeftDocument::materials() const {
  std::vector<FileMaterial> out;
  for (const Material& material : scene_.materials) out.push_back({material, false});
  out.push_back({Material{}, true});
  return out;
}

const Body* LeftDocument::bodyOf(const PhysicsNode& node, const Frame& world,
                                 const std::vector<FileMaterial>& file_materials) {
  if (!has_scene_) return nullptr;
  const auto named =
      std::find_if(scene_.bodies.begin(), scene_.bodies.end(), [&](const Body& b) { return b.name == node.name; });
  if (named == scene_.bodies.end() || found_.count(node.name) > 0) return nullptr;
  const int index = static_cast<int>(named - scene_.bodies.begin());
  const PhysicsNode expected = physicsNodeOf(scene_, index, modelOf(*named), meshes_);
  if (!samePose(world, expected) || !samePhysics(expected, materials(), node, file_materials)) {
    report_.warnings.push_back(node.label() +
                               ": it has changed since carom wrote the file; it is read from the physics of its node");
    return nullptr;
  }
  found_.insert(node.name);
  if (named->inertia.source == Inertia::Source::matrix && node.motion && node.motion->inertia_diagonal) {  // a document rounds what it puts together as a matrix
    named->inertia.moments = *node.motion->inertia_diagonal;
    named->inertia.axes = node.motion->inertia_orientation;
  }
  return &*named;
}

Scene LeftDocument::sceneOf(std::vector<Body> bodies, const PhysicsFile& file) {
  Scene scene;
  scene.gravity = zUp(file.gravity);
  if (has_scene_ && near(scene.gravity, scene_.gravity)) scene.gravity = scene_.gravity;
  scene.materials = materialsOf(file);
  scene.bodies = std::move(bodies);
  for (const Tilt& tilt : scene_.tilts)
    if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                    [&](const Body& b) { return b.name == tilt.body && !b.fixed; }))
      scene.tilts.push_back(tilt);
  return scene;
}

/// In the order of the file: a document inside glTF keeps its materials by name, in no order.
std::vector<Material> LeftDocument::materialsOf(const PhysicsFile& file) const {
  std::vector<Material> left = scene_.materials, out;
  for (const FileMaterial& found : file.materials) {
    if (found.none) continue;
    const auto named =
        std::find_if(left.begin(), left.end(), [&](const Material& m) { return m.name == found.material.name; });
    const bool same = named != left.end() && sameMaterial(*named, found.material);
    out.push_back(same ? *named : found.material);
    if (named != left.end()) left.erase(named);
  }
  out.insert(out.end(), left.begin(), left.end());
  return out;
}

void LeftDocument::addEdit(Document& document) {
  if (!edit_.is_object()) return;
  document.name = textOr(edit_, "name");
  document.notes = textOr(edit_, "notes");
  document.duration = edit_.value<double>("duration", document.duration);
  const auto each = [&](const char* list, const std::string& what, auto&& read) {
    const auto items = edit_.find(list);
    for (std::size_t i = 0; items != edit_.end() && i < items->size(); ++i) try {
        Json one = Json::object();
        one[list] = Json::array({(*items)[i]});
        read(one);
      } catch (const InputError& error) {
        report_.warnings.push_back(what + " " + std::to_string(i + 1) +
                                   " that carom left in the file is ignored: " + error.message());
      }
  };
  each("controls", "control", [&](const Json& one) {
    for (Control& control : readControls(one, document.scene)) document.controls.push_back(std::move(control));
  });
  each("constraints", "constraint", [&](const Json& one) {
    for (Constraint& constraint : readConstraints(one, document.scene, document.duration))
      document.constraints.push_back(std::move(constraint));
  });
}

}  // namespace carom::gltf
