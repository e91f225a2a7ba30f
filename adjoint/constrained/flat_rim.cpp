// SPDX-License-Identifier: MIT
#include "adjoint/constrained/flat_rim.hpp"

#include "adjoint/base/errors.h"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

// A rim whose heights differ by less lies flat, m for bodies of 1 m.
constexpr double kHeightsOfFlat = 4e-13;
// What its point has by dimensions is that of a rim which is tilted by so much, rad, about the same axis.
constexpr double kTilted = 0.5;
// Slower than this share of sqrt(g rho) it does not tilt yet, m/s.
constexpr double kTiltsFast = 1e-9;

}  // namespace

std::optional<FlatRim> FlatRim::of(const ConstrainedScene& scene, const PersistentContact& c, std::size_t k, const Pose& own, const Vec3& omega) {
  const auto* rims = dynamic_cast<const RimGeometry*>(scene.geometry.get());
  if (!rims || scene.with[k].moves()) return std::nullopt;
  const int a = c.is_first ? scene.body : c.with, b = c.is_first ? c.with : scene.body;
  const std::optional<RimOnFace> rim = rims->rimOnFace(a, b, c.features);
  if (!rim || !(rim->features == c.features) || rim->of_first != c.is_first) return std::nullopt;
  FlatRim out;
  out.rim_ = *rim, out.face_ = scene.with[k].pose;
  const Vec3 d = own.R * rim->axis, N = out.face_.R * rim->normal;
  const double heights = 2 * rim->radius * RimOnFace::tilt(d, N).norm();
  if (!(heights <= kHeightsOfFlat * std::max(1.0, own.x.cwiseAbs().maxCoeff()))) return std::nullopt;
  const Vec3 along = omega - N.dot(omega) * N;
  if (!(along.norm() * rim->radius > kTiltsFast * std::sqrt(scene.gravity.norm() * rim->radius)))
    throw NotComputable("the derivative of a body that begins to tip over a round rim from rest is not known");
  const Mat3 turn = expSO3(Vec3(kTilted * along.normalized())).toRotationMatrix();
  const Pose tilted{own.x, turn * own.R};
  const ContactJacobian J = c.is_first ? scene.geometry->jacobian(a, b, c.features, tilted, out.face_)
                                       : scene.geometry->jacobian(a, b, c.features, out.face_, tilted);
  out.sizes_ = turn.transpose() * (c.is_first ? J.size_a : J.size_b).bottomRows<3>();
  out.of_face_ = (c.is_first ? J.size_b : J.size_a).row(0);
  return out;
}

V3<ConstrainedLanes::Number> FlatRim::point(const ConstrainedLanes& lanes, const ConstrainedInputs& inputs, std::size_t k, int first, int count) const {
  using Number = ConstrainedLanes::Number;
  const ConstrainedInputs::Partner& partner = inputs.partners[inputs.partner_of[k]];
  M3<Number> face = face_.R.cast<Number>();
  for (int lane = 0; lane < count; ++lane)
    if (const int turn = first + lane - partner.pose - 3; turn >= 0 && turn < 3)
      setRates(face, Mat3(skew(Vec3(Vec3::Unit(turn))) * face_.R), static_cast<std::size_t>(lane));
  const V3<Number> d = lanes.R * V3<Number>(rim_.axis.cast<Number>()), N = face * V3<Number>(rim_.normal.cast<Number>());
  const V3<Number> tilts = lanes.body.omega.cross(d).cross(N);
  V3<Number> point = lanes.x + lanes.R * V3<Number>(rim_.center.cast<Number>()) +
                     d.cross(tilts) * (Number(rim_.radius) / sqrt(tilts.squaredNorm()));
  for (int lane = 0; lane < count; ++lane) {
    const int size = first + lane - ConstrainedInputs::kSizes;
    if (size < 0 || size >= inputs.size_count) continue;
    for (int i = 0; i < 3; ++i) point[i].rate[static_cast<std::size_t>(lane)] += sizes_(i, size);
  }
  return point;
}

// The gap is that of the point there: N.(p - Q), where what turns p along the rim leaves it in the plane.
void FlatRim::place(const ConstrainedLanes& lanes, const ConstrainedInputs& inputs, std::size_t k, int first, int count,
                    ContactInstant<ConstrainedLanes::Number>& contact, ConstrainedLanes::Number& gap) const {
  const ConstrainedInputs::Partner& partner = inputs.partners[inputs.partner_of[k]];
  const V3<ConstrainedLanes::Number> at = point(lanes, inputs, k, first, count);
  const Vec3 N = face_.R * rim_.normal, p = valuesOf(at);
  contact.n = N.cast<ConstrainedLanes::Number>();
  contact.r = at - lanes.x;
  gap = 0;
  for (int lane = 0; lane < count; ++lane) {
    const int column = first + lane, pose = column - partner.pose, size = column - partner.sizes;
    const auto i = static_cast<std::size_t>(lane);
    gap.rate[i] = N.dot(ratesOf(at, i));
    if (pose >= 0 && pose < 3) gap.rate[i] -= N[pose];
    if (pose >= 3 && pose < 6) {
      const Vec3 turn = Vec3::Unit(pose - 3);
      setRates(contact.n, Vec3(turn.cross(N)), i);
      gap.rate[i] -= N.dot(turn.cross(p - face_.x));
    }
    if (size >= 0 && size < partner.size_count) gap.rate[i] += of_face_[size];
  }
}

}  // namespace carom::adjoint_detail
