// SPDX-License-Identifier: MIT
#include "tests/support/dot_product_scenes.h"

#include <cmath>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/moving_target_scenes.h"
#include "tests/support/thrown_box.h"

namespace carom::test {
namespace {

Body floorPlane() { return makePlane("floor", Vec3::UnitZ(), 0); }

Scene frictionless() { return boxOnFloor(0.7, 0); }
Scene stick() { return boxOnFloor(0.7, 2, 0.3); }
Scene slide() { return boxOnFloor(0.7, 0.05, 0.3); }

// four contacts at once
Scene jointStick() { return flatBoxOnFloor(3); }
Scene jointSlide() { return flatBoxOnFloor(0.1); }
Scene jointFrictionless() { return flatBoxOnFloor(0); }

// a disc flat on something narrower: where its rim crosses edges, or another rim
Scene discOn(const Shape& low, const Vec3& at) {
  Body disc = makeBall("disc", 1, {0, 0, 1.2}, {0.1, 0.05, 0}), post = makeBall("post", 1, at);
  disc.shape = Cylinder{0.5, 0.4};
  disc.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  post.shape = low;
  return makeScene({0, 0, -9.81}, 0.6, 0.2, {disc, fixedBody(post)});
}
Scene discOnBeam() { return discOn(Box{{0.3, 2, 1}}, {0.15, 0, 0}); }
Scene discOnDisc() { return discOn(Cylinder{0.4, 1}, {0.55, 0.1, 0}); }

// a heavy ball on a light one on the floor: impulses with 32 digits
Scene unlike(double friction) {
  Body light = makeBall("light", 0.1, {0, 0, 0.4}, {0.1, 0, -1}), heavy = makeBall("heavy", 0.2, {0.02, 0.01, 0}, light.velocity);
  heavy.position.z() = 0.4 + std::sqrt(0.09 - heavy.position.squaredNorm());
  light.mass = 0.3, heavy.mass = 3000;
  light.angular_velocity = {1, 2, 3};
  return makeScene({0, 0, -9.81}, 0.6, friction, {light, heavy, floorPlane()});
}
Scene unlikeFrictionless() { return unlike(0); }
Scene unlikeFriction() { return unlike(0.2); }
Scene unlikeBelt() {
  Scene s = unlike(0.2);
  s.bodies[2].surface_velocity = {0.5, -0.3, 0}, s.bodies[2].surface_angular_velocity = {0.1, 0.2, 1.5};
  return s;
}

Scene withMoments(const Vec3& moments) {
  Scene s = boxOnFloor(0.7, 0.3);
  s.bodies[0].inertia = Inertia::fromMoments(moments);
  return s;
}
Scene spherical() { return withMoments({0.01, 0.01, 0.01}); }
Scene symmetric() { return withMoments({0.01, 0.01, 0.016}); }
Scene symmetricLong() { return withMoments({0.004, 0.01, 0.01}); }
Scene triaxial() { return withMoments({0.006, 0.01, 0.013}); }

Scene derivedCube() {
  Scene s = boxOnFloor(0.7, 0.3);
  s.bodies[0].shape = Box{{0.2, 0.2, 0.2}};
  return s;
}

Scene inertiaMatrix() {
  Scene s = boxOnFloor(0.7, 0.3);
  const Mat3 R = Quat(0.7, -0.1, 0.5, 0.3).normalized().toRotationMatrix();
  s.bodies[0].inertia = Inertia::fromMatrix(R * Vec3(0.006, 0.01, 0.013).asDiagonal() * R.transpose());
  return s;
}

Scene ballOnFloor() {
  Scene s = makeScene(kThrownGravity, 0.7, 0.3, {makeBall("ball", 0.1, {0, 0, 0.7}, {1, 0.4, -1}), floorPlane()});
  s.bodies[0].angular_velocity = {3, 20, -4};
  return s;
}

Scene pair(Body a, Body b, double friction = 0.3) {
  return makeScene(kThrownGravity, 0.8, friction, {std::move(a), std::move(b), floorPlane()});
}

Body ballFrom(const Vec3& position, const Vec3& to) {
  Body b = makeBall("ball", 0.1, position, 4 * (to - position));
  b.angular_velocity = {5, 1, -3};
  return b;
}

Body flyingBox(const Vec3& position) {
  Body b = makeBox("target", {0.4, 0.3, 0.5}, position, {0.1, 0.2, 1});
  b.mass = 2.5;
  b.angular_velocity = {0.1, 0.2, -0.1};
  return b;
}

const Vec3 kAt(0, 0, 1.2);
Scene ballBall() { return pair(ballFrom({0, 0, 1}, {0.9, 0.1, 1}), makeBall("other", 0.2, {0.9, 0.1, 1.05})); }
Scene ballFace() { return pair(ballFrom({0.9, 0, 1.2}, kAt), flyingBox(kAt)); }
Scene ballEdge() { return pair(ballFrom({0.8, 0.75, 1.2}, kAt), flyingBox(kAt)); }
Scene edgeBall() { return pair(flyingBox(kAt), ballFrom({0.8, 0.75, 1.2}, kAt)); }
Scene ballCorner() { return pair(ballFrom({0.6, 0.55, 1.85}, {0.225, 0.2, 1.7}), flyingBox(kAt)); }
Scene faceBall() { return pair(flyingBox(kAt), ballFrom({0.9, 0, 1.2}, kAt)); }

Body cornerBox(const Vec3& position, const Vec3& velocity) {
  Body b = makeBox("corner", {0.2, 0.25, 0.3}, position, velocity);
  b.orientation = Quat::FromTwoVectors(Vec3(-1, 1.1, 0.9), Vec3::UnitX());
  b.angular_velocity = {0.3, -0.2, 0.4};
  return b;
}
Scene vertexFace() { return pair(cornerBox({-0.9, 0.02, 1.25}, {3, 0, 0.2}), flyingBox(kAt)); }
Scene faceVertex() { return pair(flyingBox(kAt), cornerBox({-0.9, 0.02, 1.25}, {3, 0, 0.2})); }

Scene density() {
  Scene s = vertexFace();
  s.bodies[0].mass.reset();
  s.bodies[0].density = 650;
  return s;
}

// two long boxes, crossed, edge towards edge
Scene edgeEdge() {
  Body a = makeBox("over", {1, 0.1, 0.1}, {0.05, 0, 1.5}, {0, 0, -2}),
       b = makeBox("under", {0.1, 1, 0.1}, {0, 0.05, 1});
  a.orientation = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitX()));
  b.orientation = Quat(Eigen::AngleAxisd(0.8, Vec3::UnitY()));
  a.angular_velocity = {0.1, -0.2, 0.3};
  b.angular_velocity = {0.2, 0.1, 0.4};
  return pair(a, b);
}

Scene fixedBoxPose() {
  Body step = fixedBody(makeBox("step", {0.5, 0.4, 0.3}, {0.35, 0, 0.15}));
  step.orientation = Quat(0.97, 0.1, -0.1, 0.2).normalized();
  return makeScene(kThrownGravity, 0.7, 0.3, {ballFrom({-0.3, 0, 1}, {0.3, 0, 0.3}), step, floorPlane()});
}

Scene planeFirst() {  // the plane as first body of the pair
  Scene s = boxOnFloor(0.7, 0.3);
  std::swap(s.bodies[0], s.bodies[1]);
  return s;
}

Scene combined(Combine elasticity, Combine friction) {
  Scene s = boxOnFloor(0.7, 0.3, 0.2);
  s.materials.push_back(makeMaterial("other", 0.5, 0.6, -0.4));
  s.materials[0].combine_elasticity = elasticity;
  s.materials[1].combine_elasticity = Combine::multiply;
  s.materials[0].combine_friction = friction;
  s.materials[1].combine_friction = Combine::multiply;
  s.bodies[1].material = "other";
  return s;
}
Scene combineMinimum() { return combined(Combine::minimum, Combine::maximum); }
Scene combineMaximum() { return combined(Combine::maximum, Combine::minimum); }
Scene combineMultiply() { return combined(Combine::multiply, Combine::multiply); }
Scene combineAverage() { return combined(Combine::average, Combine::average); }

Scene tilted() {
  Scene s = vertexFace();
  s.tilts = {{"corner", 1, {0.05, -0.08}}, {"target", 1, {-0.03, 0.02}}, {"target", 2, {0.04, 0.01}}};
  return s;
}

Scene threeBodies() {
  RandomScene o;
  o.bodies = 4, o.lowest_elasticity = 0.4;
  return randomScene(4, o);
}

// bodies that gravity pulls each in its own way
Scene gravityFactor() {
  Scene s = boxOnFloor(0.7, 0.3);
  s.bodies[0].gravity_factor = 0.4;
  return s;
}
Scene gravityFactors() {
  Scene s = ballBall();
  s.bodies[0].gravity_factor = 0.3;
  s.bodies[1].gravity_factor = 0.9;
  return s;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const DotProductScene& row) { return out << row.name; }

std::vector<DotProductScene> dotProductScenes() {
  std::vector<DotProductScene> rows{
      // impact laws
      {"frictionless", frictionless, 3, {"frictionless"}},
      {"stick", stick, 3, {"stick"}},
      {"slide", slide, 3, {"slide"}},
      {"joint_frictionless", jointFrictionless, 2, {"joint"}},
      {"joint_stick", jointStick, 2, {"joint"}},
      {"joint_slide", jointSlide, 2, {"joint"}},
      {"unlike_frictionless", unlikeFrictionless, 1, {"joint"}},
      {"unlike_friction", unlikeFriction, 1, {"joint"}},
      {"unlike_belt", unlikeBelt, 1, {"joint"}},
      // flight tiers of body 0: of the motion / of the derivative
      {"tier_none", ballOnFloor, 3, {"none/none"}, {{false, false}, {}}},
      {"tier_spherical", ballOnFloor, 3, {"spherical/spherical"}, {{true, false}, {}}},
      {"tier_spherical_written", spherical, 3, {"spherical/triaxial"}},
      {"tier_derived_cube", derivedCube, 3, {"spherical/triaxial"}},
      {"tier_symmetric", symmetric, 3, {"symmetric/triaxial"}},
      {"tier_symmetric_long", symmetricLong, 3, {"symmetric/triaxial"}},
      {"tier_triaxial", triaxial, 3, {"triaxial/triaxial"}},
      // ways of writing a body
      {"inertia_matrix", inertiaMatrix},
      {"density", density},
      {"fixed_box_pose", fixedBoxPose, 3},
      // pairs of features, in the order of the bodies
      {"ball_plane", ballOnFloor, 3, {"ball on plane"}},
      {"vertex_plane", stick, 3, {"vertex"}},
      {"plane_vertex", planeFirst, 3, {"plane on vertex"}},
      {"ball_ball", ballBall, 2, {"ball on ball"}},
      {"ball_face", ballFace, 2, {"ball on face"}},
      {"face_ball", faceBall, 2, {"on ball"}},
      {"ball_edge", ballEdge, 2, {"ball on edge"}},
      {"edge_ball", edgeBall, 2, {"edge", "on ball"}},
      {"ball_corner", ballCorner, 2, {"ball on vertex"}},
      {"vertex_face", vertexFace, 2, {"vertex", "on face"}},
      {"face_vertex", faceVertex, 2, {"face", "on vertex"}},
      {"edge_edge", edgeEdge, 2, {"edge", "on edge"}},
      {"disc_on_beam", discOnBeam, 2, {"joint", "rim"}},
      {"disc_on_disc", discOnDisc, 2, {"joint", "rim"}},
      // combination of materials
      {"combine_average", combineAverage},
      {"combine_minimum", combineMinimum},
      {"combine_maximum", combineMaximum},
      {"combine_multiply", combineMultiply},
      {"tilt", tilted, 3},
      {"several_bodies", threeBodies, 5},
      {"gravity_factor", gravityFactor},
      {"gravity_factors", gravityFactors, 2, {"ball on ball"}},
  };
  for (DotProductScene& row : movingTargetScenes()) rows.push_back(std::move(row));
  for (DotProductScene& row : lastingScenes()) rows.push_back(std::move(row));
  return rows;
}

Motion motionOf(const DotProductScene& row) {
  const Scene scene = row.scene();
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = row.impacts;
  options.asked = row.asked;
  options.lowest_bounce = row.lowest_bounce;
  return simulate(scene, contacts, row.duration, options);
}

}  // namespace carom::test
