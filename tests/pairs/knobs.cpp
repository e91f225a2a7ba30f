// SPDX-License-Identifier: MIT
#include "tests/pairs/replay.h"

namespace carom::pairs {
namespace {

BodyNumbers bodyNumbers(const Body& body) {
  BodyNumbers n;
  n.moving = !body.fixed;
  n.shape = exact::numbersOf<Fine>(body.shape);
  n.position = FineVector(body.position);
  n.orientation = exact::rotationOf<Fine>(body.orientation);
  if (body.fixed) return n;
  n.has_density = body.density.has_value();
  n.mass_or_density = n.has_density ? *body.density : body.mass.value();
  n.inertia_derived = body.inertia.source == Inertia::Source::derived;
  n.moments = FineVector(body.inertia.moments);
  n.axes = exact::rotationOf<Fine>(body.inertia.axes);
  n.velocity = FineVector(body.velocity);
  n.spin = FineVector(body.angular_velocity);
  return n;
}

// The table of knobs, filled row by row.
struct Table {
  std::vector<PairKnob> knobs;

  void scalar(const std::string& name, int body, const std::function<Fine&(PairNumbers&)>& number,
              const std::function<double&(SceneDerivative&)>& entry) {
    knobs.push_back({name, body, [number](PairNumbers& n, const Fine& h) { number(n) += h; }, entry});
  }
  void vector(const std::string& name, int body, const std::function<FineVector&(PairNumbers&)>& number,
              const std::function<Vec3&(SceneDerivative&)>& entry) {
    for (int i = 0; i < 3; ++i)
      scalar(
          name + "." + "xyz"[i], body, [number, i](PairNumbers& n) -> Fine& { return number(n)[i]; },
          [entry, i](SceneDerivative& d) -> double& { return entry(d)[i]; });
  }
};

void addBody(Table& table, const BodyNumbers& body, std::size_t b) {
  using N = PairNumbers;
  using D = SceneDerivative;
  const std::string of = " of body " + std::to_string(b);
  const int own = static_cast<int>(b);
  table.vector(
      "position" + of, -1, [b](N& n) -> FineVector& { return n.bodies[b].position; },
      [b](D& d) -> Vec3& { return d.bodies[b].position; });
  for (int i = 0; i < 3; ++i)
    table.knobs.push_back({"orientation" + of + "." + "xyz"[i], -1,
                           [b, i](N& n, const Fine& h) {
                             FineMatrix& R = n.bodies[b].orientation;
                             R = exact::rotationBy(exact::unitVector<Fine>(i, h)) * R;
                           },
                           [b, i](D& d) -> double& { return d.bodies[b].orientation[i]; }});
  for (int i = 0; i < body.shape.dimensions(); ++i)
    table.scalar(
        "dimension " + std::to_string(i) + of, own, [b, i](N& n) -> Fine& { return n.bodies[b].shape.dimension(i); },
        [b, i](D& d) -> double& { return d.bodies[b].size[i]; });
  if (!body.moving) return;
  table.vector(
      "velocity" + of, -1, [b](N& n) -> FineVector& { return n.bodies[b].velocity; },
      [b](D& d) -> Vec3& { return d.bodies[b].velocity; });
  table.vector(
      "spin" + of, -1, [b](N& n) -> FineVector& { return n.bodies[b].spin; },
      [b](D& d) -> Vec3& { return d.bodies[b].angular_velocity; });
  const bool density = body.has_density;
  table.scalar((density ? "density" : "mass") + of, own, [b](N& n) -> Fine& { return n.bodies[b].mass_or_density; },
               [b, density](D& d) -> double& { return density ? d.bodies[b].density : d.bodies[b].mass; });
  if (!body.inertia_derived)
    table.vector(
        "moments" + of, own, [b](N& n) -> FineVector& { return n.bodies[b].moments; },
        [b](D& d) -> Vec3& { return d.bodies[b].inertia; });
}

}  // namespace

PairNumbers pairNumbers(const Scene& scene) {
  PairNumbers n;
  n.gravity = FineVector(scene.gravity);
  for (std::size_t i = 0; i < 2; ++i) {
    const Material& m = scene.materials.at(i);
    n.materials[i] = {m.elasticity, m.friction, m.tangential_elasticity, m.combine_elasticity, m.combine_friction};
    n.bodies[i] = bodyNumbers(scene.bodies.at(i));
  }
  return n;
}

std::vector<PairKnob> knobsOf(const PairNumbers& numbers) {
  using N = PairNumbers;
  using D = SceneDerivative;
  Table table;
  table.vector(
      "gravity", -1, [](N& n) -> FineVector& { return n.gravity; }, [](D& d) -> Vec3& { return d.gravity; });
  for (std::size_t i = 0; i < 2; ++i) {
    addBody(table, numbers.bodies[i], i);
    const std::string of = " of material " + std::to_string(i);
    table.scalar(
        "elasticity" + of, -1, [i](N& n) -> Fine& { return n.materials[i].elasticity; },
        [i](D& d) -> double& { return d.materials[i].elasticity; });
    table.scalar(
        "friction" + of, -1, [i](N& n) -> Fine& { return n.materials[i].friction; },
        [i](D& d) -> double& { return d.materials[i].friction; });
    table.scalar(
        "tangential elasticity" + of, -1, [i](N& n) -> Fine& { return n.materials[i].tangential_elasticity; },
        [i](D& d) -> double& { return d.materials[i].tangential_elasticity; });
  }
  return table.knobs;
}

std::string PairRow::name() const {
  const char* const names[] = {"time", "normal", "point", "before", "after"};
  const char* const parts[] = {"position", "rotation", "velocity", "spin"};
  std::string text = names[static_cast<int>(of)];
  if (of == Of::time) return text;
  if (body >= 0) text += ": " + std::string(parts[component / 3]) + " of body " + std::to_string(body);
  return text + "." + "xyz"[component % 3];
}

std::vector<PairRow> rowsOf(const PairNumbers& numbers) {
  using Of = PairRow::Of;
  std::vector<PairRow> rows = {{Of::time, -1, 0}};
  for (const Of of : {Of::normal, Of::point})
    for (int i = 0; i < 3; ++i) rows.push_back({of, -1, i});
  for (int body = 0; body < 2; ++body) {
    if (!numbers.bodies[body].moving) continue;
    for (const Of of : {Of::before, Of::after})
      for (int i = 0; i < 12; ++i) rows.push_back({of, body, i});
  }
  return rows;
}

}  // namespace carom::pairs
