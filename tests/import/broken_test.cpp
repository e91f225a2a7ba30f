// SPDX-License-Identifier: MIT
// Files that are not possible: one sentence with the file, the place, what was found and what was expected.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/import/gltf_files.h"

namespace carom::import_tests {
namespace {

using nlohmann::json;

struct Broken {
  const char* name;
  void (*spoil)(json& file);  ///< of plainDocument()
  const char* where;          ///< the JSON pointer
  const char* message;        ///< a part of it
};
std::ostream& operator<<(std::ostream& out, const Broken& row) { return out << row.name; }

class BrokenFile : public testing::TestWithParam<Broken> {};

TEST_P(BrokenFile, IsRefusedWithItsPlace) {
  json file = plainDocument();
  GetParam().spoil(file);
  const std::string path = writeTemporary("broken.gltf", file.dump());
  try {
    importGltf(path);
    ADD_FAILURE() << "it was read";
  } catch (const FormatError& error) {
    EXPECT_EQ(error.file(), path);
    EXPECT_EQ(error.where(), GetParam().where);
    EXPECT_NE(error.message().find(GetParam().message), std::string::npos) << error.message();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenFile,
    testing::Values(
        Broken{"NoPhysics",
               [](json& f) {
                 f["nodes"] = {{{"name", "a"}}, {{"name", "b"}}};
               },
               "", "no body"},
        Broken{"Version", [](json& f) { f["asset"]["version"] = "1.0"; }, "/asset/version", "2.0"},
        Broken{"ShapeIndex", [](json& f) { physicsOf(f, 1)["collider"]["geometry"]["shape"] = 7; },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/geometry/shape", "of which there are 2"},
        Broken{"NoGeometryIndex", [](json& f) { physicsOf(f, 1)["collider"]["geometry"] = json::object(); },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/geometry", "\"shape\""},
        Broken{"MeshIndex",
               [](json& f) {
                 physicsOf(f, 1)["collider"]["geometry"] = {{"mesh", 0}};
               },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/geometry/mesh", "of which there are 0"},
        Broken{"NodeIndex",
               [](json& f) {
                 physicsOf(f, 1)["collider"]["geometry"] = {{"node", -1}};
               },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/geometry/node", "-1"},
        Broken{"MaterialIndex", [](json& f) { physicsOf(f, 1)["collider"]["physicsMaterial"] = 1; },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/physicsMaterial", "of which there are 1"},
        Broken{"NegativeRadius", [](json& f) { shapesOf(f)[1]["sphere"]["radius"] = -1; },
               "/extensions/KHR_implicit_shapes/shapes/1/sphere/radius", "> 0"},
        Broken{"TextRadius", [](json& f) { shapesOf(f)[1]["sphere"]["radius"] = "big"; },
               "/extensions/KHR_implicit_shapes/shapes/1/sphere/radius", "a number"},
        Broken{"BoxSize",
               [](json& f) {
                 shapesOf(f)[1] = {{"type", "box"}, {"box", {{"size", {1, 0, 1}}}}};
               },
               "/extensions/KHR_implicit_shapes/shapes/1/box/size", "> 0"},
        Broken{"NegativeMass", [](json& f) { ballMotion(f)["mass"] = -1; },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/motion/mass", ">= 0"},
        Broken{"NegativeInertia",
               [](json& f) {
                 ballMotion(f)["inertiaDiagonal"] = {1, -1, 1};
               },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/motion/inertiaDiagonal", ">= 0"},
        Broken{"ShortVelocity",
               [](json& f) {
                 ballMotion(f)["linearVelocity"] = {1, 2};
               },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/motion/linearVelocity", "3 numbers"},
        Broken{"Quaternion",
               [](json& f) {
                 f["nodes"][1]["rotation"] = {0, 0, 0, 3};
               },
               "/nodes/1/rotation", "unit"},
        Broken{"Shear",
               [](json& f) {
                 f["nodes"][1].erase("translation");
                 f["nodes"][1]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
               },
               "/nodes/1/matrix", "shears"},
        Broken{"ScaleOfASphere",
               [](json& f) {
                 f["nodes"][1]["scale"] = {1, 2, 1};
               },
               "/nodes/1", "found a scale of [1, 2, 1] on a sphere, expected the same scale in every direction"},
        Broken{"FlatScale",
               [](json& f) {
                 f["nodes"][1]["scale"] = {1, 0, 1};
               },
               "/nodes/1", "without zeros"},
        Broken{"ScaleOfACylinder",
               [](json& f) {
                 shapesOf(f)[1] = {{"type", "cylinder"}, {"cylinder", json::object()}};
                 f["nodes"][1]["scale"] = {1, 2, 3};
               },
               "/nodes/1", "the same in x and z"},
        Broken{"CombineWord", [](json& f) { materialOf(f)["frictionCombine"] = "mean"; },
               "/extensions/KHR_physics_rigid_bodies/physicsMaterials/0/frictionCombine", "average"},
        Broken{"NegativeFriction", [](json& f) { materialOf(f)["dynamicFriction"] = -0.1; },
               "/extensions/KHR_physics_rigid_bodies/physicsMaterials/0/dynamicFriction", ">= 0"},
        Broken{"GravityDirection",
               [](json& f) {
                 f["extensions"]["OMI_physics_gravity"] = {{"gravity", 1}, {"direction", {0, 0, 0}}};
               },
               "/extensions/OMI_physics_gravity/direction", "unit vector"},
        Broken{"JointNode",
               [](json& f) {
                 physicsOf(f, 1)["joint"] = {{"connectedNode", 9}};
               },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/joint/connectedNode", "of which there are 2"},
        Broken{"FilterIndex", [](json& f) { physicsOf(f, 1)["collider"]["collisionFilter"] = 0; },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/collider/collisionFilter", "of which there are 0"},
        Broken{"TextMotion", [](json& f) { physicsOf(f, 1)["motion"] = "fast"; },
               "/nodes/1/extensions/KHR_physics_rigid_bodies/motion", "an object"},
        Broken{"Loop", [](json& f) { f["nodes"][1]["children"] = {1}; }, "/nodes/1", "below itself"},
        Broken{"ChildIndex", [](json& f) { f["nodes"][1]["children"] = {5}; }, "/nodes/1/children/0",
               "of which there are 2"},
        Broken{"FlatMovingSheet",
               [](json& f) {
                 shapesOf(f)[1] = {{"type", "plane"}, {"plane", {{"sizeX", 1}, {"sizeZ", 2}}}};
               },
               "/nodes/1", "its mass, center of mass and inertia"}),
    [](const auto& test) { return test.param.name; });

TEST(BrokenFiles, OfOtherKinds) {
  const auto refused = [](const std::string& path) {
    const std::string message = messageOf([&] { importGltf(path); });
    EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
    return message;
  };
  refused(temporaryPath("missing.gltf"));
  refused(writeTemporary("empty.gltf", ""));
  refused(writeTemporary("noise.glb", std::string("\x01\x02\xff", 3)));
  refused(writeTemporary("array.gltf", "[1, 2]"));
  refused(std::filesystem::path(temporaryPath("x")).parent_path().string());
  const std::string binary = binaryOf(jsonOf(samplePath("shapes.gltf")), contentOf(samplePath("shapes.bin")));
  for (const std::size_t length : {0u, 4u, 11u, 12u, 19u, 20u, 200u})
    refused(writeTemporary("cut.glb", binary.substr(0, length)));
  refused(writeTemporary("cut.glb", binary.substr(0, binary.size() - 4)));
}

TEST(BrokenFiles, OfMeshes) {
  const auto message = [](void (*spoil)(json&)) {
    json file = jsonOf(samplePath("older.gltf"));
    spoil(file);
    return messageOf([&] { importJson(file); });
  };
  EXPECT_NE(message([](json& f) { f["buffers"][0]["uri"] = "gone.bin"; }).find("gone.bin"), std::string::npos);
  EXPECT_NE(message([](json& f) { f["bufferViews"][0]["byteLength"] = 4000; }).find("/bufferViews/0/byteLength"),
            std::string::npos);
  EXPECT_NE(message([](json& f) { f["accessors"][1]["count"] = 400; }).find("/accessors/1"), std::string::npos);
  EXPECT_NE(message([](json& f) { f["meshes"][0]["primitives"][0]["mode"] = 1; }).find("node 'Tetrahedron'"),
            std::string::npos);
  // A triangle of the tetrahedron turned over: as a hull it does not matter, as a mesh it does.
  const auto turned_over = [](json& f) {
    f["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 18}});
    f["accessors"][1] = {{"bufferView", 2}, {"componentType", 5123}, {"type", "SCALAR"}, {"count", 9}};
    f["extensions"]["KHR_collision_shapes"]["shapes"][1].erase("extensions");
    f["accessors"][0]["count"] = 4;
  };
  json open = jsonOf(samplePath("older.gltf"));
  turned_over(open);
  const Imported imported = importJson(open);
  EXPECT_TRUE(hasWarning(imported.report, {"node 'Tetrahedron'", "its mesh is open"})) << listOf(imported.report);
}

// Whatever is done to a file, it is read or refused.
TEST(BrokenFiles, AreReadOrRefused) {
  const std::string text = json(jsonOf(samplePath("materials.gltf"))).dump();
  std::uint32_t state = 12345;
  const auto next = [&](std::size_t below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<std::size_t>(state >> 8) % below;
  };
  int read = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string spoilt = text;
    for (std::size_t changes = 1 + next(3); changes > 0; --changes) {
      static constexpr char kBytes[] = "0123456789-.eE[]{},:\"ntf \xff";
      spoilt[next(spoilt.size())] = kBytes[next(sizeof kBytes - 1)];
    }
    try {
      read += parseGltfScene(spoilt, ".").document.scene.bodies.empty() ? 0 : 1;
    } catch (const InputError& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace carom::import_tests
