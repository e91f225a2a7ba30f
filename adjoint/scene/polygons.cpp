// SPDX-License-Identifier: MIT
#include "adjoint/scene/polygons.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adjoint/base/refuse.hpp"

namespace carom::adjoint_detail {

void checkCoordinates(const std::vector<Vec3>& points, const char* item) {
  constexpr double kLargest = 1e9;  // m, as for every number of a scene
  for (std::size_t i = 0; i < points.size(); ++i)
    for (double x : points[i])
      if (!(std::abs(x) <= kLargest))
        refuse(item + (" " + std::to_string(i)), "found ", x,
               ", expected a finite coordinate of magnitude at most 1e9");
}

std::vector<int> firstOfEqual(const std::vector<Vec3>& points) {
  const auto at = [&](int i) -> const Vec3& { return points[static_cast<std::size_t>(i)]; };
  std::vector<int> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (at(a)[k] != at(b)[k]) return at(a)[k] < at(b)[k];
    return a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && at(order[i]) == at(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

std::vector<Vec3> keepUsed(Polygons& polygons, const std::vector<Vec3>& points) {
  std::vector<int> place(points.size(), -1);
  for (const auto& polygon : polygons)
    for (int v : polygon) place[static_cast<std::size_t>(v)] = 0;
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (place[i] == 0) place[i] = static_cast<int>(kept.size()), kept.push_back(points[i]);
  for (auto& polygon : polygons)
    for (int& v : polygon) v = place[static_cast<std::size_t>(v)];
  return kept;
}

std::vector<HalfEdge> halfEdges(const Polygons& polygons) {
  std::vector<HalfEdge> halves;
  for (std::size_t f = 0; f < polygons.size(); ++f)
    for (std::size_t i = 0; i < polygons[f].size(); ++i) {
      const int from = polygons[f][i], to = polygons[f][(i + 1) % polygons[f].size()];
      halves.push_back({std::min(from, to), std::max(from, to), static_cast<int>(f), from < to});
    }
  std::stable_sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  return halves;
}

}  // namespace carom::adjoint_detail
