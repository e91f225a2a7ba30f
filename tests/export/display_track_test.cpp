// SPDX-License-Identifier: MIT
// Tracks as a page evaluates them, against the motion: every example, every kind of lasting contact, and bodies on
// which gravity acts otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "formats/drawing/display.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/export/all_shapes.h"
#include "tests/export/hand_motion.h"
#include "tests/export/players.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/page_pose.h"

namespace carom::export_tests {
namespace {

constexpr double kMove = 1e-9, kTurn = 2e-3;  // m, rad
constexpr int kTimes = 200;

void expectOrder(const DisplayTrack& track) {
  ASSERT_FALSE(track.arcs.empty());
  ASSERT_FALSE(track.turns.empty());
  for (std::size_t k = 1; k < track.arcs.size(); ++k) EXPECT_LT(track.arcs[k - 1].time, track.arcs[k].time);
  for (std::size_t k = 1; k < track.turns.size(); ++k) {
    const auto &a = track.turns[k - 1], &b = track.turns[k];
    EXPECT_LT(a.time, b.time);
    EXPECT_GT(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z, 0.8f);  // cos(0.5 rad) = 0.88
  }
}

// The centre of mass to 1e-9 m, the orientation, and so the origin of the shape as far as that lets it.
void expectPose(const Motion& motion, int body, const DisplayTrack& track, double t) {
  const BodyState state = motion.stateAt(body, t);
  const test::PagePose pose = test::pagePoseAt(track, t);
  const std::string at = motion.scene->bodies[static_cast<std::size_t>(body)].name + " at " + std::to_string(t) + " s";
  const Vec3 center = state.position + state.orientation * (*motion.models)[static_cast<std::size_t>(body)].center;
  const double move = (pose.center - center).norm(), turn = pose.orientation.angularDistance(state.orientation);
  const double origin = (pose.origin - state.position).norm();
  test::recordShare(std::max(move / kMove, turn / kTurn));
  EXPECT_TRUE(move <= kMove) << at << ": " << move << " m off";
  EXPECT_TRUE(turn <= kTurn) << at << ": " << turn << " rad off";
  EXPECT_TRUE(origin <= kMove + kTurn * track.center.norm()) << at << ": " << origin << " m off";
  EXPECT_TRUE((pose.velocity - state.velocity).norm() <= 1e-6 * (1 + state.velocity.norm())) << at;
}

// At random times, at the keys, and as near to them as doubles are. Returns the tracks' bytes in a frame.
std::size_t expectTracks(const Motion& motion, std::uint64_t seed) {
  test::Random random(seed);
  std::size_t bytes = 0;
  for (int body = 0; body < static_cast<int>(motion.scene->bodies.size()); ++body) {
    const DisplayTrack track = displayTrack(motion, body);
    expectOrder(track);
    const bool bends = !std::ranges::all_of(track.arcs, &DisplayTrack::ArcKey::isParabola);
    bytes += (bends ? 152 : 80) * track.arcs.size() + 20 * track.turns.size();
    for (int i = 0; i < kTimes; ++i) expectPose(motion, body, track, random.in(0, motion.end));
    for (const DisplayTrack::ArcKey& key : track.arcs) {
      expectPose(motion, body, track, std::min(key.time, motion.end));
      expectPose(motion, body, track, std::nextafter(key.time, 0));
    }
    expectPose(motion, body, track, motion.end);
    if (testing::Test::HasFailure()) return bytes;  // one body is enough
  }
  testing::Test::RecordProperty("track_bytes", std::to_string(bytes));
  return bytes;
}

class ExampleTracks : public testing::TestWithParam<std::string> {};

TEST_P(ExampleTracks, AreTheMotion) {
  const Document document = readDocument(projectFile("examples/scenes/") + GetParam() + ".json");
  expectTracks(simulated(document), 1);
}

INSTANTIATE_TEST_SUITE_P(Examples, ExampleTracks, testing::ValuesIn(exampleScenes()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

class LastingTracks : public testing::TestWithParam<test::DotProductScene> {};

TEST_P(LastingTracks, AreTheMotion) {
  const Motion motion = test::motionOf(GetParam());
  const std::size_t bytes = expectTracks(motion, 2);
  EXPECT_LT(bytes, 100'000u);
}

INSTANTIATE_TEST_SUITE_P(Rows, LastingTracks, testing::ValuesIn(test::lastingScenes()),
                         [](const auto& test) { return std::string(test.param.name); });

// A slide round a bend is no parabola; all else is one.
TEST(DisplayTrack, OnlyBendsAreMoreThanAParabolaAnArc) {
  for (const test::DotProductScene& row : test::lastingScenes()) {
    const Motion motion = test::motionOf(row);
    for (int body = 0; body < static_cast<int>(motion.scene->bodies.size()); ++body) {
      const auto& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
      const bool bends =
          std::any_of(arcs.begin(), arcs.end(), [](const Arc& arc) { return arc.accelerationVariation() > 0; });
      const DisplayTrack track = displayTrack(motion, body);
      EXPECT_EQ(std::ranges::all_of(track.arcs, &DisplayTrack::ArcKey::isParabola), !bends) << row.name;
      EXPECT_TRUE(bends || track.arcs.size() <= arcs.size()) << row.name;
    }
  }
}

// A stone of curling slides round a bend for many seconds; what is sent of it with every step of a drag stays small.
TEST(DisplayTrack, LongBendsTakeFewKeys) {
  const Document document = readDocument(projectFile("examples/scenes/curling.json"));
  const Motion motion = simulated(document);
  const DisplayTrack track = displayTrack(motion, bodyIndex(document.scene, "stone"));
  EXPECT_FALSE(std::ranges::all_of(track.arcs, &DisplayTrack::ArcKey::isParabola));
  EXPECT_LT(track.arcs.size(), 100u);
}

// Every key has its own acceleration, so that nothing has to be known of the scene.
TEST(DisplayTrack, GravityActsOnEachBodyAsItDoes) {
  Body light = test::makeBall("light", 0.1, {0, 0, 2}, {1, 0, 0});
  light.gravity_factor = 0.25;
  Body rises = test::makeBall("rises", 0.1, {0, 1, 2});
  rises.gravity_factor = -1;
  Body door = test::makeBox("door", {1, 0.1, 1}, {0, 3, 1}, {0.1, 0, 0});
  door.kinematic = true, door.angular_velocity = {0, 0, 2};
  Body heavy_below = test::makeBox("offset", {0.3, 0.2, 0.4}, {2, 0, 2}, {0, 0, 1});
  heavy_below.center_of_mass = Vec3(0.02, 0.01, -0.1);
  heavy_below.angular_velocity = {9, -4, 6};
  const Scene scene = test::makeScene({0, 0, -9.81}, 0.5, 0.3,
                                      {light, rises, door, heavy_below, test::makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion motion = test::play(scene, 1.5);
  expectTracks(motion, 3);
  const auto acceleration = [&](int body) { return displayTrack(motion, body).arcs.at(0).acceleration.z(); };
  EXPECT_DOUBLE_EQ(acceleration(0), -9.81 / 4);
  EXPECT_DOUBLE_EQ(acceleration(1), 9.81);
  EXPECT_EQ(acceleration(2), 0);
  EXPECT_DOUBLE_EQ(acceleration(3), -9.81);
  const DisplayTrack floor = displayTrack(motion, 4);
  ASSERT_EQ(floor.arcs.size(), 1u);
  EXPECT_EQ(floor.turns.size(), 1u);
  EXPECT_TRUE(floor.arcs[0].velocity.isZero(0) && floor.arcs[0].acceleration.isZero(0));
  EXPECT_EQ(displayTrack(motion, 3).center, Vec3(0.02, 0.01, -0.1));
}

TEST(DisplayTrack, TurnsAreAsNearAsAsked) {
  const Motion motion = handMotion();
  test::Random random(4);
  std::size_t before = 0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    std::size_t keys = 0;
    for (int body = 0; body < 3; ++body) {
      const DisplayTrack track = displayTrack(motion, body, tolerance);
      expectOrder(track);
      keys += track.turns.size();
      for (int i = 0; i < kTimes; ++i) {
        const double t = random.in(0, motion.end);
        const double turn =
            test::pagePoseAt(track, t).orientation.angularDistance(motion.stateAt(body, t).orientation);
        EXPECT_TRUE(turn <= tolerance + 1e-6) << turn << " rad, expected " << tolerance;  // floats
      }
    }
    EXPECT_GT(keys, before);
    before = keys;
  }
}

TEST(DisplayTrack, BodiesThatAreFoundAlikeAreEqual) {
  const Motion motion = handMotion();
  EXPECT_TRUE(displayTrack(motion, 0) == displayTrack(motion, 0));
  EXPECT_FALSE(displayTrack(motion, 0) == displayTrack(motion, 1));
}

TEST(DisplayTrack, WhatIsNotThereIsRefused) {
  const Motion motion = handMotion();
  const int bodies = static_cast<int>(motion.scene->bodies.size());
  for (const int body : {-1, bodies}) {
    EXPECT_THROW(displayTrack(motion, body), InputError);
    EXPECT_THROW(displayMesh(*motion.scene, body, 1), InputError);
  }
  for (const double number : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(displayTrack(motion, 0, number), InputError) << number;
    EXPECT_THROW(displayMesh(*motion.scene, 0, number), InputError) << number;
  }
  Scene scene = test::makeScene({0, 0, 0}, 0.5, 0.3, {test::makeBall("whirl", 0.1, {0, 0, 0})});
  scene.bodies[0].angular_velocity = {1e9, 0, 0};
  EXPECT_THROW(displayTrack(test::play(scene, 1), 0), InputError);  // more keys than anything could show
}

TEST(PublicDisplayMesh, IsThatOfFilesInFloats) {
  const Document document = documentOfAllShapes(false);
  for (int body = 0; body < static_cast<int>(document.scene.bodies.size()); ++body) {
    const carom::DisplayMesh mesh = displayMesh(document.scene, body, 2);
    const std::string& name = document.scene.bodies[static_cast<std::size_t>(body)].name;
    ASSERT_EQ(mesh.positions.size() % 3, 0u) << name;
    ASSERT_EQ(mesh.positions.size(), mesh.normals.size()) << name;
    ASSERT_GT(mesh.triangles.size() + mesh.accent.size(), 3u) << name;
    const std::size_t vertices = mesh.positions.size() / 3;
    double volume = 0;
    for (const auto* list : {&mesh.triangles, &mesh.accent}) {
      ASSERT_EQ(list->size() % 3, 0u) << name;
      const auto at = [&](std::size_t k) {
        const std::size_t v = 3 * static_cast<std::size_t>((*list)[k]);
        return Vec3(mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]);
      };
      for (const std::uint32_t v : *list) ASSERT_LT(v, vertices) << name;
      for (std::size_t k = 0; k < list->size(); k += 3) volume += at(k).dot(at(k + 1).cross(at(k + 2))) / 6;
    }
    const Shape& shape = document.scene.bodies[static_cast<std::size_t>(body)].shape;
    if (kindOf(shape).endless) continue;
    const double solid = kindOf(shape).properties(shape).volume;
    EXPECT_LE(volume, solid * (1 + 1e-6)) << name;
    EXPECT_GE(volume, solid * 0.975) << name;
  }
}

// In the axes of its shape: a pose turns and moves it as it does every other mesh.
TEST(PublicDisplayMesh, APlaneLiesWhereItIs) {
  const Vec3 normal = Vec3(1, 2, -2) / 3;
  const Scene scene = test::makeScene({0, 0, 0}, 0.5, 0.3, {test::makePlane("slope", normal, 0.7)});
  const carom::DisplayMesh mesh = displayMesh(scene, 0, 2.5);
  ASSERT_EQ(mesh.positions.size(), 12u);
  ASSERT_EQ(mesh.triangles.size(), 6u);
  const auto corner = [&](std::size_t k) {
    const std::size_t v = 3 * static_cast<std::size_t>(mesh.triangles[k]);
    return Vec3(mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]);
  };
  for (std::size_t k = 0; k < 6; ++k) {
    test::expectEntries(normal.dot(corner(k)), 0.7, 1e-6, "offset of a corner");
    test::expectEntries((corner(k) - 0.7 * normal).norm(), 2.5 * std::sqrt(2.0), 1e-6, "half a diagonal");
  }
  const Vec3 face = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  test::expectEntries(face, normal, 1e-6, "its front");
  for (std::size_t k = 0; k < 12; k += 3)
    test::expectEntries(Vec3(mesh.normals[k], mesh.normals[k + 1], mesh.normals[k + 2]), normal, 1e-6, "normal");
}

}  // namespace
}  // namespace carom::export_tests
