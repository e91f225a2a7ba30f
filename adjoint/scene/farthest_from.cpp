// SPDX-License-Identifier: MIT
#include "adjoint/scene/farthest_from.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"

namespace carom {
namespace {

FarthestFrom farthestFrom(const Sphere& s, const Vec3& q);
FarthestFrom farthestFrom(const Box& s, const Vec3& q);
FarthestFrom farthestFrom(const Plane& s, const Vec3& q);
FarthestFrom farthestFrom(const Capsule& s, const Vec3& q);
FarthestFrom farthestFrom(const Cylinder& s, const Vec3& q);
FarthestFrom farthestFrom(const Cone& s, const Vec3& q);
FarthestFrom farthestFrom(const Hull& s, const Vec3& q);
FarthestFrom farthestFrom(const Mesh& s, const Vec3& q);
FarthestFrom farthestFrom(const Compound& s, const Vec3& q);

// Of one corner with its ball or rim; the margin is that of the point.
FarthestFrom measured(FarthestPoint p, const Vec3& q) {
  FarthestFrom f;
  Vec3 to = p.corner - q;
  if (p.rim > 0) {
    const Vec3 across = p.across(to);
    to += p.rim * (across.norm() > 0 ? Vec3(across.normalized()) : p.axis.unitOrthogonal());
  }
  const double length = to.norm();
  f.distance = length + p.ball;
  if (length > 0) f.direction = to / length;
  f.farthest = std::move(p);
  return f;
}

// How much less far the other side of the rim is, |to|^2 - |to'|^2 = 4 rim |across|.
double marginOfRim(const FarthestPoint& p, const Vec3& q, double distance) {
  return distance > 0 ? 2 * p.rim * p.across(p.corner - q).norm() / distance : 0;
}

FarthestPoint onAxis(double end, double height) {
  FarthestPoint p = FarthestPoint::at({0, 0, end * height}, 2);
  p.corner_rates(2, 1) = end;
  return p;
}

FarthestFrom farthestFrom(const Sphere& s, const Vec3& q) {
  FarthestPoint p = FarthestPoint::at(Vec3::Zero(), 1);
  p.ball = s.radius, p.ball_rates[0] = 1;
  FarthestFrom f = measured(std::move(p), q);
  f.farthest.margin = q.norm();
  return f;
}

FarthestFrom farthestFrom(const Box& s, const Vec3& q) {
  FarthestPoint p = FarthestPoint::at(Vec3::Zero(), 3);
  for (int i = 0; i < 3; ++i) {
    p.corner_rates(i, i) = q[i] > 0 ? -0.5 : 0.5;
    p.corner[i] = p.corner_rates(i, i) * s.size[i];
  }
  FarthestFrom f = measured(std::move(p), q);
  f.farthest.margin = q.cwiseAbs().cwiseProduct(s.size).minCoeff() / f.distance;
  return f;
}

FarthestFrom farthestFrom(const Plane&, const Vec3&) {
  throw InputError("found a plane, which has no farthest point, expected a bounded shape");
}

FarthestFrom farthestFrom(const Capsule& s, const Vec3& q) {
  FarthestPoint p = onAxis(q.z() > 0 ? -0.5 : 0.5, s.height);
  p.ball = s.radius, p.ball_rates[0] = 1;
  FarthestFrom f = measured(std::move(p), q);
  f.farthest.margin = std::abs(q.z()) * s.height / f.distance;
  return f;
}

FarthestFrom farthestFrom(const Cylinder& s, const Vec3& q) {
  FarthestPoint p = onAxis(q.z() > 0 ? -0.5 : 0.5, s.height);
  p.rim = s.radius, p.rim_rates[0] = 1;
  FarthestFrom f = measured(std::move(p), q);
  f.farthest.margin = std::min(std::abs(q.z()) * s.height / f.distance, marginOfRim(f.farthest, q, f.distance));
  return f;
}

FarthestFrom farthestFrom(const Cone& s, const Vec3& q) {
  FarthestFrom apex = measured(onAxis(0.5, s.height), q);
  FarthestPoint rim = onAxis(-0.5, s.height);
  rim.rim = s.radius, rim.rim_rates[0] = 1;
  FarthestFrom base = measured(std::move(rim), q);
  const double further = apex.distance - base.distance;
  apex.farthest.margin = further;
  base.farthest.margin = std::min(-further, marginOfRim(base.farthest, q, base.distance));
  return further > 0 ? apex : base;
}

FarthestFrom farthestVertex(const Surface* surface, double scale, const Vec3& q) {
  if (!surface || surface->vertices.empty())
    throw InputError("found a shape without surface, which has no farthest point, expected one with vertices");
  const Vec3* farthest = &surface->vertices.front();
  double most = -1, second = -1;
  for (const Vec3& v : surface->vertices) {
    const double distance = (scale * v - q).norm();
    if (distance > most) {
      second = most, most = distance, farthest = &v;
    } else {
      second = std::max(second, distance);
    }
  }
  FarthestPoint p = FarthestPoint::at(scale * *farthest, 1);
  p.corner_rates.col(0) = *farthest;
  FarthestFrom f = measured(std::move(p), q);
  f.farthest.margin = most - second;
  return f;
}

FarthestFrom farthestFrom(const Hull& s, const Vec3& q) { return farthestVertex(s.surface.get(), s.scale, q); }
FarthestFrom farthestFrom(const Mesh& s, const Vec3& q) { return farthestVertex(s.surface.get(), s.scale, q); }

// The dimensions of the parts one after the other.
FarthestPoint widened(const FarthestPoint& of_part, Eigen::Index first, Eigen::Index dimensions) {
  FarthestPoint whole = FarthestPoint::at(of_part.corner, dimensions);
  whole.ball = of_part.ball, whole.rim = of_part.rim, whole.axis = of_part.axis, whole.margin = of_part.margin;
  const Eigen::Index count = of_part.ball_rates.size();
  whole.corner_rates.middleCols(first, count) = of_part.corner_rates;
  whole.ball_rates.segment(first, count) = of_part.ball_rates;
  whole.rim_rates.segment(first, count) = of_part.rim_rates;
  return whole;
}

FarthestFrom farthestFrom(const Compound& s, const Vec3& q) {
  FarthestFrom best;
  best.distance = -1;
  Eigen::Index first = 0, of_best = 0;
  for (const CompoundPart& part : s.parts) {
    const Quat R = part.orientation.normalized();
    FarthestFrom f = carom::farthestFrom(part.shape, R.conjugate() * (q - part.position));
    FarthestPoint& p = f.farthest;
    p.corner = part.position + R * p.corner;
    p.axis = R * p.axis;
    p.corner_rates = R.toRotationMatrix() * p.corner_rates;
    f.direction = R * f.direction;
    const Eigen::Index at = first;
    first += p.ball_rates.size();
    if (f.distance > best.distance) {
      p.margin = std::min(p.margin, f.distance - best.distance);
      best = std::move(f), of_best = at;
    } else {
      best.farthest.margin = std::min(best.farthest.margin, best.distance - f.distance);
    }
  }
  best.farthest = widened(best.farthest, of_best, first);
  return best;
}

}  // namespace

FarthestFrom farthestFrom(const Shape& shape, const Vec3& q) {
  return std::visit([&](const auto& s) { return farthestFrom(s, q); }, shape);
}

}  // namespace carom
