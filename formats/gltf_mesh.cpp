#include "formats/detail/gltf_mesh.hpp"

#include <cmath>
#include <numbers>
#include <variant>

namespace carom {
namespace {

constexpr int kMeridians = 32;  // multiples of 4 and 2: the accent changes at each quarter and at the equator
constexpr int kParallels = 16;

void addQuad(std::vector<std::uint32_t>& out, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  for (const std::uint32_t i : {a, b, c, a, c, d}) out.push_back(i);
}

// Four corners about `centre`, spanned by u and v with u x v outwards.
void addFace(TriangleMesh& mesh, const Vec3& centre, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 normal = u.cross(v).normalized();
  for (const Vec3& corner : {Vec3(-u - v), Vec3(u - v), Vec3(u + v), Vec3(-u + v)}) {
    mesh.positions.push_back(centre + corner);
    mesh.normals.push_back(normal);
  }
  addQuad(mesh.triangles, first, first + 1, first + 2, first + 3);
}

TriangleMesh sphereMesh(const Sphere& sphere) {
  TriangleMesh mesh;
  for (int i = 0; i <= kParallels; ++i)
    for (int j = 0; j <= kMeridians; ++j) {
      const double polar = std::numbers::pi * i / kParallels, turn = 2 * std::numbers::pi * j / kMeridians;
      const Vec3 n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      mesh.positions.push_back(sphere.radius * n);
      mesh.normals.push_back(n.normalized());
    }
  for (int i = 0; i < kParallels; ++i)
    for (int j = 0; j < kMeridians; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (kMeridians + 1) + j), b = a + kMeridians + 1;
      const bool accent = (j / (kMeridians / 4) + i / (kParallels / 2)) % 2 == 1;
      auto& out = accent ? mesh.accent : mesh.triangles;
      if (i + 1 < kParallels) out.insert(out.end(), {a, b, b + 1});  // at a pole one of the two has no area
      if (i > 0) out.insert(out.end(), {a, b + 1, a + 1});
    }
  return mesh;
}

TriangleMesh boxMesh(const Box& box) {
  TriangleMesh mesh;
  const Vec3 half = box.size / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Vec3 n = half[axis] * Vec3::Unit(axis), u = half[next] * Vec3::Unit(next), v = half[last] * Vec3::Unit(last);
    addFace(mesh, n, u, v);
    addFace(mesh, -n, v, u);
  }
  return mesh;
}

TriangleMesh planeMesh(double half_width) {
  TriangleMesh mesh;
  addFace(mesh, Vec3::Zero(), half_width * Vec3::UnitZ(), half_width * Vec3::UnitX());
  return mesh;
}

struct Mesher {
  double plane_half_width;
  TriangleMesh operator()(const Sphere& sphere) const { return sphereMesh(sphere); }
  TriangleMesh operator()(const Box& box) const { return boxMesh(box); }
  TriangleMesh operator()(const Plane&) const { return planeMesh(plane_half_width); }
};

}  // namespace

TriangleMesh meshOf(const Shape& shape, double plane_half_width) { return std::visit(Mesher{plane_half_width}, shape); }

}  // namespace carom
