#include "ode_bridge/features.h"

#include <limits>

#include "adjoint/errors.h"

namespace carom {
namespace {

// Vertex v of a box has coordinate +half on axis k where bit k of v is set; faces are -x, +x, -y, +y, -z, +z; edges
// 4 k + s run along axis k, with s the sign bits of the two axes after k.

Feature blank(int dimensions) {
  Feature f;
  f.dpoint.setZero(3, dimensions);
  f.dradius.setZero(dimensions);
  return f;
}

double sign(int bit) { return bit ? 1.0 : -1.0; }

Feature boxVertex(const Vec3& half, int v) {
  Feature f = blank(3);
  for (int k = 0; k < 3; ++k) {
    f.point[k] = sign(v >> k & 1) * half[k];
    f.dpoint(k, k) = 0.5 * sign(v >> k & 1);
  }
  return f;
}

Feature boxFace(const Vec3& half, int face) {
  Feature f = blank(3);
  const int k = face / 2;
  f.direction[k] = sign(face % 2);
  f.point[k] = f.direction[k] * half[k];
  f.dpoint(k, k) = 0.5 * f.direction[k];
  return f;
}

Feature boxEdge(const Vec3& half, int edge) {
  Feature f = blank(3);
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
    Feature centre = blank(1);
    centre.radius = s.radius;
    centre.dradius[0] = 1;
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
    Feature face = blank(0);
    face.direction = p.normal;
    face.point = p.offset * p.normal;
    solid.faces.push_back(face);
    return solid;
  }
  template <class Other>
  Solid operator()(const Other&) const {
    throw InputError("/bodies", "found a shape without collision geometry, expected a sphere, box or plane");
  }
};

}  // namespace

double Solid::bound() const { return plane ? std::numeric_limits<double>::infinity() : reach + radius; }

Solid solidOf(const Shape& shape) { return std::visit(SolidMaker{}, shape); }

}  // namespace carom
