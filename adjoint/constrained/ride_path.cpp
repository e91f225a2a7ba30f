// SPDX-License-Identifier: MIT
#include "adjoint/constrained/ride_path.hpp"

#include "adjoint/constrained/left_jacobian_rate.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

Vec3 momentumOf(const BodyModel& model, const Mat3& R, const Vec3& w) { return R * model.inertia.cwiseProduct(R.transpose() * w); }

// The carrier is a body at X, with V and W, with a surface that moves on it; E is its rotation since the start, J the inertia
// tensor. By the surface a place comes to x_s = o + K u + r_s, r_s = E_s (x_0 - o), with u the velocity of its material at o,
// w its spin, E_s = exp(t w) and K = t J_l(t w). By the body to
//   x = X + r, r = E (x_s - X_0), R = E E_s R_0, v = V + W x r + E v_s, L = J (W + E w).
class PartLinearization {
 public:
  PartLinearization(const Motion& motion, const Carrier::Part& part, double start, const BodyModel& model, const Vec3& x_0, const State& state, double t)
      : motion_(motion), part_(part), start_(start), model_(model), elapsed_(t - start), state_(state), R_(state.q.toRotationMatrix()) {
    if (part.support.moves()) {
      const Kinematics k = part.support.arc->kinematicsAt(t);
      X_ = k.x, W_ = k.w;
    }
    const SupportFlow flow = SupportFlow::of(part.support, start, t);
    E_ = flow.turned, F_ = flow.by_spin;
    r_ = state.x - X_;
    if (!part.support.has_belt) return;
    u_ = part.surfaceVelocity(), w_ = part.surfaceSpin();
    const Vec3 turn = elapsed_ * w_;
    E_s_ = expSO3(turn).toRotationMatrix(), K_ = elapsed_ * leftJacobian(turn), D_ = elapsed_ * elapsed_ * leftJacobianRate(turn, u_);
    r_s_ = E_s_ * (x_0 - part.origin());
    v_s_ = E_s_ * u_ + w_.cross(r_s_);
  }

  StateDerivative tangent(const StateDerivative& start, const SceneTangent& dscene, const BodyModelDerivative& dmodel) const {
    const Rates d = ratesOf(dscene);
    const Vec3 turns_s = K_ * d.w, goes = E_s_ * (start.x - d.o) + turns_s.cross(r_s_);
    const Vec3 x_s = d.o + K_ * d.u + D_ * d.w + goes;
    const Vec3 v_s = E_s_ * d.u + turns_s.cross(Vec3(E_s_ * u_)) + d.w.cross(r_s_) + w_.cross(goes);
    const Vec3 moves = d.X + elapsed_ * d.V, turns = F_ * d.W;
    StateDerivative out;
    out.x = moves + E_ * (x_s - d.X) + turns.cross(r_);
    out.theta = E_ * (E_s_ * start.theta + turns_s) + turns;
    out.v = d.V + d.W.cross(r_) + W_.cross(Vec3(out.x - moves)) + turns.cross(Vec3(E_ * v_s_)) + E_ * v_s;
    const Vec3 spin = spinOfBody(), d_spin = d.W + turns.cross(Vec3(E_ * w_)) + E_ * d.w;
    out.L = out.theta.cross(state_.L) + momentumOf(model_, R_, d_spin - out.theta.cross(spin)) + R_ * (dmodel.inertiaTensor() * (R_.transpose() * spin));
    return out;
  }

  StateDerivative pullback(const StateDerivative& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) const {
    const Vec3 spin = spinOfBody(), by_momentum = momentumOf(model_, R_, bar.L);
    model_bar.addInertiaBar((R_.transpose() * bar.L) * (R_.transpose() * spin).transpose());
    const Vec3 theta = bar.theta + state_.L.cross(bar.L) - spin.cross(by_momentum);
    const Vec3 x = bar.x + bar.v.cross(W_), v_s = E_.transpose() * bar.v;
    const Vec3 turns = theta + r_.cross(x) + (E_ * v_s_).cross(bar.v) + (E_ * w_).cross(by_momentum);
    const Vec3 x_s = E_.transpose() * x, theta_s = E_.transpose() * theta;
    const Vec3 goes = x_s + v_s.cross(w_), turns_s = theta_s + r_s_.cross(goes) + (E_s_ * u_).cross(v_s);
    StateDerivative start;
    start.x = E_s_.transpose() * goes;
    start.theta = E_s_.transpose() * theta_s;
    Rates d;
    d.X = bar.x - x_s;
    d.V = bar.v + elapsed_ * bar.x;
    d.W = F_.transpose() * turns + r_.cross(bar.v) + by_momentum;
    d.o = x_s - start.x;
    d.u = K_.transpose() * x_s + E_s_.transpose() * v_s;
    d.w = D_.transpose() * x_s + K_.transpose() * turns_s + r_s_.cross(v_s) + E_.transpose() * by_momentum;
    pullback(d, scene_bar);
    return start;
  }

 private:
  // Of the start of the path, or their adjoints.
  struct Rates {
    Vec3 X = Vec3::Zero(), V = Vec3::Zero(), W = Vec3::Zero(), o = Vec3::Zero(), u = Vec3::Zero(), w = Vec3::Zero();
  };

  Vec3 spinOfBody() const { return W_ + E_ * w_; }

  // The face goes with its body: u and w turn with it, and get what is along the face, or about its normal.
  Rates ratesOf(const SceneTangent& dscene) const {
    const BodyDerivative& d = dscene.bodies[static_cast<std::size_t>(part_.body)];
    Rates rates;
    Vec3 theta = d.orientation;
    rates.o = d.position;
    if (part_.support.moves()) {
      const StateDerivative of = fromSceneStart(motion_, part_.body, part_.support, start_).tangent(d);
      rates.X = of.x, rates.V = of.v, rates.W = of.L, theta = of.theta;
      rates.o = of.x - theta.cross(Vec3(part_.support.pose.R * part_.support.center));
    }
    if (!part_.support.has_belt) {
      rates.o.setZero();
      return rates;
    }
    const Vec3 n = part_.normalInWorld(), by_velocity = part_.support.pose.R * d.surface_velocity, by_spin = part_.support.pose.R * d.surface_angular_velocity;
    rates.u = theta.cross(u_) + by_velocity - n * n.dot(by_velocity) + part_.height * by_spin.cross(n);
    rates.w = theta.cross(w_) + n * n.dot(by_spin);
    return rates;
  }

  void pullback(const Rates& rates, SceneGradient& scene_bar) const {
    BodyDerivative& d = scene_bar.bodies[static_cast<std::size_t>(part_.body)];
    StateDerivative of;
    of.x = rates.X, of.v = rates.V, of.L = rates.W;
    Vec3 o = Vec3::Zero();
    if (part_.support.has_belt) {
      o = rates.o;
      const Vec3 n = part_.normalInWorld();
      of.theta = u_.cross(rates.u) + w_.cross(rates.w);
      d.surface_velocity += part_.support.pose.R.transpose() * Vec3(rates.u - n * n.dot(rates.u));
      d.surface_angular_velocity += part_.support.pose.R.transpose() * Vec3(part_.height * n.cross(rates.u) + n * n.dot(rates.w));
    }
    if (!part_.support.moves()) {
      d.position += o, d.orientation += of.theta;
      return;
    }
    of.x += o, of.theta -= Vec3(part_.support.pose.R * part_.support.center).cross(o);
    fromSceneStart(motion_, part_.body, part_.support, start_).pullback(of, d);
  }

  const Motion& motion_;
  const Carrier::Part& part_;
  double start_;
  const BodyModel& model_;
  double elapsed_;
  State state_;
  Mat3 R_, E_ = Mat3::Identity(), F_ = Mat3::Zero(), E_s_ = Mat3::Identity(), K_ = Mat3::Zero(), D_ = Mat3::Zero();
  Vec3 X_ = Vec3::Zero(), W_ = Vec3::Zero(), r_, u_ = Vec3::Zero(), w_ = Vec3::Zero(), r_s_ = Vec3::Zero(), v_s_ = Vec3::Zero();
};

// Of several that translate alike, the mean: they have one motion only where they change alike.
class RideLinearization final : public TrajectoryLinearization {
 public:
  RideLinearization(const Motion& motion, const RidePath& path, const Arc& arc, double t) {
    const State& start = arc.startState();
    for (const Carrier::Part& part : path.carrier().parts)
      parts_.emplace_back(motion, part, path.carrier().start, arc.model(), start.x, path.carried(arc.model(), start, t), t);
  }

  StateDerivative tangent(const StateDerivative& start, const SceneTangent& dscene, const BodyModelDerivative& dmodel) const override {
    StateDerivative mean;
    for (const PartLinearization& part : parts_) mean.addScaled(share(), part.tangent(start, dscene, dmodel));
    return mean;
  }

  StateDerivative pullback(const StateDerivative& bar, SceneGradient& scene_bar, BodyModelDerivative& model_bar) const override {
    StateDerivative of_each, sum;
    of_each.addScaled(share(), bar);
    for (const PartLinearization& part : parts_) sum += part.pullback(of_each, scene_bar, model_bar);
    return sum;
  }

 private:
  double share() const { return 1.0 / static_cast<double>(parts_.size()); }
  std::vector<PartLinearization> parts_;
};

}  // namespace

State RidePath::carried(const BodyModel& model, const State& start, double t) const {
  const Carrier::Instant from = carrier_.at(carrier_.start), now = carrier_.at(t);
  const bool straight = carrier_.isBelt() && now.w.isZero(0);
  State state;
  state.x = straight ? Vec3(start.x + now.moved) : Vec3(now.x + now.turned * (start.x - from.x));
  state.q = now.w.isZero(0) ? start.q : (Quat(now.turned) * start.q).normalized();
  state.v = now.velocityAt(state.x);
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
