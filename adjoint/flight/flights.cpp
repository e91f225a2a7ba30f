// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"

namespace carom::adjoint_detail {
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

RotationSensitivity triaxialSensitivity(const Arc& arc, double t, bool products) {
  TriaxialRotation general;  // the motion needed less than its derivative does
  general.begin(arc.model().inverse_inertia, arc.startState().q, arc.startState().L);
  general.extendTo(t - arc.start());
  return general.sensitivityAt(t - arc.start(), products);
}

/// The centre of mass on its parabola; how the body turns is up to the tier.
class Flight : public Trajectory {
 public:
  ArcKind kind() const final { return ArcKind::flight; }
  State stateAt(const Arc& arc, double t) const final {
    const State& from = arc.startState();
    const bool turns = arc.moving() && t != arc.start();
    return {arc.positionAt(t), turns ? orientationAt(arc, t - arc.start()) : from.q, arc.velocityAt(t), from.L};
  }
  Vec3 positionAt(const Arc& arc, double t) const final { return arc.positionAt(t); }  // the arc has the parabola
  Vec3 velocityAt(const Arc& arc, double t) const final { return arc.velocityAt(t); }
  StateDerivative rateAt(const Arc& arc, double, const State& s) const final {
    const Mat3 R = s.q.toRotationMatrix();
    StateDerivative ds;
    ds.x = s.v;
    ds.theta = R * arc.model().inverse_inertia.cwiseProduct(R.transpose() * s.L);
    ds.v = arc.acceleration();
    return ds;
  }
  std::shared_ptr<const TrajectoryLinearization> linearise(const Motion&, int, int, double) const final { return nullptr; }
  RotationSensitivity rotationSensitivity(const Arc& arc, double t, Tier tier, bool products) const override {
    const double s = t - arc.start();
    const State& from = arc.startState();
    const Vec3& I = arc.model().inertia;
    switch (tier) {
      case Tier::none: return {};
      case Tier::spherical: return sphericalSensitivity(I[0], from.L, s);
      case Tier::symmetric: return symmetricSensitivity(I, symmetryAxis(I), from.q, from.L, s);
      case Tier::triaxial: break;
    }
    return triaxialSensitivity(arc, t, products);
  }

 private:
  virtual Quat orientationAt(const Arc& arc, double elapsed) const = 0;
};

TrajectoryBounds turningAt(double spin, double rate) { return {Vec3::Zero(), 0, true, spin, rate}; }

// The angular velocity is constant.
class SphericalFlight : public Flight {
 public:
  TrajectoryBounds bounds(const Arc& arc) const final {
    return turningAt(arc.startState().L.norm() / arc.model().inertia.minCoeff() * (1 + 1e-12), 0);
  }

 private:
  Quat orientationAt(const Arc& arc, double s) const override {
    return sphericalOrientation(arc.model().inertia[0], arc.startState().q, arc.startState().L, s);
  }
};

// Whose orientation is nothing that anybody reads.
class UnturnedFlight final : public SphericalFlight {
 private:
  Quat orientationAt(const Arc& arc, double) const override { return arc.startState().q; }
};

Vec3 bodySpin(const Arc& arc) {
  const Vec3 M = arc.startState().q.toRotationMatrix().transpose() * arc.startState().L;
  return M.cwiseQuotient(arc.model().inertia);
}

class SymmetricFlight final : public Flight {
 public:
  TrajectoryBounds bounds(const Arc& arc) const override {
    const Vec3 omega = bodySpin(arc);
    const double spin = omega.norm() * (1 + 1e-12);  // |omega| is constant
    return turningAt(spin, largestSpinRate(arc.model().inertia, omega, spin));
  }

 private:
  Quat orientationAt(const Arc& arc, double s) const override {
    const Vec3& I = arc.model().inertia;
    return symmetricOrientation(I, symmetryAxis(I), arc.startState().q, arc.startState().L, s);
  }
};

class TriaxialFlight final : public Flight {
 public:
  TriaxialFlight(const BodyModel& model, const State& start) { rotation_.begin(model.inverse_inertia, start.q, start.L); }

  TrajectoryBounds bounds(const Arc& arc) const override {
    const Vec3& I = arc.model().inertia;
    const Vec3 M = arc.startState().q.toRotationMatrix().transpose() * arc.startState().L;
    const double spin = largestSpin(I, M) * (1 + 1e-12);
    return turningAt(spin, largestSpinRate(I, M.cwiseQuotient(I), spin));
  }
  void extendTo(const Arc& arc, double t) override { rotation_.extendTo(t - arc.start()); }
  double availableUntil(const Arc& arc) const override { return arc.start() + rotation_.availableUntil(); }
  std::size_t series() const override { return rotation_.series(); }
  std::shared_ptr<Trajectory> fork() const override { return std::make_shared<TriaxialFlight>(*this); }
  RotationSensitivity rotationSensitivity(const Arc& arc, double t, Tier tier, bool products) const override {
    if (tier != Tier::triaxial) return Flight::rotationSensitivity(arc, t, tier, products);
    return rotation_.sensitivityAt(t - arc.start(), products);
  }

 private:
  Quat orientationAt(const Arc&, double s) const override { return rotation_.orientationAt(s); }

  TriaxialRotation rotation_;
};

// Of what has no state of its own, without a count of those who use it.
template <class Flight>
std::shared_ptr<Trajectory> same() {
  static Flight flight;
  return {std::shared_ptr<void>(), &flight};
}

}  // namespace

std::shared_ptr<Trajectory> flightOf(const BodyModel& model, Tier tier, const State& start) {
  if (!model.moving || tier == Tier::none) return same<UnturnedFlight>();
  if (tier == Tier::spherical) return same<SphericalFlight>();
  if (tier == Tier::symmetric) return same<SymmetricFlight>();
  return std::make_shared<TriaxialFlight>(model, start);
}

}  // namespace carom::adjoint_detail
