// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/body_distance.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/rim_geometry.hpp"
#include "ode_bridge/solids/solid.hpp"

namespace carom::ode_bridge_detail {

/// Rows of the table of gaps. The first feature of a pair is body a's. A vertex, an edge, a face and a rim are called
/// point, edge, plane and rim; "swapped" rows are the same gap seen from b.
enum GapKind : std::int16_t {
  kPointPlane,
  kPlanePoint,
  kPointPoint,
  kPointEdge,
  kEdgePoint,
  kEdgeEdge,
  kRimPlane,
  kPlaneRim,
  kRimPoint,
  kPointRim,
  kRimEdge,
  kEdgeRim,
  kRimRim,
};
constexpr int kGapKinds = 13;

/// A feature placed in the world; members as in Feature.
struct WorldFeature {
  Vec3 point, direction;
  double radius;
  double rim;
  double apex = 0;
};

inline WorldFeature placeFeature(const Feature& f, const Pose& pose) {
  return {pose.x + pose.R * f.point, pose.R * f.direction, f.radius, f.rim, f.apex};
}

/// Whether two features of these families have a gap in which neither hides the other; faces meet what lies before
/// them, and never an edge or a face.
bool hasKind(Family a, Family b);
/// The row for features of body a and body b of these families. Only where hasKind.
GapKind gapKind(Family a, Family b);
Family familyOfFirst(GapKind kind);
Family familyOfSecond(GapKind kind);
/// How many values |FeaturePair::sign| takes: 2 where a pair of features may come near in two places, else 1.
int branches(GapKind kind);

/// The gap of two frozen features, the first of body a and the second of body b. Smooth as long as the features stay
/// in general position. P or C is the point of a feature, d its direction, r its swept radius, rho the radius of a rim;
/// n points from the second to the first, and swapped rows return it turned about.
///   point-plane  phi = N.(P - Q) - r,             n = N,                           p = P - r n
///   point-point  phi = |P - Q| - r_1 - r_2,       n = (P - Q)/|P - Q|,             p = Q + r_2 n
///   point-edge   phi = |w| - r_1 - r_2,           n = w/|w|, w = (1 - d d^T)(P - Q), p = P - r_1 n
///   edge-edge    phi = n.(Q_1 - Q_2) - r_1 - r_2, n = +-(d_1 x d_2)/|d_1 x d_2|,
///                                                 p = nearest point of edge 2, + r_2 n
///   rim-plane    phi = N.(C - Q) - rho |d x N|,   n = N,
///                                                 p = C - rho (N - d d.N)/|N - d d.N|
///   rim-point    phi = |w| - r,  w = p - P,       n = w/|w|,
///                                                 p = C + rho (1 - d d^T)(P - C)/|(1 - d d^T)(P - C)|
///   rim-edge, rim-rim: w = p - p_2 where p on the first and p_2 on the second are nearest, so that w.t_1 = w.t_2 = 0
///     of the tangents t = d x (p - C)/rho of a rim and t = d of an edge;
///     sharp edge, rim  phi = n.w,      n = +-(t_1 x t_2)/|t_1 x t_2|
///     swept edge       phi = |w| - r,  n = w/|w|
///
/// Of a tapered edge, the side of a cone of slope tau = sin(half its opening angle), every tangent plane goes through the
/// apex A, and all normals out of it have the same n.d = tau:
///   point, cone  phi = n.(P - A) - r_1,           n = sqrt(1 - tau^2) w/|w| + tau d, p = P - r_1 n
///   edge, cone   phi = n.(Q - A) - r_1,           n.d_1 = -tau_1, n.d_2 = tau_2, one on each side of the two axes
///   rim, cone    as point-cone, at the p of the rim where n.t_1 = 0
///
/// `sign` is +-1 or +-2. Its sign picks the side of a plane (N or -N, the back of a sheet) and the orientation of a
/// cross product; other rows ignore it. |sign| picks between two places where rims come nearest: the first or the
/// second along the edge (of a cone, its axis), or along d_1 x d_2 of two rims; where there is one place both give it.
///
/// Signs 3 and 4 are 1 and 2 for sharp curves, one of them a rim, that are known to be apart: as a swept edge of radius 0,
/// so that tangents may be parallel. The search for impacts has no use for them.
///
/// Where nothing is defined (parallel edges, points that coincide, rims in parallel planes) the gap is NaN. Of a rim
/// that lies flat before a plane the gap is defined and the point is NaN; where it tilts, `motion` gives the point that
/// goes down, the limit of a tilt about an axis that stays.
ContactPoint contactOf(GapKind kind, const WorldFeature& of_a, const WorldFeature& of_b, int sign);

/// The gaps above, for the solids of a scene. Where contactOf returns NaN so does the Jacobian. Throws InputError for
/// bodies and features that are not there.
class FeatureGeometry final : public ContactGeometry,
                              public BodyGeometry,
                              public adjoint_detail::RimGeometry,
                              public adjoint_detail::BodyDistance {
 public:
  explicit FeatureGeometry(std::vector<Solid> solids) : solids_(std::move(solids)) {}

  ContactPoint contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override;
  ContactMotion motion(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B, const PoseRate& of_a,
                       const PoseRate& of_b) const override;
  ContactJacobian jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override;
  std::vector<ContactJacobian> jacobianRates(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                             std::span<const PairTangent> directions) const override;
  std::string describe(int a, int b, const FeaturePair& f) const override;
  /// Throws InputError for a pair of features that is not there.
  void checkFeatures(int a, int b, const FeaturePair& f) const;

  std::optional<adjoint_detail::RimOnFace> rimOnFace(int a, int b, const FeaturePair& f) const override;
  std::optional<int> rimOfBody(int a, int b, const FeaturePair& f, bool of_first) const override;
  double boundingRadius(int body) const override;
  double overlap(int a, int b, const Pose& A, const Pose& B) const override;
  std::vector<FeatureLimit> limits(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override;

  adjoint_detail::Nearest nearest(int a, int b, const Pose& A, const Pose& B) const override;
  std::optional<adjoint_detail::NearestInTime> nearestInTime(int a, int b, const Arc& arc_a, const Arc& arc_b,
                                                             double from, double to, double under) const override;
  adjoint_detail::Nearest separation(int a, int b, const Pose& A, const Pose& B) const override;
  std::optional<adjoint_detail::NearestInTime> leastSeparation(int a, int b, const Arc& arc_a, const Arc& arc_b,
                                                               double from, double to, double under) const override;
  std::shared_ptr<const ContactGeometry> ofTwo(const Body& first, const Body& second) const override;

  const Solid& solid(int body) const { return solids_[static_cast<std::size_t>(body)]; }
  const std::vector<Solid>& solids() const { return solids_; }

 private:
  std::vector<Solid> solids_;
};

}  // namespace carom::ode_bridge_detail
