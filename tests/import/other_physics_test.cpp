// SPDX-License-Identifier: MIT
// Files without KHR_physics_rigid_bodies: meshes that are drawn, OMI_physics_body as Godot writes it, quantised and compressed
// meshes, buffers elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <random>

#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "formats/base/base64.hpp"
#include "tests/import/gltf_files.h"

namespace carom::import_tests {
namespace {

using nlohmann::json;

/// The positions of a box from (-1, 0, -1) to (1, 1, 1), y up, in units of `unit`, as numbers of a type.
template <class Number>
std::string boxPositions(double unit) {
  std::string bytes;
  for (int i = 0; i < 8; ++i)
    for (const double x : {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : -1.0}) {
      const auto number = static_cast<Number>(x * unit);
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
  return bytes;
}

std::string boxIndices() {
  const unsigned short triangles[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return std::string(reinterpret_cast<const char*>(triangles), sizeof triangles);
}

/// Nodes "floor" (scaled flat) and "crate" above it, with the box as their mesh, and no physics.
json drawn(const std::string& positions, int component, bool normalized = false) {
  const std::string indices = boxIndices();
  json file;
  file["asset"]["version"] = "2.0";
  file["scene"] = 0;
  file["scenes"] = {{{"nodes", {0, 1}}}};
  file["nodes"] = {{{"name", "floor"}, {"mesh", 0}, {"translation", {0, -0.5, 0}}, {"scale", {5, 0.5, 5}}},
                   {{"name", "crate"}, {"mesh", 0}, {"translation", {0, 2, 0.5}}, {"scale", {0.5, 0.5, 0.5}}}};
  file["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  file["accessors"] = {{{"bufferView", 0}, {"componentType", component}, {"count", 8}, {"type", "VEC3"}, {"normalized", normalized}},
                       {{"bufferView", 1}, {"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}};
  file["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", positions.size()}},
                         {{"buffer", 0}, {"byteOffset", positions.size()}, {"byteLength", indices.size()}}};
  file["buffers"] = {{{"byteLength", positions.size() + indices.size()},
                      {"uri", "data:application/octet-stream;base64," + formats_detail::base64(positions + indices)}}};
  return file;
}

json drawnInFloats() { return drawn(boxPositions<float>(1), 5126); }

ImportOptions takenAs(ImportOptions::As as) { return {.as = as, .density = 600, .fixed = {"floor"}}; }

Scene sceneOf(const json& file, const ImportOptions& options = {}) { return parseGltfScene(file.dump(), "", options).document.scene; }

std::string refusal(const json& file, const ImportOptions& options = {}) {
  try {
    parseGltfScene(file.dump(), "", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was read";
}

TEST(DrawnMeshes, BecomeBodiesOfEachShape) {
  using As = ImportOptions::As;
  for (const As as : {As::hull, As::mesh, As::box, As::sphere}) {
    json file = drawnInFloats();
    if (as == As::sphere) file["nodes"][0]["scale"] = {5, 5, 5};
    const Scene scene = sceneOf(file, takenAs(as));
    ASSERT_EQ(scene.bodies.size(), 2u);
    const Body &floor = scene.bodies[0].fixed ? scene.bodies[0] : scene.bodies[1], &crate = scene.bodies[0].fixed ? scene.bodies[1] : scene.bodies[0];
    EXPECT_EQ(floor.name, "floor");
    EXPECT_TRUE(floor.fixed);
    EXPECT_EQ(crate.name, "crate");
    EXPECT_FALSE(crate.fixed);
    EXPECT_EQ(crate.density, 600);
    const double volume = as == As::sphere ? 4 * M_PI / 3 * std::pow(0.75, 3) : 0.5;  // half of 2 x 1 x 2: 1 x 0.5 x 1
    EXPECT_NEAR(modelOf(crate).mass, 600 * volume, 1e-4 * 600 * volume);
    const Vec3 center = crate.position + crate.orientation * modelOf(crate).center;
    EXPECT_NEAR((center - Vec3(0, -0.5, 2.25)).norm(), 0, 1e-6) << "z up";
  }
}

TEST(DrawnMeshes, NamesAndOptionsAreChecked) {
  ImportOptions options = takenAs(ImportOptions::As::hull);
  options.fixed = {"flor"};
  EXPECT_EQ(refusal(drawnInFloats(), options), "fixed: found no node \"flor\", expected one of \"floor\", \"crate\"");
  EXPECT_NE(refusal(drawnInFloats()).find("--as hull"), std::string::npos);
  EXPECT_EQ(refusal(drawnInFloats(), {.density = 3}),
            "density: found it without `as`, expected what meshes without physics are taken as");
  EXPECT_NE(refusal(plainDocument(), takenAs(ImportOptions::As::hull)).find("found physics in the file"), std::string::npos);
  json below = drawnInFloats();  // what is below a fixed node is fixed
  below["scenes"][0]["nodes"] = {0};
  below["nodes"][0]["children"] = {1};
  for (const Body& body : sceneOf(below, takenAs(ImportOptions::As::hull)).bodies) EXPECT_TRUE(body.fixed) << body.name;
}

TEST(DrawnMeshes, MayBeQuantised) {
  json shorts = drawn(boxPositions<short>(32767), 5122, true), bytes = drawn(boxPositions<signed char>(2), 5120);
  bytes["nodes"][1]["scale"] = {0.25, 0.25, 0.25}, bytes["nodes"][0]["scale"] = {2.5, 0.25, 2.5};
  for (json* file : {&shorts, &bytes}) {
    EXPECT_NE(refusal(*file, takenAs(ImportOptions::As::box)).find("KHR_mesh_quantization"), std::string::npos);
    (*file)["extensionsUsed"] = {"KHR_mesh_quantization"};
    (*file)["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = sceneOf(*file, takenAs(ImportOptions::As::box));
    const Scene plain = sceneOf(drawnInFloats(), takenAs(ImportOptions::As::box));
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_NEAR((scene.bodies[b].position - plain.bodies[b].position).norm(), 0, 1e-12);
      ASSERT_TRUE(scene.bodies[b].fixed || std::holds_alternative<Compound>(scene.bodies[b].shape) ||
                  std::holds_alternative<Box>(scene.bodies[b].shape));
      EXPECT_NEAR(kindOf(scene.bodies[b].shape).boundingRadius(scene.bodies[b].shape),
                  kindOf(plain.bodies[b].shape).boundingRadius(plain.bodies[b].shape), 1e-12);
    }
  }
}

// What is compressed is read (compressed_gltf_test.cpp); what is broken is named.
TEST(DrawnMeshes, CompressionIsNamed) {
  json draco = drawnInFloats();
  draco["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 9}, {"attributes", {{"POSITION", 0}}}};
  EXPECT_NE(refusal(draco, takenAs(ImportOptions::As::hull)).find("KHR_draco_mesh_compression"), std::string::npos);
  json meshopt = drawnInFloats();
  meshopt["buffers"][0].erase("uri");
  meshopt["buffers"][0]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  EXPECT_NE(refusal(meshopt, takenAs(ImportOptions::As::hull)).find("EXT_meshopt_compression"), std::string::npos);
}

TEST(DrawnMeshes, BuffersStayInTheFolder) {
  for (const char* uri : {"../secret.bin", "a/../../secret.bin", "%2e%2e/secret.bin", "/etc/hostname"}) {
    json file = drawnInFloats();
    file["buffers"][0]["uri"] = uri;
    EXPECT_NE(refusal(file, takenAs(ImportOptions::As::hull)).find("outside of the document's folder"), std::string::npos) << uri;
  }
}

/// As Godot 4.3 writes a rigid body with a capsule, and a static one with a box.
json fromGodot() {
  json file;
  file["asset"]["version"] = "2.0";
  file["scene"] = 0;
  file["extensionsUsed"] = {"OMI_physics_body", "OMI_physics_shape"};
  file["extensions"]["OMI_physics_shape"]["shapes"] = {{{"type", "capsule"}, {"capsule", {{"height", 2.0}, {"radius", 0.25}}}},
                                                       {{"type", "box"}, {"box", {{"size", {10, 1, 10}}}}},
                                                       {{"type", "sphere"}, {"sphere", {{"radius", 0.3}}}}};
  const double half = std::sqrt(0.5);
  file["scenes"] = {{{"nodes", {0, 2, 4}}}};
  file["nodes"] = {
      {{"name", "Pill"}, {"translation", {0, 3, 0}}, {"rotation", {0, half, 0, half}}, {"children", {1}},
       {"extensions", {{"OMI_physics_body", {{"motion", {{"type", "dynamic"}, {"mass", 2.5}, {"linearVelocity", {1, 0, 0}},
                                                         {"inertiaDiagonal", {0, 0, 0}}}}}}}}},
      {{"name", "PillShape"}, {"extensions", {{"OMI_physics_body", {{"collider", {{"shape", 0}}}}}}}},
      {{"name", "Ground"}, {"translation", {0, -0.5, 0}}, {"children", {3}},
       {"extensions", {{"OMI_physics_body", {{"motion", {{"type", "static"}}}}}}}},
      {{"name", "GroundShape"}, {"extensions", {{"OMI_physics_body", {{"collider", {{"shape", 1}}}}}}}},
      {{"name", "Lift"}, {"extensions", {{"OMI_physics_body", {{"motion", {{"type", "kinematic"}, {"linearVelocity", {0, 1, 0}}}},
                                                               {"collider", {{"shape", 2}}}}}}}}};
  return file;
}

TEST(OmiPhysics, IsReadAsGodotWritesIt) {
  const Imported imported = parseGltfScene(fromGodot().dump(), "");
  const Scene& scene = imported.document.scene;
  ASSERT_EQ(scene.bodies.size(), 3u);
  const Body &pill = scene.bodies[0], &ground = scene.bodies[1], &lift = scene.bodies[2];
  EXPECT_EQ(pill.name, "Pill");
  EXPECT_EQ(pill.mass, 2.5);
  const auto& capsule = std::get<Capsule>(pill.shape);
  EXPECT_EQ(capsule.radius, 0.25);
  EXPECT_NEAR(capsule.height, 1.5, 1e-15) << "without its caps";
  EXPECT_NEAR((pill.velocity - Vec3(1, 0, 0)).norm(), 0, 1e-12) << "in the world";
  EXPECT_NEAR((pill.position - Vec3(0, 0, 3)).norm(), 0, 1e-15);
  EXPECT_TRUE(ground.fixed);
  EXPECT_NEAR((std::get<Box>(ground.shape).size - Vec3(10, 10, 1)).norm(), 0, 1e-15);
  EXPECT_TRUE(lift.kinematic);
  EXPECT_NEAR((lift.velocity - Vec3(0, 0, 1)).norm(), 0, 1e-12);
  for (const std::string& warning : imported.report.warnings) EXPECT_EQ(warning.find("OMI"), std::string::npos) << warning;
}

/// The same as before there was OMI_physics_shape: the list of colliders, bodies with a type of their own, and a trigger.
json fromOldGodot() {
  json file = fromGodot();
  file["extensionsUsed"] = {"OMI_physics_body", "OMI_collider"};
  file["extensions"] = json::object();
  file["extensions"]["OMI_collider"]["colliders"] = {{{"type", "capsule"}, {"height", 2.0}, {"radius", 0.25}},
                                                     {{"type", "box"}, {"size", {10, 1, 10}}},
                                                     {{"type", "sphere"}, {"radius", 0.3}},
                                                     {{"type", "box"}, {"size", {1, 1, 1}}, {"isTrigger", true}}};
  const auto collider = [](int index) -> json { return {{"collider", index}}; };
  file["nodes"][0]["extensions"]["OMI_physics_body"] = {{"type", "rigid"}, {"mass", 2.5}, {"linearVelocity", {1, 0, 0}}};
  file["nodes"][1]["extensions"] = {{"OMI_collider", collider(0)}};
  file["nodes"][2]["extensions"]["OMI_physics_body"] = {{"type", "static"}};
  file["nodes"][3]["extensions"] = {{"OMI_collider", collider(1)}};
  file["nodes"][4]["extensions"] = {{"OMI_physics_body", {{"type", "kinematic"}, {"linearVelocity", {0, 1, 0}}}},
                                    {"OMI_collider", collider(2)}};
  file["nodes"].push_back({{"name", "Goal"}, {"extensions", {{"OMI_collider", collider(3)}}}});
  file["scenes"][0]["nodes"].push_back(5);
  return file;
}

TEST(OmiPhysics, CollidersOfOlderFilesAreTheSameBodies) {
  const Imported imported = parseGltfScene(fromOldGodot().dump(), "");
  const Scene old = imported.document.scene, now = sceneOf(fromGodot());
  ASSERT_EQ(old.bodies.size(), now.bodies.size());
  for (std::size_t b = 0; b < now.bodies.size(); ++b) {
    const Body &is = old.bodies[b], &wanted = now.bodies[b];
    SCOPED_TRACE(wanted.name);
    EXPECT_EQ(is.name, wanted.name);
    EXPECT_EQ(is.fixed, wanted.fixed);
    EXPECT_EQ(is.kinematic, wanted.kinematic);
    EXPECT_EQ(is.mass, wanted.mass);
    EXPECT_EQ(is.shape.index(), wanted.shape.index());
    EXPECT_EQ(kindOf(is.shape).boundingRadius(is.shape), kindOf(wanted.shape).boundingRadius(wanted.shape));
    EXPECT_EQ((is.position - wanted.position).norm(), 0);
    EXPECT_EQ((is.velocity - wanted.velocity).norm(), 0);
  }
  EXPECT_EQ(imported.report.triggers, std::vector<std::string>{"Goal"});
}

TEST(OmiPhysics, CollidersAloneAreFixedBodies) {
  json file = fromOldGodot();
  file["nodes"][2].erase("extensions");
  for (int node : {0, 1, 4, 5}) file["nodes"][static_cast<std::size_t>(node)].erase("extensions");
  const Scene scene = sceneOf(file);
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "GroundShape");
  EXPECT_TRUE(scene.bodies[0].fixed);
}

// Every kind of shape, that of a mesh too, of random sizes: as OMI_physics_shape has it.
TEST(OmiPhysics, CollidersOfEveryShape) {
  std::mt19937 random(51);
  std::uniform_real_distribution<double> in(0.2, 2);
  for (int round = 0; round < 40; ++round) {
    const double radius = in(random), height = 2 * radius + in(random);
    const json shapes[] = {{{"type", "box"}, {"size", {in(random), in(random), in(random)}}},
                           {{"type", "sphere"}, {"radius", radius}},
                           {{"type", "capsule"}, {"radius", radius}, {"height", height}},
                           {{"type", "cylinder"}, {"radius", radius}, {"height", height}},
                           {{"type", "hull"}, {"mesh", 0}},
                           {{"type", "trimesh"}, {"mesh", 0}},
                           {{"type", "box"}}, {{"type", "sphere"}}, {{"type", "capsule"}}, {{"type", "cylinder"}}};
    for (const json& flat : shapes) {
      SCOPED_TRACE(flat.dump());
      json nested = {{"type", flat["type"]}};
      for (const auto& [word, value] : flat.items())
        if (word != "type") nested[flat["type"].get<std::string>()][word] = value;
      json old = drawnInFloats(), now = drawnInFloats();
      old["extensions"]["OMI_collider"]["colliders"] = json::array({flat});
      now["extensions"]["OMI_physics_shape"]["shapes"] = json::array({nested});
      old["nodes"] = {{{"name", "a"}, {"extensions", {{"OMI_collider", {{"collider", 0}}}}}}};
      now["nodes"] = {{{"name", "a"}, {"extensions", {{"OMI_physics_body", {{"collider", {{"shape", 0}}}}}}}}};
      for (json* file : {&old, &now}) (*file)["scenes"] = {{{"nodes", {0}}}};
      const Scene is = sceneOf(old), wanted = sceneOf(now);
      ASSERT_EQ(is.bodies.size(), 1u);
      EXPECT_EQ(is.bodies[0].shape.index(), wanted.bodies[0].shape.index());
      EXPECT_EQ(kindOf(is.bodies[0].shape).boundingRadius(is.bodies[0].shape),
                kindOf(wanted.bodies[0].shape).boundingRadius(wanted.bodies[0].shape));
    }
  }
}

TEST(OmiPhysics, CollidersThatAreWrongOrOfTheFirstDraftAreNamed) {
  json file = fromOldGodot();
  file["nodes"][1]["extensions"]["OMI_collider"]["collider"] = 7;
  EXPECT_NE(refusal(file).find("/nodes/1/extensions/OMI_collider/collider"), std::string::npos) << refusal(file);
  file = fromOldGodot();
  file["extensions"]["OMI_collider"]["colliders"][0]["height"] = 0.4;
  EXPECT_NE(refusal(file).find("/extensions/OMI_collider/colliders/0/height"), std::string::npos) << refusal(file);
  file = fromOldGodot();
  file["extensions"]["OMI_collider"]["colliders"][0].erase("type");
  EXPECT_NE(refusal(file).find("/extensions/OMI_collider/colliders/0"), std::string::npos) << refusal(file);
  file = fromOldGodot();
  file["extensions"]["OMI_collider"]["colliders"][1] = {{"type", "box"}, {"extents", {10, 1, 10}}};
  EXPECT_NE(refusal(file).find("/extensions/OMI_collider/colliders/1/extents"), std::string::npos) << refusal(file);
  file = fromGodot();
  file["nodes"].push_back({{"name", "Draft"}, {"extensions", {{"OMI_collider", {{"type", "sphere"}, {"radius", 0.5}}}}}});
  file["scenes"][0]["nodes"].push_back(5);
  const Imported imported = parseGltfScene(file.dump(), "");
  EXPECT_EQ(imported.document.scene.bodies.size(), 3u);
  const auto& warnings = imported.report.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("OMI_collider") != std::string::npos; }));
}

TEST(OmiPhysics, WhatIsWrongIsNamed) {
  json file = fromGodot();
  file["nodes"][1]["extensions"]["OMI_physics_body"]["collider"]["shape"] = 5;
  EXPECT_NE(refusal(file).find("/nodes/1/extensions/OMI_physics_body/collider/shape"), std::string::npos) << refusal(file);
  file = fromGodot();
  file["nodes"][0]["extensions"]["OMI_physics_body"]["motion"]["type"] = "liquid";
  EXPECT_NE(refusal(file).find("static, kinematic or dynamic"), std::string::npos);
  file = fromGodot();
  file["extensions"]["OMI_physics_shape"]["shapes"][0]["capsule"]["height"] = 0.4;
  EXPECT_NE(refusal(file).find("at least twice the radius"), std::string::npos);
}

}  // namespace
}  // namespace carom::import_tests
