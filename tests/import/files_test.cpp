// SPDX-License-Identifier: MIT
// Every sample file: import, save, read, simulate, derivatives, and the way through an export.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate.h"
#include "editing/problem/jacobian.hpp"
#include "formats/documents/save_with_meshes.h"
#include "formats/documents/scene_json.h"
#include "formats/export/export_motion.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/import/gltf_files.h"
#include "tests/import/same_scene.h"
#include "tests/support/compare.h"

namespace carom::import_tests {

using namespace editing_detail;

namespace {

class EveryFile : public testing::TestWithParam<std::string> {
 protected:
  Document saved() {
    const std::string path = temporaryPath("scene.json");
    saveWithMeshes(path, importGltf(GetParam()).document);
    return readDocument(path);
  }
};

INSTANTIATE_TEST_SUITE_P(Samples, EveryFile, testing::ValuesIn(allFiles()), [](const auto& test) {
  const std::filesystem::path path(test.param);
  std::string name = path.parent_path().filename().string() + "_" + path.stem().string();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name + "_" + path.extension().string().substr(1);
});

TEST_P(EveryFile, SavesWhatItRead) {
  const Imported imported = importGltf(GetParam());
  const Document read = saved();
  ASSERT_EQ(read.scene.bodies.size(), imported.document.scene.bodies.size());
  for (std::size_t i = 0; i < read.scene.bodies.size(); ++i)
    expectSameBody(read.scene.bodies[i], imported.document.scene.bodies[i], 1e-13);
}

TEST_P(EveryFile, Simulates) {
  const Document document = saved();
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, 2);
  RecordProperty("impacts", std::to_string(motion.events.size()));
  RecordProperty("end", std::to_string(motion.end));
  EXPECT_GT(motion.events.size(), 0u) << "in each of them something falls onto something";
  EXPECT_TRUE(motion.status == MotionStatus::complete || !motion.message.empty());
  for (const Body& body : document.scene.bodies)
    EXPECT_TRUE(motion.stateAt(body.name, motion.end).position.allFinite()) << body.name;
}

// The derivative of where bodies are after the first impact, by their velocities: two passes that share no code.
TEST_P(EveryFile, DerivativesAgree) {
  const Document document = saved();
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, 2);
  ASSERT_FALSE(motion.events.empty());
  const double first = motion.events.front().time;
  const double time = first + 0.5 * ((motion.events.size() > 1 ? motion.events[1].time : motion.end) - first);
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
  for (const Participant& participant : motion.events.front().participants) {
    const Body& body = document.scene.bodies[static_cast<std::size_t>(participant.body)];
    if (body.fixed) continue;
    controls.push_back(velocity(body.name));
    controls.push_back(angularVelocity(body.name));
    constraints.push_back({body.name, time, {{"position", {0, 0, 0}, Vec3::Zero()}}});
  }
  ASSERT_FALSE(controls.empty());
  const EditProblem problem(document.scene, contacts, motion.end, controls, constraints);
  const Eigen::VectorXd values = problem.controls.startValues();
  const RowsAndJacobian by_adjoint = evaluateByAdjoint(problem, values);
  const RowsAndJacobian by_tangent = evaluateByTangent(problem, values);
  EXPECT_GT(by_adjoint.jacobian.cwiseAbs().maxCoeff(), 0.1 * first);
  test::expectEntries(by_adjoint.jacobian, by_tangent.jacobian, 1e-12, "d(position)/d(velocities)");
}

TEST_P(EveryFile, ComesBackFromAnExport) {
  const Document document = saved();
  OdeContacts contacts(document.scene);
  const std::string path = temporaryPath("exported.glb");
  exportMotion(path, document, simulate(document.scene, contacts, 1));
  const Imported again = importGltf(path);
  EXPECT_TRUE(again.report.warnings.empty()) << listOf(again.report);
  expectSameScene(again.document.scene, document.scene);
  expectSameEdit(again.document, document);
}

// Two balls of the public sample Materials_Restitution bounce until they rest, and their films do not grow with the rest.
TEST(SampleOfRestitution, PlaysToItsEnd) {
  const std::vector<std::string> files = allFiles();
  const auto sample = std::ranges::find_if(files, [](const std::string& path) {
    return std::filesystem::path(path).filename() == "Materials_Restitution.gltf";
  });
  if (sample == files.end()) GTEST_SKIP() << "CAROM_GLTF_SAMPLES is not set, or does not have it";
  Document document = importGltf(*sample).document;
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, 5);
  EXPECT_EQ(motion.status, MotionStatus::complete) << motion.message;
  EXPECT_LT(motion.impacts, motion.event_count);
  const std::vector<LastingContact> all = lastingContacts(motion);
  ASSERT_EQ(all.size(), 2u);
  for (const LastingContact& c : all) {
    EXPECT_EQ(c.kind, ArcKind::rest);
    EXPECT_EQ(c.to, 5);
  }
  const Motion longer = simulate(document.scene, contacts, 65);
  const auto sizeOf = [&](const Motion& of) {
    const std::string path = temporaryPath("rest.glb");
    exportMotion(path, document, of);
    return std::filesystem::file_size(path);
  };
  EXPECT_TRUE(sizeOf(longer) <= sizeOf(motion) + 64) << sizeOf(longer) << " and " << sizeOf(motion);
}

}  // namespace
}  // namespace carom::import_tests
