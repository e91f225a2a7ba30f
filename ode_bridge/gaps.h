#pragma once

#include "adjoint/contact_source.h"
#include "ode_bridge/features.h"

namespace carom {

/// Rows of the table of gaps. The first feature of a pair is body a's; "swapped" rows are the same gap seen from b.
enum GapKind : std::int16_t {
  kPointPlane,
  kPlanePoint,
  kPointPoint,
  kPointEdge,
  kEdgePoint,
  kEdgeEdge,
};

/// A feature placed in the world.
struct WorldFeature {
  Vec3 point, direction;
  double radius;
};

/// d(gap, normal, point) by (point, direction, radius of the first feature; the same of the second).
using FeatureJacobian = Eigen::Matrix<double, 7, 14>;

/// Smooth gaps between frozen features, one row a kind of pair:
///   point-plane  phi = N.(P - Q) - r,            n = N,                         p = P - r n
///   point-point  phi = |P - Q| - r_1 - r_2,      n = (P - Q)/|P - Q|,           p = Q + r_2 n
///   point-edge   phi = |w| - r_1 - r_2,          n = w/|w|, w = (1 - d d^T)(P - Q),   p = P - r_1 n
///   edge-edge    phi = n.(Q_1 - Q_2) - r_1 - r_2, n = +-(d_1 x d_2)/|d_1 x d_2|,  p = nearest point of edge 2, + r_2 n
class FeatureGeometry final : public ContactGeometry {
 public:
  explicit FeatureGeometry(std::vector<Solid> solids) : solids_(std::move(solids)) {}

  ContactPoint contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override;
  ContactJacobian jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override;
  std::string describe(int a, int b, const FeaturePair& f) const override;

  const Solid& solid(int body) const { return solids_[static_cast<std::size_t>(body)]; }
  const std::vector<Solid>& solids() const { return solids_; }

 private:
  std::vector<Solid> solids_;
};

}  // namespace carom
