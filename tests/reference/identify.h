// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/gaps.h"

namespace carom::reference {

/// Distances and normals that differ by less are taken as equal when features are recognised [m or 1].
inline constexpr double kRecognise = 1e-6;

/// The part of a box on which a world point lies.
inline Feature featureAt(const Placed& box, const Vec3& point) {
  const Vec3 local = rounded(box.R).transpose() * (point - box.x.rounded());
  const Vec3 half = box.body->size.rounded() / 2;
  Feature f;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(std::abs(local[i]) - half[i]) < kRecognise) f.sign[i] = local[i] > 0 ? 1 : -1;
  }
  if (f.count() == 0) throw std::runtime_error("the contact point is not on the surface of the box");
  return f;
}

/// Whether a world normal is that of a face of the box; then that face.
inline bool isFaceNormal(const Placed& box, const Vec3& normal, Feature& face) {
  const Vec3 local = rounded(box.R).transpose() * normal;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(std::abs(local[i]) - 1) < kRecognise * kRecognise) {
      face = {};
      face.sign[i] = local[i] > 0 ? 1 : -1;
      return true;
    }
  }
  return false;
}

/// The features that touch at a point with a normal from b to a, by geometry in double.
inline Features identify(const Placed& A, const Placed& B, const Vec3& point, const Vec3& normal) {
  using Kind = BodyNumbers::Kind;
  const Kind a = A.body->kind, b = B.body->kind;
  if (a > b) {
    const Features f = identify(B, A, point, -normal);
    return {f.b, f.a, f.side};
  }
  Features f;
  if (b == Kind::sphere) return f;
  if (a == Kind::sphere) {
    if (b == Kind::box) f.b = featureAt(B, point);
    return f;
  }
  f.a = featureAt(A, point);
  if (b == Kind::plane) {
    if (f.a.count() != 3) throw std::runtime_error("a box meets a plane with something else than a vertex");
    return f;
  }
  f.b = featureAt(B, point);
  Feature face;
  const bool face_a = isFaceNormal(A, -normal, face);
  if (face_a) f.a = face;
  const bool face_b = isFaceNormal(B, normal, face);
  if (face_b) f.b = face;
  if (face_a && face_b) throw std::runtime_error("two boxes meet face to face");
  if (f.a.count() == 2 && f.b.count() == 2) {
    f.side = A.edgeDirection(f.a).rounded().cross(B.edgeDirection(f.b).rounded()).dot(normal) > 0 ? 1 : -1;
  }
  return f;
}

}  // namespace carom::reference
