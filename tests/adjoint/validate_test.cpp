// SPDX-License-Identifier: MIT
// Scenes that are not physically meaningful are refused, with the place: one row a mistake.

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "adjoint/base/errors.h"
#include "tests/adjoint/shapes.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom {
namespace {

using namespace test;

Scene sound() {
  Scene s = makeScene({0, 0, -9.81}, 0.5, 0.3,
                      {makePlane("floor", Vec3::UnitZ(), 0), makeBall("ball", 0.1, {0, 0, 1}),
                       makeBox("box", {0.1, 0.2, 0.3}, {1, 0, 1})});
  s.bodies[2].mass.reset();
  s.bodies[2].density = 500;
  s.materials.push_back(makeMaterial("felt", 0.2, 0.8));
  s.tilts = {{"box", 1, {0.1, 0}}};
  return s;
}

Mesh boxMesh(const Vec3& size = {1, 1, 1}) { return {boxTriangles(size).surface(), 1, ""}; }
Mesh openMesh() {
  Triangles cup = boxTriangles({1, 1, 1});
  cup.triangles.pop_back();
  return {cup.surface(), 1, ""};
}
Hull boxHull(double scale) { return {boxTriangles({1, 1, 1}).surface(), scale, ""}; }

Compound nested(int levels) {
  Compound c{{part(Sphere{0.1})}};
  for (int i = 1; i < levels; ++i) c = Compound{{part(c)}};
  return c;
}
// 1 m long and 1e-6 m thick, along no axis.
Compound needle() { return {{part(boxMesh({1e-6, 1e-6, 1}), Vec3::Zero(), Quat(0.8, 0.3, -0.4, 0.2).normalized())}}; }

struct Mistake {
  const char* where;  ///< JSON pointer that the error must name
  std::function<void(Scene&)> make;
};

std::vector<Mistake> mistakes() {
  return {
      {"/gravity/2", [](Scene& s) { s.gravity.z() = kNan; }},
      {"/gravity/0", [](Scene& s) { s.gravity.x() = kInf; }},
      {"/gravity/1", [](Scene& s) { s.gravity.y() = 1e300; }},
      {"/materials/m/elasticity", [](Scene& s) { s.materials[0].elasticity = 1.01; }},
      {"/materials/m/elasticity", [](Scene& s) { s.materials[0].elasticity = -1e-9; }},
      {"/materials/felt/elasticity", [](Scene& s) { s.materials[1].elasticity = kNan; }},
      {"/materials/m/friction", [](Scene& s) { s.materials[0].friction = -0.1; }},
      {"/materials/m/friction", [](Scene& s) { s.materials[0].friction = kInf; }},
      {"/materials/m/tangential_elasticity", [](Scene& s) { s.materials[0].tangential_elasticity = 1.5; }},
      {"/materials/m/tangential_elasticity", [](Scene& s) { s.materials[0].tangential_elasticity = -1.5; }},
      {"/materials/1/name", [](Scene& s) { s.materials[1].name = "m"; }},
      {"/materials/1/name", [](Scene& s) { s.materials[1].name = ""; }},
      {"/bodies/2/name", [](Scene& s) { s.bodies[2].name = "ball"; }},
      {"/bodies/0/name", [](Scene& s) { s.bodies[0].name = ""; }},
      {"/bodies/1/material", [](Scene& s) { s.bodies[1].material = "cheese"; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = 0; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = -2; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = kNan; }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = kInf; }},
      {"/bodies/1", [](Scene& s) { s.bodies[1].mass.reset(); }},
      {"/bodies/1/density", [](Scene& s) { s.bodies[1].density = 100; }},
      {"/bodies/2/density", [](Scene& s) { s.bodies[2].density = 0; }},
      {"/bodies/2/density", [](Scene& s) { s.bodies[2].density = -kInf; }},
      {"/bodies/1/shape/sphere/radius", [](Scene& s) { s.bodies[1].shape = Sphere{0}; }},
      {"/bodies/1/shape/sphere/radius", [](Scene& s) { s.bodies[1].shape = Sphere{-0.1}; }},
      {"/bodies/1/shape/sphere/radius", [](Scene& s) { s.bodies[1].shape = Sphere{kNan}; }},
      {"/bodies/2/shape/box/size/1",
       [](Scene& s) {
         s.bodies[2].shape = Box{{0.1, 0, 0.3}};
       }},
      {"/bodies/2/shape/box/size/2",
       [](Scene& s) {
         s.bodies[2].shape = Box{{0.1, 0.1, kInf}};
       }},
      {"/bodies/0/shape/plane/normal",
       [](Scene& s) {
         s.bodies[0].shape = Plane{{0, 0, 0}, 0};
       }},
      {"/bodies/0/shape/plane/normal",
       [](Scene& s) {
         s.bodies[0].shape = Plane{{0, 0, 2}, 0};
       }},
      {"/bodies/0/shape/plane/normal",
       [](Scene& s) {
         s.bodies[0].shape = Plane{{0, kNan, 1}, 0};
       }},
      {"/bodies/0/shape/plane/offset",
       [](Scene& s) {
         s.bodies[0].shape = Plane{{0, 0, 1}, kNan};
       }},
      {"/bodies/1/shape", [](Scene& s) { s.bodies[1].shape = Plane{}; }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({0, 1, 1});
       }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({1, 1, -1});
       }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({1, kNan, 1});
       }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({1, 1, 2.1});
       }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({5, 1, 2});
       }},
      {"/bodies/2/inertia", [](Scene& s) { s.bodies[2].inertia = Inertia::fromMatrix(Vec3(1, 1, 9).asDiagonal()); }},
      {"/bodies/1/position/0", [](Scene& s) { s.bodies[1].position.x() = kNan; }},
      {"/bodies/1/position/2", [](Scene& s) { s.bodies[1].position.z() = 1e10; }},
      {"/bodies/1/orientation", [](Scene& s) { s.bodies[1].orientation = Quat(0, 0, 0, 0); }},
      {"/bodies/1/orientation", [](Scene& s) { s.bodies[1].orientation = Quat(1, 0.1, 0, 0); }},
      {"/bodies/1/orientation", [](Scene& s) { s.bodies[1].orientation = Quat(kNan, 0, 0, 0); }},
      {"/bodies/2/velocity/1", [](Scene& s) { s.bodies[2].velocity.y() = -kInf; }},
      {"/bodies/2/angular_velocity/0", [](Scene& s) { s.bodies[2].angular_velocity.x() = kNan; }},
      {"/bodies/1/shape/capsule/radius",
       [](Scene& s) {
         s.bodies[1].shape = Capsule{0, 1};
       }},
      {"/bodies/1/shape/capsule/radius",
       [](Scene& s) {
         s.bodies[1].shape = Capsule{kInf, 1};
       }},
      {"/bodies/1/shape/capsule/height",
       [](Scene& s) {
         s.bodies[1].shape = Capsule{0.1, -1};
       }},
      {"/bodies/1/shape/capsule/height",
       [](Scene& s) {
         s.bodies[1].shape = Capsule{0.1, kNan};
       }},
      {"/bodies/1/shape/cylinder/radius",
       [](Scene& s) {
         s.bodies[1].shape = Cylinder{-0.1, 1};
       }},
      {"/bodies/1/shape/cylinder/height",
       [](Scene& s) {
         s.bodies[1].shape = Cylinder{0.1, 0};
       }},
      {"/bodies/1/shape/cylinder/height",
       [](Scene& s) {
         s.bodies[1].shape = Cylinder{0.1, 2e9};
       }},
      {"/bodies/1/shape/hull", [](Scene& s) { s.bodies[1].shape = Hull{}; }},
      {"/bodies/1/shape/hull",
       [](Scene& s) {
         s.bodies[1].shape = Hull{openMesh().surface, 1, ""};
       }},
      {"/bodies/1/shape/hull/scale", [](Scene& s) { s.bodies[1].shape = boxHull(0); }},
      {"/bodies/1/shape/hull/scale", [](Scene& s) { s.bodies[1].shape = boxHull(kNan); }},
      {"/bodies/1/shape/hull/scale", [](Scene& s) { s.bodies[1].shape = boxHull(1e10); }},
      {"/bodies/1/shape/hull/scale", [](Scene& s) { s.bodies[1].shape = boxHull(8e9); }},
      {"/bodies/1/shape/mesh", [](Scene& s) { s.bodies[1].shape = Mesh{}; }},
      {"/bodies/1/shape/mesh", [](Scene& s) { s.bodies[1].shape = openMesh(); }},
      {"/bodies/2/shape/mesh", [](Scene& s) { s.bodies[2].shape = openMesh(); }},
      {"/bodies/1/shape/mesh/scale",
       [](Scene& s) {
         s.bodies[1].shape = Mesh{boxMesh().surface, -1, ""};
       }},
      {"/bodies/1/shape/mesh/scale",
       [](Scene& s) {
         s.bodies[1].shape = Mesh{boxMesh().surface, 6e8 * 6, ""};
       }},
      {"/bodies/1/shape/compound", [](Scene& s) { s.bodies[1].shape = Compound{}; }},
      {"/bodies/1/shape/compound/1/plane",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Sphere{1}), part(Plane{})}};
       }},
      {"/bodies/1/shape/compound/0/box/size/2",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Box{{1, 1, 0}})}};
       }},
      {"/bodies/1/shape/compound/1/compound/0/sphere/radius",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Sphere{1}), part(Compound{{part(Sphere{-1})}})}};
       }},
      {"/bodies/1/shape/compound/0/position/1",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Sphere{1}, {0, kNan, 0})}};
       }},
      {"/bodies/1/shape/compound/0/orientation",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Sphere{1}, {0, 0, 0}, Quat(2, 0, 0, 0))}};
       }},
      {"/bodies/1/shape/compound/1/mesh",
       [](Scene& s) {
         s.bodies[1].shape = Compound{{part(Sphere{1}), part(openMesh())}};
       }},
      {"/bodies/1/shape", [](Scene& s) { s.bodies[1].shape = needle(); }},
      {"/bodies/2/shape/cylinder/radius",
       [](Scene& s) {
         s.bodies[2].shape = Cylinder{1e-200, 1};
       }},
      {"/bodies/2/shape/sphere/radius", [](Scene& s) { s.bodies[2].shape = Sphere{5e-324}; }},
      {"/bodies/2/shape/box/size/1",
       [](Scene& s) {
         s.bodies[2].shape = Box{{1, 9e-31, 1}};
       }},
      {"/bodies/2/shape/hull/scale", [](Scene& s) { s.bodies[2].shape = boxHull(1e-31); }},
      {"/bodies/2/shape",
       [](Scene& s) {
         s.bodies[2].shape = Sphere{1e-20};
         s.bodies[2].density = 1e-100;
       }},
      {"/bodies/1/mass", [](Scene& s) { s.bodies[1].mass = 1e-160; }},
      {"/bodies/2/density", [](Scene& s) { s.bodies[2].density = 1e-160; }},
      {"/bodies/2/inertia",
       [](Scene& s) {
         s.bodies[2].inertia = Inertia::fromMoments({1e-160, 1, 1});
       }},
      {"/bodies/1/inertia", [](Scene& s) { s.bodies[1].inertia = Inertia::fromMoments({1, 0.99e-8, 1}); }},
      {"/bodies/1/shape", [](Scene& s) { s.bodies[1].shape = Capsule{1e-8, 1}; }},  // a needle
      {"/bodies/1/shape", [](Scene& s) { s.bodies[1].shape = Capsule{1e-5, 1}; }},
      {"/bodies/1/shape", [](Scene& s) { s.bodies[1].shape = Box{{1e-5, 1, 1e-5}}; }},
      {"/bodies/1/center_of_mass/2", [](Scene& s) { s.bodies[1].center_of_mass = Vec3(0, 0, kNan); }},
      {"/bodies/1/shape/compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/"
       "compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/compound/0/compound",
       [](Scene& s) { s.bodies[1].shape = nested(17); }},
      {"/bodies/2/shape/mesh",
       [](Scene& s) {
         s.bodies[2].shape = openMesh();
         s.bodies[2].inertia = Inertia::fromMoments({1, 1, 1});
       }},
      {"/tilts/0/body", [](Scene& s) { s.tilts[0].body = "floor"; }},
      {"/tilts/0/body", [](Scene& s) { s.tilts[0].body = "nobody"; }},
      {"/tilts/0/impact", [](Scene& s) { s.tilts[0].impact = 0; }},
      {"/tilts/0/value/0", [](Scene& s) { s.tilts[0].value.x() = kNan; }},
  };
}

TEST(Validate, SoundSceneIsAccepted) {
  EXPECT_NO_THROW(validate(sound()));
  EXPECT_NO_THROW(validate(Scene{})) << "nothing in it";
}

// What is unusual and has a meaning.
TEST(Validate, OddShapesAreAccepted) {
  const std::vector<std::function<void(Body&)>> odd = {
      [](Body& b) {
        b.shape = openMesh(), b.inertia = Inertia::fromMoments({1, 1, 1});
      },
      [](Body& b) { b.shape = openMesh(), b.fixed = true, b.mass.reset(); },
      [](Body& b) {
        b.shape = Compound{{part(openMesh()), part(Sphere{1})}}, b.inertia = Inertia::fromMoments({1, 1, 1});
      },
      [](Body& b) { b.shape = boxHull(1e-3); },
      [](Body& b) {
        b.shape = Compound{{part(Sphere{1}), part(Sphere{1})}};
      },  // two at one place
      [](Body& b) { b.shape = nested(16); },
      [](Body& b) {
        b.shape = needle(), b.inertia = Inertia::fromMoments({1, 1, 1e-8});
      },
      [](Body& b) {
        b.shape = boxMesh({1e-4, 1e-4, 1});
      },  // moments in a ratio of 5e7
      [](Body& b) { b.center_of_mass = Vec3(5, 0, 0); },  // outside the body, as a boomerang's
  };
  for (std::size_t i = 0; i < odd.size(); ++i) {
    SCOPED_TRACE(i);
    Scene s = sound();
    odd[i](s.bodies[1]);
    EXPECT_NO_THROW(validate(s));
  }
}

TEST(Validate, EveryMistakeIsNamed) {
  int row = 0;
  for (const Mistake& mistake : mistakes()) {
    SCOPED_TRACE("row " + std::to_string(row++) + ", " + mistake.where);
    Scene s = sound();
    mistake.make(s);
    try {
      validate(s);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), mistake.where) << error.what();
      EXPECT_NE(error.message().find("found "), std::string::npos) << error.what();
      EXPECT_NE(error.message().find("expected "), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace carom
