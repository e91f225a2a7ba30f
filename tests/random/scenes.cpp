// SPDX-License-Identifier: MIT
#include "tests/random/scenes.h"

#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>

#include "ode_bridge/ode_contacts.h"

namespace carom::brute {
namespace {

// Numbers by explicit formulae: the distributions of the standard library differ between implementations.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool chance(double p) { return uniform(0, 1) < p; }
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  Vec3 inCube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
    return {x, y, z};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = inCube(1);
      if (v.norm() <= 1 && v.norm() > 0.1) return v.normalized();
    }
  }
  Quat rotation() {
    for (;;) {
      const Vec3 v = inCube(1);
      const Quat q(uniform(-1, 1), v.x(), v.y(), v.z());
      if (q.norm() <= 1 && q.norm() > 0.1) return q.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

enum class Surroundings { open, floor, walls, closed };

void addMaterials(Scene& scene, Dice& dice) {
  const bool frictionless = dice.chance(0.35), tangential = dice.chance(0.2);
  const int count = dice.integer(1, 3);
  for (int i = 0; i < count; ++i) {
    Material m;
    m.name = "m" + std::to_string(i);
    m.elasticity = dice.chance(0.1) ? 1.0 : dice.uniform(0.3, 1);
    m.friction = frictionless ? 0 : dice.uniform(0, 1);
    m.tangential_elasticity = tangential ? dice.uniform(-1, 1) : 0;
    m.combine_elasticity = static_cast<Combine>(dice.integer(0, 2));  // not multiply: elasticities stay above 0.3
    m.combine_friction = static_cast<Combine>(dice.integer(0, 3));
    scene.materials.push_back(m);
  }
}

std::string anyMaterial(const Scene& scene, Dice& dice) {
  return scene.materials[static_cast<std::size_t>(dice.integer(0, static_cast<int>(scene.materials.size()) - 1))].name;
}

void addPlane(Scene& scene, Dice& dice, const Vec3& normal, double distance) {
  Body plane;
  plane.name = "plane" + std::to_string(scene.bodies.size());
  plane.fixed = true;
  plane.material = anyMaterial(scene, dice);
  if (dice.chance(0.5)) {
    plane.shape = Plane{normal, -distance};
  } else {  // the same half space, placed by the pose of its body
    plane.shape = Plane{};
    plane.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), normal).normalized();
    plane.position = -distance * normal;
  }
  scene.bodies.push_back(plane);
}

// Planes around the origin at about `half`, leaning a little.
void addSurroundings(Scene& scene, Dice& dice, Surroundings kind, double half) {
  const auto leaning = [&](const Vec3& n) -> Vec3 {
    return dice.chance(0.5) ? n : (n + 0.2 * dice.inCube(1)).normalized();
  };
  if (kind == Surroundings::open) return;
  addPlane(scene, dice, leaning(Vec3::UnitZ()), half);
  if (kind == Surroundings::floor) return;
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    addPlane(scene, dice, leaning(n), half);
  if (kind == Surroundings::closed) addPlane(scene, dice, leaning(-Vec3::UnitZ()), half);
}

Shape randomShape(Dice& dice) {
  if (dice.chance(0.4)) return Sphere{dice.logUniform(0.05, 0.5) / 2};
  if (dice.chance(0.15)) return Box{Vec3::Constant(dice.logUniform(0.08, 0.4))};  // cube
  Vec3 size;
  for (double& s : size) s = dice.logUniform(0.05, 0.5);
  if (dice.chance(0.2)) size[dice.integer(0, 1)] = size[2];  // two equal moments
  return Box{size};
}

Body randomBody(Scene& scene, Dice& dice, bool fixed, double half, bool aimed) {
  Body body;
  body.name = "body" + std::to_string(scene.bodies.size());
  body.material = anyMaterial(scene, dice);
  body.shape = randomShape(dice);
  body.fixed = fixed;
  body.position = dice.inCube(0.85 * half);
  body.orientation = dice.rotation();
  if (fixed) return body;
  if (dice.chance(0.5))
    body.mass = dice.logUniform(0.1, 10);
  else
    body.density = dice.logUniform(200, 5000);
  // one draw after the other: the order within an expression is the compiler's
  const Vec3 direction = dice.direction();
  body.velocity = dice.uniform(0, 5) * direction;
  if (aimed) {
    const Vec3 from = (body.position + 0.15 * dice.inCube(1)).normalized();
    body.velocity = -dice.uniform(1, 5) * from;
  }
  if (dice.chance(0.8)) {
    const Vec3 axis = dice.direction();
    body.angular_velocity = dice.uniform(0, 20) * axis;
  }
  return body;
}

bool startsApart(const Scene& scene) { return OdeContacts(scene).overlaps().empty(); }

}  // namespace

RandomScene randomScene(std::uint64_t seed) {
  Dice dice(seed);
  RandomScene random;
  Scene& scene = random.scene;
  addMaterials(scene, dice);
  const auto kind = static_cast<Surroundings>(dice.integer(0, 3));
  const double half = dice.uniform(0.5, 0.9);
  addSurroundings(scene, dice, kind, half);
  const bool gravity = kind != Surroundings::open && dice.chance(0.7);
  scene.gravity = gravity ? Vec3(0, 0, -9.81) : Vec3::Zero();
  const int count = dice.integer(2, 8);
  for (int i = 0; i < count; ++i) {
    const bool fixed = i > 0 && dice.chance(0.2);
    for (int attempt = 0; attempt < 200; ++attempt) {
      scene.bodies.push_back(randomBody(scene, dice, fixed, half, kind == Surroundings::open));
      if (startsApart(scene)) break;
      scene.bodies.pop_back();
    }
  }
  random.duration = dice.uniform(0.5, 1.5);
  return random;
}

std::string describe(const RandomScene& random) {
  const Scene& s = random.scene;
  std::ostringstream out;
  out << std::setprecision(17) << "gravity " << s.gravity.transpose() << ", duration " << random.duration << "\n";
  for (const Material& m : s.materials)
    out << "  " << m.name << ": e " << m.elasticity << " mu " << m.friction << " e_t " << m.tangential_elasticity
        << " combine " << static_cast<int>(m.combine_elasticity) << static_cast<int>(m.combine_friction) << "\n";
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const Body& b = s.bodies[i];
    out << "  " << i << " " << kindOf(b.shape).name << " " << b.material << (b.fixed ? " fixed" : " moving");
    if (const auto* plane = std::get_if<Plane>(&b.shape))
      out << " normal " << plane->normal.transpose() << " offset " << plane->offset;
    else
      out << " size " << kindOf(b.shape).dimensions(b.shape).transpose();
    if (b.mass) out << " mass " << *b.mass;
    if (b.density) out << " density " << *b.density;
    out << " x " << b.position.transpose() << " q(wxyz) " << b.orientation.w() << " " << b.orientation.vec().transpose()
        << " v " << b.velocity.transpose() << " w " << b.angular_velocity.transpose() << "\n";
  }
  return out.str();
}

}  // namespace carom::brute
