// SPDX-License-Identifier: MIT
#include "tests/support/solids.h"

#include <cmath>
#include <map>
#include <numbers>

namespace carom::test {

Triangles Triangles::placed(const Quat& turn, const Vec3& move) const {
  Triangles result = *this;
  for (Vec3& v : result.vertices) v = move + turn * v;
  return result;
}

Triangles Triangles::with(const Triangles& other) const {
  Triangles result = *this;
  const int first = static_cast<int>(vertices.size());
  result.vertices.insert(result.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) result.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return result;
}

Triangles Triangles::insideOut() const {
  Triangles result = *this;
  for (auto& t : result.triangles) std::swap(t[1], t[2]);
  return result;
}

Triangles boxTriangles(const Vec3& size) {
  Triangles box;
  for (int i = 0; i < 8; ++i)
    box.vertices.push_back(0.5 * size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    box.triangles.push_back({a, b, c});
    box.triangles.push_back({a, c, d});
  }
  return box;
}

Triangles ballTriangles(double radius, int level) {
  const double g = std::numbers::phi;
  Triangles ball;
  ball.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  ball.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(ball.vertices.size()));
      if (is_new) {
        const Vec3 sum = ball.vertices[static_cast<std::size_t>(a)] + ball.vertices[static_cast<std::size_t>(b)];
        ball.vertices.push_back(sum.normalized());
      }
      return place->second;
    };
    for (Vec3& v : ball.vertices) v.normalize();
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : ball.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    ball.triangles = std::move(finer);
  }
  for (Vec3& v : ball.vertices) v = radius * v.normalized();
  return ball;
}

Triangles torusTriangles(double ring, double tube, int around, int across) {
  Triangles torus;
  const auto number = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const double r = ring + tube * std::cos(b);
      torus.vertices.push_back({r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
      torus.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      torus.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  return torus;
}

Triangles tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

}  // namespace carom::test
