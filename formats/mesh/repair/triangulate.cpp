// SPDX-License-Identifier: MIT
#include "formats/mesh/repair/triangulate.hpp"

#include <limits>

#include "formats/mesh/repair/loose_mesh.hpp"

namespace carom::mesh_repair {
namespace {

/// Least area of what corners i to j and the line between them bound, for ever longer runs of corners.
class LeastArea {
 public:
  explicit LeastArea(const std::vector<Vec3>& polygon)
      : p_(polygon), n_(polygon.size()), least_(n_ * n_, 0), middle_(n_ * n_, 0) {
    for (std::size_t length = 2; length < n_; ++length)
      for (std::size_t i = 0; i + length < n_; ++i) findMiddle(i, i + length);
  }

  bool exists() const { return least_[n_ - 1] < std::numeric_limits<double>::infinity(); }

  void collect(std::vector<std::array<int, 3>>& out) const {
    std::vector<std::array<std::size_t, 2>> runs{{0, n_ - 1}};
    while (!runs.empty()) {
      const auto [i, j] = runs.back();
      runs.pop_back();
      if (j - i < 2) continue;
      const std::size_t m = middle_[i * n_ + j];
      out.push_back({static_cast<int>(i), static_cast<int>(m), static_cast<int>(j)});
      runs.push_back({i, m});
      runs.push_back({m, j});
    }
  }

 private:
  void findMiddle(std::size_t i, std::size_t j) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t m = i + 1; m < j; ++m) {
      const double rest = least_[i * n_ + m] + least_[m * n_ + j];
      if (!(rest < best) || isFlat(p_[i], p_[m], p_[j])) continue;
      const double area = rest + 0.5 * (p_[m] - p_[i]).cross(p_[j] - p_[i]).norm();
      if (area < best) best = area, middle_[i * n_ + j] = m;
    }
    least_[i * n_ + j] = best;
  }

  const std::vector<Vec3>& p_;
  std::size_t n_;
  std::vector<double> least_;
  std::vector<std::size_t> middle_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(const std::vector<Vec3>& polygon) {
  std::vector<std::array<int, 3>> triangles;
  if (polygon.size() < 3 || polygon.size() > kMostTriangulated) return triangles;
  const LeastArea least(polygon);
  if (least.exists()) least.collect(triangles);
  return triangles;
}

}  // namespace carom::mesh_repair
