// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>

#include "tests/reference/numbers.h"
#include "tests/reference/principal.h"

// Bodies made of balls, boxes, capsules, cylinders, hulls and meshes, of uniform density: what follows from their
// numbers, in 50 digits.

namespace carom::reference {

inline RMat diagonal(const RVec& d) { return {{axisVector(0, d[0]), axisVector(1, d[1]), axisVector(2, d[2])}}; }
inline RMat operator*(const Real& s, const RMat& a) { return {{s * a.column[0], s * a.column[1], s * a.column[2]}}; }

/// Mass properties in the axes of a shape, at density 1: J about the centre.
struct RealSolid {
  Real volume;
  RVec center;
  RMat J;
};

/// By the divergence theorem: tetrahedra that the origin spans with the triangles of a surface.
inline RealSolid solidOf(const Surface& surface) {
  RealSolid s;
  RMat second;  // integral of x x^T
  for (const Surface::Face& f : surface.faces) {
    const auto corner = [&](int i) {
      return RVec(surface.vertices[static_cast<std::size_t>(surface.corners[static_cast<std::size_t>(f.first + i)])]);
    };
    for (int i = 1; i + 1 < f.count; ++i) {
      const RVec a = corner(0), b = corner(i), c = corner(i + 1), sum = a + b + c;
      const Real V = dot(a, cross(b, c)) / 6;
      s.volume += V;
      s.center = s.center + V / 4 * sum;
      for (int j = 0; j < 3; ++j)
        second.column[j] = second.column[j] + (V / 20) * (a[j] * a + b[j] * b + c[j] * c + sum[j] * sum);
    }
  }
  s.center = (1 / s.volume) * s.center;
  Real trace = 0;
  for (int j = 0; j < 3; ++j) {
    second.column[j] = second.column[j] - s.volume * s.center[j] * s.center;
    trace += second.column[j][j];
  }
  for (int j = 0; j < 3; ++j) s.J.column[j] = axisVector(j, trace) - second.column[j];
  return s;
}

/// A part of a shape; `size` is radius; x, y, z; radius and height; or the scale of a surface.
struct PartNumbers {
  enum class Kind { ball, box, cylinder, capsule, cone, hull, mesh };
  Kind kind = Kind::ball;
  std::vector<Real> size;
  std::shared_ptr<const Surface> surface;
  RVec position;
  RMat orientation = RMat::identity();

  RealSolid solid() const {
    const Real pi = BodyNumbers::pi(), &a = size[0];
    if (surface && !surface->closed) return {1, RVec(), {}};  // mass and inertia are written
    if (surface) {
      const RealSolid one = solidOf(*surface);
      return {a * a * a * one.volume, position + orientation * (a * one.center),
              orientation * (a * a * a * a * a * one.J * transpose(orientation))};
    }
    Real V;
    RVec J;
    if (kind == Kind::ball) {
      V = 4 * pi / 3 * a * a * a;
      J = (V * 2 * a * a / 5) * RVec{1, 1, 1};
    } else if (kind == Kind::box) {
      const Real &b = size[1], &c = size[2];
      V = a * b * c;
      J = (V / 12) * RVec{b * b + c * c, a * a + c * c, a * a + b * b};
    } else if (kind == Kind::cone) {
      const Real &h = size[1], across = 3 * (4 * a * a + h * h) / 80;
      V = pi * a * a * h / 3;
      J = V * RVec{across, across, 3 * a * a / 10};
      return {V, position + orientation * RVec{0, 0, -h / 4}, orientation * (diagonal(J) * transpose(orientation))};
    } else {
      const Real &h = size[1], tube = pi * a * a * h, across = a * a / 4 + h * h / 12;
      V = tube;
      J = tube * RVec{across, across, a * a / 2};
      if (kind == Kind::capsule) {  // two half balls, their centres of mass 3/8 of the radius beyond the ends
        const Real ball = 4 * pi / 3 * a * a * a, out = h / 2 + 3 * a / 8, side = 83 * a * a / 320 + out * out;
        V += ball;
        J = J + ball * RVec{side, side, 2 * a * a / 5};
      }
    }
    return {V, position, orientation * (diagonal(J) * transpose(orientation))};
  }
};

inline PartNumbers partOf(const Shape& shape, const Vec3& position, const Quat& orientation) {
  PartNumbers p;
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    p.kind = PartNumbers::Kind::ball, p.size = {ball->radius};
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    p.kind = PartNumbers::Kind::box, p.size = {box->size.x(), box->size.y(), box->size.z()};
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    p.kind = PartNumbers::Kind::cylinder, p.size = {cylinder->radius, cylinder->height};
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    p.kind = PartNumbers::Kind::capsule, p.size = {capsule->radius, capsule->height};
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    p.kind = PartNumbers::Kind::cone, p.size = {cone->radius, cone->height};
  } else if (const auto* hull = std::get_if<Hull>(&shape)) {
    p.kind = PartNumbers::Kind::hull, p.size = {hull->scale}, p.surface = hull->surface;
  } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    p.kind = PartNumbers::Kind::mesh, p.size = {mesh->scale}, p.surface = mesh->surface;
  } else {
    throw std::invalid_argument("the reference knows no such part");
  }
  p.position = RVec(position);
  p.orientation = rotationOf(orientation);
  return p;
}

/// One body and what it flies in, as written.
struct WrittenNumbers {
  RVec gravity;
  Real elasticity, friction, tangential_elasticity;
  std::vector<PartNumbers> parts;
  bool has_density = false, inertia_derived = true;
  Real mass_or_density;
  RVec moments;             ///< unless derived, with their axes in the shape
  Real inertia_factor = 1;  ///< of a derived inertia
  RMat axes = RMat::identity();
  std::optional<RVec> center;
  RVec position, velocity, spin;
  RMat orientation = RMat::identity();

  RealSolid solid() const {
    std::vector<RealSolid> solids;
    RealSolid all;
    for (const PartNumbers& part : parts) {
      solids.push_back(part.solid());
      all.volume += solids.back().volume;
      all.center = all.center + solids.back().volume * solids.back().center;
    }
    all.center = (1 / all.volume) * all.center;
    for (const RealSolid& s : solids) {
      const RVec d = s.center - all.center;
      all.J = all.J + s.J;
      for (int j = 0; j < 3; ++j) all.J.column[j] = all.J.column[j] + s.volume * (dot(d, d) * axisVector(j) - d[j] * d);
    }
    return all;
  }
};

/// What moves: mass, centre and principal axes in the shape, principal moments.
struct RealModel {
  Real mass;
  RVec center;
  Principal principal;
};

inline RealModel modelOf(const WrittenNumbers& n) {
  const RealSolid solid = n.solid();
  RealModel m;
  m.mass = n.has_density ? n.mass_or_density * solid.volume : n.mass_or_density;
  m.center = n.center ? *n.center : solid.center;
  m.principal = n.inertia_derived ? principalOf((n.inertia_factor * m.mass / solid.volume) * solid.J)
                                  : Principal{n.moments, n.axes};
  return m;
}

inline WrittenNumbers writtenNumbers(const Scene& scene, const Body& body) {
  WrittenNumbers n;
  n.gravity = RVec(scene.gravity);
  const Material& m = materialOf(scene, body);
  n.elasticity = m.elasticity, n.friction = m.friction, n.tangential_elasticity = m.tangential_elasticity;
  if (const auto* compound = std::get_if<Compound>(&body.shape)) {
    for (const CompoundPart& part : compound->parts)
      n.parts.push_back(partOf(part.shape, part.position, part.orientation));
  } else {
    n.parts.push_back(partOf(body.shape, Vec3::Zero(), Quat::Identity()));
  }
  n.has_density = body.density.has_value();
  n.mass_or_density = n.has_density ? *body.density : body.mass.value();
  n.inertia_derived = body.inertia.source == Inertia::Source::derived;
  n.moments = RVec(body.inertia.moments);
  n.axes = rotationOf(body.inertia.axes);
  if (body.center_of_mass) n.center = RVec(*body.center_of_mass);
  n.position = RVec(body.position), n.velocity = RVec(body.velocity), n.spin = RVec(body.angular_velocity);
  n.orientation = rotationOf(body.orientation);
  return n;
}

}  // namespace carom::reference
