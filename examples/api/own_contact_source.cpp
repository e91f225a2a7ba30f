// SPDX-License-Identifier: MIT
// Collision detection of one's own: a ball above a level floor, whose first impact has a closed form. The simulator and
// all derivatives work with it as with the library's.
#include <cmath>
#include <cstdio>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/simulate/simulate.h"

using namespace carom;

namespace {

constexpr FeaturePair kBallOnFloor{.kind = 0, .a = 0, .b = 0, .sign = 1};

// The gap is z - radius, its normal points up. Body 0 is the ball, body 1 the floor; it has one dimension, the radius.
class BallAboveFloor final : public ContactGeometry, public BodyGeometry {
 public:
  explicit BallAboveFloor(double radius) : radius_(radius) {}

  ContactPoint contact(int, int, const FeaturePair&, const Pose& ball, const Pose&) const override {
    return {ball.x.z() - radius_, Vec3::UnitZ(), Vec3(ball.x.x(), ball.x.y(), 0)};
  }
  ContactJacobian jacobian(int, int, const FeaturePair&, const Pose&, const Pose&) const override {
    ContactJacobian J;
    J.pose(0, 2) = 1;                   // the gap by z
    J.pose(4, 0) = J.pose(5, 1) = 1;    // the point by x and y
    J.size_a.setZero(7, 1);
    J.size_a(0, 0) = -1;                // the gap by the radius
    J.size_b.setZero(7, 0);
    return J;
  }
  std::vector<ContactJacobian> jacobianRates(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                             std::span<const PairTangent> directions) const override {
    ContactJacobian constant = jacobian(a, b, f, A, B);
    constant.pose.setZero(), constant.size_a.setZero();
    return std::vector<ContactJacobian>(directions.size(), constant);
  }
  std::string describe(int, int, const FeaturePair&) const override { return "the ball on the floor"; }

  double boundingRadius(int body) const override { return body == 0 ? radius_ : kInfinity; }
  double overlap(int, int, const Pose& ball, const Pose&) const override { return std::max(0.0, radius_ - ball.x.z()); }
  std::vector<FeatureLimit> limits(int, int, const FeaturePair&, const Pose&, const Pose&) const override { return {}; }

 private:
  double radius_;
};

class FloorContacts final : public ContactSource {
 public:
  void begin(const Scene& scene) override {
    radius_ = std::get<Sphere>(scene.bodies[0].shape).radius;
    geometry_ = std::make_shared<BallAboveFloor>(radius_);
    placed_.clear();
    if (std::abs(scene.bodies[0].position.z() - radius_) <= 1e-12) placed_.push_back({0, 1, {kBallOnFloor}});
  }
  std::vector<PlacedContact> placed() const override { return placed_; }
  void setPath(int, const Arc&, double, double) override {}
  void neighbours(int body, std::vector<int>& out) override { out = {1 - body}; }
  std::optional<PredictedImpact> firstImpact(int, int, Arc& ball, Arc&, double from, double until) override {
    if (WorkCount* counted = work()) counted->step();  // throws WorkEnded at the limit
    const Vec3 v = ball.velocityAt(from);
    const double height = ball.positionAt(from).z() - radius_, g = -ball.acceleration().z();
    const double fall = (v.z() + std::sqrt(std::max(0.0, v.z() * v.z() + 2 * g * height))) / g;
    if (!(fall > 0) || from + fall > until) return std::nullopt;
    return PredictedImpact{from + fall, kBallOnFloor};
  }
  // Where fixed bodies lie flush, a face goes on from one to the next, and what holds a ball there holds it on all of them.
  // Here is one floor: what holds the ball is this pair, and nothing else is met beside it.
  std::optional<PredictedImpact> firstImpactOnGround(int, int, std::span<const PersistentFeatures> held, Arc& ball, Arc& floor,
                                                     double from, double until) override {
    return held.empty() ? firstImpact(0, 1, ball, floor, from, until) : std::nullopt;
  }
  std::shared_ptr<const ContactGeometry> geometry() const override { return geometry_; }

 private:
  double radius_ = 0;
  std::shared_ptr<const BallAboveFloor> geometry_;
  std::vector<PlacedContact> placed_;  // the ball, where it lies on the floor at the start
};

}  // namespace

int main() {
  Scene scene;
  Body ball, floor;
  ball.name = "ball", ball.shape = Sphere{0.1}, ball.mass = 1, ball.position = {0, 0, 1};
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  scene.bodies = {ball, floor};
  FloorContacts contacts;
  const Motion motion = simulate(scene, contacts, 1);
  std::printf("%zu impacts, z = %.9f m\n", motion.events.size(), motion.stateAt("ball", 1).position.z());

  StateSeed z;
  z.body = 0, z.at = Instant::at(1), z.position = Vec3::UnitZ();
  std::printf("dz/d(radius) = %.9f\n", adjoint(motion, {&z, 1}).bodies[0].size[0]);
}
