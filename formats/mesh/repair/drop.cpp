// SPDX-License-Identifier: MIT
// Triangles that are of no use, and those that lie on each other.
#include <algorithm>
#include <map>
#include <set>

#include "adjoint/numeric/union_find.hpp"
#include "adjoint/scene/polygons.hpp"
#include "formats/mesh/repair/loose_mesh.hpp"

namespace carom::mesh_repair {
namespace {

using Triangle = LooseMesh::Triangle;

/// From its least corner on, so that two are equal if they are one triangle and look the same way.
Triangle fromLeast(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}
Triangle turned(const Triangle& t) { return fromLeast({t[0], t[2], t[1]}); }

/// Two triangles on each other, the first written first, and the patch of such pairs that they belong to.
struct Pair {
  std::size_t first, second, patch;
};

std::vector<Pair> coveredPairs(const LooseMesh& mesh) {
  std::map<Triangle, std::size_t> known;
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto other = known.find(turned(mesh.triangles[t]));
    if (other != known.end()) {
      pairs.push_back({other->second, t, pairs.size()});
      known.erase(other);
    } else {
      known.emplace(fromLeast(mesh.triangles[t]), t);
    }
  }
  return pairs;
}

/// Where solids meet, the patch ends at their other triangles all around, two at each edge; a sheet has an edge of its own,
/// or ends nowhere, and one side of a solid that is drawn twice would leave a hole.
class Patches {
 public:
  Patches(const LooseMesh& mesh, std::vector<Pair>& pairs) : pairs_(pairs) {
    adjoint_detail::UnionFind patches(pairs.size());
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::size_t> pair_of(mesh.triangles.size(), kNone);
    for (std::size_t i = 0; i < pairs.size(); ++i) pair_of[pairs[i].first] = pair_of[pairs[i].second] = i;
    std::vector<std::size_t> free, joined;
    forEachEdge(edgeUses(mesh), [&](const std::vector<EdgeUse>& uses) {
      std::vector<std::size_t> here;
      std::size_t others = 0;
      for (const EdgeUse& use : uses) {
        const std::size_t pair = pair_of[static_cast<std::size_t>(use.half_edge / 3)];
        if (pair == kNone) ++others;
        else here.push_back(pair);
      }
      if (here.empty()) return;
      for (const std::size_t pair : here) patches.join(pair, here.front());
      if (others > 0) joined.push_back(here.front());
      if (others % 2 == 1 || (others == 0 && here.size() == 2)) free.push_back(here.front());
    });
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs_[i].patch = patches.find(i);
    is_free_.assign(pairs.size(), 0), is_joined_.assign(pairs.size(), 0);
    for (const std::size_t pair : free) is_free_[patches.find(pair)] = 1;
    for (const std::size_t pair : joined) is_joined_[patches.find(pair)] = 1;
  }

  bool isWall(const Pair& pair) const { return is_joined_[pair.patch] && !is_free_[pair.patch]; }

 private:
  std::vector<Pair>& pairs_;
  std::vector<char> is_free_, is_joined_;
};

}  // namespace

void dropUseless(LooseMesh& mesh, Repairs& repairs) {
  const std::vector<int> first = adjoint_detail::firstOfEqual(mesh.vertices);
  std::vector<char> kept(mesh.triangles.size(), 0);
  std::set<Triangle> known;
  CountedTriangles points, flat, twice;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    Triangle& corners = mesh.triangles[t];
    for (int& v : corners) v = first[static_cast<std::size_t>(v)];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      points.add(mesh.lines[t]);
    } else if (isFlat(mesh.at(corners[0]), mesh.at(corners[1]), mesh.at(corners[2]))) {
      flat.add(mesh.lines[t]);
    } else if (!known.insert(fromLeast(corners)).second) {
      twice.add(mesh.lines[t]);
    } else {
      kept[t] = 1;
    }
  }
  points.tell(repairs, "with two corners at one place dropped");
  flat.tell(repairs, "with corners on one line dropped");
  twice.tell(repairs, "written twice dropped");
  keepTriangles(mesh, kept);
}

void dropCovered(LooseMesh& mesh, Repairs& repairs) {
  std::vector<Pair> pairs = coveredPairs(mesh);
  if (pairs.empty()) return;
  const Patches patches(mesh, pairs);
  std::vector<char> kept(mesh.triangles.size(), 1);
  CountedTriangles walls, sheets;
  for (const Pair& pair : pairs) {
    kept[pair.second] = 0;
    if (patches.isWall(pair)) {
      kept[pair.first] = 0;
      walls.add(mesh.lines[pair.first]), walls.add(mesh.lines[pair.second]);
    } else {
      sheets.add(mesh.lines[pair.second]);
    }
  }
  walls.tell(repairs, "between solids that meet there dropped");
  sheets.tell(repairs, "covering others from behind dropped");
  keepTriangles(mesh, kept);
}

}  // namespace carom::mesh_repair
