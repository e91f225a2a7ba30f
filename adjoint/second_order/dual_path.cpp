// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_path.hpp"

#include "adjoint/contact/closed_path_linearization.hpp"

namespace carom::adjoint_detail {
namespace {

const Arc& arcOf(const Lanes& lanes, int body, int k) {
  return lanes.motion().world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(k)];
}

PathInputs<Num> inputsOf(const Lanes& lanes, int body, int k) {
  const ContactPath& path = *arcOf(lanes, body, k).closedForm();
  const DualState start = lanes.startOf(body, k);
  PathInputs<Num> in;
  in.x = start.x, in.v = start.v, in.L = start.L, in.R = start.R;
  in.gravity = lanes.gravity();
  in.normal = constant(path.inputs.normal);
  in.friction = lanes.rules(path.body, path.face).friction.value;
  in.mass = lanes.model(body).mass;
  in.J = lanes.model(body).J;
  in.reach = Num(path.inputs.reach);
  in.axis = constant(path.inputs.axis);
  in.begins = path.inputs.begins;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const auto& bodies = lanes.direction(lane).scene.bodies;
    setRates(in.normal, Vec3(bodies[static_cast<std::size_t>(path.face)].orientation.cross(path.inputs.normal)), lane);
    if (path.reach_rates.size() > 0)
      in.reach.rate[lane] = path.reach_rates.dot(bodies[static_cast<std::size_t>(path.body)].size);
  }
  return in;
}

Num elapsedAt(const Lanes& lanes, int body, int k, const Num& t) {
  Num elapsed = t - lanes.startTime(body, k);
  elapsed.value = arcOf(lanes, body, k).closedForm()->elapsedAt(t.value);
  return elapsed;
}

}  // namespace

StateBar pathRate(const Lanes& lanes, int body, int k, const Num& t) {
  return pathRateAt<Num>(arcOf(lanes, body, k).closedForm()->variedForm(), inputsOf(lanes, body, k), elapsedAt(lanes, body, k, t));
}

StateBar pathPullback(const Lanes& lanes, int body, int k, const Num& t, const StateBar& end_bar, SceneBar& scene_bar,
                      ModelBar& model_bar) {
  const ContactPath& path = *arcOf(lanes, body, k).closedForm();
  const PathInputs<Num> in = inputsOf(lanes, body, k);
  const bool orientation = !carom::isZero(end_bar.theta);
  PathInputsDerivative<Num> bar;
  const StateBar start_bar =
      pullback(pathSensitivity<Num>(path.variedForm(), in, elapsedAt(lanes, body, k, t), orientation), end_bar, bar);
  pathInputsPullback<Num>(*lanes.motion().scene, path, in.normal, lanes.rules(path.body, path.face).friction, bar,
                          scene_bar, model_bar);
  return start_bar;
}

}  // namespace carom::adjoint_detail
