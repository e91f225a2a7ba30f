// SPDX-License-Identifier: MIT
// Shapes of every family, what they are made of, and the mass properties that follow.
#include <cstdio>

#include "adjoint/base/errors.h"
#include "adjoint/scene/body_model.h"
#include "adjoint/scene/farthest_from.h"
#include "adjoint/scene/surface.h"
#include "ode_bridge/convex_hull.h"

using namespace carom;

int main() {
  Scene scene;
  Material rubber{.name = "rubber", .elasticity = 0.8, .friction = 0.9};
  rubber.combine_friction = Combine::maximum;  // rubber grips, whatever it meets
  scene.materials = {rubber};

  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::shared_ptr<const Surface> tetrahedron = convexHull(corners);
  const std::shared_ptr<const Surface> same = meshSurface(corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  const Shape shapes[] = {Sphere{0.5}, Capsule{0.2, 1}, Cone{0.3, 0.8}, Hull{tetrahedron, 1, ""}, Mesh{same, 2, ""}};
  for (const Shape& shape : shapes) {
    const ShapeKind& kind = kindOf(shape);
    const SolidProperties solid = kind.properties(shape);
    const SolidRate& rate = solid.rates[0];
    std::printf("%-8s volume %.4f m^3, centre (%.3f %.3f %.3f) m, d(volume)/d(%s) %.4f\n", kind.name, solid.volume,
                solid.center.x(), solid.center.y(), solid.center.z(), kind.dimension_names(shape)[0].c_str(), rate.volume);
  }

  const FarthestPoint foot = kindOf(shapes[2]).farthest(shapes[2], {0, 0.6, -0.8});  // on the rim of the cone's base
  const Vec3 place = foot.point({0, 0.6, -0.8});
  std::printf("cone     reaches %.2f m along (0 0.6 -0.8), at (%.1f %.1f %.1f)\n", foot.reach({0, 0.6, -0.8}), place.x(),
              place.y(), place.z());
  const FarthestFrom far = farthestFrom(shapes[2], {0, 0, 0.4});  // from its apex
  std::printf("cone     reaches %.2f m away from its apex\n", far.distance);

  Body wheel;
  wheel.name = "wheel", wheel.material = "rubber";
  wheel.shape = Cylinder{0.3, 0.1};
  wheel.mass = 4;
  wheel.inertia = Inertia::fromMoments({0.1, 0.1, 0.2});       // measured, not derived from the shape
  CollisionFilter& filter = wheel.collision_filter;
  filter.not_collide_with = {"ghosts"};                        // bodies of that system pass through it
  scene.bodies = {wheel};
  validate(scene);
  const BodyModel model = modelOf(wheel);
  const State start = startState(wheel, model);
  std::printf("wheel    %.1f kg, moments %.2f %.2f %.2f kg m^2, starts at z = %.1f\n", model.mass, model.inertia.x(),
              model.inertia.y(), model.inertia.z(), start.x.z());

  scene.bodies[0].mass = -4;
  try {
    validate(scene);
  } catch (const InputError& error) {
    std::printf("%s\n", error.what());
  }
}
