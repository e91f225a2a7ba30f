// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/arguments.hpp"
#include "adjoint/scene/shape.h"

namespace carom::shapes {

using namespace adjoint_detail;

// The table of shapes: a row each, which stands with its formulas in the file of that name.
ShapeKind kindRow(KindOf<Sphere>);
ShapeKind kindRow(KindOf<Box>);
ShapeKind kindRow(KindOf<Plane>);
ShapeKind kindRow(KindOf<Capsule>);
ShapeKind kindRow(KindOf<Cylinder>);
ShapeKind kindRow(KindOf<Cone>);
ShapeKind kindRow(KindOf<Hull>);
ShapeKind kindRow(KindOf<Mesh>);
ShapeKind kindRow(KindOf<Compound>);

/// The shape as the kind that its row is for.
template <class Kind>
const Kind& as(const Shape& shape) {
  return std::get<Kind>(shape);
}

/// A vector of dimensions.
inline Eigen::VectorXd dimensionsOf(std::initializer_list<double> values) {
  Eigen::VectorXd d(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), d.data());
  return d;
}

/// Throws InputError unless there is a number for each dimension.
inline void requireDimensions(const Eigen::VectorXd& given, Eigen::Index count) {
  checkCount("dimensions of a shape", "numbers", static_cast<std::size_t>(given.size()), static_cast<std::size_t>(count));
}

inline Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

inline bool alwaysSolid(const Shape&) { return true; }

}  // namespace carom::shapes
