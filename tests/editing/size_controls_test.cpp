// SPDX-License-Identifier: MIT
// The control `size` of every shape's dimensions, by their names, up to edits that vary them.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/controls/control_set.hpp"
#include "tests/editing/scenes.h"
#include "tests/support/solids.h"
#include "tests/support/swept_points.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

CompoundPart part(const Shape& shape, const Vec3& position = Vec3::Zero()) {
  return {shape, position, Quat(0.9, 0.2, -0.1, 0.3).normalized()};
}

Shape wedge(double scale) {
  return Hull{test::tetrahedron({0, 0, 0}, {0.3, 0, 0}, {0.05, 0.25, 0}, {0.1, 0.1, 0.2}).surface(), scale, ""};
}

struct SizeRow {
  const char* name;
  Shape shape;
  std::vector<std::string> words;
};

std::vector<SizeRow> sizeRows() {
  const Shape ring = Mesh{test::torusTriangles(0.2, 0.05, 9, 6).surface(), 0.9, ""};
  const Shape hammer = Compound{{part(Sphere{0.1}, {0, 0, 0.2}), part(Cylinder{0.03, 0.3}), part(ring)}};
  return {{"sphere", Sphere{0.1}, {"radius"}},
          {"box", Box{{0.3, 0.2, 0.1}}, {"x", "y", "z"}},
          {"capsule", Capsule{0.06, 0.2}, {"radius", "height"}},
          {"cylinder", Cylinder{0.1, 0.2}, {"radius", "height"}},
          {"cone", Cone{0.1, 0.2}, {"radius", "height"}},
          {"hull", wedge(1.2), {"scale"}},
          {"mesh", ring, {"scale"}},
          {"compound", hammer, {"0.radius", "1.radius", "1.height", "2.scale"}},
          {"nested",
           Compound{{part(wedge(1)), part(hammer, {0.1, 0, 0})}},
           {"0.scale", "1.0.radius", "1.1.radius", "1.1.height", "1.2.scale"}}};
}

Scene sceneOf(const Shape& shape, bool fixed = false) {
  Scene scene = thrownBox();
  Body& body = scene.bodies[1];
  body.shape = shape;
  body.fixed = fixed;
  return scene;
}

TEST(SizeControls, NamesValuesAndTheScenesTheyMake) {
  for (const SizeRow& row : sizeRows())
    for (bool fixed : {false, true}) {
      SCOPED_TRACE(row.name);
      const Scene scene = sceneOf(row.shape, fixed);
      const ControlSet set(scene, {size("box")});
      const ShapeKind& kind = kindOf(row.shape);
      ASSERT_EQ(set.size(), static_cast<int>(row.words.size()));
      EXPECT_EQ(set.startValues(), kind.dimensions(row.shape));
      for (int i = 0; i < set.size(); ++i) {
        const Variable& v = set.variables()[static_cast<std::size_t>(i)];
        EXPECT_EQ(v.component, row.words[static_cast<std::size_t>(i)]);
        if (set.size() > 1 || v.component != "value") {
          EXPECT_EQ(set.describeVariable(i), "size." + v.component + " of 'box'");
        }
        EXPECT_GT(v.lower, 0);
        EXPECT_LT(v.lower, 1e-5 * v.start);
        EXPECT_EQ(v.scale, v.start) << "a size is weighed relative to itself";
      }
      Eigen::VectorXd values = set.startValues();
      for (Eigen::Index i = 0; i < values.size(); ++i) values[i] *= 1.1 + 0.1 * static_cast<double>(i);
      const Scene changed = set.sceneAt(values);
      EXPECT_NO_THROW(validate(changed));
      EXPECT_EQ(kind.dimensions(changed.bodies[1].shape), values);
      EXPECT_EQ(kind.dimensions(scene.bodies[1].shape), kind.dimensions(row.shape)) << "the scene given is untouched";
    }
}

TEST(SizeControls, OneDimensionByItsName) {
  for (const SizeRow& row : sizeRows())
    for (std::size_t d = 0; d < row.words.size(); ++d) {
      SCOPED_TRACE(std::string(row.name) + ", " + row.words[d]);
      const Scene scene = sceneOf(row.shape);
      const ControlSet set(scene, {size("box").only({row.words[d]}).within(1e-3, 50)});
      ASSERT_EQ(set.size(), 1);
      Eigen::VectorXd expected = kindOf(row.shape).dimensions(row.shape);
      const auto k = static_cast<Eigen::Index>(d);
      EXPECT_EQ(set.startValues()[0], expected[k]);
      expected[k] *= 1.5;
      const Scene changed = set.sceneAt(expected.segment<1>(k));
      EXPECT_EQ(kindOf(row.shape).dimensions(changed.bodies[1].shape), expected);

      SceneGradient gradient(scene);
      for (Eigen::Index i = 0; i < expected.size(); ++i) gradient.bodies[1].size[i] = static_cast<double>(i) + 2;
      EXPECT_EQ(set.gather(gradient, set.startValues())[0], static_cast<double>(d) + 2);
      const SceneTangent tangent = set.scatter(Eigen::VectorXd::Constant(1, 3), set.startValues());
      EXPECT_EQ(tangent.bodies[1].size, 3 * Eigen::VectorXd::Unit(expected.size(), k));
    }
}

TEST(SizeControls, WrongNamesListTheRightOnes) {
  for (const SizeRow& row : sizeRows()) {
    SCOPED_TRACE(row.name);
    try {
      const ControlSet set(sceneOf(row.shape), {size("box").only({"9.girth"})});
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), "/controls/0/components");
      EXPECT_NE(error.message().find("9.girth"), std::string::npos) << error.message();
      for (const std::string& word : row.words)
        EXPECT_NE(error.message().find(word), std::string::npos) << error.message();
    }
  }
}

// Where a size moves the centre of mass, turns the principal axes or reaches the floor sooner, an edit finds the one
// that brings the body where it shall be.
TEST(SizeControls, EditsFindASize) {
  struct Row {
    const char* name;
    Shape shape;
    const char* word;
    double wanted;  ///< times what it is
  };
  const Compound hammer{
      {part(Sphere{0.1}, {0, 0, 0.2}), part(Cylinder{0.03, 0.3}), part(Capsule{0.02, 0.1}, {0.2, 0, 0})}};
  for (const Row& row :
       {Row{"capsule", Capsule{0.06, 0.3}, "height", 1.1}, Row{"hull", wedge(1), "scale", 0.9},
        Row{"part", hammer, "0.radius", 1.15}, Row{"partThatTouchesNothing", hammer, "1.radius", 1.2}}) {
    SCOPED_TRACE(row.name);
    Scene scene = sceneOf(row.shape);
    scene.bodies[1].position.z() = 0.7;
    scene.bodies[1].velocity.z() = -1;
    test::SweptPointContacts contacts(scene), of_other(scene);
    const ControlSet set(scene, {size("box").only({row.word})});
    const Scene other = set.sceneAt(row.wanted * set.startValues());
    of_other.begin(other);
    const Motion here = simulate(scene, contacts, 0.6), there = simulate(other, of_other, 0.6);
    ASSERT_GE(std::min(here.events.size(), there.events.size()), 2u);
    // between the first impact of both and the second of either
    const double T = 0.5 * std::max(here.events[0].time, there.events[0].time) +
                     0.5 * std::min(here.events[1].time, there.events[1].time);
    ASSERT_GT(T, std::max(here.events[0].time, there.events[0].time));
    Edit edit(scene, contacts, T);
    edit.vary(size("box").only({row.word}));
    edit.nail("box", T).position({any, any, there.stateAt("box", T).position.z()});
    const EditResult r = edit.solve();
    ASSERT_TRUE(r.solved()) << r.message;
    ASSERT_EQ(r.changed.size(), 1u);
    EXPECT_LE(std::abs(r.motion.stateAt("box", T).position.z() - there.stateAt("box", T).position.z()), 1e-9);
    EXPECT_LT(std::abs(std::log(r.changed[0].after / r.changed[0].before)), 1.01 * std::abs(std::log(row.wanted)))
        << "no further than what is known to do";
  }
}

}  // namespace
}  // namespace carom
