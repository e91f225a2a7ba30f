// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::ode_bridge_detail {

/// The point, line, plane or space that points span. What is off it by a billionth of the size lies in it.
class AffineSpan {
 public:
  explicit AffineSpan(double size = 1) : size_(size) {}

  void add(const Vec3& p) {
    if (!origin_) {
      origin_ = p;
      return;
    }
    if (const Vec3 rest = across(p); rest.norm() > kSame * size_) basis_.push_back(rest.normalized());
  }
  bool contains(const Vec3& p) const { return origin_ && across(p).norm() <= kSame * size_; }
  bool isPlane() const { return basis_.size() >= 2; }
  const Vec3& origin() const { return *origin_; }  ///< the first point

 private:
  static constexpr double kSame = 1e-9;

  Vec3 across(const Vec3& p) const {
    Vec3 rest = p - *origin_;
    for (const Vec3& e : basis_) rest -= e.dot(rest) * e;
    return rest;
  }

  double size_;  // m
  std::optional<Vec3> origin_;
  std::vector<Vec3> basis_;  // orthonormal
};

}  // namespace carom::ode_bridge_detail
