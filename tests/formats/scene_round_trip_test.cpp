// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "formats/base/read_file.hpp"
#include "formats/documents/scene_json.h"
#include "formats/json/json_writer.hpp"
#include "tests/formats/same_documents.h"
#include "tests/formats/scene_documents.h"

namespace carom {

using namespace formats_detail;

namespace {

using formats_test::documentWithEverything;
using formats_test::exampleScenes;
using formats_test::expectRoundTrip;
using formats_test::expectSameScene;
using formats_test::replaced;
using formats_test::textOf;

TEST(SceneRoundTrip, everyMember) {
  expectRoundTrip(parseDocument(documentWithEverything(), "everything"), "everything");
}

TEST(SceneRoundTrip, everyExample) {
  const std::vector<std::string> paths = exampleScenes();
  EXPECT_GE(paths.size(), 6u);
  for (const std::string& path : paths) {
    SCOPED_TRACE(path);
    const Document document = readDocument(path);
    EXPECT_FALSE(document.controls.empty());
    EXPECT_FALSE(document.constraints.empty());
    expectRoundTrip(document, path);
  }
}

TEST(SceneRoundTrip, membersAreRead) {
  const Document d = parseDocument(documentWithEverything(), "everything");
  EXPECT_EQ(d.scene.gravity, Vec3(0.1, -0.2, -9.81));
  EXPECT_EQ(d.duration, 2.5);
  EXPECT_EQ(d.schema, "https://example.org/schemas/scene.schema.json");
  EXPECT_EQ(d.name, "Everything \"quoted\" é");
  EXPECT_EQ(d.notes, "one line\nand another");
  EXPECT_EQ(d.scene.materials[0].notes, "old oak");
  EXPECT_EQ(d.scene.bodies[3].notes, "the one with the torn cover");
  EXPECT_EQ(d.controls[5].notes, "by wax");
  EXPECT_EQ(d.constraints[2].notes, "spins");
  ASSERT_EQ(d.scene.materials.size(), 3u);
  EXPECT_EQ(d.scene.materials[0].name, "wood");
  EXPECT_EQ(d.scene.materials[0].tangential_elasticity, -0.25);
  EXPECT_EQ(d.scene.materials[1].combine_elasticity, Combine::minimum);
  EXPECT_EQ(d.scene.materials[1].combine_friction, Combine::multiply);
  EXPECT_EQ(d.scene.materials[2].combine_elasticity, Combine::average);
  EXPECT_EQ(d.scene.materials[2].combine_friction, Combine::maximum);
  EXPECT_EQ(d.scene.materials[2].elasticity, 0.5);
  ASSERT_EQ(d.scene.bodies.size(), 11u);
  EXPECT_TRUE(d.scene.bodies[0].fixed);
  EXPECT_EQ(std::get<Plane>(d.scene.bodies[0].shape).offset, -0.125);
  EXPECT_EQ(d.scene.bodies[1].orientation.y(), 0.8);
  EXPECT_EQ(*d.scene.bodies[2].density, 700.5);
  EXPECT_FALSE(d.scene.bodies[2].mass);
  EXPECT_EQ(d.scene.bodies[3].inertia.moments, Vec3(0.0011, 0.0012, 0.0019));
  EXPECT_EQ(d.scene.bodies[3].angular_velocity, Vec3(0.1, 0.2, 0.30000000000000004));
  EXPECT_EQ(d.scene.bodies[4].inertia.source, Inertia::Source::matrix);
  EXPECT_NEAR(d.scene.bodies[4].inertia.matrix()(1, 2), -0.02, 1e-15);
  EXPECT_EQ(std::get<Capsule>(d.scene.bodies[5].shape).height, 0.7);
  EXPECT_EQ(std::get<Cylinder>(d.scene.bodies[6].shape).radius, 0.12);
  EXPECT_EQ(std::get<Cone>(d.scene.bodies.back().shape).radius, 0.18);
  EXPECT_EQ(std::get<Cone>(d.scene.bodies.back().shape).height, 0.71);
  EXPECT_EQ(d.scene.bodies[7].center_of_mass, Vec3(0.013, -0.002, 0.001));
  EXPECT_FALSE(d.scene.bodies[6].center_of_mass);
  const Hull& die = std::get<Hull>(d.scene.bodies[7].shape);
  EXPECT_EQ(die.surface->vertices.size(), 4u);  // the fifth point is inside
  EXPECT_EQ(die.scale, 1.25);
  const Compound& hat = std::get<Compound>(d.scene.bodies[8].shape);
  ASSERT_EQ(hat.parts.size(), 3u);
  EXPECT_EQ(hat.parts[1].position, Vec3(0, 0, 0.06));
  EXPECT_EQ(hat.parts[1].orientation.coeffs(), Eigen::Vector4d(0, 0, 0.96, 0.28));
  EXPECT_EQ(std::get<Compound>(hat.parts[2].shape).parts[2].orientation.w(), 0);
  ASSERT_EQ(d.scene.tilts.size(), 2u);
  EXPECT_EQ(d.scene.tilts[1].value, Vec2(0, 0.1));
  EXPECT_EQ(d.controls[0].min, (std::vector<double>{-1, -2}));
  EXPECT_EQ(d.controls[0].max, std::vector<double>{3});
  EXPECT_EQ(d.controls[11].impact, 2);
  EXPECT_TRUE(std::isnan(d.constraints[0].targets[0].value[1]));
  EXPECT_EQ(d.constraints[0].targets[1].value, (std::vector<TargetNumber>{0.8, 0, 0.6, 0}));
  EXPECT_EQ(d.constraints[1].at.impact, 3);
  EXPECT_EQ(d.constraints[1].at.with, "floor");
  EXPECT_EQ(d.constraints[1].targets[1].value, (std::vector<TargetNumber>{1.25}));
  EXPECT_EQ(d.constraints[3].targets[0].body_point, Vec3(0.5, 0, 0));
}

using Numbers = std::vector<TargetNumber>;

/// Numbers with the free ones as 99.
Numbers shown(Numbers numbers) {
  for (TargetNumber& x : numbers)
    if (x.isFree()) x = 99;
  return numbers;
}

TEST(SceneRoundTrip, spansRangesAndRegionsAreRead) {
  const Document d = parseDocument(documentWithEverything(), "everything");
  ASSERT_EQ(d.constraints.size(), 13u);
  EXPECT_TRUE(d.constraints[12].at.rest);
  EXPECT_EQ(shown(d.constraints[12].targets.at(0).value), (Numbers{99, 5.125, 99}));
  EXPECT_EQ(d.constraints[12].targets.at(1).max, Numbers{2.375});
  const Target &distance = d.constraints[8].targets[0], &closest = d.constraints[9].targets[0];
  EXPECT_EQ(distance.quantity + " " + distance.to, "distance pill");
  EXPECT_EQ(shown(distance.value), Numbers{99});
  EXPECT_EQ(distance.min, Numbers{0.15});
  EXPECT_EQ(distance.max, Numbers{8.5});
  EXPECT_EQ(closest.quantity + " " + closest.to, "closest_approach can");
  EXPECT_EQ(closest.value, Numbers{0.065});
  EXPECT_EQ(closest.during, (TimeSpan(0.45, 1.95)));
  ASSERT_TRUE(d.constraints[10].hits);
  EXPECT_EQ(d.constraints[10].hits->with, "pill");
  EXPECT_EQ(d.constraints[10].hits->during, (TimeSpan(0.55, 1.85)));
  EXPECT_EQ(d.constraints[10].hits->after->with, "crate");
  EXPECT_EQ(d.constraints[10].hits->before->n, 7);
  EXPECT_EQ(d.constraints[11].sequence, (std::vector<std::string>{"can pill", "...", "d?e pil*"}));
  const Constraint& hat = d.constraints[4];
  EXPECT_EQ(hat.at.span, (TimeSpan(0.31, 1.9)));
  EXPECT_EQ(hat.at.impact, 0);
  EXPECT_EQ(hat.relative_to, "crate");
  ASSERT_EQ(hat.targets.size(), 2u);
  EXPECT_EQ(shown(hat.targets[0].value), (Numbers{99, 99, 99}));
  EXPECT_EQ(shown(hat.targets[0].min), (Numbers{-0.3, 99, 99}));
  EXPECT_EQ(shown(hat.targets[0].max), (Numbers{0.75, 4.5, 99}));
  EXPECT_EQ(shown(hat.targets[1].value), (Numbers{0.11, 99, 99}));
  EXPECT_EQ(shown(hat.targets[1].min), (Numbers{99, -7.5, 99}));
  EXPECT_TRUE(hat.targets[1].max.empty());
  const Constraint& pill = d.constraints[5];
  EXPECT_EQ(shown(pill.targets[0].value), Numbers{99});
  EXPECT_EQ(pill.targets[0].min, Numbers{0.4});
  EXPECT_EQ(pill.targets[0].max, Numbers{2.25});
  EXPECT_EQ(shown(pill.targets[1].min), (Numbers{-8.5, 99, 99}));
  ASSERT_EQ(pill.regions.size(), 1u);
  EXPECT_EQ(pill.regions[0].side, Region::Side::inside);
  EXPECT_EQ(std::get<Box>(pill.regions[0].shape).size, Vec3(40.5, 30, 20));
  EXPECT_FALSE(pill.regions[0].during);
  EXPECT_FALSE(pill.regions[0].margin);
  const Constraint& die = d.constraints[7];
  ASSERT_EQ(die.targets.size(), 5u);
  EXPECT_EQ(die.targets[0].value, (std::vector<TargetNumber>{3.25}));
  EXPECT_EQ(die.targets[1].max, (std::vector<TargetNumber>{41.5}));
  EXPECT_TRUE(die.targets[1].min.empty());
  EXPECT_EQ(die.targets[2].min, (std::vector<TargetNumber>{1.125}));
  EXPECT_EQ(die.targets[3].quantity, "contact");
  EXPECT_EQ(shown(die.targets[3].value), (Numbers{99, 99, 4.75}));
  EXPECT_EQ(shown(die.targets[3].min), (Numbers{0.7, 99, 99}));
  EXPECT_EQ(die.targets[4].value, (std::vector<TargetNumber>{-0.375}));
  const Constraint& can = d.constraints[6];
  EXPECT_TRUE(can.targets.empty());
  ASSERT_EQ(can.regions.size(), 3u);
  EXPECT_EQ(can.regions[0].side, Region::Side::inside);
  EXPECT_EQ(std::get<Sphere>(can.regions[0].shape).radius, 12.5);
  EXPECT_EQ(can.regions[1].orientation.w(), 0.96);
  EXPECT_EQ(can.regions[1].margin, 0);
  EXPECT_EQ(can.regions[1].keep, Region::Keep::shape);
  EXPECT_EQ(can.regions[2].side, Region::Side::avoid);
  EXPECT_EQ(can.regions[2].during, (TimeSpan(0.2, 1.7)));
  EXPECT_EQ(can.regions[2].margin, 0.05);
  EXPECT_EQ(can.regions[2].keep, Region::Keep::ball);
  EXPECT_EQ(can.regions[2].position, Vec3(-9, 3, -0.1));
}

TEST(SceneRoundTrip, randomConstraintsAreExact) {
  const unsigned seed = 20261121;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto number = [&] { return (unit(random) - 0.5) * std::pow(10, 9 * unit(random) - 4); };
  const auto chance = [&] { return unit(random) < 0.5; };
  Document d = parseDocument(documentWithEverything(), "everything");
  for (int round = 0; round < 300; ++round) {
    Constraint c{"ball", When(0.0), {}};
    const double from = unit(random), to = from + 1e-3 + unit(random);
    c.at = chance()   ? between(from, to)
           : chance() ? nthImpact(3, chance() ? "floor" : "")
           : chance() ? atRest()
                      : When(to);
    if (chance()) c.relative_to = "book";
    for (const char* quantity : {"position", "velocity", "angular_velocity", "point"}) {
      Target target{quantity, {number(), any, chance() ? TargetNumber(number()) : any}};
      if (chance()) target.min = {any, number(), any};
      if (chance()) target.max = {any, target.min.empty() ? number() : target.min[1] + unit(random) + 1e-6, any};
      if (target.quantity == std::string("point")) target.body_point = {number(), number(), number()};
      c.targets.push_back(target);
    }
    const bool inside_first = chance();
    for (int k = 0; k < 3; ++k) {
      Region region;
      region.side = inside_first == (k < 2) ? Region::Side::inside : Region::Side::avoid;
      if (chance()) region.shape = Box{{unit(random), unit(random), 1e-9}};
      if (chance()) region.position = {number(), number(), number()};
      if (chance()) region.orientation = Quat(0.6, 0, -0.8, 0);
      if (chance()) region.during = {from, to};
      if (chance()) region.margin = unit(random);
      if (chance()) region.keep = Region::Keep::shape;
      c.regions.push_back(region);
    }
    d.constraints = {c};
    expectRoundTrip(d, "random constraint");
    if (testing::Test::HasFailure()) return;
  }
}

TEST(SceneRoundTrip, handWrittenMatrixComesBackAsWritten) {
  const std::string text = writeDocument(parseDocument(documentWithEverything(), "everything"));
  EXPECT_NE(text.find("[[0.2, 0.01, 0.005], [0.01, 0.25, -0.02], [0.005, -0.02, 0.3]]"), std::string::npos) << text;
}

TEST(SceneRoundTrip, defaults) {
  const Document d = parseDocument(
      R"({"carom": 1, "bodies": [{"name": "b", "mass": 1, "shape": {"sphere": {"radius": 1}}}]})", "small");
  EXPECT_EQ(d.scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(d.duration, 1);
  EXPECT_TRUE(d.scene.bodies[0].material.empty());
  EXPECT_EQ(d.scene.bodies[0].orientation.coeffs(), Quat::Identity().coeffs());
  expectRoundTrip(d, "small");
}

TEST(SceneRoundTrip, directionsBecomeUnitAndStaySo) {
  std::string text = replaced(documentWithEverything(), "\"normal\": [0, 0.6, 0.8]", "\"normal\": [3, -4, 5e-7]");
  text = replaced(text, "[0.5, -0.5, 0.5, -0.5]", "[0.7071, 0, 0.7071, 0]");
  const Document d = parseDocument(text, "rounded");
  EXPECT_NEAR(std::get<Plane>(d.scene.bodies[0].shape).normal.norm(), 1, 2e-16);
  EXPECT_NEAR(d.scene.bodies[3].orientation.norm(), 1, 2e-16);
  EXPECT_EQ(d.scene.bodies[3].orientation.w(), d.scene.bodies[3].orientation.y());
  expectRoundTrip(d, "rounded");
}

TEST(SceneRoundTrip, randomNumbersAreExact) {
  const unsigned seed = 20240611;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  Document d = parseDocument(documentWithEverything(), "everything");
  std::uniform_real_distribution<double> exponent(-300, 8.9), unit(-1, 1);
  for (int k = 0; k < 300; ++k) {
    for (Body& body : d.scene.bodies) {
      for (double& x : body.position) x = unit(random) * std::pow(10, exponent(random));
      Quat q;
      for (double& x : q.coeffs()) x = unit(random);
      q.normalize();
      if (std::abs(q.squaredNorm() - 1) < 1e-15) body.orientation = q;
      if (body.fixed) continue;
      for (double& x : body.velocity) x = unit(random) * std::pow(10, exponent(random));
    }
    const Document again = parseDocument(writeDocument(d), "random");
    expectSameScene(d.scene, again.scene);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(NumberText, readsBackExactly) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 100000; ++k) {
    const double x = std::bit_cast<double>(random());
    const std::string text = numberText(x);
    if (!std::isfinite(x)) {
      EXPECT_EQ(text, "null");
      continue;
    }
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), x) << text;
  }
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(-0.0), "-0.0");
  EXPECT_EQ(numberText(100000), "100000");
  EXPECT_EQ(numberText(1e300), "1e+300");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.30000000000000004");
}

TEST(SceneWrite, twoTargetsOfOneKindBecomeTwoConstraints) {
  Document d = parseDocument(documentWithEverything(), "everything");
  const Target point = d.constraints[3].targets[0];
  d.constraints = {{"crate", When(1.0), {point, {"position", {1, 2, 3}, Vec3::Zero()}, point}}};
  const Document again = parseDocument(writeDocument(d), "two points");
  ASSERT_EQ(again.constraints.size(), 2u);
  EXPECT_EQ(again.constraints[0].targets.size(), 2u);
  EXPECT_EQ(again.constraints[1].targets.size(), 1u);
}

// Two constraints between two times would have a time each.
TEST(SceneWrite, twoTargetsOfOneKindAtOneTimeOfASpanAreRefused) {
  Document d = parseDocument(documentWithEverything(), "everything");
  const Target point = d.constraints[3].targets[0];
  d.constraints = {{"crate", between(1, 2), {point, point}}};
  EXPECT_THROW(writeDocument(d), InputError);
}

TEST(SceneWrite, refusesWhatCannotBeRead) {
  const Document good = parseDocument(documentWithEverything(), "everything");
  Document d = good;
  d.scene.bodies[3].velocity.x() = std::nan("");
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.controls[0].weight = 1 / 0.0;
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[0].targets[0].value[0] = 1 / 0.0;
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[0].targets[0].value[0] = std::nan("");  // null would leave it free
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[4].targets[0].min[0] = -1 / 0.0;
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[4].at.span->second = std::nan("");
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[6].regions[2].margin = std::nan("");
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[6].regions[0].shape = Sphere{std::nan("")};
  EXPECT_THROW(writeDocument(d), InputError);
}

class SceneFile : public testing::Test {
 protected:
  SceneFile()
      : folder_(std::filesystem::temp_directory_path() / ("carom-scene-" + std::to_string(std::random_device{}()))) {
    std::filesystem::create_directory(folder_);
  }
  ~SceneFile() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

TEST_F(SceneFile, savesAndLeavesNothingElse) {
  const Document d = parseDocument(documentWithEverything(), "everything");
  saveDocument(path("scene.json"), d);
  saveDocument(path("scene.json"), d);
  EXPECT_EQ(textOf(path("scene.json")), writeDocument(d));
  expectSameScene(readDocument(path("scene.json")).scene, d.scene);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(SceneFile, whatCannotBeSavedLeavesTheOldFile) {
  Document d = parseDocument(documentWithEverything(), "everything");
  saveDocument(path("scene.json"), d);
  const std::string before = textOf(path("scene.json"));
  d.controls[0].body = "nobody";
  EXPECT_THROW(saveDocument(path("scene.json"), d), FormatError);
  d.scene.bodies[3].mass = -1;
  EXPECT_THROW(saveDocument(path("scene.json"), d), FormatError);
  EXPECT_EQ(textOf(path("scene.json")), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST(ReadStream, readsAllUpToALimit) {
  std::istringstream text("0123456789");
  EXPECT_EQ(readStream(text, "<stdin>", 10), "0123456789");
  EXPECT_EQ(readStream(text, "<stdin>", 10), "");  // there is no more
  std::istringstream longer("0123456789");
  try {
    readStream(longer, "<stdin>", 9);
    FAIL() << "read";
  } catch (const FormatError& error) {
    EXPECT_STREQ(error.what(), "<stdin>: found more, expected at most 9 bytes");
  }
}

TEST_F(SceneFile, folderThatDoesNotExist) {
  const Document d = parseDocument(documentWithEverything(), "everything");
  try {
    saveDocument(path("none/scene.json"), d);
    FAIL() << "saved";
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find(path("none/scene.json") + ": cannot write"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace carom
