// SPDX-License-Identifier: MIT
// Scene documents whose shapes come from mesh files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "formats/documents/scene_json.h"
#include "formats/mesh/mesh_file.h"
#include "tests/formats/mesh_texts.h"
#include "tests/formats/same_documents.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

class ShapeFiles : public testing::Test {
 protected:
  ShapeFiles() : folder_(fs::temp_directory_path() / ("carom-shapes-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(folder_ / "meshes");
    write("meshes/cube.obj", formats_test::cubeObj());
    write("meshes/open.obj", formats_test::openCubeObj());
    write("meshes/points.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv .1 .1 .1\n");
    write("meshes/four.gltf", formats_test::tetrahedronGltf(true));
    write("meshes/four.glb", formats_test::glb(formats_test::tetrahedronGltf(false), formats_test::tetrahedronBytes()));
  }
  ~ShapeFiles() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary | std::ios::trunc) << text;
  }

  /// A document of moving bodies 0, 1, ... with these shapes.
  static std::string documentOf(const std::vector<std::string>& shapes) {
    std::string bodies;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      bodies += (i == 0 ? "" : ",") + std::string(R"({ "name": "body )") + std::to_string(i) +
                R"(", "density": 500, "shape": { )" + shapes[i] + R"( }, "position": [)" + std::to_string(10 * i) +
                ", 0, 0] }";
    return R"({ "carom": 1, "bodies": [)" + bodies + "] }";
  }
  Document documentWith(const std::vector<std::string>& shapes) const {
    write("scene.json", documentOf(shapes));
    return readDocument(path("scene.json"));
  }

  void expectRefused(const std::string& shape, const std::string& where,
                     const std::vector<std::string>& fragments) const {
    SCOPED_TRACE(shape);
    try {
      documentWith({shape});
      ADD_FAILURE() << "was read";
    } catch (const FormatError& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.file(), path("scene.json"));
      EXPECT_EQ(error.where(), "/bodies/0/shape" + where) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      for (const std::string& fragment : fragments)
        EXPECT_NE(what.find(fragment), std::string::npos) << what << "\nwithout: " << fragment;
    }
  }

  fs::path folder_;
};

const Mesh& meshOf(const Document& d, std::size_t body) { return std::get<Mesh>(d.scene.bodies.at(body).shape); }
const Hull& hullOf(const Document& d, std::size_t body) { return std::get<Hull>(d.scene.bodies.at(body).shape); }

TEST_F(ShapeFiles, meshesAndHullsOfEveryFormat) {
  const Document d = documentWith(
      {R"("mesh": { "file": "meshes/cube.obj", "scale": 0.1 })", R"("mesh": { "file": "meshes/four.gltf" })",
       R"("mesh": { "file": "meshes/four.glb" })", R"("hull": { "file": "meshes/cube.obj" })",
       R"("hull": { "file": "meshes/points.obj", "scale": 3 })", R"("hull": { "file": "meshes/four.glb" })",
       R"("hull": { "file": "meshes/open.obj" })"});
  EXPECT_NEAR(meshOf(d, 0).surface->volume, 1, 1e-15);
  EXPECT_EQ(meshOf(d, 0).scale, 0.1);
  EXPECT_EQ(meshOf(d, 0).file, "meshes/cube.obj");
  EXPECT_NEAR(meshOf(d, 1).surface->volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(meshOf(d, 2).surface->volume, 1.0 / 6, 1e-15);
  EXPECT_EQ(hullOf(d, 3).surface->faces.size(), 6u);
  EXPECT_EQ(hullOf(d, 4).surface->vertices.size(), 4u);
  EXPECT_NEAR(hullOf(d, 5).surface->volume, 1.0 / 6, 1e-15);
  EXPECT_TRUE(hullOf(d, 6).surface->closed);
  formats_test::expectRoundTrip(d, "shapes");
}

TEST_F(ShapeFiles, oneFileIsReadOnce) {
  const Document d = documentWith({R"("mesh": { "file": "meshes/cube.obj" })",
                                   R"("mesh": { "file": "meshes/../meshes/cube.obj", "scale": 2 })",
                                   R"("hull": { "file": "meshes/cube.obj" })",
                                   R"("compound": [ { "mesh": { "file": ")" + path("meshes/cube.obj") +
                                       R"(" } }, { "hull": { "file": "./meshes/cube.obj" } } ])"});
  const auto& parts = std::get<Compound>(d.scene.bodies[3].shape).parts;
  EXPECT_EQ(meshOf(d, 0).surface, meshOf(d, 1).surface);
  EXPECT_EQ(meshOf(d, 0).surface, std::get<Mesh>(parts[0].shape).surface);
  EXPECT_EQ(hullOf(d, 2).surface, std::get<Hull>(parts[1].shape).surface);
  formats_test::expectRoundTrip(d, "shared");
}

TEST_F(ShapeFiles, anOpenMeshNeedsMassAndInertia) {
  expectRefused(R"("mesh": { "file": "meshes/open.obj" })", "/mesh", {"an open mesh"});
  write("fixed.json", R"({ "carom": 1, "bodies": [ { "name": "bowl", "fixed": true,
      "shape": { "mesh": { "file": "meshes/open.obj" } } }, { "name": "shell", "mass": 1, "inertia": [1, 1, 1],
      "center_of_mass": [0, 0, -0.2], "position": [9, 0, 0], "shape": { "mesh": { "file": "meshes/open.obj" } } } ] })");
  const Document d = readDocument(path("fixed.json"));
  EXPECT_FALSE(meshOf(d, 0).surface->closed);
  formats_test::expectRoundTrip(d, "open");
}

TEST_F(ShapeFiles, aFlatSheetIsToldWhatStandsForIt) {
  write("meshes/sheet.obj", "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n");
  expectRefused(R"("mesh": { "file": "meshes/sheet.obj" })", "/mesh",
                {"a flat sheet on a moving body", "a \"box\" as thick as the sheet"});
  expectRefused(R"("hull": { "file": "meshes/sheet.obj" })", "/hull/file",
                {"in one plane", "a \"box\" as thick as it is"});
}

TEST_F(ShapeFiles, badFilesAreNamedWithTheirPlace) {
  write("meshes/letters.obj", "v 0 0 0\nv 1 0 zero\n");
  write("meshes/flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write("meshes/line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n");
  write("meshes/empty.obj", "");
  write("meshes/picture.png", "PNG");
  write("meshes/broken.glb", "glTF");
  write("meshes/broken.gltf",
        formats_test::replaced(formats_test::tetrahedronGltf(true), "\"mesh\": 0", "\"mesh\": 4"));
  const auto mesh = [](const std::string& name) { return R"("mesh": { "file": "meshes/)" + name + "\" }"; };
  expectRefused(mesh("none.obj"), "/mesh/file", {path("meshes/none.obj") + ": found no such file", "OBJ file"});
  expectRefused(R"("mesh": { "file": "meshes" })", "/mesh/file", {"no regular file"});
  expectRefused(R"("mesh": { "file": "/dev/zero" })", "/mesh/file", {"/dev/zero: found no regular file"});
  expectRefused(R"("mesh": { "file": "a\u0000.obj" })", "/mesh/file", {"a zero byte"});
  expectRefused(R"("mesh": { "file": "a\nb.obj" })", "/mesh/file", {"a control character"});
  expectRefused(mesh("picture.png"), "/mesh/file", {"ends in \".png\"", ".obj, .gltf or .glb"});
  expectRefused(mesh("letters.obj"), "/mesh/file", {"letters.obj: line 2: found \"zero\", expected a number"});
  expectRefused(mesh("flat.obj"), "/mesh/file", {"flat.obj: triangle 0 (line 4): found"});
  expectRefused(mesh("empty.obj"), "/mesh/file", {"empty.obj: found a mesh of 0 vertices"});
  expectRefused(mesh("broken.glb"), "/mesh/file", {"broken.glb: found a binary file of 4 bytes"});
  expectRefused(mesh("broken.gltf"), "/mesh/file", {"broken.gltf: /nodes/0/mesh: found 4"});
  expectRefused(R"("hull": { "file": "meshes/line.obj" })", "/hull/file", {"line.obj: "});
  expectRefused(R"("compound": [ { "sphere": { "radius": 1 } }, { "mesh": { "file": "no.obj" } } ])",
                "/compound/1/mesh/file", {"no such file"});
}

TEST_F(ShapeFiles, repairsAreKept) {
  write("meshes/turned.obj", formats_test::replaced(formats_test::cubeObj(), "f 5 6 7 8", "f 8 7 6 5"));
  const Document d = documentWith({R"("mesh": { "file": "meshes/turned.obj" })", R"("mesh": { "file": "meshes/turned.obj", "scale": 2 })"});
  ASSERT_EQ(d.repairs.size(), 1u) << "a file is read once";
  EXPECT_EQ(d.repairs[0].file, path("meshes/turned.obj"));
  EXPECT_NE(d.repairs[0].what.find("2 triangles turned over"), std::string::npos) << d.repairs[0].what;
  formats_test::expectRoundTrip(d, "turned");
}

TEST_F(ShapeFiles, aLargeFileIsRefusedUnread) {
  write("meshes/large.obj", "v 0 0 0\n");
  fs::resize_file(path("meshes/large.obj"), kLargestMeshFile + 1);
  expectRefused(R"("mesh": { "file": "meshes/large.obj" })", "/mesh/file",
                {"a file of 200000001 bytes", "at most 200000000"});
}

TEST_F(ShapeFiles, aTextWithoutFolderNamesNoFiles) {
  const std::string text = documentOf({R"("mesh": { "file": "meshes/cube.obj" })"});
  EXPECT_THROW(parseDocument(text, "text"), FormatError);
  EXPECT_EQ(parseDocument(text, "text", folder_.string()).folder, folder_.string());
}

TEST_F(ShapeFiles, namesFollowTheDocumentToAnotherFolder) {
  Document d = documentWith({R"("mesh": { "file": "meshes/cube.obj" })",
                             R"("compound": [ { "hull": { "file": "meshes/points.obj" } } ])",
                             R"("mesh": { "file": ")" + path("meshes/four.glb") + "\" }"});
  fs::create_directories(folder_ / "out" / "deep");
  for (const std::string name : {"saved.json", "out/saved.json", "out/deep/saved.json", "meshes/saved.json"}) {
    SCOPED_TRACE(name);
    saveDocument(path(name), d);
    const Document again = readDocument(path(name));
    EXPECT_EQ(meshOf(again, 0).surface->vertices, meshOf(d, 0).surface->vertices);
    EXPECT_EQ(meshOf(again, 2).file, path("meshes/four.glb"));
    saveDocument(path("back.json"), again);  // and back again
    EXPECT_EQ(formats_test::textOf(path("back.json")), formats_test::textOf(path("saved.json")));
  }
  EXPECT_EQ(meshOf(readDocument(path("saved.json")), 0).file, "meshes/cube.obj");
  EXPECT_EQ(meshOf(readDocument(path("out/deep/saved.json")), 0).file, "../../meshes/cube.obj");
  EXPECT_EQ(meshOf(readDocument(path("meshes/saved.json")), 0).file, "cube.obj");
}

TEST_F(ShapeFiles, aTextForAnotherFolderIsWhatIsSavedThere) {
  const Document d = documentWith({R"("mesh": { "file": "meshes/cube.obj" })"});
  fs::create_directories(folder_ / "out");
  saveDocument(path("out/saved.json"), d);
  EXPECT_EQ(writeDocumentIn(path("out"), d), formats_test::textOf(path("out/saved.json")));
  Document impossible = d;
  impossible.scene.bodies[0].mass = -1;
  EXPECT_THROW(writeDocumentIn(path("out"), impossible), InputError);
}

TEST_F(ShapeFiles, namesFollowThroughALinkedFolder) {
  const Document d = documentWith({R"("mesh": { "file": "meshes/cube.obj" })"});
  fs::create_directories(folder_ / "far" / "away");
  fs::create_directory_symlink(folder_ / "far" / "away", folder_ / "link");
  saveDocument(path("link/saved.json"), d);
  EXPECT_EQ(meshOf(readDocument(path("far/away/saved.json")), 0).file, "../../meshes/cube.obj");
}

TEST_F(ShapeFiles, aMissingFileIsNotSaved) {
  Document d = documentWith({R"("mesh": { "file": "meshes/cube.obj" })"});
  fs::remove(path("meshes/cube.obj"));
  EXPECT_THROW(saveDocument(path("new.json"), d), FormatError);
  EXPECT_FALSE(fs::exists(path("new.json")));
}

TEST_F(ShapeFiles, aMeshMadeInMemoryIsRefused) {
  Document d = documentWith({R"("compound": [ { "mesh": { "file": "meshes/cube.obj" } } ])"});
  std::get<Mesh>(std::get<Compound>(d.scene.bodies[0].shape).parts[0].shape).file.clear();
  try {
    writeDocument(d);
    FAIL() << "was written";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "/bodies/0/shape/compound/0/mesh");
    EXPECT_NE(std::string(error.what()).find("made in memory"), std::string::npos) << error.what();
  }
}

TEST_F(ShapeFiles, aHullWithoutAFileIsWrittenAsItsPoints) {
  Document d = documentWith({R"("hull": { "file": "meshes/cube.obj", "scale": 0.5 })"});
  auto& hull = std::get<Hull>(d.scene.bodies[0].shape);
  hull.file.clear();
  const Document again = parseDocument(writeDocument(d), "points");
  EXPECT_EQ(hullOf(again, 0).surface->vertices, hull.surface->vertices);
  EXPECT_EQ(hullOf(again, 0).scale, 0.5);
  formats_test::expectRoundTrip(d, "points");
}

}  // namespace
}  // namespace carom
