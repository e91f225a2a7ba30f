// SPDX-License-Identifier: MIT
#include "adjoint/constrained/ride_path.hpp"

#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

Vec3 momentumOf(const BodyModel& model, const Mat3& R, const Vec3& w) { return R * model.inertia.cwiseProduct(R.transpose() * w); }

// With E the rotation of the carrier since the start, r = E (x_0 - X_0) and J the inertia tensor:
//   x = X + r, R = E R_0, v = V + W x r, L = J W.
class RideLinearization final : public TrajectoryLinearization {
 public:
  RideLinearization(const Motion& motion, const RidePath& path, const Arc& arc, double t)
      : motion_(motion), carrier_(path.carrier()), model_(arc.model()), now_(carrier_.at(t)), flow_(carrier_.flowTo(t)),
        elapsed_(t - carrier_.start), state_(path.carried(model_, arc.startState(), t)), r_(state_.x - now_.x),
        R_(state_.q.toRotationMatrix()) {}

  StateDerivative tangent(const StateDerivative& start, const SceneTangent& dscene, const BodyModelDerivative& dmodel) const override {
    const Carrier::Derivative d = carrier_.tangent(motion_, dscene);
    const Vec3 moves = d.x + elapsed_ * d.v, turns = flow_.by_spin * d.w;
    const Vec3 &W = now_.w, WR = R_.transpose() * W;
    StateDerivative out;
    out.x = moves + now_.turned * (start.x - d.x) + turns.cross(r_);
    out.theta = now_.turned * start.theta + turns;
    out.v = d.v + d.w.cross(r_) + W.cross(Vec3(out.x - moves));
    out.L = out.theta.cross(state_.L) + momentumOf(model_, R_, d.w - out.theta.cross(W)) + R_ * (dmodel.inertiaTensor() * WR);
    return out;
  }

  StateDerivative pullback(const StateDerivative& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) const override {
    const Vec3& W = now_.w;
    const Vec3 by_momentum = momentumOf(model_, R_, bar.L);
    model_bar.addInertiaBar((R_.transpose() * bar.L) * (R_.transpose() * W).transpose());
    const Vec3 theta = bar.theta + state_.L.cross(bar.L) - W.cross(by_momentum);
    const Vec3 x = bar.x + bar.v.cross(W);
    const Vec3 turns = theta + r_.cross(x);
    StateDerivative start;
    start.x = now_.turned.transpose() * x;
    start.theta = now_.turned.transpose() * theta;
    Carrier::Derivative d;
    const Vec3& moves = bar.x;  // x goes with them, and is measured from there for v
    d.x = moves - start.x;
    d.v = bar.v + elapsed_ * moves;
    d.w = by_momentum + r_.cross(bar.v) + flow_.by_spin.transpose() * turns;
    carrier_.pullback(motion_, d, scene_bar);
    return start;
  }

 private:
  const Motion& motion_;
  const Carrier& carrier_;
  const BodyModel& model_;
  Carrier::Instant now_;
  SupportFlow flow_;
  double elapsed_;
  State state_;
  Vec3 r_;
  Mat3 R_;
};

}  // namespace

State RidePath::carried(const BodyModel& model, const State& start, double t) const {
  const Carrier::Instant from = carrier_.at(carrier_.start), now = carrier_.at(t);
  const Vec3 r = now.turned * (start.x - from.x);
  State state;
  state.x = now.x + r;
  state.q = now.w.isZero(0) ? start.q : (Quat(now.turned) * start.q).normalized();
  state.v = now.v + now.w.cross(r);
  state.L = momentumOf(model, state.q.toRotationMatrix(), now.w);
  return state;
}

Vec3 RidePath::positionAt(const Arc& arc, double t) const { return stateAt(arc, t).x; }
Vec3 RidePath::velocityAt(const Arc& arc, double t) const { return stateAt(arc, t).v; }

StateDerivative RidePath::rateAt(const Arc&, double t, const State& state) const {
  const Carrier::Instant now = carrier_.at(t);
  StateDerivative rate;
  rate.x = state.v, rate.theta = now.w;
  rate.v = now.accelerationAt(state.x);
  rate.L = now.w.cross(state.L);
  return rate;
}

// The acceleration turns.
TrajectoryBounds RidePath::bounds(const Arc& arc) const {
  const Carrier::Instant from = carrier_.at(carrier_.start);
  TrajectoryBounds bounds;
  bounds.acceleration = from.accelerationAt(arc.startState().x);
  bounds.variation = 2 * bounds.acceleration.norm();
  bounds.straight = from.w.isZero(0);
  bounds.spin = from.w.norm();
  return bounds;
}

std::shared_ptr<const TrajectoryLinearization> RidePath::linearise(const Motion& motion, int body, int k, double t) const {
  const Arc& arc = motion.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(k)];
  return std::make_shared<RideLinearization>(motion, *this, arc, t);
}

}  // namespace carom::adjoint_detail
