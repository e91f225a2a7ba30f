// SPDX-License-Identifier: MIT
// Export and import again: the same scene, bit by bit while the file is as it was, and what a file says where another
// program has changed it.
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"
#include "tests/import/gltf_files.h"
#include "tests/import/same_scene.h"
#include "tests/import/scenes.h"

namespace carom::import_tests {
namespace {

using nlohmann::json;

Imported throughFile(const Document& document, const std::string& name) {
  const std::string path = temporaryPath(name);
  exportFreeFlight(path, document);
  return importGltf(path);
}

/// The exported document as JSON, for a test to change, and the body that it then has.
json exportedJson(const Document& document) {
  const std::string path = temporaryPath("exported.gltf");
  exportFreeFlight(path, document);
  return jsonOf(path);
}

json& nodeNamed(json& document, const std::string& name) {
  for (json& node : document["nodes"])
    if (node.value("name", "") == name) return node;
  throw std::runtime_error("no node " + name);
}

class Endings : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(RoundTrip, Endings, testing::Values("scene.glb", "scene.gltf"),
                         [](const auto& test) { return test.param.substr(6); });

TEST_P(Endings, EveryKindComesBackBitByBit) {
  const Document document = documentOfEveryKind();
  const Imported again = throughFile(document, GetParam());
  EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
  expectSameScene(again.document.scene, document.scene);
  expectSameEdit(again.document, document);
}

TEST(RoundTrip, CameraLightGhostsAndNailsArePassedOver) {
  const Document document = documentOfEveryKind();
  GltfOptions options{GltfKeys::cubic};
  options.camera = options.nails = true, options.light = 2000, options.ghosts = 0.05;
  const std::string path = temporaryPath("scene.glb");
  exportFreeFlight(path, document, options);
  const Imported again = importGltf(path);
  EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
  expectSameScene(again.document.scene, document.scene);
  expectSameEdit(again.document, document);
}

TEST(RoundTrip, RandomScenesComeBackBitByBit) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Document document = randomDocument(seed);
    const Imported again = throughFile(document, "scene.glb");
    EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
    expectSameScene(again.document.scene, document.scene);
    if (HasFailure()) return;
  }
}

// What an import writes, a later one writes again, to the last byte: document and mesh files.
TEST(RoundTrip, SavedDocumentsAreTheSameText) {
  for (const char* name : {"shapes.gltf", "materials.gltf", "older.gltf"}) {
    SCOPED_TRACE(name);
    const std::string first = temporaryPath("first.json");
    const auto meshes = saveWithMeshes(first, importGltf(samplePath(name)).document);
    const Document read = readDocument(first);
    const Imported again = throughFile(read, "again.glb");
    EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
    std::filesystem::create_directories(temporaryPath("again"));
    const std::string second = temporaryPath("again/first.json");
    EXPECT_EQ(saveWithMeshes(second, again.document), meshes);
    EXPECT_EQ(contentOf(second), contentOf(first));
    for (const std::string& mesh : meshes)
      EXPECT_EQ(contentOf(temporaryPath("again/" + mesh)), contentOf(temporaryPath(mesh))) << mesh;
  }
}

/// Compounds are flat in glTF: the nodes below a body with motion.
Shape flattened(const Shape& shape) {
  const auto* compound = std::get_if<Compound>(&shape);
  if (compound == nullptr) return shape;
  Compound flat;
  for (const CompoundPart& part : compound->parts) {
    const Shape inner = flattened(part.shape);
    const auto* parts = std::get_if<Compound>(&inner);
    if (parts == nullptr) {
      flat.parts.push_back({inner, part.position, part.orientation});
      continue;
    }
    for (const CompoundPart& one : parts->parts)
      flat.parts.push_back(
          {one.shape, part.position + part.orientation * one.position, part.orientation * one.orientation});
  }
  return flat;
}

// Of surfaces that move the extensions say nothing.
void standStill(Body& body) { body.surface_velocity.setZero(), body.surface_angular_velocity.setZero(); }

Vec3 surfaceVelocityAt(const Body& body, const Vec3& p) {
  const Vec3 there = body.orientation.conjugate() * (p - body.position);
  return body.orientation * (body.surface_velocity + body.surface_angular_velocity.cross(there));
}

// Nodes say by themselves how their surfaces move, wherever those of planes and of parts come to lie.
TEST(RoundTrip, WithoutTheDocumentSurfacesMoveAsTheyDid) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  for (json& scene : file["scenes"]) scene.erase("extras");
  const Imported again = importJson(file);
  const auto expectSameAt = [&](const std::string& name, const Body& found) {
    const Body& expected = document.scene.bodies[static_cast<std::size_t>(bodyIndex(document.scene, name))];
    ASSERT_TRUE(expected.surfaceMoves());
    for (const Vec3& p : {Vec3(0.3, -0.2, 1), Vec3(4, 8, -1)}) {
      const Vec3 found_there = surfaceVelocityAt(found, p), there = surfaceVelocityAt(expected, p);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(found_there[i], there[i], 1e-12) << name;
    }
  };
  for (const char* name : {"cylinder", "wall", "slope"}) expectSameAt(name, bodyIn(again, name));
  int parts = 0;
  for (const Body& body : again.document.scene.bodies) {
    if (body.name.starts_with("shed")) expectSameAt("shed", body), ++parts;
    if (!body.immovable()) EXPECT_FALSE(body.surfaceMoves()) << body.name;
  }
  EXPECT_GT(parts, 1);
  EXPECT_FALSE(bodyIn(again, "floor").surfaceMoves());
}

// What other programs read: the physics of the nodes alone.
TEST(RoundTrip, WithoutExtrasBodiesAreTheSameInTheWorld) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  stripExtras(file);
  const Imported again = importJson(file);
  for (const std::string& warning : again.report.warnings)
    EXPECT_NE(warning.find("its animation is ignored"), std::string::npos) << warning;
  int moving = 0;
  for (const Body& body : document.scene.bodies) {
    if (body.fixed) continue;
    Body expected = body;
    expected.shape = flattened(body.shape);
    standStill(expected);
    if (body.material.empty()) expected.material = "material-3";  // the one after the last, which has no name
    expectSameBody(bodyIn(again, body.name), expected);
    ++moving;
  }
  EXPECT_EQ(moving, 11);
  EXPECT_LE((again.document.scene.gravity - document.scene.gravity).norm(), 1e-14);
  ASSERT_EQ(again.document.scene.materials.size(), 4u);
  EXPECT_EQ(again.document.scene.materials[1].elasticity, 1.0 / 3);
  EXPECT_EQ(again.document.scene.materials[1].combine_friction, Combine::minimum);
  EXPECT_EQ(again.document.scene.materials[3].friction, Material{}.friction);
  EXPECT_TRUE(again.document.controls.empty());
}

TEST(RoundTrip, WithoutExtrasFixedBodiesAreWhereTheyWere) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  stripExtras(file);
  const Imported again = importJson(file);
  const auto& bodies = document.scene.bodies;
  for (const char* name : {"post", "drum", "wall", "stone", "terrain"}) {
    Body expected = bodies[static_cast<std::size_t>(bodyIndex(document.scene, name))];
    standStill(expected);
    if (expected.material.empty()) expected.material = "material-3";
    const ShapeKind& kind = kindOf(expected.shape);
    const bool below = kind.dimensions(expected.shape).size() == 1;  // a scale: on a node of its own
    expectSameBody(bodyIn(again, below ? std::string(name) + " collider" : name), expected);
  }
  for (const char* name : {"floor", "slope"}) {  // a plane may lie anywhere in itself
    const Body& expected = bodies[static_cast<std::size_t>(bodyIndex(document.scene, name))];
    const Body& found = bodyIn(again, name);
    const Plane &a = std::get<Plane>(found.shape), &b = std::get<Plane>(expected.shape);
    const Vec3 n = found.orientation * a.normal;
    EXPECT_LE((n - expected.orientation * b.normal).norm(), 1e-14) << name;
    EXPECT_NEAR(a.offset + n.dot(found.position), b.offset + n.dot(expected.position), 1e-13) << name;
  }
}

TEST(RoundTrip, AChangedBodyIsReadFromItsNodeAndTheOthersAreKept) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  nodeNamed(file, "box")["translation"] = {0.5, 1.25, -1};
  const Imported again = importJson(file);
  ASSERT_EQ(again.report.warnings.size(), 2u) << listOf(again.report);
  EXPECT_TRUE(hasWarning(again.report, {"node 'box'", "has changed since carom wrote the file"}));
  EXPECT_TRUE(hasWarning(again.report, {"node 'box'", "its animation is ignored"}));
  Body expected = document.scene.bodies[static_cast<std::size_t>(bodyIndex(document.scene, "box"))];
  expected.position = {0.5, 1, 1.25};
  expectSameBody(bodyIn(again, "box"), expected);
  Document kept = again.document;
  kept.scene.bodies[static_cast<std::size_t>(bodyIndex(document.scene, "box"))] =
      document.scene.bodies[static_cast<std::size_t>(bodyIndex(document.scene, "box"))];
  expectSameScene(kept.scene, document.scene);
  expectSameEdit(again.document, document);
}

struct Change {
  const char* name;
  void (*apply)(json& file);
  const char* body;
};
std::ostream& operator<<(std::ostream& out, const Change& change) { return out << change.name; }
class Changes : public testing::TestWithParam<Change> {};

TEST_P(Changes, AreSeen) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  GetParam().apply(file);
  const Imported again = importJson(file);
  EXPECT_TRUE(hasWarning(again.report, {"node '" + std::string(GetParam().body) + "'", "has changed"}))
      << listOf(again.report);
}

json& motionOf(json& file, const std::string& name) {
  return nodeNamed(file, name)["extensions"]["KHR_physics_rigid_bodies"]["motion"];
}

INSTANTIATE_TEST_SUITE_P(
    RoundTrip, Changes,
    testing::Values(Change{"Turn",
                           [](json& f) {
                             nodeNamed(f, "sphere")["rotation"] = {0, 0, 0.6, 0.8};
                           },
                           "sphere"},
                    Change{"Scale",
                           [](json& f) {
                             nodeNamed(f, "sphere")["scale"] = {2, 2, 2};
                           },
                           "sphere"},
                    Change{"Mass", [](json& f) { motionOf(f, "mesh")["mass"] = 5; }, "mesh"},
                    Change{"Velocity",
                           [](json& f) {
                             motionOf(f, "mesh")["linearVelocity"] = {1, 2, 3};
                           },
                           "mesh"},
                    Change{"Spin",
                           [](json& f) {
                             motionOf(f, "hull")["angularVelocity"] = {1, 2, 3};
                           },
                           "hull"},
                    Change{"Inertia",
                           [](json& f) {
                             motionOf(f, "hull")["inertiaDiagonal"] = {1, 1, 1};
                           },
                           "hull"},
                    Change{"Centre",
                           [](json& f) {
                             motionOf(f, "box")["centerOfMass"] = {0, 0, 0.01};
                           },
                           "box"},
                    Change{"Gravity", [](json& f) { motionOf(f, "box")["gravityFactor"] = 0; }, "box"},
                    Change{"Material",
                           [](json& f) {
                             nodeNamed(
                                 f, "box")["extensions"]["KHR_physics_rigid_bodies"]["collider"]["physicsMaterial"] = 2;
                           },
                           "box"},
                    Change{"PartMoved",
                           [](json& f) {
                             nodeNamed(f, "hat <1> \"x\" part 4")["translation"] = {1, 1, 1};
                           },
                           "hat <1> \"x\""},
                    Change{"Parent",
                           [](json& f) {
                             const std::size_t parent = f["nodes"].size();
                             f["nodes"].push_back({{"translation", {0, 0, 1}}, {"children", f["scenes"][0]["nodes"]}});
                             f["scenes"][0]["nodes"] = {parent};
                           },
                           "capsule"}),
    [](const auto& test) { return test.param.name; });

TEST(RoundTrip, WhatConcernsABodyThatIsGoneIsLeftOutByName) {
  json file = exportedJson(documentOfEveryKind());
  json& children = file["scenes"][0]["nodes"];
  for (std::size_t i = 0; i < children.size(); ++i)
    if (file["nodes"][children[i].get<std::size_t>()]["name"] == "sphere") {
      children.erase(i);
      break;
    }
  const Imported again = importJson(file);
  EXPECT_TRUE(hasWarning(again.report, {"control 1", "ignored", "sphere"})) << listOf(again.report);
  EXPECT_TRUE(hasWarning(again.report, {"constraint 1", "ignored", "sphere"})) << listOf(again.report);
  EXPECT_TRUE(hasWarning(again.report, {"node 'sphere'", "not in the scene"})) << listOf(again.report);
  EXPECT_EQ(again.document.controls.size(), 2u);
  EXPECT_TRUE(hasWarning(again.report, {"constraint 4", "ignored", "sphere"})) << listOf(again.report);
  EXPECT_EQ(again.document.constraints.size(), 2u);
}

TEST(RoundTrip, ChangedMaterialsAndGravityAreTakenFromTheFile) {
  const Document document = documentOfEveryKind();
  json file = exportedJson(document);
  file["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"][0]["restitution"] = 0.75;
  file["extensions"]["OMI_physics_gravity"] = {{"gravity", 1.62}, {"direction", {0, -1, 0}}};
  const Imported again = importJson(file);
  EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
  Scene expected = document.scene;
  expected.materials[0].elasticity = 0.75;
  expected.gravity = {0, 0, -1.62};
  expectSameScene(again.document.scene, expected);
}

TEST(RoundTrip, ChangedVerticesAreTakenInPlaceOfTheDigitsBesideThem) {
  const Document document = documentOfEveryKind();
  const std::string path = temporaryPath("scene.gltf");
  exportFreeFlight(path, document);
  json file = jsonOf(path);
  std::size_t collision = 0;
  while (file["meshes"][collision]["name"] != "mesh collision" && file["meshes"][collision]["name"] != "shed collision")
    ++collision;
  file["meshes"][collision]["extras"]["carom"]["positions"] = 0;  // a view of another length
  const Imported again = importJson(file);
  EXPECT_TRUE(hasWarning(again.report, {"mesh /meshes/" + std::to_string(collision), "exact positions"}))
      << listOf(again.report);
}

TEST(RoundTrip, ADocumentThatCannotBeReadIsReportedAndThePhysicsIsUsed) {
  json file = exportedJson(documentOfEveryKind());
  file["scenes"][0]["extras"]["carom"]["bodies"][0]["fixed"] = 7;
  const Imported again = importJson(file);
  EXPECT_TRUE(hasWarning(again.report, {"the scene document that carom left in the file cannot be read", "fixed"}))
      << listOf(again.report);
  EXPECT_GE(again.document.scene.bodies.size(), documentOfEveryKind().scene.bodies.size());
}

}  // namespace
}  // namespace carom::import_tests
