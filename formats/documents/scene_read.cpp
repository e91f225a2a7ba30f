// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "formats/base/unit.hpp"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

template <class Items>
std::vector<std::string> namesOf(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

Vec3 vectorOr(const Json& object, const char* member, const Vec3& otherwise) {
  const auto found = object.find(member);
  return found == object.end() ? otherwise : readVector(*found);
}

Combine readCombine(const Json& material, const char* coefficient) {
  const auto rules = material.find("combine");
  if (rules == material.end() || !rules->contains(coefficient)) return Combine::average;
  const auto& words = combineWords();
  const auto word = std::find(words.begin(), words.end(), (*rules)[coefficient].get<std::string>());
  return static_cast<Combine>(word - words.begin());
}

Material readMaterial(const std::string& name, const Json& value) {
  Material material;
  material.name = name;
  material.elasticity = value.value("elasticity", material.elasticity);
  material.friction = value.value("friction", material.friction);
  material.tangential_elasticity = value.value("tangential_elasticity", material.tangential_elasticity);
  material.combine_elasticity = readCombine(value, "elasticity");
  material.combine_friction = readCombine(value, "friction");
  material.notes = textOr(value, "notes");
  return material;
}

Inertia readInertia(const Json& value, const std::string& where) {
  const bool rows = value[0].is_array();
  for (std::size_t i = 1; i < 3; ++i)
    if (value[i].is_array() != rows)
      fail(pointerTo(where, i), describe(value[i]), rows ? "a row of three numbers" : "a number");
  if (!rows) return Inertia::fromMoments(readVector(value));
  Mat3 matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = readVector(value[static_cast<std::size_t>(i)]);
  constexpr double kSymmetryRounding = 1e-12;
  const double scale = matrix.cwiseAbs().maxCoeff();
  if (!((matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= kSymmetryRounding * scale))
    fail(where, "a matrix that is not symmetric", "a symmetric 3x3 matrix");
  return Inertia::fromMatrix(matrix);
}

void requireAtRest(const Body& body, const std::string& where) {
  if (!body.fixed) return;
  if (!body.velocity.isZero(0)) fail(where + "/velocity", "a velocity of a fixed body", "none, or zeros");
  if (!body.angular_velocity.isZero(0))
    fail(where + "/angular_velocity", "an angular velocity of a fixed body", "none, or zeros");
}

void requireStillSurface(const Body& body, const std::string& where) {
  if (body.immovable()) return;
  for (const auto& [member, value] : {std::pair("surface_velocity", body.surface_velocity),
                                      std::pair("surface_angular_velocity", body.surface_angular_velocity)})
    if (!value.isZero(0))
      fail(where + "/" + member, "a moving surface of a body that impacts move", "none, or zeros: surfaces of fixed and kinematic bodies move");
}

CollisionFilter readFilter(const Json& value) {
  const auto names = [&](const char* member) { return value.value(member, std::vector<std::string>()); };
  return {names("systems"), names("collide_with"), names("not_collide_with")};
}

Body readBody(const Json& value, const std::string& where, SurfaceFiles& files) {
  Body body;
  body.name = value["name"].get<std::string>();
  body.fixed = value.value("fixed", false);
  body.kinematic = value.value("kinematic", false);
  body.gravity_factor = value.value("gravity_factor", body.gravity_factor);
  if (value.contains("collision_filter")) body.collision_filter = readFilter(value["collision_filter"]);
  body.material = textOr(value, "material");
  const bool derived = !value.contains("mass") || !value.contains("inertia") || !value.contains("center_of_mass");
  files.readSolids(!body.immovable() && derived);
  body.shape = readShape(value["shape"], where + "/shape", files);
  if (value.contains("mass")) body.mass = value["mass"].get<double>();
  if (value.contains("density")) body.density = value["density"].get<double>();
  if (value.contains("inertia")) body.inertia = readInertia(value["inertia"], where + "/inertia");
  if (value.contains("center_of_mass")) body.center_of_mass = readVector(value["center_of_mass"]);
  body.position = vectorOr(value, "position", body.position);
  if (value.contains("orientation")) body.orientation = readQuaternion(value["orientation"], where + "/orientation");
  body.velocity = vectorOr(value, "velocity", body.velocity);
  body.angular_velocity = vectorOr(value, "angular_velocity", body.angular_velocity);
  body.surface_velocity = vectorOr(value, "surface_velocity", body.surface_velocity);
  body.surface_angular_velocity = vectorOr(value, "surface_angular_velocity", body.surface_angular_velocity);
  body.notes = textOr(value, "notes");
  requireAtRest(body, where);
  requireStillSurface(body, where);
  return body;
}

void readBodies(const Json& list, Scene& scene, SurfaceFiles& files) {
  std::set<std::string> materials;
  for (const Material& material : scene.materials) materials.insert(material.name);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = pointerTo("/bodies", i);
    Body body = readBody(list[i], where, files);
    if (!body.material.empty() && materials.count(body.material) == 0)
      failUnknownMaterial(where + "/material", body.material, scene);
    scene.bodies.push_back(std::move(body));
  }
}

void readTilts(const Json& list, Scene& scene) {
  std::set<std::pair<std::string, int>> seen;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = pointerTo("/tilts", i);
    const Json& value = list[i];
    readBodyName(value["body"], where + "/body", scene);
    Tilt tilt;
    tilt.body = value["body"].get<std::string>();
    tilt.impact = value["impact"].get<int>();
    tilt.value = {value["value"][0].get<double>(), value["value"][1].get<double>()};
    if (!seen.emplace(tilt.body, tilt.impact).second)
      fail(where, "a second tilt of impact " + std::to_string(tilt.impact) + " of " + quotedText(tilt.body),
           "one at most");
    scene.tilts.push_back(std::move(tilt));
  }
}

}  // namespace

const std::vector<std::string>& combineWords() {
  static const std::vector<std::string> words{"average", "minimum", "maximum", "multiply"};
  return words;
}

std::string textOr(const Json& object, const char* member) { return object.value(member, std::string()); }

Vec3 readVector(const Json& value) { return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()}; }

Quat readQuaternion(const Json& value, const std::string& where) {
  const Quat q(value[0].get<double>(), value[1].get<double>(), value[2].get<double>(), value[3].get<double>());
  constexpr double kHandWritten = 1e-3;  // three digits, as people write them
  if (!(std::abs(q.norm() - 1) <= kHandWritten))
    fail(where, describe(value) + " of length " + numberText(q.norm()), "a unit quaternion [w, x, y, z]");
  return unitQuaternion(q);
}

int readBodyName(const Json& value, const std::string& where, const Scene& scene) {
  const auto& name = value.get_ref<const std::string&>();
  const auto named = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](auto& b) { return b.name == name; });
  if (named == scene.bodies.end())
    fail(where, quotedText(name), "the name of a body (there is " + expectedOf(name, namesOf(scene.bodies)) + ")");
  return static_cast<int>(named - scene.bodies.begin());
}

void failUnknownMaterial(const std::string& where, const std::string& name, const Scene& scene) {
  fail(where, quotedText(name), "the name of a material (there is " + expectedOf(name, namesOf(scene.materials)) + ")");
}

Scene readScene(const Json& document, SurfaceFiles& files) {
  Scene scene;
  scene.gravity = vectorOr(document, "gravity", scene.gravity);
  if (const auto materials = document.find("materials"); materials != document.end())
    for (const auto& material : materials->items())
      scene.materials.push_back(readMaterial(material.key(), material.value()));
  readBodies(document["bodies"], scene, files);
  if (const auto tilts = document.find("tilts"); tilts != document.end()) readTilts(*tilts, scene);
  return scene;
}

}  // namespace carom::formats_detail
