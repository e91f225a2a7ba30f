#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "formats/json_writer.h"
#include "formats/scene_json.h"
#include "tests/formats/scene_documents.h"

namespace carom {
namespace {

using formats_test::documentWithEverything;
using formats_test::exampleScenes;
using formats_test::replaced;
using formats_test::textOf;

template <class A, class B>
void expectSameNumbers(const A& a, const B& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (int i = 0; i < static_cast<int>(a.size()); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(static_cast<double>(a[i])),
              std::bit_cast<std::uint64_t>(static_cast<double>(b[i])))
        << where << " " << i << ": " << numberText(a[i]) << " " << numberText(b[i]);
}

void expectSameBody(const Body& a, const Body& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.fixed, b.fixed);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.density, b.density);
  ASSERT_EQ(a.shape.index(), b.shape.index());
  expectSameNumbers(kindOf(a.shape).dimensions(a.shape), kindOf(b.shape).dimensions(b.shape), a.name + " shape");
  if (const auto* plane = std::get_if<Plane>(&a.shape)) {
    expectSameNumbers(plane->normal, std::get<Plane>(b.shape).normal, a.name + " normal");
    EXPECT_EQ(plane->offset, std::get<Plane>(b.shape).offset);
  }
  ASSERT_EQ(a.inertia.source, b.inertia.source);
  if (a.inertia.source == Inertia::Source::matrix) {
    EXPECT_LE((a.inertia.matrix() - b.inertia.matrix()).norm(), 1e-14 * a.inertia.matrix().norm());
  } else {
    expectSameNumbers(a.inertia.moments, b.inertia.moments, a.name + " inertia");
  }
  expectSameNumbers(a.position, b.position, a.name + " position");
  expectSameNumbers(a.orientation.coeffs(), b.orientation.coeffs(), a.name + " orientation");
  expectSameNumbers(a.velocity, b.velocity, a.name + " velocity");
  expectSameNumbers(a.angular_velocity, b.angular_velocity, a.name + " angular_velocity");
}

void expectSameScene(const Scene& a, const Scene& b) {
  expectSameNumbers(a.gravity, b.gravity, "gravity");
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    const Material &m = a.materials[i], &n = b.materials[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.elasticity, n.elasticity);
    EXPECT_EQ(m.friction, n.friction);
    EXPECT_EQ(m.tangential_elasticity, n.tangential_elasticity);
    EXPECT_EQ(m.combine_elasticity, n.combine_elasticity);
    EXPECT_EQ(m.combine_friction, n.combine_friction);
  }
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) expectSameBody(a.bodies[i], b.bodies[i]);
  ASSERT_EQ(a.tilts.size(), b.tilts.size());
  for (std::size_t i = 0; i < a.tilts.size(); ++i) {
    EXPECT_EQ(a.tilts[i].body, b.tilts[i].body);
    EXPECT_EQ(a.tilts[i].impact, b.tilts[i].impact);
    expectSameNumbers(a.tilts[i].value, b.tilts[i].value, "tilt");
  }
}

void expectSameEdit(const Document& a, const Document& b) {
  ASSERT_EQ(a.controls.size(), b.controls.size());
  for (std::size_t i = 0; i < a.controls.size(); ++i) {
    const Control &c = a.controls[i], &d = b.controls[i];
    EXPECT_EQ(c.vary, d.vary);
    EXPECT_EQ(c.body, d.body);
    EXPECT_EQ(c.material, d.material);
    EXPECT_EQ(c.impact, d.impact);
    EXPECT_EQ(c.components, d.components);
    EXPECT_EQ(c.min, d.min);
    EXPECT_EQ(c.max, d.max);
    EXPECT_EQ(c.weight, d.weight);
  }
  ASSERT_EQ(a.constraints.size(), b.constraints.size());
  for (std::size_t i = 0; i < a.constraints.size(); ++i) {
    const Constraint &c = a.constraints[i], &d = b.constraints[i];
    EXPECT_EQ(c.body, d.body);
    EXPECT_EQ(c.at.time, d.at.time);
    EXPECT_EQ(c.at.impact, d.at.impact);
    EXPECT_EQ(c.at.with, d.at.with);
    ASSERT_EQ(c.targets.size(), d.targets.size());
    for (std::size_t k = 0; k < c.targets.size(); ++k) {
      EXPECT_EQ(c.targets[k].quantity, d.targets[k].quantity);
      ASSERT_EQ(c.targets[k].value.size(), d.targets[k].value.size());
      for (std::size_t n = 0; n < c.targets[k].value.size(); ++n) {
        const double x = c.targets[k].value[n], y = d.targets[k].value[n];
        EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << x << " " << y;
      }
      expectSameNumbers(c.targets[k].body_point, d.targets[k].body_point, "body_point");
    }
  }
}

void expectRoundTrip(const Document& document, const std::string& name) {
  const std::string text = writeDocument(document);
  const Document again = parseDocument(text, name);
  EXPECT_EQ(again.duration, document.duration);
  expectSameScene(document.scene, again.scene);
  expectSameEdit(document, again);
  EXPECT_EQ(writeDocument(again), text);
}

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
  ASSERT_EQ(d.scene.materials.size(), 3u);
  EXPECT_EQ(d.scene.materials[0].name, "wood");
  EXPECT_EQ(d.scene.materials[0].tangential_elasticity, -0.25);
  EXPECT_EQ(d.scene.materials[1].combine_elasticity, Combine::minimum);
  EXPECT_EQ(d.scene.materials[1].combine_friction, Combine::multiply);
  EXPECT_EQ(d.scene.materials[2].combine_elasticity, Combine::average);
  EXPECT_EQ(d.scene.materials[2].combine_friction, Combine::maximum);
  EXPECT_EQ(d.scene.materials[2].elasticity, 0.5);
  ASSERT_EQ(d.scene.bodies.size(), 5u);
  EXPECT_TRUE(d.scene.bodies[0].fixed);
  EXPECT_EQ(std::get<Plane>(d.scene.bodies[0].shape).offset, -0.125);
  EXPECT_EQ(d.scene.bodies[1].orientation.y(), 0.8);
  EXPECT_EQ(*d.scene.bodies[2].density, 700.5);
  EXPECT_FALSE(d.scene.bodies[2].mass);
  EXPECT_EQ(d.scene.bodies[3].inertia.moments, Vec3(0.0011, 0.0012, 0.0019));
  EXPECT_EQ(d.scene.bodies[3].angular_velocity, Vec3(0.1, 0.2, 0.30000000000000004));
  EXPECT_EQ(d.scene.bodies[4].inertia.source, Inertia::Source::matrix);
  EXPECT_NEAR(d.scene.bodies[4].inertia.matrix()(1, 2), -0.02, 1e-15);
  ASSERT_EQ(d.scene.tilts.size(), 2u);
  EXPECT_EQ(d.scene.tilts[1].value, Vec2(0, 0.1));
  EXPECT_EQ(d.controls[0].min, (std::vector<double>{-1, -2}));
  EXPECT_EQ(d.controls[0].max, std::vector<double>{3});
  EXPECT_EQ(d.controls[11].impact, 2);
  EXPECT_TRUE(std::isnan(d.constraints[0].targets[0].value[1]));
  EXPECT_EQ(d.constraints[0].targets[1].value, (std::vector<double>{0.8, 0, 0.6, 0}));
  EXPECT_EQ(d.constraints[1].at.impact, 3);
  EXPECT_EQ(d.constraints[1].at.with, "floor");
  EXPECT_EQ(d.constraints[1].targets[1].value, std::vector<double>{1.25});
  EXPECT_EQ(d.constraints[3].targets[0].body_point, Vec3(0.5, 0, 0));
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
  d.constraints = {{"crate", When(1), {point, {"position", {1, 2, 3}, {}}, point}}};
  const Document again = parseDocument(writeDocument(d), "two points");
  ASSERT_EQ(again.constraints.size(), 2u);
  EXPECT_EQ(again.constraints[0].targets.size(), 2u);
  EXPECT_EQ(again.constraints[1].targets.size(), 1u);
}

TEST(SceneWrite, refusesWhatCannotBeRead) {
  const Document good = parseDocument(documentWithEverything(), "everything");
  Document d = good;
  d.scene.bodies[3].velocity.x() = any;
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.controls[0].weight = 1 / 0.0;
  EXPECT_THROW(writeDocument(d), InputError);
  d = good;
  d.constraints[0].targets[0].value[0] = 1 / 0.0;
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
