// SPDX-License-Identifier: MIT
#include "tests/editing/scenes.h"

#include <gtest/gtest.h>

#include "adjoint/simulate/simulate.h"

namespace carom::testing_scenes {

Material material(const std::string& name, double elasticity, double friction) {
  Material m;
  m.name = name, m.elasticity = elasticity, m.friction = friction;
  return m;
}

Body fixedPlane(const std::string& name, const std::string& material, const Vec3& normal, double offset) {
  Body body;
  body.name = name, body.fixed = true, body.material = material;
  body.shape = Plane{normal, offset};
  return body;
}

Body ball(const std::string& name, const std::string& material, double radius, const Vec3& position,
          const Vec3& velocity) {
  Body body;
  body.name = name, body.material = material, body.mass = 1;
  body.shape = Sphere{radius};
  body.position = position, body.velocity = velocity;
  return body;
}

Scene floorAndWall() {
  Scene scene;
  scene.gravity = {0, 0, -9.8};
  scene.materials = {material("rubber", 0.92, 0)};
  scene.bodies = {fixedPlane("floor", "rubber", Vec3::UnitZ(), 0), fixedPlane("wall", "rubber", -Vec3::UnitX(), -1.75),
                  ball("ball", "rubber", 0.1, {-0.5, 0, 1}, {5, 0, -5})};
  return scene;
}

Scene manyBounces() {
  Scene scene;
  scene.gravity = {0, 0, -9.8};
  scene.materials = {material("rubber", 0.8, 0)};
  scene.bodies = {fixedPlane("floor", "rubber", Vec3::UnitZ(), 0),
                  ball("ball", "rubber", 0.1, {0, 0, 50.1}, Vec3::Zero())};
  return scene;
}

Scene thrownBox() {
  Scene scene;
  scene.materials = {material("felt", 0.5, 0.4), material("wood", 0.6, 0.3)};
  Body box;
  box.name = "box", box.material = "felt", box.density = 600;
  box.shape = Box{{0.3, 0.2, 0.1}};
  box.position = {0, 0, 1};
  box.orientation = Quat(0.9, 0.2, -0.1, 0.3).normalized();
  box.velocity = {1.5, 0.2, 1};
  box.angular_velocity = {1, 2, 0.5};
  scene.bodies = {fixedPlane("floor", "wood", Vec3::UnitZ(), 0), box};
  return scene;
}

std::vector<Control> everyControl() {
  return {position("box"),
          orientation("box"),
          velocity("box"),
          angularVelocity("box"),
          surfaceVelocity("floor"),
          surfaceAngularVelocity("floor"),
          elasticity("felt"),
          friction("felt"),
          tangentialElasticity("felt"),
          mass("box"),
          inertia("box"),
          size("box"),
          tilt("box", 1),
          gravity()};
}

std::vector<Constraint> everyQuantity() {
  return {{"box", 0.4, {{"position", {1, any, 2}}, {"orientation", {1, 0, 0, 0}}, {"velocity", {0, 0, any}}}},
          {"box",
           nthImpact(2, "floor"),
           {{"time", {0.5}}, {"point", {1, 2, 3}, {0.1, 0.2, 0.3}}, {"angular_velocity", {any, 1, any}}}},
          {"box",
           0.4,
           {{"speed", {3}},
            {"kinetic_energy", {20}},
            {"height", {1}},
            {.quantity = "distance", .value = {0.3}, .to = "floor"},
            {.quantity = "closest_approach", .value = {0.5}, .to = "floor", .during = {{0.05, 0.3}}}}},
          {"box", nthImpact(2, "floor"), {{"impulse", {4}}, {"speed", {2}}, {"kinetic_energy", {10}}, {"contact", {1, 2, any}}}}};
}

void expectHonest(const EditResult& r, double duration, ContactSource& contacts) {
  EXPECT_FALSE(r.message.empty());
  const Motion again = simulate(r.scene, contacts, duration);
  EXPECT_EQ(again.signature(), r.motion.signature());
  if (r.solved()) {
    EXPECT_TRUE(r.scaled_residual <= 1e-9) << r.scaled_residual;
  }
}

}  // namespace carom::testing_scenes
