// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <array>
#include <cstring>
#include <map>

#include "formats/export/export_motion.h"
#include "tests/export/all_shapes.h"
#include "tests/export/hand_motion.h"
#include "tests/support/compare.h"

namespace carom::export_tests {
namespace {

struct Corner {
  std::array<float, 3> place;
  Vec3 normal;
  Vec3 x() const { return Vec3(place[0], place[1], place[2]); }
};
using Triangles = std::vector<std::array<Corner, 3>>;

std::array<float, 3> vectorAt(const tinygltf::Model& model, int accessor, std::uint32_t index) {
  const auto& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  std::array<float, 3> out;
  std::memcpy(out.data(), model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset + index * sizeof out,
              sizeof out);
  return out;
}

std::uint32_t indexAt(const tinygltf::Model& model, int accessor, std::size_t k) {
  const auto& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  std::uint32_t out = 0;
  std::memcpy(&out, model.buffers.at(0).data.data() + view.byteOffset + a.byteOffset + k * sizeof out, sizeof out);
  return out;
}

// All triangles of the mesh that a body is drawn with, both shades.
Triangles trianglesOf(const tinygltf::Model& model, const std::string& body) {
  Triangles out;
  for (const auto& mesh : model.meshes) {
    if (mesh.name != body) continue;
    for (const auto& primitive : mesh.primitives)
      for (std::size_t k = 0; k < model.accessors.at(static_cast<std::size_t>(primitive.indices)).count; ++k) {
        const std::uint32_t index = indexAt(model, primitive.indices, k);
        const auto n = vectorAt(model, primitive.attributes.at("NORMAL"), index);
        if (k % 3 == 0) out.emplace_back();
        out.back()[k % 3] = {vectorAt(model, primitive.attributes.at("POSITION"), index), Vec3(n[0], n[1], n[2])};
      }
  }
  return out;
}

class DisplayMesh : public testing::TestWithParam<NamedShape> {
 protected:
  void SetUp() override {
    const Document document = documentOfAllShapes(false);
    const std::string path = temporaryPath("all.glb");
    exportMotion(path, document, handMotion(document.scene, document.duration, {}));
    std::string error, warning;
    ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model_, &error, &warning, path)) << error;
    triangles_ = trianglesOf(model_, GetParam().name);
    ASSERT_GT(triangles_.size(), 3u);
  }

  tinygltf::Model model_;
  Triangles triangles_;
};

TEST_P(DisplayMesh, IsClosedAndFacesOneWay) {
  std::map<std::array<std::array<float, 3>, 2>, int> runs;
  for (const auto& triangle : triangles_)
    for (std::size_t k = 0; k < 3; ++k) ++runs[{triangle[k].place, triangle[(k + 1) % 3].place}];
  int open = 0;
  for (const auto& [edge, count] : runs) {
    const auto back = runs.find({edge[1], edge[0]});
    open += back == runs.end() || back->second != count;
  }
  EXPECT_EQ(open, 0) << "of " << runs.size();
}

TEST_P(DisplayMesh, HoldsTheVolumeOfTheSolid) {
  double volume = 0;
  for (const auto& t : triangles_) volume += t[0].x().dot(t[1].x().cross(t[2].x())) / 6;
  const Shape& shape = GetParam().shape;
  const double expected = kindOf(shape).properties(shape).volume;
  // Round shapes are inscribed with 32 sides: a circle loses 0.6 % of its area, a ball 1.3 % more of its volume.
  const bool flat =
      std::holds_alternative<Box>(shape) || std::holds_alternative<Hull>(shape) || std::holds_alternative<Mesh>(shape);
  EXPECT_LE(volume, expected * (1 + 1e-6));
  EXPECT_GE(volume, expected * (flat ? 1 - 1e-6 : 0.975));
}

TEST_P(DisplayMesh, StaysWithinTheBoundingRadius) {
  const Shape& shape = GetParam().shape;
  const double radius = kindOf(shape).boundingRadius(shape);
  double most = 0;
  for (const auto& triangle : triangles_)
    for (const Corner& corner : triangle) most = std::max(most, corner.x().norm());
  EXPECT_LE(most, radius * (1 + 1e-6));
  EXPECT_GE(most, radius * 0.5);
}

TEST_P(DisplayMesh, NormalsAreUnitAndNearTheirFaces) {
  for (const auto& t : triangles_) {
    const Vec3 face = (t[1].x() - t[0].x()).cross(t[2].x() - t[0].x()).normalized();
    for (const Corner& corner : t) {
      test::expectEntries(corner.normal.norm(), 1.0, 1e-6, "length of a normal");
      EXPECT_GT(corner.normal.dot(face), 0.9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryShape, DisplayMesh, testing::ValuesIn(solidShapes()),
                         [](const auto& shape) { return shape.param.name; });

// As a player of glTF 2.0 joins keys, the pose of the origin stays on its path though the body turns about another
// point.
TEST(DisplayMesh, TheOriginFollowsItsPathAboutTheCentreOfMass) {
  const Document document = documentOfAllShapes(false);
  const Motion motion = handMotion(document.scene, document.duration, {});
  const std::string path = temporaryPath("all.glb");
  exportMotion(path, document, motion, {{GltfKeys::cubic}});
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path)) << error;
  int tracks = 0;
  for (const auto& channel : model.animations.at(0).channels) {
    if (channel.target_path != "translation") continue;
    const auto& sampler = model.animations[0].samplers.at(static_cast<std::size_t>(channel.sampler));
    const auto& times = model.accessors.at(static_cast<std::size_t>(sampler.input));
    const auto timeAt = [&](std::size_t k) {
      float t = 0;
      const auto& view = model.bufferViews.at(static_cast<std::size_t>(times.bufferView));
      std::memcpy(&t, model.buffers.at(0).data.data() + view.byteOffset + k * sizeof t, sizeof t);
      return static_cast<double>(t);
    };
    const auto vector = [&](std::size_t k) {
      const auto v = vectorAt(model, sampler.output, static_cast<std::uint32_t>(k));
      return Vec3(v[0], -v[2], v[1]);
    };
    const std::string& name = model.nodes.at(static_cast<std::size_t>(channel.target_node)).name;
    for (std::size_t k = 0; k + 1 < times.count; ++k)
      for (const double s : {0.0, 0.2, 0.5, 0.7, 1.0}) {
        const double d = timeAt(k + 1) - timeAt(k), t = std::min(timeAt(k) + s * d, motion.end);
        const Vec3 found =
            (2 * s * s * s - 3 * s * s + 1) * vector(3 * k + 1) + d * (s * s * s - 2 * s * s + s) * vector(3 * k + 2) +
            (-2 * s * s * s + 3 * s * s) * vector(3 * k + 4) + d * (s * s * s - s * s) * vector(3 * k + 3);
        EXPECT_TRUE((found - motion.stateAt(name, t).position).norm() <= 1e-5) << name << " at " << t;
      }
    ++tracks;
  }
  EXPECT_EQ(tracks, static_cast<int>(solidShapes().size()) + 1);
}

// A pen of hundreds of equal balls is written with one ball's triangles.
TEST(DisplayMesh, EqualBodiesShareTheirTriangles) {
  Document document;
  std::vector<std::size_t> vertex_bytes;
  for (const int count : {1, 20}) {
    document.scene.bodies.clear();
    for (int i = 0; i < count; ++i) {
      Body body;
      body.name = "ball " + std::to_string(i), body.shape = Sphere{0.1}, body.density = 500;
      body.position.x() = i;
      document.scene.bodies.push_back(body);
    }
    const std::string path = temporaryPath("balls.glb");
    exportMotion(path, document, handMotion(document.scene, 0.1, {}));
    tinygltf::Model model;
    std::string error, warning;
    ASSERT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path)) << error;
    EXPECT_EQ(model.meshes.size(), static_cast<std::size_t>(count));
    vertex_bytes.push_back(0);
    for (const auto& view : model.bufferViews)
      if (view.target != 0) vertex_bytes.back() += view.byteLength;
  }
  EXPECT_EQ(vertex_bytes[0], vertex_bytes[1]);
}

}  // namespace
}  // namespace carom::export_tests
