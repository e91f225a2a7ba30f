// SPDX-License-Identifier: MIT
#include "tests/support/swept_points.h"

#include <algorithm>

#include "adjoint/flight/arc.h"
#include "adjoint/scene/body_model.h"

namespace carom::test {
namespace {

constexpr double kStep = 5e-4;   ///< s, between samples
constexpr double kApart = 1e-9;  ///< m, the gap from which on a point can touch anew

struct PointsOf {
  std::vector<SweptPoint> operator()(const Sphere& s) const {
    return {{Vec3::Zero(), s.radius, Eigen::Matrix3Xd::Zero(3, 1), Eigen::RowVectorXd::Ones(1)}};
  }
  std::vector<SweptPoint> operator()(const Box& b) const {
    std::vector<SweptPoint> points;
    for (int v = 0; v < 8; ++v) {
      const Vec3 half(v & 1 ? 0.5 : -0.5, v & 2 ? 0.5 : -0.5, v & 4 ? 0.5 : -0.5);
      points.push_back({half.cwiseProduct(b.size), 0, Mat3(half.asDiagonal()), Eigen::RowVectorXd::Zero(3)});
    }
    return points;
  }
  std::vector<SweptPoint> operator()(const Capsule& c) const {
    std::vector<SweptPoint> points;
    for (double sign : {-0.5, 0.5}) {
      SweptPoint p{{0, 0, sign * c.height}, c.radius, Eigen::Matrix3Xd::Zero(3, 2), Eigen::RowVector2d(1, 0)};
      p.dpoint(2, 1) = sign;
      points.push_back(p);
    }
    return points;
  }
  std::vector<SweptPoint> operator()(const Hull& h) const {
    std::vector<SweptPoint> points;
    for (const Vec3& v : h.surface->vertices) points.push_back({h.scale * v, 0, v, Eigen::RowVectorXd::Zero(1)});
    return points;
  }
  std::vector<SweptPoint> operator()(const Compound& c) const {
    Eigen::Index dimensions = 0, first = 0;
    for (const CompoundPart& part : c.parts) dimensions += kindOf(part.shape).dimensions(part.shape).size();
    std::vector<SweptPoint> points;
    for (const CompoundPart& part : c.parts) {
      const Mat3 R = part.orientation.toRotationMatrix();
      for (const SweptPoint& p : sweptPointsOf(part.shape)) {
        SweptPoint q{part.position + R * p.point, p.radius, Eigen::Matrix3Xd::Zero(3, dimensions),
                     Eigen::RowVectorXd::Zero(dimensions)};
        q.dpoint.middleCols(first, p.dpoint.cols()) = R * p.dpoint;
        q.dradius.segment(first, p.dradius.cols()) = p.dradius;
        points.push_back(q);
      }
      first += kindOf(part.shape).dimensions(part.shape).size();
    }
    return points;
  }
  template <class Other>
  std::vector<SweptPoint> operator()(const Other&) const {
    return {};
  }
};

struct Floor {
  Vec3 normal;
  double offset;
};

/// Gap n.(x_a + R_a p - x_b) - offset - r of point and plane. `a` of a FeaturePair is the point, whichever body has it.
class Geometry final : public ContactGeometry {
 public:
  explicit Geometry(const Scene& scene) : bodies_(scene.bodies) {
    for (const Body& body : scene.bodies) {
      const auto* plane = std::get_if<Plane>(&body.shape);
      floors_.push_back(plane ? Floor{plane->normal, plane->offset} : Floor{});
      std::vector<SweptPoint>& points = points_.emplace_back(sweptPointsOf(body.shape));
      const Vec3 center = centerOfMass(body);
      const Eigen::Matrix3Xd rates = centerOfMassRates(body);
      for (SweptPoint& p : points) p.point -= center, p.dpoint -= rates;
    }
  }

  std::size_t pointsOf(int body) const { return points_[static_cast<std::size_t>(body)].size(); }

  ContactPoint contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override {
    if (pointsOf(a) == 0) {
      ContactPoint c = contact(b, a, f, B, A);
      c.normal = -c.normal;
      return c;
    }
    const SweptPoint& p = point(a, f);
    const Floor& floor = floors_[static_cast<std::size_t>(b)];
    const Vec3 P = A.x + A.R * p.point, n = B.R * floor.normal;
    return {n.dot(P - B.x) - floor.offset - p.radius, n, P - p.radius * n};
  }

  ContactJacobian jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const override {
    if (pointsOf(a) == 0) {
      ContactJacobian J = jacobian(b, a, f, B, A);
      J.pose.middleRows<3>(1) *= -1;
      J.size_a.middleRows<3>(1) *= -1;
      J.pose.leftCols<6>().swap(J.pose.rightCols<6>());
      J.size_a.swap(J.size_b);
      return J;
    }
    const SweptPoint& p = point(a, f);
    const Vec3 arm = A.R * p.point, n = B.R * floors_[static_cast<std::size_t>(b)].normal, to = A.x + arm - B.x;
    ContactJacobian J;
    J.pose.row(0) << n.transpose(), arm.cross(n).transpose(), -n.transpose(), n.cross(to).transpose();
    J.pose.block<3, 3>(1, 9) = -skew(n);
    J.pose.block<3, 3>(4, 0).setIdentity();
    J.pose.block<3, 3>(4, 3) = -skew(arm);
    J.pose.block<3, 3>(4, 9) = p.radius * skew(n);
    J.size_a = Eigen::Matrix<double, 7, Eigen::Dynamic>::Zero(7, p.dpoint.cols());
    J.size_a.row(0) = n.transpose() * A.R * p.dpoint - p.dradius;
    J.size_a.bottomRows<3>() = A.R * p.dpoint - n * p.dradius;
    J.size_b.resize(7, 0);
    return J;
  }

  std::vector<ContactJacobian> jacobianRates(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                             std::span<const PairTangent> directions) const override {
    std::vector<ContactJacobian> all;
    for (const PairTangent& d : directions) {
      if (pointsOf(a) > 0) {
        all.push_back(jacobianRate(a, b, f, A, B, d));
        continue;
      }
      PairTangent turned{d.pose, d.size_b, d.size_a};
      turned.pose << d.pose.tail<6>(), d.pose.head<6>();
      ContactJacobian rate = jacobianRate(b, a, f, B, A, turned);
      rate.pose.middleRows<3>(1) *= -1;
      rate.size_a.middleRows<3>(1) *= -1;
      rate.pose.leftCols<6>().swap(rate.pose.rightCols<6>());
      rate.size_a.swap(rate.size_b);
      all.push_back(std::move(rate));
    }
    return all;
  }

  std::string describe(int, int, const FeaturePair& f) const override { return "point " + std::to_string(f.a); }

 private:
  ContactJacobian jacobianRate(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                               const PairTangent& d) const {
    const SweptPoint& p = point(a, f);
    const Vec3 theta_a = d.pose.segment<3>(3), theta_b = d.pose.segment<3>(9);
    const Vec3 arm = A.R * p.point, n = B.R * floors_[static_cast<std::size_t>(b)].normal, to = A.x + arm - B.x;
    const bool sized = d.size_a.size() > 0;
    const Vec3 darm = theta_a.cross(arm) + (sized ? Vec3(A.R * p.dpoint * d.size_a) : Vec3(Vec3::Zero()));
    const Vec3 dn = theta_b.cross(n), dto = d.pose.head<3>() + darm - d.pose.segment<3>(6);
    const double dradius = sized ? p.dradius.dot(d.size_a) : 0;
    Eigen::Matrix3Xd point_rates = skew(theta_a) * A.R * p.dpoint;
    const Body& body = bodies_[static_cast<std::size_t>(a)];
    if (sized && !body.center_of_mass && !body.fixed) {  // the centre of mass need not follow the sizes linearly
      const SolidProperties change = kindOf(body.shape).propertiesRate(body.shape, d.size_a);
      for (std::size_t k = 0; k < change.rates.size(); ++k)
        point_rates.col(static_cast<Eigen::Index>(k)) -= A.R * change.rates[k].center;
    }
    ContactJacobian J;
    J.pose.row(0) << dn.transpose(), (darm.cross(n) + arm.cross(dn)).transpose(), -dn.transpose(),
        (dn.cross(to) + n.cross(dto)).transpose();
    J.pose.block<3, 3>(1, 9) = -skew(dn);
    J.pose.block<3, 3>(4, 3) = -skew(darm);
    J.pose.block<3, 3>(4, 9) = dradius * skew(n) + p.radius * skew(dn);
    J.size_a = Eigen::Matrix<double, 7, Eigen::Dynamic>::Zero(7, p.dpoint.cols());
    J.size_a.row(0) = dn.transpose() * A.R * p.dpoint + n.transpose() * point_rates;
    J.size_a.bottomRows<3>() = point_rates - dn * p.dradius;
    J.size_b.resize(7, 0);
    return J;
  }

  const SweptPoint& point(int body, const FeaturePair& f) const {
    return points_[static_cast<std::size_t>(body)][static_cast<std::size_t>(f.a)];
  }

  std::vector<Body> bodies_;
  std::vector<Floor> floors_;
  std::vector<std::vector<SweptPoint>> points_;
};

}  // namespace

std::vector<SweptPoint> sweptPointsOf(const Shape& shape) { return std::visit(PointsOf{}, shape); }

void SweptPointContacts::begin(const Scene& scene) {
  plane_.clear();
  points_.clear();
  for (const Body& body : scene.bodies) {
    plane_.push_back(std::holds_alternative<Plane>(body.shape));
    points_.push_back(sweptPointsOf(body.shape).size());
  }
  geometry_ = std::make_shared<Geometry>(scene);
}

void SweptPointContacts::neighbours(int body, std::vector<int>& out) {
  out.clear();
  for (std::size_t i = 0; i < plane_.size(); ++i)
    if (plane_[i] != plane_[static_cast<std::size_t>(body)]) out.push_back(static_cast<int>(i));
}

std::optional<PredictedImpact> SweptPointContacts::firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                               double until) {
  arc_a.extendTo(until);
  arc_b.extendTo(until);
  const std::size_t count = points_[static_cast<std::size_t>(plane_[static_cast<std::size_t>(a)] ? b : a)];
  const auto gap = [&](std::size_t point, double t) {
    const Kinematics ka = arc_a.kinematicsAt(t), kb = arc_b.kinematicsAt(t);
    return geometry_->contact(a, b, {0, static_cast<std::int32_t>(point), 0, 1}, {ka.x, ka.R}, {kb.x, kb.R}).gap;
  };
  std::vector<bool> apart(count);
  for (std::size_t p = 0; p < count; ++p) apart[p] = gap(p, from) > kApart;
  std::optional<PredictedImpact> first;
  for (double t = from; t < until && !first;) {
    // short steps at the start, where points that have just touched leave the plane
    const double next = std::min(until, t + (t - from < kStep ? kStep / 64 : kStep));
    for (std::size_t p = 0; p < count; ++p) {
      const double g = gap(p, next);
      if (apart[p] && g < 0) {
        double lo = t, hi = next;
        for (int i = 0; i < 60; ++i) (gap(p, 0.5 * (lo + hi)) >= 0 ? lo : hi) = 0.5 * (lo + hi);
        if (!first || lo < first->time) first = PredictedImpact{lo, {0, static_cast<std::int32_t>(p), 0, 1}};
      }
      apart[p] = apart[p] || g > kApart;
    }
    t = next;
  }
  return first;
}

}  // namespace carom::test
