// SPDX-License-Identifier: MIT
// Camera, light, ghosts and nails of exported glTF.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "formats/drawing/motion_extent.hpp"
#include "formats/export/export_motion.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {

using namespace formats_detail;

namespace {

tinygltf::Model staged(const Document& document, const Motion& motion, const GltfOptions& options) {
  const std::string path = temporaryPath("m.glb");
  exportMotion(path, document, motion, {options});
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path)) << error;
  return model;
}

const tinygltf::Node& nodeIn(const tinygltf::Model& model, const std::string& name) {
  const auto found =
      std::find_if(model.nodes.begin(), model.nodes.end(), [&](const auto& node) { return node.name == name; });
  if (found == model.nodes.end()) throw std::runtime_error("no node " + name);
  return *found;
}

// Poses in the axes of the file.
Vec3 placeOf(const tinygltf::Node& node) { return Vec3(node.translation.data()); }
Mat3 turnOf(const tinygltf::Node& node) {
  const auto& q = node.rotation;
  return Quat(q[3], q[0], q[1], q[2]).toRotationMatrix();
}
// And in ours, of something whose axes are turned along.
Vec3 ourPlace(const tinygltf::Node& node) { return {node.translation[0], -node.translation[2], node.translation[1]}; }
Quat ourTurn(const tinygltf::Node& node) {
  const auto& q = node.rotation;
  return {q[3], q[0], -q[2], q[1]};
}

// Every corner of what moves is in the picture, and the farthest one is near its border.
TEST(Stage, TheCameraSeesTheWholeMotion) {
  GltfOptions options;
  options.camera = true;
  for (const bool along_y : {false, true}) {
    Document document = handDocument();
    document.controls.clear(), document.constraints.clear();
    if (along_y)
      for (Body& body : document.scene.bodies) std::swap(body.velocity.x(), body.velocity.y());
    const Motion motion = handMotion(document.scene, 1.2, {});
    const tinygltf::Model model = staged(document, motion, options);
    const tinygltf::Node& node = nodeIn(model, "camera");
    const auto& lens = model.cameras.at(static_cast<std::size_t>(node.camera)).perspective;
    const Extent extent = motionExtent(motion);
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 ours = extent.corner(static_cast<Extent::CornerType>(corner));
      const Vec3 p = turnOf(node).transpose() * (Vec3(ours.x(), ours.z(), -ours.y()) - placeOf(node));
      EXPECT_LT(p.z(), -lens.znear);
      EXPECT_GT(p.z(), -lens.zfar);
      const double tan = std::tan(0.5 * lens.yfov);
      farthest = std::max({farthest, std::abs(p.y() / p.z()) / tan, std::abs(p.x() / p.z()) / (tan * lens.aspectRatio)});
    }
    EXPECT_LT(farthest, 1);
    EXPECT_GT(farthest, 0.85);
    EXPECT_NEAR(turnOf(node)(1, 0), 0, 1e-12) << "the picture is level";
    EXPECT_GT(turnOf(node)(1, 1), 0) << "and upright";
  }
}

TEST(Stage, TheSunShinesDown) {
  GltfOptions options;
  options.light = 1234;
  const tinygltf::Model model = staged(handDocument(), handMotion(), options);
  ASSERT_EQ(model.lights.size(), 1u);
  EXPECT_EQ(model.lights[0].type, "directional");
  EXPECT_EQ(model.lights[0].intensity, 1234);
  EXPECT_LT((-turnOf(nodeIn(model, "sun")).col(2)).y(), -0.5);
  EXPECT_EQ(nodeIn(model, "sun").extensions.at("KHR_lights_punctual").Get("light").GetNumberAsInt(), 0);
  EXPECT_TRUE(model.extensionsRequired.empty());
}

TEST(Stage, GhostsStandOnThePath) {
  GltfOptions options;
  options.ghosts = 0.3;
  const Motion motion = handMotion();
  const tinygltf::Model model = staged(handDocument(), motion, options);
  const auto& group = nodeIn(model, "ghosts");
  EXPECT_EQ(group.children.size(), 3u * 5u);
  for (const char* name : {"book", "ball <1>", "top"}) {
    int mesh = -1;
    for (const char* at : {"0", "0.3", "0.6", "0.9", "1.2"}) {
      const auto& ghost = nodeIn(model, std::string(name) + " at " + at + " s");
      const BodyState state = motion.stateAt(name, std::stod(at));
      EXPECT_LE((ourPlace(ghost) - state.position).norm(), 1e-12) << ghost.name;
      EXPECT_LE(ourTurn(ghost).angularDistance(state.orientation), 1e-12) << ghost.name;
      EXPECT_TRUE(mesh < 0 || mesh == ghost.mesh) << "one mesh for all of them";
      mesh = ghost.mesh;
      EXPECT_TRUE(ghost.extensions.empty());
    }
    const auto& primitive = model.meshes.at(static_cast<std::size_t>(mesh)).primitives.at(0);
    const auto& material = model.materials.at(static_cast<std::size_t>(primitive.material));
    EXPECT_EQ(material.alphaMode, "BLEND");
    EXPECT_LT(material.pbrMetallicRoughness.baseColorFactor[3], 0.5);
  }
}

TEST(Stage, NailsStandWhereBodiesShallBe) {
  GltfOptions options;
  options.nails = true;
  Document document = handDocument();
  Region region;
  region.shape = Box{{1, 2, 3}}, region.position = {4, 5, 6};
  Constraint away{.body = "top", .at = 0.0, .targets = {}};
  away.regions = {region};
  document.constraints.push_back(away);
  const Motion motion = handMotion();
  const tinygltf::Model model = staged(document, motion, options);
  EXPECT_EQ(nodeIn(model, "nails").children.size(), 4u);
  EXPECT_LE((ourPlace(nodeIn(model, "book at 1.1 s")) - Vec3(2.1, 0.2, 0.6)).norm(), 1e-12);
  const auto& pose = nodeIn(model, "book at 1.1 s pose");
  EXPECT_LE((ourPlace(pose) - Vec3(2.1, 0.2, 0.6)).norm(), 1e-12);
  EXPECT_LE(ourTurn(pose).angularDistance(Quat::Identity()), 1e-12);
  // Only x is nailed: y and z are those of the motion.
  Vec3 place = motion.stateAt("ball <1>", 0.5).position;
  place.x() = 0.9;
  EXPECT_LE((ourPlace(nodeIn(model, "ball <1> at impact 1 with floor")) - place).norm(), 1e-12);
  EXPECT_LE((ourPlace(nodeIn(model, "top stays out")) - Vec3(4, 5, 6)).norm(), 1e-12);
  const tinygltf::Model bare = staged(handDocument(), motion, {});
  EXPECT_EQ(bare.nodes.size(), 5u);
}

}  // namespace
}  // namespace carom::export_tests
