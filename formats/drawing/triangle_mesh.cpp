// SPDX-License-Identifier: MIT
#include "formats/drawing/triangle_mesh.hpp"

#include <cmath>
#include <numbers>

#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {
namespace {

constexpr int kMeridians = 32;  // multiples of 4 and 2: the accent changes at each quarter and at the equator
constexpr int kParallels = 16;

void addQuad(std::vector<std::uint32_t>& out, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  for (const std::uint32_t i : {a, b, c, a, c, d}) out.push_back(i);
}

}  // namespace

void addFace(TriangleMesh& mesh, const Vec3& centre, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 normal = u.cross(v).normalized();
  for (const Vec3& corner : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(-u + v)}) {
    mesh.positions.push_back(centre + corner);
    mesh.normals.push_back(normal);
  }
  addQuad(mesh.triangles, first, first + 1, first + 2, first + 3);
}

TriangleMesh revolved(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  for (const Ring& ring : rings)
    for (int j = 0; j <= kMeridians; ++j) {
      const double turn = 2 * std::numbers::pi * (j % kMeridians) / kMeridians;
      const double c = std::cos(turn), s = std::sin(turn);
      mesh.positions.emplace_back(ring.radius * c, ring.radius * s, ring.z);
      mesh.normals.push_back(Vec3(ring.normal.x() * c, ring.normal.x() * s, ring.normal.y()).normalized());
    }
  const double middle = 0.5 * (rings.front().z + rings.back().z);
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const Ring &upper = rings[i], &lower = rings[i + 1];
    if (upper.radius == lower.radius && upper.z == lower.z) continue;
    const int half = 0.5 * (upper.z + lower.z) > middle ? 0 : 1;
    for (int j = 0; j < kMeridians; ++j) {
      const auto a = static_cast<std::uint32_t>(static_cast<int>(i) * (kMeridians + 1) + j), b = a + kMeridians + 1;
      auto& out = (j / (kMeridians / 4) + half) % 2 == 1 ? mesh.accent : mesh.triangles;
      if (lower.radius > 0) out.insert(out.end(), {a, b, b + 1});  // at a pole one of the two has no area
      if (upper.radius > 0) out.insert(out.end(), {a, b + 1, a + 1});
    }
  }
  return mesh;
}

void addHalfBall(std::vector<Ring>& rings, double radius, double centre, bool top) {
  constexpr int kHalf = kParallels / 2;
  for (int i = 0; i <= kHalf; ++i) {
    const double polar = 0.5 * std::numbers::pi * (top ? i : i + kHalf) / kHalf;
    const bool pole = i == (top ? 0 : kHalf);
    const Vec2 normal(pole ? 0 : std::sin(polar), std::cos(polar));
    rings.push_back({radius * normal.x(), centre + radius * normal.y(), normal});
  }
}

TriangleMesh surfaceMesh(const Surface& surface, double scale) {
  TriangleMesh mesh;
  addSurface(mesh, surface, scale);
  return mesh;
}

void append(TriangleMesh& whole, const TriangleMesh& part, const Vec3& x, const Quat& q) {
  const auto first = static_cast<std::uint32_t>(whole.positions.size());
  for (const Vec3& p : part.positions) whole.positions.push_back(x + q * p);
  for (const Vec3& n : part.normals) whole.normals.push_back(q * n);
  for (const std::uint32_t i : part.triangles) whole.triangles.push_back(first + i);
  for (const std::uint32_t i : part.accent) whole.accent.push_back(first + i);
}

TriangleMesh meshOf(const Shape& shape, double plane_half_width) {
  return shapes::formatOf(shape).mesh(shape, plane_half_width);
}

}  // namespace carom::formats_detail
