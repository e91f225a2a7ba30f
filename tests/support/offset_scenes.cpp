// SPDX-License-Identifier: MIT
#include "tests/support/offset_scenes.h"

#include <algorithm>
#include <numbers>

#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom::test {
namespace {

const Quat kTurned = Quat(0.7, -0.1, 0.5, 0.3).normalized();
const Vec3 kCenter(0.03, -0.02, 0.015);

CompoundPart part(const Shape& shape, const Vec3& position, const Quat& orientation = Quat::Identity()) {
  return {shape, position, orientation};
}

Scene thrown(const Shape& shape, const std::optional<Vec3>& center = {}) {
  Body b = makeBall("body", 1, {0.1, -0.2, 0.7}, {0.8, 0.4, -0.9});
  b.shape = shape;
  b.mass = 1.3;
  b.center_of_mass = center;
  b.orientation = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  b.angular_velocity = {4, -3, 6};
  Body floor = makePlane("floor", Vec3(0.1, -0.05, 1).normalized(), 0.02);
  floor.position = {0.02, 0.01, -0.03};
  floor.orientation = Quat(Eigen::AngleAxisd(0.1, Vec3(0.6, 0.8, 0)));
  Scene s = makeScene({0.2, -0.1, -9.81}, 0.7, 0.25, {b, floor});
  s.materials[0].tangential_elasticity = 0.2;
  return s;
}

const Box kBrick{{0.3, 0.2, 0.1}};

Scene ballWithCenter() { return thrown(Sphere{0.12}, kCenter); }
Scene boxWithCenter() { return thrown(kBrick, kCenter); }
Scene boxWithMomentsAndCenter() {
  Scene s = boxWithCenter();
  s.bodies[0].inertia = Inertia::fromMoments({0.006, 0.01, 0.013});
  return s;
}
Scene boxWithMatrixAndCenter() {
  Scene s = boxWithCenter();
  const Mat3 R = kTurned.toRotationMatrix();
  s.bodies[0].inertia = Inertia::fromMatrix(R * Vec3(0.006, 0.01, 0.013).asDiagonal() * R.transpose());
  return s;
}

// A hammer that is nobody's idea of symmetry.
Compound hammer() {
  return {{part(Sphere{0.08}, {0.02, 0.01, 0.2}), part(Box{{0.05, 0.06, 0.3}}, {0.01, 0, 0}, kTurned),
           part(Cylinder{0.04, 0.12}, {0.06, -0.03, -0.05}, kTurned.conjugate()), part(Sphere{0.03}, {-0.1, 0.05, 0})}};
}
Scene compound() { return thrown(hammer()); }
Scene compoundByDensity() {
  Scene s = compound();
  s.bodies[0].mass.reset();
  s.bodies[0].density = 420;
  return s;
}
Scene compoundWithCenter() { return thrown(hammer(), kCenter); }
Scene compoundWithMoments() {
  Scene s = compound();
  s.bodies[0].inertia = Inertia::fromMoments({0.008, 0.009, 0.004});
  return s;
}

// Two balls on a cylinder: whatever their sizes, it stays round.
Compound dumbbell(const Vec3& at, const Quat& q) {
  const Vec3 axis = q * Vec3::UnitZ();
  return {
      {part(Cylinder{0.02, 0.3}, at, q), part(Sphere{0.07}, at - 0.15 * axis), part(Sphere{0.05}, at + 0.15 * axis)}};
}
Scene round() { return thrown(dumbbell({0, 0, 0.04}, Quat::Identity())); }
Scene roundAskew() { return thrown(dumbbell({0.02, 0.03, -0.01}, kTurned)); }

// Four balls at the corners of a square: one that grows turns the principal axes.
Scene square() {
  Compound c;
  for (double x : {-0.1, 0.1})
    for (double y : {-0.1, 0.1}) c.parts.push_back(part(Sphere{0.05}, {x, y, 0.03}));
  return thrown(c);
}
Scene squareOfBox() {  // its sides vary one by one, its axes stay
  return thrown(Compound{{part(Box{{0.2, 0.2, 0.08}}, {0, 0, 0}), part(Sphere{0.06}, {0, 0, 0.1})}});
}
Scene cube() {
  Compound c;
  for (int v = 0; v < 8; ++v)
    c.parts.push_back(part(Sphere{0.05}, 0.1 * Vec3(v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1) + kCenter));
  return thrown(c);
}

// A wedge whose centre of mass is far from its origin and whose principal axes are its own business.
Triangles wedge() {
  return tetrahedron({0.02, 0.01, -0.03}, {0.27, 0.03, 0.01}, {0.05, 0.22, -0.02}, {0.09, 0.06, 0.18});
}
Scene capsule() { return thrown(Capsule{0.06, 0.22}); }
Scene capsuleByDensity() {
  Scene s = thrown(Capsule{0.07, 0.16}, kCenter);
  s.bodies[0].mass.reset();
  s.bodies[0].density = 300;
  return s;
}
Scene hull() { return thrown(Hull{wedge().surface(), 1.1, ""}); }
Scene hullByDensity() {
  Scene s = hull();
  s.bodies[0].mass.reset();
  s.bodies[0].density = 500;
  return s;
}
// Of every kind one part, some of which stick out nowhere.
Scene everyKind() {
  return thrown(Compound{{part(Capsule{0.03, 0.3}, {0.02, 0, 0.05}, kTurned),
                          part(Hull{wedge().surface(), 0.9, ""}, {-0.1, 0, 0.02}, kTurned.conjugate()),
                          part(Mesh{torusTriangles(0.06, 0.02, 7, 5).surface(), 0.8, ""}, {0.03, 0.02, 0}, kTurned),
                          part(Cylinder{0.03, 0.1}, {0.05, 0.01, 0.01}), part(Box{{0.1, 0.2, 0.05}}, {0, 0.05, 0})}});
}

// Shapes that nothing touches here: flights of what round rims and meshes weigh.
Scene flying(Scene s) {
  s.bodies[1].position.z() = -50;
  return s;
}
Scene cylinder() { return flying(thrown(Cylinder{0.12, 0.2}, kCenter)); }
Scene cylinderByDensity() {
  Scene s = flying(thrown(Cylinder{0.12, 0.2}));
  s.bodies[0].mass.reset();
  s.bodies[0].density = 200;
  return s;
}
Scene cone() { return flying(thrown(Cone{0.12, 0.25}, kCenter)); }
Scene coneByDensity() {
  Scene s = flying(thrown(Cone{0.12, 0.25}));
  s.bodies[0].mass.reset();
  s.bodies[0].density = 300;
  return s;
}
Scene cones() {
  return flying(thrown(Compound{{part(Cone{0.12, 0.25}, kCenter, kTurned), part(Cone{0.06, 0.3}, {0.1, 0, 0.02})}}));
}
Scene mesh() {  // two pieces, so that no two moments are equal
  const Triangles t = torusTriangles(0.2, 0.07, 9, 6).with(boxTriangles({0.1, 0.2, 0.3}).placed(kTurned, {0.3, 0, 0}));
  return flying(thrown(Mesh{t.placed(kTurned, kCenter).surface(), 0.8, ""}));
}
Scene openMesh() {  // its centre of mass is its origin
  Triangles cup = boxTriangles({0.2, 0.3, 0.4});
  cup.triangles.pop_back();
  Scene s = flying(thrown(Mesh{cup.surface(), 0.8, ""}));
  s.bodies[0].inertia = Inertia::fromMoments({0.006, 0.01, 0.013});
  return s;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const OffsetScene& row) { return out << row.name; }

const std::vector<OffsetScene>& offsetScenes() {
  using T = Tier;
  static const std::vector<OffsetScene> rows = {
      {"ball_center", ballWithCenter, 0.8, T::spherical, T::spherical, false},
      {"box_center", boxWithCenter, 0.8, T::triaxial, T::triaxial, false},
      {"box_moments_center", boxWithMomentsAndCenter, 0.8, T::triaxial, T::triaxial, false},
      {"box_matrix_center", boxWithMatrixAndCenter, 0.8, T::triaxial, T::triaxial, false},
      {"compound", compound, 0.8, T::triaxial, T::triaxial, true},
      {"compound_density", compoundByDensity, 0.8, T::triaxial, T::triaxial, true},
      {"compound_center", compoundWithCenter, 0.8, T::triaxial, T::triaxial, true},
      {"compound_moments", compoundWithMoments, 0.8, T::triaxial, T::triaxial, false},
      {"round", round, 0.8, T::symmetric, T::symmetric, false},
      {"round_askew", roundAskew, 0.8, T::symmetric, T::symmetric, false},
      {"square", square, 0.8, T::symmetric, T::triaxial, true},
      {"square_of_box", squareOfBox, 0.8, T::symmetric, T::triaxial, false},
      {"cube", cube, 0.8, T::spherical, T::triaxial, true},
      {"capsule", capsule, 0.8, T::symmetric, T::symmetric, false},
      {"capsule_density", capsuleByDensity, 0.8, T::symmetric, T::symmetric, false},
      {"hull", hull, 0.8, T::triaxial, T::triaxial, false},
      {"hull_density", hullByDensity, 0.5, T::triaxial, T::triaxial, false},
      {"every_kind", everyKind, 0.6, T::triaxial, T::triaxial, true},
      {"cylinder", cylinder, 0.8, T::symmetric, T::symmetric, false},
      {"cylinder_density", cylinderByDensity, 0.8, T::symmetric, T::symmetric, false},
      {"cone", cone, 0.8, T::symmetric, T::symmetric, false},
      {"cone_density", coneByDensity, 0.8, T::symmetric, T::symmetric, false},
      {"cones", cones, 0.8, T::triaxial, T::triaxial, true},
      {"mesh", mesh, 0.8, T::triaxial, T::triaxial, false},
      {"open_mesh", openMesh, 0.8, T::triaxial, T::triaxial, false},
  };
  return rows;
}

Scene floorFirst(Scene scene) {
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  return scene;
}

}  // namespace carom::test
