// SPDX-License-Identifier: MIT
// Physics materials and gravity of a glTF document.
#include <algorithm>
#include <set>

#include "formats/documents/scene_reader.hpp"
#include "formats/gltf/read/parts.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::gltf {

using namespace formats_detail;

namespace {

double notNegative(const JsonPlace& material, const char* member, double otherwise) {
  const double value = material.numberOr(member, otherwise);
  if (!(value >= 0)) fail(material.pointer + "/" + member, numberText(value), "a number >= 0");
  return value;
}

Combine readCombine(const JsonPlace& material, const char* member) {
  const auto rule = material.find(member);
  if (!rule) return Combine::average;
  const auto& words = combineWords();
  const auto word = std::find(words.begin(), words.end(), rule->text());
  if (word == words.end()) fail(rule->pointer, quotedText(rule->text()), "one of " + listed(words));
  return static_cast<Combine>(word - words.begin());
}

/// A name of its own for each; what has none is called by its number.
std::string nameFor(const JsonPlace& material, std::size_t index, std::set<std::string>& taken) {
  std::string name = shortName(material.textOr("name", ""));
  if (name.empty()) name = "material-" + std::to_string(index);
  std::string free = name;
  for (int k = 2; !taken.insert(free).second; ++k) free = name + "-" + std::to_string(k);
  return free;
}

FileMaterial readMaterial(const JsonPlace& value, ImportReport& report) {
  constexpr double kFriction = 0.6, kRestitution = 0;  // defaults of the extension
  FileMaterial out;
  Material& material = out.material;
  material.friction = notNegative(value, "dynamicFriction", kFriction);
  const double at_rest = notNegative(value, "staticFriction", kFriction);
  material.elasticity = notNegative(value, "restitution", kRestitution);
  material.combine_friction = readCombine(value, "frictionCombine");
  material.combine_elasticity = readCombine(value, "restitutionCombine");
  if (const auto extras = caromExtrasOf(value)) {
    const auto tangential = extras->find("tangential_elasticity");
    if (tangential && tangential->value.is_number()) material.tangential_elasticity = tangential->number();
    const auto none = extras->find("none");
    out.none = none && none->value.is_boolean() && none->boolean();
  }
  const std::string where = "physics material " + value.pointer;
  if (at_rest != material.friction)
    report.warnings.push_back(where + ": its static friction " + numberText(at_rest) +
                              " is ignored: there is one friction here, and the dynamic " +
                              numberText(material.friction) + " is used");
  if (material.elasticity > 1) {
    report.warnings.push_back(where + ": its restitution " + numberText(material.elasticity) +
                              " is clamped to 1: impacts do not add energy");
    material.elasticity = 1;
  }
  return out;
}

}  // namespace

std::vector<FileMaterial> readMaterials(const JsonPlace& document, ImportReport& report) {
  std::vector<FileMaterial> materials;
  std::set<std::string> taken;
  const auto physics = extensionOf(document, "KHR_physics_rigid_bodies");
  const auto list = physics ? physics->find("physicsMaterials") : std::nullopt;
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    FileMaterial material = readMaterial(list->at(i), report);
    material.none = material.none && sameMaterial(material.material, Material{});
    if (!material.none) material.material.name = nameFor(list->at(i), i, taken);
    materials.push_back(std::move(material));
  }
  return materials;
}

Vec3 readGravity(const JsonPlace& document) {
  const auto gravity = extensionOf(document, "OMI_physics_gravity");
  if (!gravity) return PhysicsFile{}.gravity;
  const double strength = gravity->require("gravity").number();
  const Vec3 direction = gravity->findVector("direction").value_or(-Vec3::UnitY());
  const double length = direction.stableNorm();
  if (strength == 0) return Vec3::Zero();
  if (!(length > 0)) fail(gravity->pointer + "/direction", "a direction of length 0", "a unit vector");
  const bool unit = std::abs(length - 1) <= 1e-15;
  return strength * (unit ? direction : Vec3(direction / length));
}

}  // namespace carom::gltf
