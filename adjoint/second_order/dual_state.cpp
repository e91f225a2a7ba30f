// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_state.hpp"

namespace carom::adjoint_detail {

namespace {

template <class OfNum, class OfMatrix>
SceneGradient picked(const SceneBar& bar, const Scene& scene, const OfNum& number, const OfMatrix& matrix) {
  SceneGradient out(scene);
  out.gravity = matrix(bar.gravity);
  for (std::size_t m = 0; m < bar.materials.size(); ++m)
    out.materials[m] = {number(bar.materials[m].elasticity), number(bar.materials[m].friction),
                        number(bar.materials[m].tangential_elasticity)};
  for (std::size_t b = 0; b < bar.bodies.size(); ++b) {
    const BodyBar& in = bar.bodies[b];
    out.bodies[b] = {matrix(in.position), matrix(in.orientation), matrix(in.velocity), matrix(in.angular_velocity),
                     number(in.mass),     number(in.density),     matrix(in.inertia),  matrix(in.size),
                     matrix(in.surface_velocity), matrix(in.surface_angular_velocity)};
  }
  for (std::size_t t = 0; t < bar.tilts.size(); ++t) out.tilts[t] = matrix(bar.tilts[t]);
  return out;
}

// Mass properties of a shape with their rates, field by field.
struct DualSolidRate {
  Num volume;
  NVec center;
  NMat unit_inertia;
};
struct DualSolid : DualSolidRate {
  std::vector<DualSolidRate> rates;
};

DualSolid dualSolid(const Shape& shape, std::span<const BodyDerivative* const> lanes) {
  const ShapeKind& kind = kindOf(shape);
  if (!kind.solid(shape)) return {};  // nothing follows from the shape
  const auto constants = [](const auto& p) {
    return DualSolidRate{p.volume, constant(p.center), constant(p.unit_inertia)};
  };
  const auto set = [](DualSolidRate& to, const auto& rate, std::size_t lane) {
    to.volume.rate[lane] = rate.volume;
    setRates(to.center, rate.center, lane);
    setRates(to.unit_inertia, rate.unit_inertia, lane);
  };
  const SolidProperties now = kind.properties(shape);
  DualSolid out{constants(now), {}};
  for (const SolidRate& rate : now.rates) out.rates.push_back(constants(rate));
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const SolidProperties along = kind.propertiesRate(shape, lanes[lane]->size);
    set(out, along, lane);
    for (std::size_t d = 0; d < out.rates.size(); ++d) set(out.rates[d], along.rates[d], lane);
  }
  return out;
}

}  // namespace

SceneGradient ratesOf(const SceneBar& bar, const Scene& scene, std::size_t lane) {
  return picked(
      bar, scene, [lane](const Num& n) { return n.rate[lane]; }, [lane](const auto& m) { return ratesOf(m, lane); });
}

SceneGradient valuesOf(const SceneBar& bar, const Scene& scene) {
  return picked(
      bar, scene, [](const Num& n) { return n.value; }, [](const auto& m) { return valuesOf(m); });
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
  NMat R_WG = constant(Mat3(body.orientation.normalized().toRotationMatrix()));
  NVec w = constant(body.angular_velocity);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    turn(R_WG, lanes[i]->orientation, i);
    setRates(w, lanes[i]->angular_velocity, i);
  }
  startPullbackOf(model, R_WG, w, bar, body_bar, model_bar);
}

void modelPullback(const Body& body, const DualModel& model, std::span<const BodyDerivative* const> lanes,
                   const ModelBar& bar, BodyBar& body_bar) {
  if (body.fixed) return;
  const bool derived = body.inertia.source == Inertia::Source::derived;
  const bool by_size = !body.center_of_mass || (!body.kinematic && (body.density || derived));
  Num density = body.density.value_or(0);
  for (std::size_t i = 0; i < lanes.size(); ++i) density.rate[i] = lanes[i]->density;
  modelPullbackOf(body, model, density, by_size ? dualSolid(body.shape, lanes) : DualSolid{}, bar, body_bar);
}

}  // namespace carom::adjoint_detail
