// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "formats/mesh/gltf_reader.hpp"
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

struct BrokenMesh {
  const char* name;
  std::function<void(Json&)> break_it;
  std::string where;
  std::vector<std::string> fragments;
};

void expectRefused(const std::string& bytes, const std::string& where, const std::vector<std::string>& fragments) {
  try {
    parseGltfMesh(bytes, "/nonexistent");
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.where(), where) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 500u) << what;
    for (const std::string& fragment : fragments)
      EXPECT_NE(what.find(fragment), std::string::npos) << what << "\nwithout: " << fragment;
  }
}

Json& primitive(Json& json) { return json["meshes"][0]["primitives"][0]; }

TEST(BrokenGltf, brokenDocuments) {
  const BrokenMesh all[] = {
      {"version", [](Json& j) { j["asset"]["version"] = "1.0"; }, "/asset/version", {"\"1.0\"", "\"2.0\""}},
      {"noAsset", [](Json& j) { j.erase("asset"); }, "", {"no member \"asset\""}},
      {"sceneIndex", [](Json& j) { j["scene"] = 1; }, "/scene", {"found 1", "index into scenes", "there are 1"}},
      {"noScene", [](Json& j) { j.erase("scene"), j.erase("scenes"); }, "/scenes", {"none", "a scene with meshes"}},
      {"rootIndex", [](Json& j) { j["scenes"][0]["nodes"][0] = -1; }, "/scenes/0/nodes/0", {"found -1"}},
      {"rootTwice",
       [](Json& j) {
         j["scenes"][0]["nodes"] = {0, 0};
       },
       "/scenes/0/nodes",
       {"second time"}},
      {"meshIndex", [](Json& j) { j["nodes"][0]["mesh"] = 4294967296; }, "/nodes/0/mesh", {"index into meshes"}},
      {"meshText", [](Json& j) { j["nodes"][0]["mesh"] = "0"; }, "/nodes/0/mesh", {"found \"0\""}},
      {"ownChild", [](Json& j) { j["nodes"][0]["children"] = {0}; }, "/nodes/0", {"below itself"}},
      {"twoParents",
       [](Json& j) {
         j["nodes"].push_back({{"children", {2}}});
         j["nodes"].push_back(Json::object());
         j["nodes"][0]["children"] = {2};
       },
       "/nodes/1/children",
       {"child of node 0 already"}},
      {"rootWithParent",
       [](Json& j) {
         j["nodes"].push_back({{"children", {0}}});
       },
       "/scenes/0/nodes",
       {"a child of node 1"}},
      {"shortMatrix",
       [](Json& j) {
         j["nodes"][0]["matrix"] = {1, 2};
       },
       "/nodes/0/matrix",
       {"16 numbers"}},
      {"projection",
       [](Json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
       "/nodes/0/matrix",
       {"affine"}},
      {"flat",
       [](Json& j) {
         j["nodes"][0]["scale"] = {1, 0, 1};
       },
       "/nodes/0",
       {"a scale that is not 0"}},
      {"infinite",
       [](Json& j) {
         j["nodes"][0]["scale"] = {1e200, 1e200, 1e200};
       },
       "/nodes/0",
       {"flattens"}},
      {"longQuaternion",
       [](Json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 1, 1};
       },
       "/nodes/0/rotation",
       {"a unit quaternion"}},
      {"noPrimitives", [](Json& j) { j["meshes"][0].erase("primitives"); }, "/meshes/0", {"\"primitives\""}},
      {"noPosition",
       [](Json& j) {
         primitive(j)["attributes"] = {{"NORMAL", 0}};
       },
       "/meshes/0/primitives/0/attributes",
       {"no \"POSITION\""}},
      {"noAttributes", [](Json& j) { primitive(j).erase("attributes"); }, "/meshes/0/primitives/0", {"\"attributes\""}},
      {"accessorIndex",
       [](Json& j) { primitive(j)["attributes"]["POSITION"] = 2; },
       "/meshes/0/primitives/0/attributes/POSITION",
       {"found 2", "index into accessors, of which there are 2"}},
      {"indicesIndex", [](Json& j) { primitive(j)["indices"] = 17; }, "/meshes/0/primitives/0/indices", {"found 17"}},
      {"lines",
       [](Json& j) { primitive(j)["mode"] = 1; },
       "/meshes/0/primitives/0/mode",
       {"found lines", "triangles, a triangle strip or a triangle fan"}},
      {"points", [](Json& j) { primitive(j)["mode"] = 0; }, "/meshes/0/primitives/0/mode", {"found points"}},
      {"mode", [](Json& j) { primitive(j)["mode"] = 7; }, "/meshes/0/primitives/0/mode", {"found 7"}},
      {"notThree",
       [](Json& j) { j["accessors"][1]["count"] = 11; },
       "/meshes/0/primitives/0",
       {"triangles of 11 corners"}},
      {"shortPositions",
       [](Json& j) { j["accessors"][0]["count"] = 3; },
       "/meshes/0/primitives/0/indices",
       {"vertex 3 at place 5", "below 3"}},
      {"longPositions",
       [](Json& j) { j["accessors"][0]["count"] = 5; },
       "/accessors/0",
       {"5 elements of 12 bytes from byte 0", "within view 0 of 48 bytes"}},
      {"hugeCount", [](Json& j) { j["accessors"][0]["count"] = 2147483647; }, "/accessors/0", {"within view 0"}},
      {"wrappedCount",
       [](Json& j) { j["accessors"][0]["count"] = 18446744073709551615u; },
       "/accessors/0/count",
       {"an integer from 1"}},
      {"zeroCount", [](Json& j) { j["accessors"][0]["count"] = 0; }, "/accessors/0/count", {"found 0"}},
      {"accessorOffset", [](Json& j) { j["accessors"][0]["byteOffset"] = 4; }, "/accessors/0", {"from byte 4 on"}},
      {"negativeOffset",
       [](Json& j) { j["accessors"][0]["byteOffset"] = -4; },
       "/accessors/0/byteOffset",
       {"found -4"}},
      {"shortPositionsType",
       [](Json& j) { j["accessors"][0]["componentType"] = 5122; },
       "/meshes/0/primitives/0/attributes/POSITION",
       {"component type 5122", "3 floats"}},
      {"doubles",
       [](Json& j) { j["accessors"][0]["componentType"] = 5130; },
       "/accessors/0/componentType",
       {"found 5130"}},
      {"vec2",
       [](Json& j) { j["accessors"][0]["type"] = "VEC2"; },
       "/meshes/0/primitives/0/attributes/POSITION",
       {"3 floats"}},
      {"type", [](Json& j) { j["accessors"][0]["type"] = "VEC5"; }, "/accessors/0/type", {"found \"VEC5\""}},
      {"signedIndices",
       [](Json& j) { j["accessors"][1]["componentType"] = 5122; },
       "/meshes/0/primitives/0/indices",
       {"unsigned scalars"}},
      {"indicesWithoutView",
       [](Json& j) { j["accessors"][1].erase("bufferView"); },
       "/meshes/0/primitives/0/indices",
       {"an accessor without a view"}},
      {"viewIndex", [](Json& j) { j["accessors"][0]["bufferView"] = 2; }, "/accessors/0/bufferView", {"found 2"}},
      {"viewLength",
       [](Json& j) { j["bufferViews"][1]["byteLength"] = 25; },
       "/bufferViews/1/byteLength",
       {"found 25 from byte 48 on", "buffer of 72 bytes"}},
      {"viewOffset",
       [](Json& j) { j["bufferViews"][1]["byteOffset"] = 18446744073709551600u; },
       "/bufferViews/1/byteOffset",
       {"an integer from 0"}},
      {"viewBuffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; }, "/bufferViews/0/buffer", {"found 1"}},
      {"stride", [](Json& j) { j["bufferViews"][0]["byteStride"] = 8; }, "/accessors/0", {"view of stride 8"}},
      {"oddStride",
       [](Json& j) { j["bufferViews"][0]["byteStride"] = 13; },
       "/bufferViews/0/byteStride",
       {"a multiple of 4"}},
      {"bufferLength",
       [](Json& j) { j["buffers"][0]["byteLength"] = 73; },
       "/buffers/0/byteLength",
       {"found 73", "the 72 bytes of data that there are"}},
      {"hugeBuffer",
       [](Json& j) { j["buffers"][0]["byteLength"] = 3000000000u; },
       "/buffers/0/byteLength",
       {"found 3000000000"}},
      {"manyBuffers",
       [](Json& j) {
         for (int i = 0; i < 3; ++i) j["buffers"].push_back({{"byteLength", 100000000}});
       },
       "/buffers/2",
       {"buffers of 200000072 bytes"}},
      {"noUri", [](Json& j) { j["buffers"][0].erase("uri"); }, "/buffers/0", {"without \"uri\""}},
      {"notBase64", [](Json& j) { j["buffers"][0]["uri"] = "data:;base64,AAA*"; }, "/buffers/0/uri", {"not base64"}},
      {"plainData", [](Json& j) { j["buffers"][0]["uri"] = "data:,hello"; }, "/buffers/0/uri", {"data in base64"}},
      {"missingFile",
       [](Json& j) { j["buffers"][0]["uri"] = "my%20mug.bin"; },
       "/buffers/0/uri",
       {"/nonexistent/my mug.bin: found no such file"}},
      {"fileOfTwoLines",
       [](Json& j) { j["buffers"][0]["uri"] = "my%0Amug.bin"; },
       "/buffers/0/uri",
       {"my%0Amug.bin", "the name of a file"}},
      {"network",
       [](Json& j) { j["buffers"][0]["uri"] = "https://example.org/a.bin"; },
       "/buffers/0/uri",
       {"the name of a file"}},
      {"device", [](Json& j) { j["buffers"][0]["uri"] = "/dev/zero"; }, "/buffers/0/uri", {"a file outside of the document's folder"}},
      {"nan",
       [](Json& j) { setBuffer(j, std::string("\xff\xff\xff\x7f", 4) + formats_test::tetrahedronBytes().substr(4)); },
       "/meshes/0/primitives/0/attributes/POSITION",
       {"not finite in element 0"}},
      {"morphed",
       [](Json& j) {
         j["meshes"][0]["weights"] = {0, 0.5};
       },
       "/meshes/0/weights",
       {"a morphed mesh"}},
      {"skinned", [](Json& j) { j["nodes"][0]["skin"] = 0; }, "/nodes/0/skin", {"bends the mesh"}},
      {"sparseOrder",
       [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5123}, {"byteOffset", 2}}},
                                        {"values", {{"bufferView", 0}}}};
       },
       "/meshes/0/primitives/0/attributes/POSITION/sparse/indices",
       {"found element 1", "increasing ones below 4"}},
      {"sparseRange",
       [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 3},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5125}, {"byteOffset", 16}}},
                                        {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/indices",
       {"within view 1 of 24 bytes"}},
      {"sparseCount",
       [](Json& j) {
         j["accessors"][0]["sparse"] = {
             {"count", 5}, {"indices", {{"bufferView", 1}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
       },
       "/accessors/0/sparse/count",
       {"found 5"}},
      {"nodesObject",
       [](Json& j) {
         j["nodes"] = {{"mesh", 0}};
       },
       "/nodes",
       {"an array"}},
      {"nodeNumber", [](Json& j) { j["nodes"][0] = 3; }, "/nodes/0", {"found 3", "an object"}},
  };
  for (const BrokenMesh& broken : all) {
    SCOPED_TRACE(broken.name);
    Json json = tetrahedronDocument();
    broken.break_it(json);
    expectRefused(json.dump(), broken.where, broken.fragments);
  }
}

TEST(BrokenGltf, brokenTexts) {
  const std::string nested(100000, '[');
  expectRefused("", "line 1, column 1", {"the end of the text"});
  expectRefused("v 0 0 0", "line 1, column 1", {"valid JSON"});
  expectRefused("[1]", "", {"found [1]", "an object"});
  std::string place =
      "/extras";  // the document is a level itself, and the arrays before the last have their first item
  for (int level = 2; level < 49; ++level) place += "/0";
  expectRefused(R"({"asset": {"version": "2.0"}, "extras": )" + nested, place, {"more than 48 levels"});
  const std::string whole = tetrahedronGltf(true);
  const std::size_t cut = whole.find("\"count\": 4") + 3;
  expectRefused(whole.substr(0, cut), "line 8, column " + std::to_string(cut - whole.rfind('\n', cut)),
                {"the end of the text"});
}

TEST(BrokenGltf, brokenContainers) {
  const std::string good = formats_test::glb(tetrahedronGltf(false), formats_test::tetrahedronBytes());
  const auto with = [&](std::size_t at, std::uint32_t word) {
    std::string bytes = good;
    return bytes.replace(at, 4, bytesOf(std::vector{word}));
  };
  const auto json_size = static_cast<std::uint32_t>(good.size() - 28 - 72);
  expectRefused(good.substr(0, 19), "", {"a binary file of 19 bytes"});
  expectRefused(with(4, 1), "", {"version 1 of the container"});
  expectRefused(with(8, 0xffffffffu), "", {"the end of the file after"});
  expectRefused(with(8, 12), "", {"no chunk"});
  expectRefused(with(12, 0xfffffff0u), "", {"a chunk at byte 12 that goes beyond the end"});
  expectRefused(with(16, 0), "", {"another first chunk"});
  expectRefused(with(20 + json_size, 73), "", {"goes beyond the end"});  // tinygltf lets 8 bytes more pass
  expectRefused(with(20 + json_size, 72 + 8), "", {"goes beyond the end"});
  expectRefused(with(24 + json_size, 0x4E4F534A), "", {"a second chunk of JSON"});
  expectRefused(with(24 + json_size, 7), "/buffers/0", {"without \"uri\""});
  for (std::size_t length = 0; length < good.size(); length += 3)
    EXPECT_THROW(parseGltfMesh(good.substr(0, length), ""), InputError);
}

TEST(BrokenGltf, manyVerticesOfNothing) {
  Json json = tetrahedronDocument();
  json["accessors"][0].erase("bufferView");
  json["accessors"][0]["count"] = 2000000000;
  primitive(json).erase("indices");
  expectRefused(json.dump(), "/meshes/0/primitives/0", {"2000000000 corners", "at most 15000000"});
  json["accessors"][0]["count"] = 9000000;
  expectRefused(json.dump(), "/meshes/0/primitives/0", {"at most 5000000 triangles and 5000000 vertices"});
}

}  // namespace
}  // namespace carom
