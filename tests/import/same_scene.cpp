// SPDX-License-Identifier: MIT
#include "tests/import/same_scene.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <variant>

#include "adjoint/scene/body_model.h"
#include "formats/documents/scene_json.h"
#include "formats/json/json_writer.hpp"
#include "tests/support/compare.h"

namespace carom::import_tests {

using namespace formats_detail;

namespace {

using test::expectEntries;

template <class A, class B>
void expectSameBits(const A& a, const B& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (int i = 0; i < static_cast<int>(a.size()); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(double(a[i])), std::bit_cast<std::uint64_t>(double(b[i])))
        << where << " " << i << ": " << numberText(a[i]) << " " << numberText(b[i]);
}

void expectSameSurface(const Surface& a, const Surface& b, const std::string& where) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size()) << where;
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    expectSameBits(a.vertices[i], b.vertices[i], where + " vertex " + std::to_string(i));
  EXPECT_EQ(a.corners, b.corners) << where;
  EXPECT_EQ(a.faces.size(), b.faces.size()) << where;
  EXPECT_EQ(a.volume, b.volume) << where;
}

void expectSameShape(const Shape& a, const Shape& b, const std::string& where) {
  ASSERT_EQ(a.index(), b.index()) << where;
  expectSameBits(kindOf(a).dimensions(a), kindOf(b).dimensions(b), where);
  if (const auto* plane = std::get_if<Plane>(&a)) {
    expectSameBits(plane->normal, std::get<Plane>(b).normal, where + " normal");
    EXPECT_EQ(plane->offset, std::get<Plane>(b).offset) << where;
  } else if (const auto* hull = std::get_if<Hull>(&a)) {
    expectSameSurface(*hull->surface, *std::get<Hull>(b).surface, where);
  } else if (const auto* mesh = std::get_if<Mesh>(&a)) {
    expectSameSurface(*mesh->surface, *std::get<Mesh>(b).surface, where);
  } else if (const auto* compound = std::get_if<Compound>(&a)) {
    const auto& others = std::get<Compound>(b).parts;
    ASSERT_EQ(compound->parts.size(), others.size()) << where;
    for (std::size_t i = 0; i < others.size(); ++i) {
      const std::string part = where + " part " + std::to_string(i);
      expectSameShape(compound->parts[i].shape, others[i].shape, part);
      expectSameBits(compound->parts[i].position, others[i].position, part);
      expectSameBits(compound->parts[i].orientation.coeffs(), others[i].orientation.coeffs(), part);
    }
  }
}

void expectSameBytes(const Body& a, const Body& b) {
  SCOPED_TRACE("body '" + b.name + "'");
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.fixed, b.fixed);
  EXPECT_EQ(a.kinematic, b.kinematic);
  EXPECT_EQ(a.gravity_factor, b.gravity_factor);
  EXPECT_EQ(a.collision_filter, b.collision_filter);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.density, b.density);
  expectSameShape(a.shape, b.shape, "shape");
  EXPECT_EQ(a.center_of_mass, b.center_of_mass);
  EXPECT_EQ(a.inertia.source, b.inertia.source);
  expectSameBits(a.inertia.moments, b.inertia.moments, "inertia");
  expectSameBits(a.inertia.axes.coeffs(), b.inertia.axes.coeffs(), "axes of inertia");
  expectSameBits(a.position, b.position, "position");
  expectSameBits(a.orientation.coeffs(), b.orientation.coeffs(), "orientation");
  expectSameBits(a.velocity, b.velocity, "velocity");
  expectSameBits(a.angular_velocity, b.angular_velocity, "angular velocity");
  expectSameBits(a.surface_velocity, b.surface_velocity, "surface velocity");
  expectSameBits(a.surface_angular_velocity, b.surface_angular_velocity, "surface angular velocity");
}

bool hasSurface(const Shape& shape) {
  if (const auto* compound = std::get_if<Compound>(&shape)) {
    for (const CompoundPart& part : compound->parts)
      if (hasSurface(part.shape)) return true;
    return false;
  }
  return std::holds_alternative<Hull>(shape) || std::holds_alternative<Mesh>(shape);
}

/// Tensor about the centre of mass, in world axes.
Mat3 worldInertia(const Body& body, const BodyModel& model) {
  const Mat3 R = body.orientation.toRotationMatrix() * model.R_BG.transpose();
  return R * model.inertia.asDiagonal() * R.transpose();
}

}  // namespace

void expectSameScene(const Scene& found, const Scene& expected) {
  expectSameBits(found.gravity, expected.gravity, "gravity");
  ASSERT_EQ(found.materials.size(), expected.materials.size());
  for (std::size_t i = 0; i < expected.materials.size(); ++i) {
    const Material &m = found.materials[i], &n = expected.materials[i];
    EXPECT_EQ(m.name, n.name);
    EXPECT_EQ(m.elasticity, n.elasticity);
    EXPECT_EQ(m.friction, n.friction);
    EXPECT_EQ(m.tangential_elasticity, n.tangential_elasticity);
    EXPECT_EQ(m.combine_elasticity, n.combine_elasticity);
    EXPECT_EQ(m.combine_friction, n.combine_friction);
  }
  ASSERT_EQ(found.bodies.size(), expected.bodies.size());
  for (std::size_t i = 0; i < expected.bodies.size(); ++i) expectSameBytes(found.bodies[i], expected.bodies[i]);
  ASSERT_EQ(found.tilts.size(), expected.tilts.size());
  for (std::size_t i = 0; i < expected.tilts.size(); ++i) {
    EXPECT_EQ(found.tilts[i].body, expected.tilts[i].body);
    EXPECT_EQ(found.tilts[i].impact, expected.tilts[i].impact);
    expectSameBits(found.tilts[i].value, expected.tilts[i].value, "tilt");
  }
}

void expectSameEdit(const Document& found, const Document& expected) {
  EXPECT_EQ(found.duration, expected.duration);
  // As text: a plain scene with the edit, so that `null` and ranges are compared as they are written.
  const auto text = [&](const Document& document) {
    Document edit = document;
    edit.scene = Scene{};
    edit.scene.materials = expected.scene.materials;
    for (const Body& body : expected.scene.bodies) {
      Body ball;
      ball.name = body.name, ball.mass = 1, ball.fixed = body.fixed;
      if (body.fixed) ball.mass.reset();
      edit.scene.bodies.push_back(ball);
    }
    return writeDocument(edit);
  };
  EXPECT_EQ(text(found), text(expected));
}

void expectSameBody(const Body& found, const Body& expected, double floats) {
  SCOPED_TRACE("body '" + expected.name + "'");
  const double tolerance = hasSurface(expected.shape) ? floats : 1e-13;
  EXPECT_EQ(found.fixed, expected.fixed);
  EXPECT_EQ(found.material, expected.material);
  EXPECT_EQ(found.shape.index(), expected.shape.index());
  const ShapeKind& kind = kindOf(expected.shape);
  if (kind.solid(expected.shape)) {
    ASSERT_TRUE(kindOf(found.shape).solid(found.shape));
    const SolidProperties a = kindOf(found.shape).properties(found.shape), b = kind.properties(expected.shape);
    expectEntries(a.volume, b.volume, tolerance, "volume", 0);
    expectEntries(a.center, b.center, tolerance, "centre of the shape");
    expectEntries(a.unit_inertia, b.unit_inertia, tolerance, "unit inertia");
  }
  expectEntries(found.position, expected.position, 1e-13, "position");
  expectEntries(found.orientation.toRotationMatrix(), expected.orientation.toRotationMatrix(), 1e-13, "orientation");
  EXPECT_EQ(found.kinematic, expected.kinematic);
  EXPECT_EQ(found.collision_filter, expected.collision_filter);
  expectEntries(found.surface_velocity, expected.surface_velocity, 1e-13, "surface velocity");
  expectEntries(found.surface_angular_velocity, expected.surface_angular_velocity, 1e-13, "surface angular velocity");
  if (expected.fixed) return;
  EXPECT_EQ(found.gravity_factor, expected.gravity_factor);
  expectEntries(found.velocity, expected.velocity, 1e-13, "velocity");
  expectEntries(found.angular_velocity, expected.angular_velocity, 1e-13, "angular velocity");
  const BodyModel a = modelOf(found), b = modelOf(expected);
  expectEntries(a.center, b.center, tolerance, "centre of mass");
  if (expected.kinematic) return;
  expectEntries(a.mass, b.mass, tolerance, "mass", 0);
  const Mat3 inertia = worldInertia(expected, b);
  expectEntries(worldInertia(found, a), inertia, tolerance, "inertia", inertia.cwiseAbs().maxCoeff());
}

}  // namespace carom::import_tests
