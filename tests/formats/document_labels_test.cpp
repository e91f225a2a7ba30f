// SPDX-License-Identifier: MIT
// What a document says to people and to editors: $schema, name, notes.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "adjoint/simulate/simulate.h"
#include "formats/documents/journal_json.h"
#include "formats/documents/scene_json.h"
#include "formats/export/export_motion.h"
#include "formats/gltf/read/import_gltf.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLabelled = R"({
  "$schema": "../schemas/scene.schema.json",
  "carom": 1,
  "name": "A drop",
  "notes": "onto the floor",
  "duration": 0.3,
  "materials": { "rubber": { "elasticity": 0.8, "notes": "from an old tyre" } },
  "bodies": [
    { "name": "floor", "fixed": true, "material": "rubber", "shape": { "plane": { "normal": [0, 0, 1] } } },
    { "name": "ball", "notes": "red", "material": "rubber", "mass": 0.1,
      "shape": { "sphere": { "radius": 0.1 } }, "position": [0, 0, 1] }
  ],
  "controls": [{ "vary": "velocity", "body": "ball", "notes": "of the hand" }],
  "constraints": [{ "body": "ball", "at": 0.2, "notes": "the mark", "position": [null, null, 0.9] }]
})";

class DocumentLabels : public testing::Test {
 protected:
  DocumentLabels() : folder_(fs::temp_directory_path() / ("carom-labels-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(folder_ / "scenes" / "edited");
  }
  ~DocumentLabels() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static void expectNotes(const Document& d) {
    EXPECT_EQ(d.name, "A drop");
    EXPECT_EQ(d.notes, "onto the floor");
    ASSERT_EQ(d.scene.materials.size(), 1u);
    EXPECT_EQ(d.scene.materials[0].notes, "from an old tyre");
    ASSERT_EQ(d.scene.bodies.size(), 2u);
    EXPECT_EQ(d.scene.bodies[1].notes, "red");
    ASSERT_EQ(d.controls.size(), 1u);
    EXPECT_EQ(d.controls[0].notes, "of the hand");
    ASSERT_EQ(d.constraints.size(), 1u);
    EXPECT_EQ(d.constraints[0].notes, "the mark");
  }

  fs::path folder_;
};

TEST_F(DocumentLabels, theSchemaFollowsAFileAndAnAddressStays) {
  Document d = parseDocument(kLabelled, "labelled", path("scenes"));
  saveDocument(path("scenes/same.json"), d);
  EXPECT_EQ(readDocument(path("scenes/same.json")).schema, "../schemas/scene.schema.json");
  saveDocument(path("scenes/edited/drop.json"), d);
  const Document moved = readDocument(path("scenes/edited/drop.json"));
  EXPECT_EQ(moved.schema, "../../schemas/scene.schema.json");
  expectNotes(moved);
  for (const char* kept : {"https://example.org/scene.schema.json", "/usr/share/scene.schema.json", "urn:x:y"}) {
    d.schema = kept;
    saveDocument(path("scenes/edited/drop.json"), d);
    EXPECT_EQ(readDocument(path("scenes/edited/drop.json")).schema, kept);
  }
}

TEST_F(DocumentLabels, nothingIsWrittenWhereThereIsNothing) {
  Document d = parseDocument(kLabelled, "labelled");
  d.name.clear(), d.notes.clear(), d.schema.clear();
  d.scene.materials[0].notes.clear(), d.scene.bodies[1].notes.clear();
  d.controls[0].notes.clear(), d.constraints[0].notes.clear();
  const std::string text = writeDocument(d);
  EXPECT_EQ(text.find("notes"), std::string::npos) << text;
  EXPECT_EQ(text.find("$schema"), std::string::npos) << text;
  EXPECT_EQ(text.find("\"name\""), text.find("\"name\": \"floor\"")) << text;
}

TEST_F(DocumentLabels, throughGltfAndBack) {
  const Document d = parseDocument(kLabelled, "labelled", path("scenes"));
  OdeContacts contacts(d.scene);
  exportMotion(path("drop.glb"), d, simulate(d.scene, contacts, d.duration));
  const Imported back = importGltf(path("drop.glb"));
  expectNotes(back.document);
  EXPECT_EQ(back.document.schema, "");  // a file name would mean nothing beside the glTF file
}

TEST_F(DocumentLabels, throughAJournal) {
  const Document d = parseDocument(kLabelled, "labelled", path("scenes"));
  JournalDocument journal;
  journal.journal = {d.scene, d.duration, d.controls, d.constraints, {}, {}};
  journal.folder = d.folder, journal.name = d.name, journal.notes = d.notes;
  journal.schema = "../schemas/journal.schema.json";
  saveJournal(path("scenes/edited/session.json"), journal);
  const JournalDocument back = readJournal(path("scenes/edited/session.json"));
  EXPECT_EQ(back.schema, "../../schemas/journal.schema.json");
  EXPECT_EQ(back.name, "A drop");
  EXPECT_EQ(back.notes, "onto the floor");
  EXPECT_EQ(back.journal.scene.bodies[1].notes, "red");
  ASSERT_EQ(back.journal.nails.size(), 1u);
  EXPECT_EQ(back.journal.nails[0].notes, "the mark");
}

}  // namespace
}  // namespace carom
