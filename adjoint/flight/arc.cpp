// SPDX-License-Identifier: MIT
#include "adjoint/flight/arc.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/base/names.hpp"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/flight/flight_pass.hpp"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/flight_triaxial.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(ArcKind kind) { return nameIn({"flight", "rest", "slide", "roll", "pivot"}, kind); }
const char* nameOf(Tier tier) { return nameIn({"none", "spherical", "symmetric", "triaxial"}, tier); }

namespace {

// Largest |omega| on the polhode: with y = omega_i^2 >= 0, sum I_i y_i and sum I_i^2 y_i are constant, so the greatest
// sum y_i is found where one component vanishes.
double largestSpin(const Vec3& I, const Vec3& M) {
  const double twice_energy = M.cwiseAbs2().dot(I.cwiseInverse()), L2 = M.squaredNorm();
  double best = M.cwiseQuotient(I).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const double a = I[(i + 1) % 3], b = I[(i + 2) % 3];
    if (!(std::abs(a - b) > 1e-12 * std::max(a, b))) {  // a pair of equal moments: bound by the smallest one
      best = std::max(best, L2 / (std::min(a, b) * std::min(a, b)));
      continue;
    }
    const double ya = (L2 - b * twice_energy) / (a * (a - b)), yb = (L2 - a * twice_energy) / (b * (b - a));
    if (ya >= 0 && yb >= 0) best = std::max(best, ya + yb);
  }
  return std::sqrt(best);
}

// Bound on |omega'|, omega'_i = (I_j - I_k)/I_i omega_j omega_k. The sums of I_i |I_i - I_k| omega_i^2, for the largest
// and the smallest moment I_k, are constant in the flight and bound every other omega_i^2: a spin about one of these two
// axes stays.
double largestSpinRate(const Vec3& I, const Vec3& omega, double spin) {
  Vec3 most = Vec3::Constant(spin * spin);
  Eigen::Index low, high;
  I.minCoeff(&low), I.maxCoeff(&high);
  for (const Eigen::Index k : {low, high}) {
    const Vec3 weight = I.cwiseProduct((I.array() - I[k]).abs().matrix());
    const double kept = weight.dot(omega.cwiseAbs2());
    for (int i = 0; i < 3; ++i)
      if (weight[i] > 0) most[i] = std::min(most[i], kept / weight[i]);
  }
  double rate2 = 0, uneven = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double factor = std::abs(I[j] - I[k]) / I[i];
    rate2 += factor * factor * most[j] * most[k];
    uneven = std::max(uneven, factor);
  }
  // in any case the sum of (omega_j omega_k)^2 is at most |omega|^4 / 3
  const double always = uneven * spin * spin / std::sqrt(3.0);
  return std::min(always, std::sqrt(rate2) * (1 + 1e-12) + 1e-15 * always);
}

}  // namespace

Arc::Arc(const BodyModel& model, Tier tier, const Vec3& gravity, double start, const State& state)
    : model_(&model),
      tier_(tier),
      start_(start),
      acceleration_(model.moving ? Vec3(model.gravity_factor * gravity) : Vec3::Zero()),
      state_(state) {
  if (!model.moving) return;
  const Vec3& I = model.inertia;
  if (tier == Tier::none || tier == Tier::spherical) {
    spin_bound_ = state.L.norm() / I.minCoeff() * (1 + 1e-12);  // omega is constant
    return;
  }
  const Vec3 M = state.q.toRotationMatrix().transpose() * state.L;
  if (tier == Tier::symmetric) {
    symmetry_axis_ = symmetryAxis(I);
    spin_bound_ = M.cwiseQuotient(I).norm() * (1 + 1e-12);  // |omega| is constant
  } else {
    triaxial_ = std::make_unique<TriaxialRotation>();
    triaxial_->begin(model.inverse_inertia, state.q, state.L);
    spin_bound_ = largestSpin(I, M) * (1 + 1e-12);
  }
  spin_rate_bound_ = largestSpinRate(I, M.cwiseQuotient(I), spin_bound_);
}

Arc::Arc(const BodyModel& model, Tier tier, const ContactPath& path, double start, const State& state)
    : model_(&model), tier_(tier), start_(start), path_(std::make_unique<ContactPath>(path)), state_(state) {
  takeBounds();
}

void Arc::takeBounds() {
  if (path_->integrated) path_->bounds = path_->integrated->bounds();
  acceleration_ = path_->bounds.acceleration;
  spin_bound_ = path_->bounds.spin;
  spin_rate_bound_ = path_->bounds.spin_rate;
}

IntegratedPath* Arc::integrated() const { return path_ ? path_->integrated.get() : nullptr; }

ArcKind Arc::kind() const {
  if (!path_) return ArcKind::flight;
  switch (path_->form) {
    case PathForm::rest:
      return ArcKind::rest;
    case PathForm::glide_ball:
    case PathForm::glide_block:
      return ArcKind::slide;
    case PathForm::held:
      if (path_->integrated->slides()) return ArcKind::slide;
      return path_->integrated->rolls() ? ArcKind::roll : ArcKind::pivot;
    case PathForm::roll_ball:
    case PathForm::roll_axle:
      break;
  }
  return ArcKind::roll;
}

double Arc::accelerationVariation() const { return path_ ? path_->bounds.variation : 0; }

std::optional<Vec3> Arc::steadyAxis() const {
  if (path_ && spin_bound_ > 0) return std::nullopt;
  if (path_ || tier_ == Tier::none || tier_ == Tier::spherical) return Vec3(Vec3::Zero());
  if (tier_ != Tier::symmetric) return std::nullopt;
  const Vec3 axis = Vec3::Unit(symmetry_axis_);
  return model_->has_offset ? Vec3(model_->R_BG.transpose() * axis) : axis;
}

Arc::Arc(const Arc& o) : Arc(o, o.path_ ? std::make_unique<ContactPath>(*o.path_) : nullptr) {}

Arc Arc::view() const {
  if (!integrated()) return *this;
  return Arc(*this, std::make_unique<ContactPath>(path_->view()));
}

Arc Arc::withModel(const BodyModel& model) const {
  Arc copy = *this;
  copy.model_ = &model;
  if (IntegratedPath* path = copy.integrated()) path->useModel(model);
  return copy;
}

Arc::Arc(const Arc& o, std::unique_ptr<ContactPath> path)
    : model_(o.model_),
      tier_(o.tier_),
      symmetry_axis_(o.symmetry_axis_),
      start_(o.start_),
      spin_bound_(o.spin_bound_),
      spin_rate_bound_(o.spin_rate_bound_),
      triaxial_(o.triaxial_ ? std::make_unique<TriaxialRotation>(*o.triaxial_) : nullptr),
      path_(std::move(path)),
      acceleration_(o.acceleration_),
      state_(o.state_) {}

Arc& Arc::operator=(const Arc& other) { return *this = Arc(other); }
Arc::Arc(Arc&&) noexcept = default;
Arc& Arc::operator=(Arc&&) noexcept = default;
Arc::~Arc() = default;

double Arc::knownUntil() const {
  return path_ && path_->integrated ? path_->integrated->knownUntil() : std::numeric_limits<double>::infinity();
}

double Arc::availableUntil() const {
  if (path_ && path_->integrated)
    return path_->integrated->ended() ? std::numeric_limits<double>::infinity() : path_->integrated->knownUntil();
  if (path_ && tier_ != Tier::none) return path_->followedUntil(TriaxialRotation::kMostSegments);
  return triaxial_ ? start_ + triaxial_->availableUntil() : std::numeric_limits<double>::infinity();
}
std::size_t Arc::series() const {
  if (path_ && path_->integrated) return path_->integrated->steps();
  return triaxial_ ? triaxial_->series() : 0;
}

void Arc::extendTo(double t) {
  if (path_ && path_->integrated) {
    if (availableUntil() < t) path_->integrated->extendTo(t), takeBounds();
    return;
  }
  if (triaxial_) triaxial_->extendTo(t - start_);
  if (path_ && !(t <= availableUntil()))
    throw NotComputable("its rotation takes more than " + std::to_string(TriaxialRotation::kMostSegments) +
                        " series to follow");
}

Quat Arc::rotationAt(double s) const {
  if (!model_->moving || s == 0) return state_.q;
  switch (tier_) {
    case Tier::none:
      return state_.q;
    case Tier::spherical:
      return sphericalOrientation(model_->inertia[0], state_.q, state_.L, s);
    case Tier::symmetric:
      return symmetricOrientation(model_->inertia, symmetry_axis_, state_.q, state_.L, s);
    case Tier::triaxial:
      return triaxial_->orientationAt(s);
  }
  return state_.q;
}

// Apart, so that flights do without its stack.
[[gnu::noinline]] static PathCenter<double> centerOn(const ContactPath& path, double t) {
  return pathCenterAt(path.form, path.inputs, path.elapsedAt(t));
}

Vec3 Arc::positionAt(double t) const {
  const double s = t - start_;
  if (path_ && path_->integrated) return path_->integrated->positionAt(t);
  if (path_ && !path_->bounds.straight) return centerOn(*path_, t).x;
  return state_.x + s * (state_.v + 0.5 * s * acceleration_);
}

Vec3 Arc::velocityAt(double t) const {
  if (path_ && path_->integrated) return path_->integrated->velocityAt(t);
  if (path_ && !path_->bounds.straight) return centerOn(*path_, t).v;
  return state_.v + (t - start_) * acceleration_;
}

State Arc::stateAt(double t) const {
  if (path_) return path_->stateAt(state_, t, tier_ != Tier::none);
  return {positionAt(t), rotationAt(t - start_), velocityAt(t), state_.L};
}

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
  StateDerivative ds;
  if (!model_->moving) return ds;
  if (path_ && path_->integrated) return path_->integrated->rateAt(t);
  if (path_) return pathRateAt(path_->form, path_->inputs, path_->elapsedAt(t));
  const Mat3 R = s.q.toRotationMatrix();
  ds.x = s.v;
  ds.theta = R * model_->inverse_inertia.cwiseProduct(R.transpose() * s.L);
  ds.v = acceleration_;
  return ds;
}

RotationSensitivity Arc::rotationSensitivity(double t, Tier tier, bool products) const {
  const double s = t - start_;
  switch (tier) {
    case Tier::none:
      return {};
    case Tier::spherical:
      return sphericalSensitivity(model_->inertia[0], state_.L, s);
    case Tier::symmetric:
      return symmetricSensitivity(model_->inertia, symmetryAxis(model_->inertia), state_.q, state_.L, s);
    case Tier::triaxial:
      break;
  }
  if (triaxial_) return triaxial_->sensitivityAt(s, products);
  TriaxialRotation general;  // the motion needed less than its derivative does
  general.begin(model_->inverse_inertia, state_.q, state_.L);
  general.extendTo(s);
  return general.sensitivityAt(s, products);
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
