// SPDX-License-Identifier: MIT
#include "tests/support/constrained_scenes.h"

#include <cmath>

#include "ode_bridge/convex_hull.h"
#include "tests/support/solids.h"

namespace carom::test {
namespace {

const Vec3 kDownward(0, 0, -9.81);

Body floorAt(double height = 0) { return makePlane("floor", Vec3::UnitZ(), height); }
Body tableTop() { return fixedBody(makeBox("table", {2, 2, 0.75}, {0, 0, -0.375})); }
Body turned(Body body, const Quat& q) {
  body.orientation = q;
  return body;
}
Body spinning(Body body, const Vec3& w) {
  body.angular_velocity = w;
  return body;
}
Body shaped(Body body, Shape shape) {
  body.shape = std::move(shape);
  return body;
}
Quat about(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

// As high above the floor as its lowest corner is below its centre.
Body onOneCorner(const Vec3& size, const Quat& q, const Vec3& spin) {
  const Mat3 R = q.toRotationMatrix();
  const double height = 0.5 * R.row(2).cwiseAbs().dot(size.transpose());
  return spinning(turned(makeBox("box", size, {0, 0, height}), q), spin);
}

// With that corner at the origin.
Body cornerAtOrigin(const Vec3& size, const Quat& q) {
  const Mat3 R = q.toRotationMatrix();
  const Vec3 up = R.row(2).transpose().cwiseSign();
  return turned(makeBox("box", size, 0.5 * (R * size.cwiseProduct(up))), q);
}

}  // namespace

std::vector<ConstrainedCase> constrainedScenes() {
  const double half = std::sqrt(0.1) / 2, past = std::atan2(0.1, 0.3) + 0.1;
  const Body tall = turned(makeBox("box", {0.1, 0.2, 0.3}, {half * std::sin(0.1), 0, half * std::cos(0.1)}),
                           about(past, Vec3::UnitY()));
  const Body plate = spinning(makeBox("plate", {0.2, 0.2, 0.05}, {0, 0, 0.025}, {1, 0, 0}), {0, 0, 5});
  const Body corner = onOneCorner({0.1, 0.2, 0.3}, about(0.9, {1, 0.8, 0.3}), Vec3::Zero());
  const Quat lying = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
  const Body cylinder = turned(shaped(makeBall("body", 0.1, {0, 0, 0.1}, {0.5, 1, 0}), Cylinder{0.1, 0.3}), lying);
  const Body capsule = shaped(cylinder, Capsule{0.1, 0.3});
  const Body coin = spinning(turned(shaped(makeBall("coin", 0.1, {0, 0, 0.1}), Cylinder{0.1, 0.02}), lying), {0, 0, 12});
  const Body ball = spinning(makeBall("ball", 0.05, {0.9, 0, 0.05}, {0.3, 0, 0}), {0, 6, 0});
  const Body pushed = turned(makeBox("box", {0.3, 0.2, 0.1}, {0.8, 0, 0.05}, {1.3, 0, 0}), about(0.2, Vec3::UnitZ()));
  const Body dropped = spinning(turned(makeBox("box", {0.1, 0.2, 0.3}, {0, 0, 0.4}), about(0.7, {1, 2, 3})), {1, 2, -1});
  const Vec3 left(0, -std::cos(0.7), std::sin(0.7)), right(0, std::cos(0.7), std::sin(0.7));
  const Body in_v = spinning(makeBall("ball", 0.1, {0, 0, 0.1 / std::sin(0.7)}, {0.5, 0, 0}), {0, 2, 9});
  const Body stone = shaped(dropped, Hull{convexHull(boxTriangles({0.2, 0.15, 0.1}).vertices), 1, ""});
  const Body in_a_corner = cornerAtOrigin({0.1, 0.2, 0.3}, about(0.9, {1, 0.8, 0.3}));
  const Body low = makePlane("left", {0, -std::cos(1.2), std::sin(1.2)}, 0), high = makePlane("right", {0, std::cos(1.2), std::sin(1.2)}, 0);
  return {
      {"falls over an edge", makeScene(kDownward, 0, 0.5, {tall, floorAt()}), 1.5},
      {"slides and turns", makeScene(kDownward, 0, 0.4, {plate, floorAt()}), 1},
      {"falls from one corner", makeScene(kDownward, 0, 0.5, {corner, floorAt()}), 1.5},
      {"falls from one corner without friction", makeScene(kDownward, 0, 0, {corner, floorAt()}), 0.4, 0.25},
      {"cylinder slides on its side", makeScene(kDownward, 0, 0.3, {cylinder, floorAt()}), 1, 0.34},
      {"capsule slides on its side", makeScene(kDownward, 0, 0.3, {capsule, floorAt()}), 1, 0.3},
      {"coin spins", makeScene(kDownward, 0, 0.3, {coin, floorAt()}), 0.5, 0.3},
      {"ball over an edge", makeScene(kDownward, 0, 0.5, {ball, tableTop(), floorAt(-0.75)}), 1},
      {"box over an edge", makeScene(kDownward, 0.2, 0.3, {pushed, tableTop(), floorAt(-0.75)}), 0.6},
      {"ball spins in a V", makeScene(kDownward, 0, 0.3, {in_v, makePlane("left", left, 0), makePlane("right", right, 0)}), 0.14, 0.045},
      {"corner in a V", makeScene(kDownward, 0, 0.2, {in_a_corner, low, high}), 0.25},
      {"dropped", makeScene(kDownward, 0.2, 0.4, {dropped, floorAt()}), 3},
      {"hull", makeScene(kDownward, 0, 0.4, {stone, floorAt()}), 0.8},
  };
}

}  // namespace carom::test
