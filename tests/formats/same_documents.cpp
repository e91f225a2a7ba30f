// SPDX-License-Identifier: MIT
#include "tests/formats/same_documents.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <variant>

#include "formats/documents/scene_json.h"
#include "formats/json/json_writer.hpp"

namespace carom::formats_test {

using namespace formats_detail;

namespace {

template <class A, class B>
void expectSameNumbers(const A& a, const B& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (int i = 0; i < static_cast<int>(a.size()); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(static_cast<double>(a[i])),
              std::bit_cast<std::uint64_t>(static_cast<double>(b[i])))
        << where << " " << i << ": " << numberText(a[i]) << " " << numberText(b[i]);
}

void expectSameSurface(const Surface& a, const Surface& b, const std::string& where) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size()) << where;
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    expectSameNumbers(a.vertices[i], b.vertices[i], where + " vertex " + std::to_string(i));
  EXPECT_EQ(a.corners, b.corners) << where;
  EXPECT_EQ(a.faces.size(), b.faces.size()) << where;
}

void expectSameShape(const Shape& a, const Shape& b, const std::string& where) {
  ASSERT_EQ(a.index(), b.index()) << where;
  expectSameNumbers(kindOf(a).dimensions(a), kindOf(b).dimensions(b), where);
  if (const auto* plane = std::get_if<Plane>(&a)) {
    expectSameNumbers(plane->normal, std::get<Plane>(b).normal, where + " normal");
    EXPECT_EQ(plane->offset, std::get<Plane>(b).offset);
  } else if (const auto* hull = std::get_if<Hull>(&a)) {
    EXPECT_EQ(hull->file, std::get<Hull>(b).file);
    expectSameSurface(*hull->surface, *std::get<Hull>(b).surface, where);
  } else if (const auto* mesh = std::get_if<Mesh>(&a)) {
    EXPECT_EQ(mesh->file, std::get<Mesh>(b).file);
    expectSameSurface(*mesh->surface, *std::get<Mesh>(b).surface, where);
  } else if (const auto* compound = std::get_if<Compound>(&a)) {
    const auto& others = std::get<Compound>(b).parts;
    ASSERT_EQ(compound->parts.size(), others.size()) << where;
    for (std::size_t i = 0; i < others.size(); ++i) {
      const std::string part = where + " part " + std::to_string(i);
      expectSameShape(compound->parts[i].shape, others[i].shape, part);
      expectSameNumbers(compound->parts[i].position, others[i].position, part);
      expectSameNumbers(compound->parts[i].orientation.coeffs(), others[i].orientation.coeffs(), part);
    }
  }
}

void expectSameBody(const Body& a, const Body& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.fixed, b.fixed);
  EXPECT_EQ(a.kinematic, b.kinematic);
  EXPECT_EQ(a.gravity_factor, b.gravity_factor);
  EXPECT_EQ(a.collision_filter, b.collision_filter);
  EXPECT_EQ(a.material, b.material);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.notes, b.notes);
  expectSameShape(a.shape, b.shape, a.name + " shape");
  ASSERT_EQ(a.center_of_mass, b.center_of_mass);
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
  expectSameNumbers(a.surface_velocity, b.surface_velocity, a.name + " surface_velocity");
  expectSameNumbers(a.surface_angular_velocity, b.surface_angular_velocity, a.name + " surface_angular_velocity");
}

void expectSameLimits(const std::vector<TargetNumber>& a, const std::vector<TargetNumber>& b, const std::string& where) {
  ASSERT_EQ(a.size(), b.size()) << where;
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << where << " " << a[i] << " " << b[i];
}

void expectSameRegion(const Region& a, const Region& b) {
  EXPECT_EQ(a.side, b.side);
  ASSERT_EQ(a.shape.index(), b.shape.index());
  if (const auto* sphere = std::get_if<Sphere>(&a.shape)) {
    EXPECT_EQ(sphere->radius, std::get<Sphere>(b.shape).radius);
  } else {
    expectSameNumbers(std::get<Box>(a.shape).size, std::get<Box>(b.shape).size, "size of a region");
  }
  expectSameNumbers(a.position, b.position, "position of a region");
  expectSameNumbers(a.orientation.coeffs(), b.orientation.coeffs(), "orientation of a region");
  EXPECT_EQ(a.during, b.during);
  EXPECT_EQ(a.margin, b.margin);
  EXPECT_EQ(a.keep, b.keep);
}

}  // namespace

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
    EXPECT_EQ(m.notes, n.notes);
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

void expectSameDistribution(const Distribution& a, const Distribution& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* normal = std::get_if<NormalDistribution>(&a)) {
    const auto& other = std::get<NormalDistribution>(b);
    EXPECT_EQ(std::tie(normal->mean, normal->deviation, normal->factor), std::tie(other.mean, other.deviation, other.factor));
  } else if (const auto* log_normal = std::get_if<LogNormalDistribution>(&a)) {
    const auto& other = std::get<LogNormalDistribution>(b);
    EXPECT_EQ(std::tie(log_normal->median, log_normal->deviation, log_normal->factor),
              std::tie(other.median, other.deviation, other.factor));
  } else if (const auto* uniform = std::get_if<UniformDistribution>(&a)) {
    EXPECT_EQ(std::tie(uniform->from, uniform->to), std::tie(std::get<UniformDistribution>(b).from, std::get<UniformDistribution>(b).to));
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
    ASSERT_EQ(c.distribution.has_value(), d.distribution.has_value());
    if (c.distribution) expectSameDistribution(*c.distribution, *d.distribution);
    EXPECT_EQ(c.notes, d.notes);
  }
  ASSERT_EQ(a.constraints.size(), b.constraints.size());
  for (std::size_t i = 0; i < a.constraints.size(); ++i) {
    const Constraint &c = a.constraints[i], &d = b.constraints[i];
    EXPECT_EQ(c.body, d.body);
    EXPECT_EQ(c.at.time, d.at.time);
    EXPECT_EQ(c.at.impact, d.at.impact);
    EXPECT_EQ(c.at.with, d.at.with);
    EXPECT_EQ(c.at.span, d.at.span);
    EXPECT_EQ(c.at.rest, d.at.rest);
    EXPECT_EQ(c.relative_to, d.relative_to);
    EXPECT_EQ(c.notes, d.notes);
    ASSERT_EQ(c.targets.size(), d.targets.size());
    for (std::size_t k = 0; k < c.targets.size(); ++k) {
      EXPECT_EQ(c.targets[k].quantity, d.targets[k].quantity);
      EXPECT_EQ(c.targets[k].to, d.targets[k].to);
      EXPECT_EQ(c.targets[k].during, d.targets[k].during);
      ASSERT_EQ(c.targets[k].value.size(), d.targets[k].value.size());
      for (std::size_t n = 0; n < c.targets[k].value.size(); ++n) {
        const double x = c.targets[k].value[n], y = d.targets[k].value[n];
        EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y))) << x << " " << y;
      }
      expectSameNumbers(c.targets[k].body_point, d.targets[k].body_point, "body_point");
      expectSameLimits(c.targets[k].min, d.targets[k].min, "min");
      expectSameLimits(c.targets[k].max, d.targets[k].max, "max");
    }
    ASSERT_EQ(c.regions.size(), d.regions.size());
    for (std::size_t k = 0; k < c.regions.size(); ++k) expectSameRegion(c.regions[k], d.regions[k]);
  }
}

void expectRoundTrip(const Document& document, const std::string& name) {
  const std::string text = writeDocument(document);
  const Document again = parseDocument(text, name, document.folder);
  EXPECT_EQ(again.schema, document.schema);
  EXPECT_EQ(again.name, document.name);
  EXPECT_EQ(again.notes, document.notes);
  EXPECT_EQ(again.duration, document.duration);
  expectSameScene(document.scene, again.scene);
  expectSameEdit(document, again);
  EXPECT_EQ(writeDocument(again), text);
}

}  // namespace carom::formats_test
