#include "ode_bridge/features.h"

#include <limits>

namespace carom {
namespace {

// Vertex v of a box has coordinate +half on axis k where bit k of v is set; faces are -x, +x, -y, +y, -z, +z; edges
// 4 k + s run along axis k, with s the sign bits of the two axes after k.

double sign(int bit) { return bit ? 1.0 : -1.0; }

Feature boxVertex(const Vec3& half, int v) {
  Feature f;
  for (int k = 0; k < 3; ++k) {
    f.point[k] = sign(v >> k & 1) * half[k];
    f.dpoint(k, k) = 0.5 * sign(v >> k & 1);
  }
  return f;
}

Feature boxFace(const Vec3& half, int face) {
  Feature f;
  const int k = face / 2;
  f.direction[k] = sign(face % 2);
  f.point[k] = f.direction[k] * half[k];
  f.dpoint(k, k) = 0.5 * f.direction[k];
  return f;
}

Feature boxEdge(const Vec3& half, int edge) {
  Feature f;
  const int k = edge / 4;
  f.direction[k] = 1;
  for (int j = 0; j < 2; ++j) {
    const int axis = (k + 1 + j) % 3;
    f.point[axis] = sign(edge >> j & 1) * half[axis];
    f.dpoint(axis, axis) = 0.5 * sign(edge >> j & 1);
  }
  return f;
}

std::pair<int, int> boxEdgeVertices(int edge) {
  const int k = edge / 4;
  int v = 0;
  for (int j = 0; j < 2; ++j)
    if (edge >> j & 1) v |= 1 << ((k + 1 + j) % 3);
  return {v, v | 1 << k};
}

struct SolidMaker {
  Solid operator()(const Sphere& s) const {
    Solid solid;
    solid.ball = true;
    solid.radius = s.radius;
    Feature centre;
    centre.radius = s.radius;
    centre.dradius = Vec3::UnitX();
    solid.vertices.push_back(centre);
    return solid;
  }
  Solid operator()(const Box& b) const {
    Solid solid;
    solid.box = true;
    solid.half = 0.5 * b.size;
    solid.reach = solid.half.norm();
    for (int v = 0; v < 8; ++v) solid.vertices.push_back(boxVertex(solid.half, v));
    for (int f = 0; f < 6; ++f) solid.faces.push_back(boxFace(solid.half, f));
    for (int e = 0; e < 12; ++e) {
      solid.edges.push_back(boxEdge(solid.half, e));
      solid.edge_vertices.push_back(boxEdgeVertices(e));
    }
    return solid;
  }
  Solid operator()(const Plane& p) const {
    Solid solid;
    solid.plane = true;
    Feature face;
    face.direction = p.normal;
    face.point = p.offset * p.normal;
    solid.faces.push_back(face);
    return solid;
  }
};

}  // namespace

double Solid::bound() const { return plane ? std::numeric_limits<double>::infinity() : reach + radius; }

Solid solidOf(const Shape& shape) { return std::visit(SolidMaker{}, shape); }

}  // namespace carom
