// SPDX-License-Identifier: MIT
// adjoint/ needs no collision library: a ContactSource for balls over one horizontal floor, written here in full.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

/// Gap z_ball - r - z_floor, for the body pairs (ball, floor).
class FloorGeometry final : public ContactGeometry {
 public:
  explicit FloorGeometry(std::vector<double> radii) : radii_(std::move(radii)) {}

  ContactPoint contact(int a, int, const FeaturePair&, const Pose& A, const Pose& B) const override {
    const double r = radii_[static_cast<std::size_t>(a)];
    return {A.x.z() - r - B.x.z(), Vec3::UnitZ(), A.x - r * Vec3::UnitZ()};
  }
  ContactJacobian jacobian(int a, int, const FeaturePair&, const Pose& A, const Pose& B) const override {
    const double r = radii_[static_cast<std::size_t>(a)];
    ContactJacobian jacobian;
    auto& J = jacobian.pose;
    J(0, 2) = 1, J(0, 8) = -1;
    // the normal turns with the floor, about the floor's origin
    const Mat3 turn = -skew(Vec3::UnitZ());
    J.block<1, 3>(0, 9) = (A.x - B.x).transpose() * turn;
    J.block<3, 3>(1, 9) = turn;
    J.block<3, 3>(4, 0).setIdentity();
    J.block<3, 3>(4, 9) = -r * turn;
    jacobian.size_a = Eigen::Matrix<double, 7, 1>::Zero();
    jacobian.size_a(0, 0) = -1;
    jacobian.size_a.col(0).tail<3>() = -Vec3::UnitZ();
    return jacobian;
  }
  std::vector<ContactJacobian> jacobianRates(int a, int, const FeaturePair&, const Pose& A, const Pose& B,
                                             std::span<const PairTangent> directions) const override {
    const double r = radii_[static_cast<std::size_t>(a)];
    std::vector<ContactJacobian> all;
    for (const PairTangent& d : directions) {
      const Vec3 n = Vec3::UnitZ(), dn = Vec3(d.pose.segment<3>(9)).cross(n), to = A.x - B.x;
      const Vec3 dto = d.pose.head<3>() - d.pose.segment<3>(6);
      const double dr = d.size_a.size() > 0 ? d.size_a[0] : 0;
      ContactJacobian& rate = all.emplace_back();
      auto& J = rate.pose;
      J.block<1, 3>(0, 0) = dn.transpose();
      J.block<1, 3>(0, 6) = -dn.transpose();
      J.block<1, 3>(0, 9) = (dn.cross(to) + n.cross(dto)).transpose();
      J.block<3, 3>(1, 9) = -skew(dn);
      J.block<3, 3>(4, 9) = dr * skew(n) + r * skew(dn);
      rate.size_a = Eigen::Matrix<double, 7, 1>::Zero();
      rate.size_a.col(0).tail<3>() = -dn;
    }
    return all;
  }
  std::string describe(int, int, const FeaturePair&) const override { return "ball on floor"; }

 private:
  std::vector<double> radii_;
};

/// The last body is the floor; all others are balls that never meet.
class FloorContacts final : public ContactSource {
 public:
  void begin(const Scene& scene) override {
    std::vector<double> radii;
    for (const Body& b : scene.bodies)
      radii.push_back(std::holds_alternative<Sphere>(b.shape) ? std::get<Sphere>(b.shape).radius : 0);
    radii_ = radii;
    geometry_ = std::make_shared<FloorGeometry>(std::move(radii));
  }
  void setPath(int, const Arc&, double, double) override {}
  void neighbours(int, std::vector<int>& out) override { out = {static_cast<int>(radii_.size()) - 1}; }
  std::optional<PredictedImpact> firstImpact(int a, int, Arc& ball, Arc& floor, double from, double until) override {
    const double gap = ball.positionAt(from).z() - radii_[static_cast<std::size_t>(a)] - floor.positionAt(from).z();
    const double v = ball.velocityAt(from).z(), g = ball.acceleration().z();
    const double root = std::sqrt(v * v - 2 * g * std::max(0.0, gap));
    if (!(v < 0 || g < 0)) return std::nullopt;
    // a ball that leaves the floor comes back after -2 v/g
    const double h = v > 0 ? -(v + root) / g : 2 * std::max(0.0, gap) / (root - v);
    if (!(from + h <= until)) return std::nullopt;
    return PredictedImpact{from + h, {0, 0, 0, 1}};
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return geometry_; }

 private:
  std::vector<double> radii_;
  std::shared_ptr<FloorGeometry> geometry_;
};

Scene threeBalls() {
  Scene s = makeScene({0, 0, -9.81}, 0.8, 0.3,
                      {makeBall("a", 0.1, {0, 0, 1}, {0.3, 0.2, 0}), makeBall("b", 0.2, {5, 0, 1.5}, {1, 0, 2}),
                       makeBall("c", 0.3, {0, 5, 0.7}, {0, -0.4, -1}), makePlane("floor", Vec3::UnitZ(), 0)});
  s.bodies[0].angular_velocity = {3, -2, 1};
  s.bodies[2].angular_velocity = {0.1, 9, 1};
  return s;
}

TEST(FloorContacts, GiveTheMotionAndGradientOfTheCollisionLibrary) {
  const Scene s = threeBalls();
  FloorContacts own;
  OdeContacts ode(s);
  const double T = 1.6;
  const Motion m = simulate(s, own, T), n = simulate(s, ode, T);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  ASSERT_EQ(m.events.size(), n.events.size());
  EXPECT_GE(m.events.size(), 5u);
  for (int b = 0; b < 3; ++b) {
    expectEntries(flatten(m.stateAt(b, T)), flatten(n.stateAt(b, T)), 1e-12, "state");
    for (int i = 0; i < 12; ++i)
      expectEntries(flatten(gradientOf(m, b, T, i)), flatten(gradientOf(n, b, T, i)), 1e-9,
                    "gradient of " + std::to_string(i));
  }
}

TEST(FloorContacts, DescribeTheirEvents) {
  const Scene s = threeBalls();
  FloorContacts own;
  const Motion m = simulate(s, own, 0.6);
  ASSERT_FALSE(m.events.empty());
  EXPECT_NE(m.describeEvent(0).find("(ball on floor)"), std::string::npos) << m.describeEvent(0);
}

}  // namespace
}  // namespace carom
