// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_state.hpp"

namespace carom::detail {

SceneBar::SceneBar(const Scene& scene)
    : materials(scene.materials.size()), bodies(scene.bodies.size()), tilts(scene.tilts.size(), V2<Num>::Zero()) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Shape& shape = scene.bodies[b].shape;
    bodies[b].size = Eigen::Matrix<Num, Eigen::Dynamic, 1>::Zero(kindOf(shape).dimensions(shape).size());
  }
}

template <class OfNum, class OfMatrix>
SceneGradient SceneBar::picked(const Scene& scene, const OfNum& number, const OfMatrix& matrix) const {
  SceneGradient out(scene);
  out.gravity = matrix(gravity);
  for (std::size_t m = 0; m < materials.size(); ++m)
    out.materials[m] = {number(materials[m].elasticity), number(materials[m].friction),
                        number(materials[m].tangential_elasticity)};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyBar& in = bodies[b];
    out.bodies[b] = {matrix(in.position), matrix(in.orientation), matrix(in.velocity), matrix(in.angular_velocity),
                     number(in.mass),     number(in.density),     matrix(in.inertia),  matrix(in.size)};
  }
  for (std::size_t t = 0; t < tilts.size(); ++t) out.tilts[t] = matrix(tilts[t]);
  return out;
}

SceneGradient SceneBar::rates(const Scene& scene, std::size_t lane) const {
  return picked(
      scene, [lane](const Num& n) { return n.rate[lane]; }, [lane](const auto& m) { return ratesOf(m, lane); });
}

SceneGradient SceneBar::values(const Scene& scene) const {
  return picked(
      scene, [](const Num& n) { return n.value; }, [](const auto& m) { return valuesOf(m); });
}

DualModel dualModel(const BodyModel& model) {
  DualModel out;
  out.moving = model.moving;
  out.kinematic = model.kinematic;
  out.gravity_factor = model.gravity_factor;
  out.mass = model.mass;
  out.inverse_mass = model.inverse_mass;
  out.J = constant(Mat3(model.inertia.asDiagonal()));
  out.A = constant(Mat3(model.inverse_inertia.asDiagonal()));
  out.center = constant(model.center);
  out.R_BG = model.R_BG;
  return out;
}

void setRates(DualModel& dual, const BodyModelDerivative& d, std::size_t lane) {
  if (!dual.moving) return;
  const Mat3 dJ = d.inertiaTensor(), A = valuesOf(dual.A);
  dual.mass.rate[lane] = d.mass;
  dual.inverse_mass.rate[lane] = -d.mass * dual.inverse_mass.value * dual.inverse_mass.value;
  setRates(dual.J, dJ, lane);
  setRates(dual.A, Mat3(-A * dJ * A), lane);
  setRates(dual.center, d.center, lane);
}

DualState dualState(const State& s) {
  return {constant(s.x), constant(s.v), constant(s.L), constant(s.q.toRotationMatrix())};
}

void setRates(DualState& dual, const StateDerivative& d, std::size_t lane) {
  setRates(dual.x, d.x, lane);
  setRates(dual.v, d.v, lane);
  setRates(dual.L, d.L, lane);
  turn(dual.R, d.theta, lane);
}

void startPullback(const Body& body, const DualModel& model, std::span<const BodyDerivative* const> lanes,
                   const StateBar& bar, BodyBar& body_bar, ModelBar& model_bar) {
  body_bar.position += bar.x;
  body_bar.orientation += bar.theta;
  if (!model.moving) return;
  NMat R_WG = constant(body.orientation.normalized().toRotationMatrix());
  NVec w = constant(body.angular_velocity);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    turn(R_WG, lanes[i]->orientation, i);
    setRates(w, lanes[i]->angular_velocity, i);
  }
  const NMat R = R_WG * model.R_BG.transpose();
  body_bar.orientation += (R_WG * model.center).cross(bar.x);
  model_bar.center += R_WG.transpose() * bar.x;
  body_bar.velocity += bar.v;
  const NMat J = R * model.J * R.transpose();
  const NVec w_bar = J * bar.L, Jw = J * w;
  body_bar.angular_velocity += w_bar;
  body_bar.orientation += Jw.cross(bar.L) - w.cross(w_bar);
  model_bar.addInertiaBar((R.transpose() * bar.L) * (R.transpose() * w).transpose());
}

void modelPullback(const Body& body, const DualModel& model, std::span<const BodyDerivative* const> lanes,
                   const ModelBar& bar, BodyBar& body_bar) {
  if (body.fixed) return;
  if (body.kinematic && body.center_of_mass) return;
  const bool derived = body.inertia.source == Inertia::Source::derived;
  if (!derived && !body.kinematic) body_bar.inertia += bar.inertia;
  if (!body.kinematic && !body.density && !derived && body.center_of_mass) {
    body_bar.mass += bar.mass;
    return;
  }
  const ShapeKind& kind = kindOf(body.shape);
  if (!kind.solid(body.shape)) {  // nothing follows from the shape
    if (!body.kinematic) body_bar.mass += bar.mass;
    return;
  }
  const SolidProperties solid = kind.properties(body.shape);
  std::vector<SolidProperties> rates;
  for (const BodyDerivative* lane : lanes) rates.push_back(kind.propertiesRate(body.shape, lane->size));
  // a number of the solid with its rates
  const auto number = [&](double value, const auto& of) {
    Num n = value;
    for (std::size_t i = 0; i < rates.size(); ++i) n.rate[i] = of(rates[i]);
    return n;
  };
  const auto matrix = [&](const auto& value, const auto& of) {
    auto m = constant(value);
    for (std::size_t i = 0; i < rates.size(); ++i) setRates(m, of(rates[i]), i);
    return m;
  };
  if (body.kinematic) {  // its centre alone follows from the shape
    for (std::size_t d = 0; d < solid.rates.size(); ++d)
      body_bar.size[static_cast<Eigen::Index>(d)] +=
          bar.center.dot(matrix(solid.rates[d].center, [d](const auto& p) { return p.rates[d].center; }));
    return;
  }
  Num density = body.density.value_or(0);
  for (std::size_t i = 0; i < lanes.size(); ++i) density.rate[i] = lanes[i]->density;
  const Num volume = number(solid.volume, [](const SolidProperties& p) { return p.volume; });

  Num mass_bar = bar.mass;
  NMat J_G_bar = NMat::Zero();
  if (derived) {
    NMat J_bar = bar.inertia.asDiagonal();
    J_bar(1, 2) = J_bar(2, 1) = 0.5 * bar.products[0];
    J_bar(0, 2) = J_bar(2, 0) = 0.5 * bar.products[1];
    J_bar(0, 1) = J_bar(1, 0) = 0.5 * bar.products[2];
    J_G_bar = model.R_BG.transpose() * J_bar * model.R_BG;
    mass_bar += J_G_bar.cwiseProduct(matrix(solid.unit_inertia, [](const auto& p) { return p.unit_inertia; })).sum();
  }
  for (std::size_t d = 0; d < solid.rates.size(); ++d) {
    Num& size_bar = body_bar.size[static_cast<Eigen::Index>(d)];
    if (derived) {
      const NMat j = matrix(solid.rates[d].unit_inertia, [d](const auto& p) { return p.rates[d].unit_inertia; });
      size_bar += model.mass * J_G_bar.cwiseProduct(j).sum();
    }
    if (!body.center_of_mass)
      size_bar += bar.center.dot(matrix(solid.rates[d].center, [d](const auto& p) { return p.rates[d].center; }));
    if (body.density)
      size_bar += mass_bar * density * number(solid.rates[d].volume, [d](const auto& p) { return p.rates[d].volume; });
  }
  (body.density ? body_bar.density : body_bar.mass) += body.density ? mass_bar * volume : mass_bar;
}

}  // namespace carom::detail
