// SPDX-License-Identifier: MIT
// What is not supported is named, with its node, and the rest is read.
#include <gtest/gtest.h>

#include "formats/documents/save_with_meshes.h"
#include "tests/import/gltf_files.h"

namespace carom::import_tests {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

struct LeftOut {
  const char* name;
  void (*add)(json& file);  ///< to plainDocument()
  Words words;              ///< in one of the warnings
  std::size_t bodies = 2;   ///< that there still are
};
std::ostream& operator<<(std::ostream& out, const LeftOut& row) { return out << row.name; }

json sphereShape() { return {{"type", "sphere"}, {"sphere", {{"radius", 0.1}}}}; }

/// Node 2, below the scene or below another node.
void addNode(json& file, const json& node, int parent = -1) {
  file["nodes"].push_back(node);
  json& list = parent < 0 ? file["scenes"][0]["nodes"] : file["nodes"][static_cast<std::size_t>(parent)]["children"];
  list.push_back(file["nodes"].size() - 1);
}

void addAnimation(json& file, int node) {
  file["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}},
                         {"samplers", {{{"input", 0}, {"output", 0}}}}}};
}

class Unsupported : public testing::TestWithParam<LeftOut> {};

TEST_P(Unsupported, IsNamedAndTheRestIsRead) {
  json file = plainDocument();
  GetParam().add(file);
  const Imported imported = importJson(file);
  EXPECT_TRUE(hasWarning(imported.report, GetParam().words)) << listOf(imported.report);
  EXPECT_EQ(imported.document.scene.bodies.size(), GetParam().bodies);
  EXPECT_TRUE(saveWithMeshes(temporaryPath("scene.json"), imported.document).size() < 2);
}

INSTANTIATE_TEST_SUITE_P(
    Table, Unsupported,
    testing::Values(
        LeftOut{"Trigger",
                [](json& f) {
                  addNode(f, {{"name", "zone"}});
                  physicsOf(f, 2)["trigger"] = {{"geometry", {{"shape", 1}}}};
                },
                {"node 'zone' (/nodes/2)", "trigger", "not supported"}},
        LeftOut{"Joint",
                [](json& f) {
                  f["extensions"]["KHR_physics_rigid_bodies"]["physicsJoints"] = {{{"limits", json::array()}}};
                  addNode(f, {{"name", "hinge"}}, 1);
                  physicsOf(f, 2)["joint"] = {{"connectedNode", 0}, {"joint", 0}, {"enableCollision", true}};
                },
                {"node 'hinge' (/nodes/2)", "joint to node 'floor' (/nodes/0)", "not supported"}},
        LeftOut{"SeveralFilters",
                [](json& f) {
                  f["extensions"]["KHR_physics_rigid_bodies"]["collisionFilters"] = {{{"collisionSystems", {"a"}}}};
                  addNode(f, {{"name", "part"}, {"translation", {0, 0, 1}}}, 1);
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 1}}}, {"collisionFilter", 0}};
                },
                {"node 'ball'", "several collision filters", "that of the first"}},
        LeftOut{
            "InfiniteMass", [](json& f) { ballMotion(f)["mass"] = 0; }, {"node 'ball'", "infinite mass", "fixed body"}},
        LeftOut{"InfiniteInertia",
                [](json& f) {
                  ballMotion(f)["inertiaDiagonal"] = {0, 1, 1};
                },
                {"node 'ball'", "infinite moments", "derived from its shape"}},
        LeftOut{"ImpossibleInertia",
                [](json& f) {
                  ballMotion(f)["inertiaDiagonal"] = {0.4, 0.1, 0.1};
                },
                {"node 'ball'", "moments of inertia (0.4, 0.1, 0.1", "nearest possible ones (0.33333333333333"}},
        LeftOut{"NoGeometry",
                [](json& f) { physicsOf(f, 1).erase("collider"); },
                {"node 'ball'", "motion is ignored", "no collider"},
                1},
        LeftOut{"StaticFriction",
                [](json& f) { materialOf(f)["staticFriction"] = 0.9; },
                {"physicsMaterials/0", "static friction 0.9", "0.4"}},
        LeftOut{"Restitution",
                [](json& f) { materialOf(f)["restitution"] = 1.5; },
                {"physicsMaterials/0", "restitution 1.5", "clamped to 1"}},
        LeftOut{"SeveralMaterials",
                [](json& f) {
                  f["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"].push_back({{"name", "n"}});
                  addNode(f, {{"name", "part"}, {"translation", {0, 0, 1}}}, 1);
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 1}}}, {"physicsMaterial", 1}};
                },
                {"node 'ball'", "several physics materials", "'m'"}},
        LeftOut{"UnknownShape",
                [](json& f) {
                  shapesOf(f).push_back({{"type", "torus"}, {"torus", {{"radius", 1}}}});
                  addNode(f, {{"name", "ring"}});
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 2}}}};
                },
                {"node 'ring' (/nodes/2)", "\"torus\"", "not supported"}},
        LeftOut{"HalfInfinitePlane",
                [](json& f) {
                  shapesOf(f).push_back({{"type", "plane"}, {"plane", {{"sizeX", 2}}}});
                  addNode(f, {{"name", "strip"}});
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 2}}}};
                },
                {"node 'strip'", "infinite in one direction"}},
        LeftOut{"DoubleSidedPlane",
                [](json& f) { shapesOf(f)[0]["plane"]["doubleSided"] = true; },
                {"node 'floor'", "one side"}},
        LeftOut{"MovingPlane",
                [](json& f) {
                  addNode(f, {{"name", "lid"}}, 1);
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 0}}}};
                },
                {"node 'lid'", "its plane is ignored"}},
        LeftOut{"ZeroScale",
                [](json& f) {
                  addNode(f, {{"name", "off"}, {"scale", {0, 0, 0}}});
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 1}}}};
                },
                {"node 'off'", "a scale of 0"}},
        LeftOut{"TwoRadii",
                [](json& f) {
                  shapesOf(f)[1] = {{"type", "capsule"},
                                    {"capsule", {{"height", 1}, {"radiusTop", 0.1}, {"radiusBottom", 0.2}}}};
                },
                {"node 'ball'", "two radii (0.2 and 0.1)", "convex hull of 1154 points"}},
        LeftOut{"Animation", [](json& f) { addAnimation(f, 1); }, {"node 'ball'", "animation"}},
        LeftOut{"AnimationOfACarrier",
                [](json& f) {
                  addNode(f, {{"name", "lift"}, {"translation", {0, 5, 0}}});
                  addNode(f, {{"name", "cabin"}}, 2);
                  physicsOf(f, 3)["collider"] = {{"geometry", {{"shape", 1}}}};
                  addAnimation(f, 2);
                },
                {"node 'cabin' (/nodes/3)", "animation"},
                3},
        LeftOut{"OtherBodies",
                [](json& f) { f["nodes"][1]["extensions"]["OMI_physics_body"] = json::object(); },
                {"node 'ball'", "OMI_physics_body", "not supported"}},
        LeftOut{"LocalGravity",
                [](json& f) {
                  f["nodes"][1]["extensions"]["OMI_physics_gravity"] = {{"gravity", 1}};
                },
                {"node 'ball'", "OMI_physics_gravity"}},
        LeftOut{"Instances",
                [](json& f) { f["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"] = json::object(); },
                {"node 'ball'", "EXT_mesh_gpu_instancing"}},
        LeftOut{"RequiredExtension",
                [](json& f) {
                  f["extensionsRequired"] = {"KHR_materials_unlit", "VENDOR_springs"};
                },
                {"requires", "VENDOR_springs"}},
        LeftOut{"AnotherScene",
                [](json& f) {
                  f["nodes"].push_back({{"name", "elsewhere"}});
                  physicsOf(f, 2)["collider"] = {{"geometry", {{"shape", 1}}}};
                  f["scenes"].push_back({{"nodes", {2}}});
                },
                {"node 'elsewhere' (/nodes/2)", "not in the scene"}}),
    [](const auto& test) { return test.param.name; });

TEST(Supported, IsReadWithoutAWarning) {
  const Imported imported = importJson(plainDocument());
  EXPECT_TRUE(imported.report.warnings.empty()) << listOf(imported.report);
  EXPECT_EQ(imported.document.scene.bodies.size(), 2u);
  json file = plainDocument();
  shapesOf(file)[1] = sphereShape();
  file["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  file["textures"] = {{{"source", 0}}};
  file["images"] = {{{"uri", "nowhere/missing.png"}}};
  file["extensionsRequired"] = {"KHR_lights_punctual", "KHR_physics_rigid_bodies", "KHR_texture_transform"};
  const Imported textured = importJson(file);
  EXPECT_TRUE(textured.report.warnings.empty()) << listOf(textured.report);
}

TEST(Unsupported, TheSampleNamesItAll) {
  const Imported sample = importGltf(samplePath("shapes.gltf"));
  EXPECT_TRUE(hasWarning(sample.report, {"node 'Lamp' (/nodes/14)", "trigger"}));
  EXPECT_TRUE(hasWarning(sample.report, {"node 'Cone'", "two radii"}));
  EXPECT_TRUE(hasWarning(sample.report, {"node 'Tapered capsule'", "two radii"}));
  EXPECT_TRUE(hasWarning(sample.report, {"node 'Bowl'", "its mesh is open", "its convex hull"}));
  EXPECT_EQ(sample.report.triggers, Words{"Lamp"});
  EXPECT_EQ(sample.report.warnings.size(), 4u) << listOf(sample.report);
}

}  // namespace
}  // namespace carom::import_tests
