#pragma once

#include <string>
#include <vector>

#include "adjoint/scene.h"

namespace carom {

/// A vertex, edge or face of a shape, in the shape's axes, and its change with the shape's dimensions. Features are
/// swept by a ball of `radius`: a sphere is a vertex with a radius, a box has radius 0.
struct Feature {
  Vec3 point = Vec3::Zero();      ///< the vertex, the middle of the edge, a point of the face
  Vec3 direction = Vec3::Zero();  ///< unit: along the edge, or out of the face; 0 for a vertex
  double radius = 0;
  Eigen::Matrix3Xd dpoint;      ///< d point / d dimensions
  Eigen::RowVectorXd dradius;   ///< d radius / d dimensions
};

/// A convex solid (or half space) by its features: exact double geometry beside the collision library's.
struct Solid {
  std::vector<Feature> vertices, edges, faces;
  std::vector<std::pair<int, int>> edge_vertices;  ///< ends of each edge
  Vec3 half = Vec3::Zero();                        ///< box: half the size
  double radius = 0;                               ///< swept radius of all features
  double reach = 0;                                ///< largest distance of a vertex from the origin, without the radius
  bool ball = false, box = false, plane = false;

  /// Bounding radius about the origin; infinite for a plane.
  double bound() const;
};

Solid solidOf(const Shape& shape);

}  // namespace carom
