#pragma once

#include "adjoint/shape.h"

namespace carom::shapes {

// One row of the table a shape; each stands with its formulas in the file of that name.
ShapeKind sphereKind();
ShapeKind boxKind();
ShapeKind planeKind();
ShapeKind capsuleKind();
ShapeKind cylinderKind();
ShapeKind hullKind();
ShapeKind meshKind();
ShapeKind compoundKind();

/// A vector of dimensions.
inline Eigen::VectorXd dimensionsOf(std::initializer_list<double> values) {
  Eigen::VectorXd d(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), d.data());
  return d;
}

inline Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

inline bool alwaysSolid(const Shape&) { return true; }

}  // namespace carom::shapes
