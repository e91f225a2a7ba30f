// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/edit.h"

/// Scenes that several tests of editing/ use.
namespace carom::testing_scenes {

Material material(const std::string& name, double elasticity, double friction);
Body fixedPlane(const std::string& name, const std::string& material, const Vec3& normal, double offset);
Body ball(const std::string& name, const std::string& material, double radius, const Vec3& position,
          const Vec3& velocity);

/// docs/equations.md section 8, "floor and wall", in the plane y = 0: z is the height.
Scene floorAndWall();
/// The same section, "many bounces": a ball of radius .1 released at rest from 50 above its lowest place.
Scene manyBounces();
/// A box thrown against a floor with friction; everything about it can vary.
Scene thrownBox();

/// One control of every kind, for a scene with a body "box" of material "felt".
std::vector<Control> everyControl();
/// Constraints on every quantity of that body, at a time and at its second impact.
std::vector<Constraint> everyQuantity();

/// What every result must keep, whatever its status: it says what its own scene does.
void expectHonest(const EditResult& r, double duration, ContactSource& contacts);

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace carom::testing_scenes
