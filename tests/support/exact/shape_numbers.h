// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/scene/shape.h"
#include "tests/support/exact/vector.h"

namespace carom::exact {

/// A shape's numbers in the arithmetic T. `size` holds its dimensions in the order of ShapeKind::dimension_names (those
/// of a compound are its parts'). Of a surface only vertices and corners are read.
template <class T>
struct ShapeNumbers {
  enum class Kind { sphere, box, plane, capsule, cylinder, hull, mesh, compound };  // the order of `Shape`
  struct Part;

  Kind kind = Kind::sphere;
  std::vector<T> size;
  Vec<T> plane_normal;
  T plane_offset = 0;
  std::shared_ptr<const Surface> surface;
  std::vector<Part> parts;

  int dimensions() const {
    int n = static_cast<int>(size.size());
    for (const Part& p : parts) n += p.shape.dimensions();
    return n;
  }
  T& dimension(int i) {
    for (Part& p : parts) {
      if (i < p.shape.dimensions()) return p.shape.dimension(i);
      i -= p.shape.dimensions();
    }
    return size.at(i);
  }
};
template <class T>
struct ShapeNumbers<T>::Part {
  ShapeNumbers<T> shape;
  Vec<T> position;
  Mat<T> R;  ///< part to compound
};

template <class T>
ShapeNumbers<T> numbersOf(const Shape& shape) {
  ShapeNumbers<T> n;
  n.kind = static_cast<typename ShapeNumbers<T>::Kind>(shape.index());
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    n.size = {T(sphere->radius)};
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    n.size = {T(box->size.x()), T(box->size.y()), T(box->size.z())};
  } else if (const auto* plane = std::get_if<Plane>(&shape)) {
    n.plane_normal = unit(Vec<T>(plane->normal));
    n.plane_offset = plane->offset;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    n.size = {T(capsule->radius), T(capsule->height)};
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    n.size = {T(cylinder->radius), T(cylinder->height)};
  } else if (const auto* hull = std::get_if<Hull>(&shape)) {
    n.size = {T(hull->scale)}, n.surface = hull->surface;
  } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
    n.size = {T(mesh->scale)}, n.surface = mesh->surface;
  } else {
    for (const CompoundPart& part : std::get<Compound>(shape).parts)
      n.parts.push_back({numbersOf<T>(part.shape), Vec<T>(part.position), rotationOf<T>(part.orientation)});
  }
  return n;
}

/// Volume, and its first and second moments (integrals of x and x x^T) about the shape's origin.
template <class T>
struct Integrals {
  T volume = 0;
  Vec<T> first;
  Mat<T> second;

  Vec<T> center() const { return (1 / volume) * first; }
  /// Inertia about the centre, per unit mass.
  Mat<T> unitInertia() const {
    const Mat<T> covariance = (1 / volume) * second - outer(center(), center());
    return trace(covariance) * Mat<T>::identity() - covariance;
  }
};

template <class T>
T piOf() {
  using std::acos;
  return acos(T(-1));
}

namespace detail {

template <class T>
Mat<T> diagonal(const T& x, const T& y, const T& z) {
  return {{unitVector<T>(0, x), unitVector<T>(1, y), unitVector<T>(2, z)}};
}

/// Of the solid inside a surface at scale 1: tetrahedra that the origin spans with its faces.
template <class T>
Integrals<T> surfaceIntegrals(const Surface& s) {
  Integrals<T> sum;
  for (const Surface::Face& face : s.faces) {
    const auto corner = [&](int i) { return Vec<T>(s.vertices[s.corners[face.first + i]]); };
    for (int i = 1; i + 1 < face.count; ++i) {
      const Vec<T> a = corner(0), b = corner(i), c = corner(i + 1), all = a + b + c;
      const T volume = dot(a, cross(b, c)) / 6;
      sum.volume += volume;
      sum.first = sum.first + (volume / 4) * all;
      sum.second = sum.second + (volume / 20) * (outer(a, a) + outer(b, b) + outer(c, c) + outer(all, all));
    }
  }
  return sum;
}

/// The integrals do not change while a scale does, and are dear in many digits.
template <class T>
const Integrals<T>& knownIntegrals(const std::shared_ptr<const Surface>& surface) {
  static std::vector<std::pair<std::shared_ptr<const Surface>, Integrals<T>>> known;
  for (const auto& entry : known) {
    if (entry.first == surface) return entry.second;
  }
  if (known.size() > 64) known.clear();
  known.emplace_back(surface, surfaceIntegrals<T>(*surface));
  return known.back().second;
}

}  // namespace detail

template <class T>
Integrals<T> integralsOf(const ShapeNumbers<T>& n) {
  using Kind = typename ShapeNumbers<T>::Kind;
  using detail::diagonal;
  const std::vector<T>& s = n.size;
  const T pi = piOf<T>();
  switch (n.kind) {
    case Kind::sphere: {
      const T V = pi * 4 / 3 * s[0] * s[0] * s[0], m = V * s[0] * s[0] / 5;
      return {V, {}, diagonal<T>(m, m, m)};
    }
    case Kind::box: {
      const T V = s[0] * s[1] * s[2], f = V / 12;
      return {V, {}, diagonal<T>(f * s[0] * s[0], f * s[1] * s[1], f * s[2] * s[2])};
    }
    case Kind::plane:
      return {};
    case Kind::capsule: {
      // the balls' halves, whose moments about their flat side are those of half a ball: centre at 3r/8
      const T r = s[0], h = s[1], tube = pi * r * r * h, ball = pi * 4 / 3 * r * r * r;
      const T x = tube * r * r / 4 + ball * r * r / 5;
      const T z = tube * h * h / 12 + ball * (r * r / 5 + h * h / 4 + h * r * 3 / 8);
      return {tube + ball, {}, diagonal<T>(x, x, z)};
    }
    case Kind::cylinder: {
      const T r = s[0], h = s[1], V = pi * r * r * h;
      return {V, {}, diagonal<T>(V * r * r / 4, V * r * r / 4, V * h * h / 12)};
    }
    case Kind::hull:
    case Kind::mesh: {
      const Integrals<T>& one = detail::knownIntegrals<T>(n.surface);
      const T cube = s[0] * s[0] * s[0];
      return {cube * one.volume, (cube * s[0]) * one.first, (cube * s[0] * s[0]) * one.second};
    }
    case Kind::compound:
      break;
  }
  Integrals<T> sum;
  for (const auto& part : n.parts) {
    const Integrals<T> own = integralsOf(part.shape);
    const Vec<T> turned = part.R * own.first;
    sum.volume += own.volume;
    sum.first = sum.first + turned + own.volume * part.position;
    sum.second = sum.second + part.R * own.second * transpose(part.R) + outer(turned, part.position) +
                 outer(part.position, turned) + own.volume * outer(part.position, part.position);
  }
  return sum;
}

}  // namespace carom::exact
