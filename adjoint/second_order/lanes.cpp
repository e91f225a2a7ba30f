// SPDX-License-Identifier: MIT
#include "adjoint/second_order/lanes.hpp"

#include "adjoint/derivative/arc_pass.hpp"
#include "adjoint/second_order/dual_path.hpp"

namespace carom::adjoint_detail {
namespace {

std::vector<const SceneTangent*> scenesOf(std::span<const ReadingDirection> directions) {
  std::vector<const SceneTangent*> out;
  for (const ReadingDirection& d : directions) out.push_back(&d.scene);
  return out;
}

}  // namespace

Lanes::Lanes(DerivativeTape& tape, std::span<const ReadingDirection> directions)
    : tape_(tape),
      directions_(directions),
      influence_(tape.motion(), scenesOf(directions)),
      gravity_(constant(tape.motion().scene->gravity)) {
  for (const BodyModel& model : *motion().models) models_.push_back(dualModel(model));
  for (std::size_t lane = 0; lane < directions.size(); ++lane) {
    tangents_.push_back(carom::tangent(tape, directions[lane].scene, &influence_));
    setRates(gravity_, directions[lane].scene.gravity, lane);
    for (std::size_t b = 0; b < models_.size(); ++b)
      setRates(models_[b], tangents_.back().model(static_cast<int>(b)), lane);
  }
}

std::vector<const BodyDerivative*> Lanes::ofBody(std::size_t body) const {
  std::vector<const BodyDerivative*> out;
  for (const ReadingDirection& d : directions_) out.push_back(&d.scene.bodies[body]);
  return out;
}

Num Lanes::eventTime(int event) const {
  Num t = motion().events[static_cast<std::size_t>(event)].time;
  for (std::size_t lane = 0; lane < size(); ++lane) t.rate[lane] = tangents_[lane].eventTime(event);
  return t;
}

Num Lanes::startTime(int body, int k) const {
  if (k == 0) return arc(body, 0).start();
  return eventTime(motion().world_lines[static_cast<std::size_t>(body)].events[static_cast<std::size_t>(k) - 1]);
}

DualState Lanes::startOf(int body, int k) const {
  const State& now = arc(body, k).startState();
  const StateDerivative flow = arc(body, k).rateAt(arc(body, k).start(), now);
  const Num t = startTime(body, k);
  DualState state = dualState(now);
  for (std::size_t lane = 0; lane < size(); ++lane) {
    StateDerivative d = tangents_[lane].start(body, k);
    d.addScaled(t.rate[lane], flow);
    setRates(state, d, lane);
  }
  return state;
}

DualState Lanes::stateAt(int body, int k, const Num& t, const State& now, const ArcSensitivity& S) const {
  const StateDerivative flow = arc(body, k).rateAt(t.value, now);
  DualState state = dualState(now);
  for (std::size_t lane = 0; lane < size(); ++lane) {
    StateDerivative d = arcTangent(motion(), body, k, t.value, S, [&](int of, int arc) { return tangents_[lane].start(of, arc); },
                                   directions_[lane].scene, [&](int of) { return tangents_[lane].model(of); });
    d.addScaled(t.rate[lane], flow);
    setRates(state, d, lane);
  }
  return state;
}

PairRules<Num> Lanes::rules(int a, int b) const {
  const Scene& scene = *motion().scene;
  const auto coefficients = [&](const Material& material, int m) {
    MaterialDerivativeOf<Num> out{material.elasticity, material.friction, material.tangential_elasticity};
    for (std::size_t lane = 0; m >= 0 && lane < size(); ++lane) {
      const MaterialDerivative& d = directions_[lane].scene.materials[static_cast<std::size_t>(m)];
      out.elasticity.rate[lane] = d.elasticity;
      out.friction.rate[lane] = d.friction;
      out.tangential_elasticity.rate[lane] = d.tangential_elasticity;
    }
    return out;
  };
  const Material &of_a = materialOf(scene, scene.bodies[static_cast<std::size_t>(a)]),
                 &of_b = materialOf(scene, scene.bodies[static_cast<std::size_t>(b)]);
  return {of_a, of_b, coefficients(of_a, materialIndexOf(scene, a)), coefficients(of_b, materialIndexOf(scene, b))};
}

StateBar Lanes::rate(int body, int k, const Num& t, const DualState& state) const {
  if (arc(body, k).closedForm()) return pathRate(*this, body, k, t);
  StateBar F;
  const DualModel& m = model(body);
  if (!m.moving) return F;
  F.x = state.v;
  F.theta = spinOf(m, state.R, state.L);
  F.v = m.gravity_factor * gravity_;
  return F;
}

}  // namespace carom::adjoint_detail
