// SPDX-License-Identifier: MIT
#include "formats/mesh/gltf_reader.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "adjoint/scene/surface.h"
#include "tests/formats/gltf_json.h"

namespace carom {

using namespace formats_detail;

namespace {

using Json = nlohmann::json;
using formats_test::base64;
using formats_test::bytesOf;
using formats_test::setBuffer;
using formats_test::tetrahedronDocument;
using formats_test::tetrahedronGltf;

using Triangles = std::vector<std::array<int, 3>>;

TriangleSoup read(const std::string& bytes) { return parseGltfMesh(bytes, "/nonexistent"); }

// glTF's y is our z, its z our -y.
const std::vector<Vec3> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
const Triangles kFaces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

TEST(GltfReader, tetrahedronInTextAndBinary) {
  for (const std::string& bytes :
       {tetrahedronGltf(true), formats_test::glb(tetrahedronGltf(false), formats_test::tetrahedronBytes()),
        formats_test::glb(tetrahedronGltf(true), "")}) {
    const TriangleSoup geometry = read(bytes);
    EXPECT_EQ(geometry.vertices, kTetrahedron);
    EXPECT_EQ(geometry.triangles, kFaces);
    EXPECT_NEAR(meshSurface(geometry.vertices, geometry.triangles)->volume, 1.0 / 6, 1e-15);
  }
}

TEST(GltfReader, indicesOfEverySize) {
  const std::string positions = bytesOf(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const std::vector<std::uint8_t> order{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const std::string bytes[] = {bytesOf(order), bytesOf(std::vector<std::uint16_t>(order.begin(), order.end())),
                               bytesOf(std::vector<std::uint32_t>(order.begin(), order.end()))};
  const int types[] = {5121, 5123, 5125};
  for (std::size_t k = 0; k < 3; ++k) {
    Json json = tetrahedronDocument();
    setBuffer(json, positions + bytes[k]);
    json["bufferViews"][1]["byteLength"] = bytes[k].size();
    json["accessors"][1]["componentType"] = types[k];
    EXPECT_EQ(read(json.dump()).triangles, kFaces) << types[k];
  }
}

TEST(GltfReader, withoutIndices) {
  Json json = tetrahedronDocument();
  json["meshes"][0]["primitives"][0].erase("indices");
  json["accessors"][0]["count"] = 3;
  const TriangleSoup geometry = read(json.dump());
  EXPECT_EQ(geometry.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(geometry.vertices.size(), 3u);
}

TEST(GltfReader, stripsAndFans) {
  Json json = tetrahedronDocument();
  json["meshes"][0]["primitives"][0]["mode"] = 5;
  json["accessors"][1]["count"] = 5;  // 0 2 1 0 1: the last two have a corner twice
  EXPECT_EQ(read(json.dump()).triangles, (Triangles{{0, 2, 1}, {2, 0, 1}}));
  json["meshes"][0]["primitives"][0]["mode"] = 6;
  json["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(read(json.dump()).triangles, (Triangles{{1, 2, 0}, {2, 3, 0}}));
}

TEST(GltfReader, stridedViewsWithOffsets) {
  std::vector<float> numbers{9, 9};
  for (const Vec3& v : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    numbers.insert(numbers.end(), {7, float(v.x()), float(v.y()), float(v.z()), 8});
  const std::string order = bytesOf(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  Json json = tetrahedronDocument();
  setBuffer(json, bytesOf(numbers) + order);
  json["bufferViews"][0] = {{"buffer", 0}, {"byteOffset", 8}, {"byteLength", 80}, {"byteStride", 20}};
  json["accessors"][0]["byteOffset"] = 4;
  json["bufferViews"][1]["byteOffset"] = 88;
  EXPECT_EQ(read(json.dump()).vertices, kTetrahedron);
}

TEST(GltfReader, sparseAccessors) {
  const std::string bytes = formats_test::tetrahedronBytes() + bytesOf(std::vector<std::uint16_t>{1, 3}) +
                            bytesOf(std::vector<float>{2, 0, 0, 0, 0, 5});
  Json json = tetrahedronDocument();
  setBuffer(json, bytes);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 4}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 76}, {"byteLength", 24}});
  json["accessors"][0]["sparse"] = {
      {"count", 2}, {"indices", {{"bufferView", 2}, {"componentType", 5123}}}, {"values", {{"bufferView", 3}}}};
  EXPECT_EQ(read(json.dump()).vertices, (std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, -5, 0}}));
  json["accessors"][0].erase("bufferView");  // all others are 0
  EXPECT_EQ(read(json.dump()).vertices, (std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, -5, 0}}));
}

TEST(GltfReader, nodesTransform) {
  Json json = tetrahedronDocument();
  json["nodes"] = Json::parse(R"([
    { "children": [1, 2], "translation": [10, 20, 30] },
    { "mesh": 0, "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757], "scale": [2, 1, 1] },
    { "mesh": 0, "matrix": [-1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  5, 0, 0, 1] } ])");
  const TriangleSoup geometry = read(json.dump());
  ASSERT_EQ(geometry.vertices.size(), 8u);
  // x axis times 2, turned to y, moved, then y up to z up.
  EXPECT_LE((geometry.vertices[1] - Vec3(10, -30, 22)).norm(), 1e-14);
  EXPECT_LE((geometry.vertices[2] - Vec3(9, -30, 20)).norm(), 1e-14);
  EXPECT_EQ(geometry.vertices[5], Vec3(14, -30, 20));
  // A mirror turns the triangles over, and so they stay outside.
  EXPECT_EQ(geometry.triangles[4], (std::array<int, 3>{5, 6, 4}));
  const auto surface = meshSurface(geometry.vertices, geometry.triangles);
  EXPECT_NEAR(surface->volume, 3.0 / 6, 1e-13);
}

TEST(GltfReader, onlyTheDefaultScene) {
  Json json = tetrahedronDocument();
  json["nodes"].push_back({{"mesh", 0}, {"translation", {1, 0, 0}}});
  json["scenes"].push_back({{"nodes", {1}}});
  EXPECT_EQ(read(json.dump()).vertices[0], Vec3(0, 0, 0));
  json["scene"] = 1;
  EXPECT_EQ(read(json.dump()).vertices[0], Vec3(1, 0, 0));
  json.erase("scene");
  EXPECT_EQ(read(json.dump()).vertices[0], Vec3(0, 0, 0));
}

TEST(GltfReader, verticesThatNoTriangleUsesAreLeftOut) {
  Json json = tetrahedronDocument();
  json["accessors"][1]["count"] = 3;
  const TriangleSoup geometry = read(json.dump());
  EXPECT_EQ(geometry.vertices.size(), 3u);
  EXPECT_EQ(geometry.triangles, (Triangles{{0, 2, 1}}));
}

TEST(GltfReader, whatIsNotGeometryDoesNotMatter) {
  Json json = tetrahedronDocument();
  json["images"] = {{{"uri", "missing.png"}}, {{"bufferView", 99}}, 7};
  json["textures"] = {{{"source", 99}}};
  json["materials"] = {{{"pbrMetallicRoughness", "none"}}};
  json["animations"] = {1, 2};
  json["cameras"] = {{{"type", "fisheye"}}};
  json["skins"] = {{}};
  json["extensions"] = {{"KHR_lights_punctual", {{"lights", {1}}}}, {"ACME_big", {{"id", 123456789012345}}}};
  json["extras"] = {{"time", 1700000000000}};
  json["meshes"][0]["primitives"][0]["material"] = 3;
  EXPECT_EQ(read(json.dump()).triangles, kFaces);
}

}  // namespace
}  // namespace carom
