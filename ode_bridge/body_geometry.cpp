// SPDX-License-Identifier: MIT
#include "adjoint/motion/body_geometry.h"

#include "adjoint/base/arguments.hpp"
#include "ode_bridge/feature_limits.hpp"
#include "ode_bridge/gaps.hpp"
#include "ode_bridge/overlap.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

double FeatureGeometry::boundingRadius(int body) const {
  return solids_[checkedIndex("boundingRadius", "body", body, solids_.size())].bound();
}

double FeatureGeometry::overlap(int a, int b, const Pose& A, const Pose& B) const {
  for (int body : {a, b}) checkedIndex("overlap", "body", body, solids_.size());
  return overlapOf(Placed(solid(a), A.x, A.R), Placed(solid(b), B.x, B.R), 0).value_or(0);
}

std::vector<FeatureLimit> FeatureGeometry::limits(int a, int b, const FeaturePair& f, const Pose& A,
                                                  const Pose& B) const {
  std::vector<FeatureLimit> limits;
  const Vec3 point = contact(a, b, f, A, B).point;
  const auto kind = static_cast<GapKind>(f.kind);
  addFeatureLimits(solid(a), familyOfFirst(kind), f.a, A.R.transpose() * (point - A.x), -1, a, limits);
  addFeatureLimits(solid(b), familyOfSecond(kind), f.b, B.R.transpose() * (point - B.x), 1, b, limits);
  return limits;
}

}  // namespace carom
