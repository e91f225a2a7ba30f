// SPDX-License-Identifier: MIT
#include "adjoint/flight/arc.h"

#include <utility>

#include "adjoint/base/names.hpp"
#include "adjoint/flight/flight_pass.hpp"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/trajectory.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(ArcKind kind) { return nameIn({"flight", "rest", "slide", "roll", "pivot", "ride"}, kind); }
const char* nameOf(Tier tier) { return nameIn({"none", "spherical", "symmetric", "triaxial"}, tier); }
const char* nameOf(TransitionCause cause) {
  return nameIn({"none", "slip_ends", "leaves", "tips", "lifts", "slips", "sticks"}, cause);
}

Arc::Arc(std::shared_ptr<const BodyModel> model, Tier tier, const Vec3& gravity, double start, const State& state)
    : model_(std::move(model)), trajectory_(flightOf(*model_, tier, state)), tier_(tier), start_(start), state_(state) {
  if (!model_->moving) return;
  take(trajectory_->bounds(*this));
  acceleration_ = model_->gravity_factor * gravity;
}

Arc::Arc(const BodyModel& model, Tier tier, const Vec3& gravity, double start, const State& state)
    : Arc(std::make_shared<const BodyModel>(model), tier, gravity, start, state) {}

Arc::Arc(std::shared_ptr<const BodyModel> model, Tier tier, std::shared_ptr<Trajectory> trajectory, double start,
         const State& state, int slot)
    : model_(std::move(model)),
      trajectory_(std::move(trajectory)),
      tier_(tier),
      slot_(slot),
      flies_(false),
      start_(start),
      state_(state) {
  take(trajectory_->bounds(*this));
}

void Arc::take(const TrajectoryBounds& bounds) {
  acceleration_ = bounds.acceleration;
  variation_ = bounds.variation;
  straight_ = bounds.straight;
  spin_bound_ = bounds.spin;
  spin_rate_bound_ = bounds.spin_rate;
}

Arc Arc::fork() const {
  auto trajectory = trajectory_->fork();
  return trajectory ? on(std::move(trajectory)) : *this;
}

Arc Arc::on(std::shared_ptr<adjoint_detail::Trajectory> trajectory) const {
  Arc own = *this;
  own.trajectory_ = std::move(trajectory);
  return own;
}

ArcKind Arc::kind() const { return trajectory_->kindOf(*this); }
const ContactPath* Arc::closedForm() const { return trajectory_->closedForm(); }
std::size_t Arc::series() const { return trajectory_->series(); }
bool Arc::isIntegrated() const { return trajectory_->isIntegrated(); }

// Persistent contact has derivatives with respect to the pose as the scene has it, which is that of the origin.
bool Arc::stays() const {
  if (!model_->moving) return true;
  return flies_ && model_->kinematic && state_.v.isZero(0) && state_.L.isZero(0) && model_->center.isZero(0);
}

std::optional<Vec3> Arc::steadyAxis() const {
  if (!flies_ && spin_bound_ > 0) return std::nullopt;
  if (!flies_ || tier_ == Tier::none || tier_ == Tier::spherical) return Vec3(Vec3::Zero());
  if (tier_ != Tier::symmetric) return std::nullopt;
  const Vec3 axis = Vec3::Unit(symmetryAxis(model_->inertia));
  return model_->has_offset ? Vec3(model_->R_BG.transpose() * axis) : axis;
}

double Arc::precession() const {
  const int axis = tier_ == Tier::symmetric ? symmetryAxis(model_->inertia) : 2;
  return state_.L.norm() * model_->inverse_inertia[(axis + 1) % 3];
}

double Arc::knownUntil() const { return trajectory_->knownUntil(); }
double Arc::availableUntil() const { return trajectory_->availableUntil(*this); }

// Another arc may have extended it, too.
void Arc::extendTo(double t) {
  trajectory_->extendTo(*this, t);
  if (trajectory_->isIntegrated()) take(trajectory_->bounds(*this));
}

Vec3 Arc::positionAt(double t) const {
  if (!straight_) return trajectory_->positionAt(*this, t);
  const double s = t - start_;
  return state_.x + s * (state_.v + 0.5 * s * acceleration_);
}

Vec3 Arc::velocityAt(double t) const {
  return straight_ ? Vec3(state_.v + (t - start_) * acceleration_) : trajectory_->velocityAt(*this, t);
}

State Arc::stateAt(double t) const { return trajectory_->stateAt(*this, t); }

Kinematics Arc::kinematicsOf(const State& s) const {
  Kinematics k;
  k.x = s.x;
  k.v = s.v;
  k.R = s.q.toRotationMatrix();
  if (model_->moving) k.w = k.R * model_->inverse_inertia.cwiseProduct(k.R.transpose() * s.L);
  k.R = model_->shapeToWorld(k.R);
  return k;
}

StateDerivative Arc::rateAt(double t, const State& s) const {
  if (!model_->moving) return {};
  return trajectory_->rateAt(*this, t, s);
}

RotationSensitivity Arc::rotationSensitivity(double t, Tier tier, bool products) const {
  return trajectory_->rotationSensitivity(*this, t, tier, products);
}

StateDerivative flightTangent(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& dstart,
                              const Vec3& dgravity, const BodyModelDerivative& dmodel) {
  if (!arc.moving()) return dstart;
  const double s = t - arc.start();
  const Vec3 dacceleration = arc.model().gravity_factor * dgravity;
  StateDerivative d;
  d.x = dstart.x + s * (dstart.v + 0.5 * s * dacceleration);
  d.v = dstart.v + s * dacceleration;
  d.theta = S.dtheta_dtheta * dstart.theta + S.dtheta_dL * dstart.L + S.dtheta_dI * dmodel.inertia +
            S.dtheta_dproducts * dmodel.products;
  d.L = dstart.L;
  return d;
}

StateDerivative flightPullback(const Arc& arc, double t, const RotationSensitivity& S, const StateDerivative& end_bar,
                               Vec3& gravity_bar, BodyModelDerivative& model_bar) {
  if (!arc.moving()) return end_bar;
  return flightPullbackOf(arc.model().gravity_factor, t - arc.start(), S, end_bar, gravity_bar, model_bar);
}

}  // namespace carom
