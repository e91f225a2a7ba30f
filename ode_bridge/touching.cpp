#include <cmath>

#include "ode_bridge/first_impact.h"

namespace carom {
namespace {

Vec3 vertexOf(const Placed& p, std::size_t v) { return p.k.x + p.k.R * p.solid->vertices[v].point; }

// Vertices of `a` that touch the surface of box `b`, each with the face it is nearest to.
template <class Add>
void verticesOnBox(const Placed& a, const Placed& b, double tolerance, const Add& add) {
  for (std::size_t v = 0; v < a.solid->vertices.size(); ++v) {
    const Vec3 y = b.k.R.transpose() * (vertexOf(a, v) - b.k.x);
    int axis;
    const double depth = (y.cwiseAbs() - b.solid->half).maxCoeff(&axis);
    if (std::abs(depth) <= tolerance) add(static_cast<int>(v), 2 * axis + (y[axis] > 0 ? 1 : 0));
  }
}

// Edges of a solid with both ends within tolerance of its furthest extent along a direction.
std::vector<int> frontEdges(const Placed& p, const Vec3& direction, double tolerance) {
  double furthest = -1e300;
  std::vector<double> along(p.solid->vertices.size());
  for (std::size_t v = 0; v < along.size(); ++v) {
    along[v] = direction.dot(vertexOf(p, v));
    furthest = std::max(furthest, along[v]);
  }
  std::vector<int> edges;
  for (std::size_t e = 0; e < p.solid->edge_vertices.size(); ++e) {
    const auto [v, w] = p.solid->edge_vertices[e];
    if (along[static_cast<std::size_t>(v)] >= furthest - tolerance &&
        along[static_cast<std::size_t>(w)] >= furthest - tolerance)
      edges.push_back(static_cast<int>(e));
  }
  return edges;
}

// Edges that cross strictly inside both.
bool crossInside(const Placed& a, const Placed& b, int edge_a, int edge_b, const Vec3& n, std::int16_t& sign) {
  const Feature &fa = a.solid->edges[static_cast<std::size_t>(edge_a)],
                &fb = b.solid->edges[static_cast<std::size_t>(edge_b)];
  const Vec3 d1 = a.k.R * fa.direction, d2 = b.k.R * fb.direction, c = d1.cross(d2);
  const double s2 = c.squaredNorm();
  if (s2 < 1e-12) return false;  // parallel edges touch along a line: their vertices carry the contact
  const Vec3 w = a.k.x + a.k.R * fa.point - b.k.x - b.k.R * fb.point;
  const double t1 = -w.dot(d2.cross(c)) / s2, t2 = -w.dot(d1.cross(c)) / s2;
  sign = c.dot(n) >= 0 ? 1 : -1;
  return std::abs(t1) < a.solid->half[edge_a / 4] && std::abs(t2) < b.solid->half[edge_b / 4];
}

}  // namespace

std::vector<FeaturePair> touchingFeatures(const Placed& a, const Placed& b, const Witness& witness, double tolerance) {
  std::vector<FeaturePair> found;
  const auto add = [&](int kind, int fa, int fb, int sign = 1) {
    found.push_back({static_cast<std::int16_t>(kind), fa, fb,
                     static_cast<std::int16_t>(sign)});
  };
  if (a.solid->box && b.solid->plane) {
    const double height = witness.n.dot(b.k.x) + b.solid->faces[0].point.dot(b.solid->faces[0].direction);
    for (std::size_t v = 0; v < a.solid->vertices.size(); ++v)
      if (witness.n.dot(vertexOf(a, v)) - height <= tolerance) add(kPointPlane, static_cast<int>(v), 0);
  } else if (a.solid->plane && b.solid->box) {
    const double height = -witness.n.dot(a.k.x) + a.solid->faces[0].point.dot(a.solid->faces[0].direction);
    for (std::size_t v = 0; v < b.solid->vertices.size(); ++v)
      if (-witness.n.dot(vertexOf(b, v)) - height <= tolerance) add(kPlanePoint, 0, static_cast<int>(v));
  } else if (a.solid->box && b.solid->box) {
    verticesOnBox(a, b, tolerance, [&](int v, int face) { add(kPointPlane, v, face); });
    verticesOnBox(b, a, tolerance, [&](int v, int face) { add(kPlanePoint, face, v); });
    for (int ea : frontEdges(a, -witness.n, tolerance))
      for (int eb : frontEdges(b, witness.n, tolerance))
        if (std::int16_t sign; crossInside(a, b, ea, eb, witness.n, sign)) add(kEdgeEdge, ea, eb, sign);
  }
  if (found.empty()) found.push_back(witness.features);
  return found;
}

}  // namespace carom
