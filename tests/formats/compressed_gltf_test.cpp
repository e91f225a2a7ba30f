// SPDX-License-Identifier: MIT
// Meshes compressed by Draco and meshoptimizer: a box of 0.4 x 0.6 x 0.2 m (z up), as the encoders of these libraries wrote it.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "examples/support/project_file.h"
#include "formats/mesh/draco_mesh.hpp"
#include "formats/mesh/gltf_reader.hpp"
#include "formats/mesh/meshopt_views.hpp"
#include "tests/formats/gltf_json.h"
#include "tests/formats/scene_documents.h"

namespace carom {

using namespace formats_detail;

namespace {

using Json = nlohmann::json;

constexpr const char* kDracoFiles[] = {"draco.gltf", "draco-sequential.gltf", "draco-normals.gltf"};
constexpr const char* kMeshoptFiles[] = {"meshopt.gltf", "meshopt-sequence.gltf"};
const Vec3 kHalf(0.2f, 0.3f, 0.1f);
const std::string kDracoPlace = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
const std::string kMeshoptPlace = "/bufferViews/0/extensions/EXT_meshopt_compression";

Json file(const std::string& name) { return Json::parse(formats_test::textOf(projectFile("fuzz/corpus/gltf/" + name))); }

TriangleSoup soupOf(const Json& document) { return parseGltfMesh(document.dump(), "/nonexistent"); }

/// Six times the volume of the tetrahedra under the triangles, over six.
double volumeOf(const TriangleSoup& soup) {
  double six = 0;
  for (const auto& t : soup.triangles) {
    const auto at = [&](int k) { return soup.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6;
}

void expectBox(const TriangleSoup& soup, double tolerance) {
  EXPECT_EQ(soup.triangles.size(), 12u);
  for (const Vec3& v : soup.vertices)
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::abs(std::abs(v[k]) - kHalf[k]) <= tolerance) << v.transpose();
  EXPECT_TRUE(std::abs(volumeOf(soup) - 8 * kHalf.prod()) <= tolerance) << "outwards, and closed";
}

void expectRefused(const Json& document, const std::string& where, const std::string& fragment) {
  SCOPED_TRACE(fragment);
  try {
    soupOf(document);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), where) << error.what();
    EXPECT_NE(std::string(error.what()).find(fragment), std::string::npos) << error.what();
  }
}

/// As it is broken; without the library as whatever it compresses.
void expectDracoRefused(const Json& document, const std::string& where, const std::string& fragment) {
  if (readsDraco()) return expectRefused(document, where, fragment);
  expectRefused(document, kDracoPlace, "built without Draco");
}
void expectMeshoptRefused(const Json& document, const std::string& where, const std::string& fragment) {
  if (readsMeshopt()) return expectRefused(document, where, fragment);
  expectRefused(document, kMeshoptPlace, "built without meshoptimizer");
}

TEST(CompressedGltf, DracoIsRead) {
  for (const char* name : kDracoFiles) {
    SCOPED_TRACE(name);
    if (readsDraco()) {
      expectBox(soupOf(file(name)), std::string(name) == "draco-normals.gltf" ? 4e-5 : 1e-15);  // 14 bits, or floats
    } else {
      expectDracoRefused(file(name), "", "");
    }
  }
}

TEST(CompressedGltf, MeshoptIsRead) {
  for (const char* name : kMeshoptFiles) {
    SCOPED_TRACE(name);
    if (readsMeshopt()) {
      expectBox(soupOf(file(name)), std::string(name) == "meshopt-sequence.gltf" ? 2e-5 : 1e-15);  // 15 bits, or floats
    } else {
      expectMeshoptRefused(file(name), "", "");
    }
  }
}

std::string bytesOfBuffer(const Json& document) {
  const std::string uri = document["buffers"][0]["uri"];
  return formats_test::fromBase64(uri.substr(uri.find(',') + 1));
}

Json withBytes(Json document, const std::string& bytes) {
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + formats_test::base64(bytes);
  document["buffers"][0]["byteLength"] = bytes.size();
  return document;
}

TEST(CompressedGltf, BrokenDracoIsNamed) {
  Json good = file("draco.gltf");
  const auto broken = [&](const std::function<void(Json&)>& change) {
    Json document = good;
    change(document);
    return document;
  };
  const auto bytes = [&](const std::function<void(std::string&)>& change) {
    std::string changed = bytesOfBuffer(good);
    change(changed);
    return withBytes(good, changed);
  };
  expectDracoRefused(bytes([](std::string& b) { b[0] = 'd'; }), kDracoPlace, "do not begin with \"DRACO\"");
  expectDracoRefused(bytes([](std::string& b) { b[6] = 1; }), kDracoPlace, "found version 2.1 of the bitstream, expected 2.2");
  expectDracoRefused(bytes([](std::string& b) { b[7] = 0; }), kDracoPlace, "a cloud of points");
  expectDracoRefused(bytes([](std::string& b) { b.replace(12, 2, "\xff\x7f"); }), kDracoPlace, "vertices");
  expectDracoRefused(broken([](Json& j) { j["bufferViews"][0]["byteLength"] = 9; }), kDracoPlace, "ends within its header");
  expectDracoRefused(broken([](Json& j) { j["bufferViews"][0]["byteLength"] = 60; }), kDracoPlace, "Draco does not decode");
  expectDracoRefused(broken([](Json& j) { j["accessors"][1]["count"] = 33; }), kDracoPlace, "found 12 triangles, expected the 33 corners");
  expectDracoRefused(broken([](Json& j) { j["accessors"][0]["count"] = 9; }), kDracoPlace, "found 8 vertices, expected 9");
  Json& extension = good["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  const Json whole = extension;
  extension["attributes"]["POSITION"] = 7;
  expectDracoRefused(good, kDracoPlace + "/attributes/POSITION", "the id of an attribute");
  extension["attributes"].erase("POSITION");
  expectRefused(good, kDracoPlace + "/attributes", "POSITION");
  extension = whole;
  extension["bufferView"] = 4;
  expectRefused(good, kDracoPlace + "/bufferView", "index into bufferViews");
}

TEST(CompressedGltf, BrokenMeshoptIsNamed) {
  const auto broken = [&](int view, const std::function<void(Json&)>& change, const std::string& place, const std::string& fragment) {
    Json document = file("meshopt.gltf");
    const std::string where = "/bufferViews/" + std::to_string(view);
    change(document["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"]);
    expectMeshoptRefused(document, where + (place == "view" ? "/byteLength" : "/extensions/EXT_meshopt_compression" + place), fragment);
  };
  broken(0, [](Json& e) { e["mode"] = "POINTS"; }, "/mode", "ATTRIBUTES, TRIANGLES or INDICES");
  broken(0, [](Json& e) { e["mode"] = 3; }, "/mode", "ATTRIBUTES, TRIANGLES or INDICES");
  broken(0, [](Json& e) { e["filter"] = "SHARPEN"; }, "/filter", "OCTAHEDRAL");
  broken(0, [](Json& e) { e["filter"] = "QUATERNION"; }, "/filter", "with a stride of 12");
  broken(0, [](Json& e) { e["byteStride"] = 10; }, "/byteStride", "a multiple of 4");
  broken(0, [](Json& e) { e["byteStride"] = 260; }, "/byteStride", "from 1 to 256");
  broken(0, [](Json& e) { e["count"] = 9; }, "view", "found 96, expected 108");
  broken(0, [](Json& e) { e["byteLength"] = 2000; }, "/byteLength", "data within buffer 0");
  broken(0, [](Json& e) { e["byteLength"] = 20; }, "", "meshoptimizer does not decode");
  broken(0, [](Json& e) { e["buffer"] = 2; }, "/buffer", "index into buffers");
  broken(0, [](Json& e) { e["buffer"] = 1; }, "/byteLength", "data within buffer 1 of 0 bytes");
  broken(1, [](Json& e) { e["byteStride"] = 3; }, "/byteStride", "2 or 4");
  broken(1, [](Json& e) { e["count"] = 35; }, "/count", "three a triangle");
  broken(1, [](Json& e) { e["filter"] = "EXPONENTIAL"; }, "/filter", "indices have no filter");
  Json bare = file("meshopt.gltf");
  bare["bufferViews"][1].erase("extensions");
  expectMeshoptRefused(bare, "/bufferViews/1/buffer", "a fallback of EXT_meshopt_compression without data");
}

// Whatever bytes change, there is a mesh whose corners exist, or an error with a place.
TEST(CompressedGltf, AnyBytesGiveAMeshOrAPlace) {
  int read = 0, refused = 0;
  for (const auto& names : {std::vector<std::string>(std::begin(kDracoFiles), std::end(kDracoFiles)),
                            std::vector<std::string>(std::begin(kMeshoptFiles), std::end(kMeshoptFiles))})
    for (const std::string& name : names) {
      const Json good = file(name);
      const std::string bytes = bytesOfBuffer(good);
      for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(name + ", seed " + std::to_string(seed));
        std::mt19937 random(seed);
        std::string changed = bytes;
        const unsigned changes = 1 + random() % 4;
        for (unsigned k = 0; k < changes; ++k) {
          const std::size_t at = random() % changed.size();
          changed[at] = static_cast<char>(random());
        }
        try {
          const TriangleSoup soup = soupOf(withBytes(good, changed));
          ++read;
          for (const auto& triangle : soup.triangles)
            for (const int corner : triangle) ASSERT_LT(static_cast<std::size_t>(corner), soup.vertices.size());
          for (const Vec3& v : soup.vertices) ASSERT_TRUE(v.allFinite());
        } catch (const InputError& error) {
          ++refused;
          EXPECT_EQ(error.where().rfind("/", 0), 0u) << error.what();
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
      }
    }
  if (readsDraco() && readsMeshopt()) EXPECT_TRUE(read >= 100 && refused >= 100) << read << " read, " << refused << " refused";
}

}  // namespace
}  // namespace carom
