// SPDX-License-Identifier: MIT
// Where a path in contact ends: roots of its guards, and where they nearly are.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/constrained_dynamics.hpp"
#include "adjoint/constrained/constrained_path_values.hpp"

namespace carom::adjoint_detail {
namespace {

// A rim is flat where its height varies by no more than this, m for bodies of 1 m: separations are known to 1e-13.
constexpr double kFlat = 2e-13;
// What is rounding of a tilt.
constexpr double kTiltRounding = 8e-16;
// At the last node of a step to where it lies flat the direction of its tilt is known to 1e-16 of a tilt of 0.009 of how far it
// tilts in that step: it answers for an error of this share of g/c over its rate.
constexpr double kNodeNoise = 0.05;
// Rounds of a step to where it lies flat.
constexpr int kLandings = 12;
// A contact whose gap answers to its push by less than this share of its answer to the normal alone jams.
constexpr double kJams = 1e-3;

}  // namespace

TrajectoryEnd ConstrainedPath::end() const {
  if (!end_) return {};
  return {end_->time, end_->guard.cause, end_->guard.contact, end_->guard.limit};
}

bool ConstrainedPath::endAt(ConstrainedStepper& stepper, const ConstrainedStepper::Start& start, ConstrainedStep& step, Ending& end) const {
  const std::size_t which = indexOf(guards_, end.guard);
  return adjoint_detail::endAt(stepper, start, step, end, guardRounding(end.guard, scene_.size),
                               [&](const ConstrainedStep& of, double t) { return Values(*this, of).at(t)[which]; });
}

// How often a rim's lowest point goes round tells how much work the rest of a motion is: some ten steps each time.
std::string ConstrainedPath::tooManySteps() const {
  std::string why = textOf(6, "its path in contact takes more than ", steps_.size(), " steps");
  for (std::size_t k = 0; k < rims_.size(); ++k) {
    if (!rims_[k]) continue;
    const Tilt tilt = tiltOf(k, last_);
    const double turns = tilt.x.cross(tilt.rate).norm() / tilt.x.squaredNorm() / (2 * std::numbers::pi);
    return why + textOf(6, ": the lowest point of its rim, which is tilted by ", tilt.x.norm(), " rad, moves round ", turns, " times per second");
  }
  return why + ": it rotates too fast";
}

// Of a contact that slides: how its gap answers to the push n - mu d, while the others hold, over how it does to n. Where that
// comes down to 0 its force grows beyond any bound: it jams (Painleve).
std::string ConstrainedPath::jamAt(const ConstrainedStepper::Start& start) const {
  const ConstrainedInstant now = instantOf(scene_, contacts_, start.state, start.time, start.slip);
  Eigen::MatrixXd inverse;
  const ConstrainedDynamics forces(now.body, now.contacts, redundant_, &inverse);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != ContactMode::slides || !(contacts_[k].friction > 0)) continue;
    const ContactInstant<double>& c = now.contacts[k];
    const Eigen::Index at = forces.unknown(k);
    const double share = 1 / (inverse(at, at) * c.n.dot(forces.responseAt(c.r, k, c.n)));
    if (!(share < kJams)) continue;
    return textOf(3, ": it jams there (Painleve): n.K(n - mu d) of a sliding contact, the denominator of its force, has fallen to ", share,
                  " of n.K n, and the force has grown to ", forces.pressing(k) / (scene_.model->mass * scene_.gravity.norm()),
                  " times the weight");
  }
  return {};
}

void ConstrainedPath::findRims() {
  rims_.resize(contacts_.size());
  const auto* geometry = dynamic_cast<const RimGeometry*>(scene_.geometry.get());
  for (std::size_t k = 0; k < contacts_.size() && geometry; ++k) {
    const PersistentContact& c = contacts_[k];
    if (scene_.with[k].moves()) continue;
    const auto rim = c.is_first ? geometry->rimOnFace(scene_.body, c.with, c.features)
                                : geometry->rimOnFace(c.with, scene_.body, c.features);
    if (rim && rim->features == c.features && rim->of_first == c.is_first) rims_[k] = rim;
  }
}

ConstrainedPath::Tilt ConstrainedPath::tiltOf(std::size_t k, const State& state) const {
  const Mat3 R = state.q.toRotationMatrix();
  const Vec3 d = scene_.model->shapeToWorld(R) * rims_[k]->axis, N = scene_.with[k].pose.R * rims_[k]->normal;
  const Vec3 omega = scene_.model->inverseInertiaWorld(R) * state.L;
  return {RimOnFace::tilt(d, N), RimOnFace::tilt(omega.cross(d), N)};
}

// A tilt x = d x N comes to 0 only along a line: else it goes by at the distance |x x x'|/|x'|, and the lowest point of the rim
// goes round. What passes so near that the heights of the rim never differ by more than is known of them lies flat (11.26).
std::optional<ConstrainedPath::FlatAhead> ConstrainedPath::flatAhead(const ConstrainedStepper::Start& start) const {
  const double flat = kFlat * std::max(1.0, start.state.x.cwiseAbs().maxCoeff());
  for (std::size_t k = 0; k < rims_.size(); ++k) {
    if (!rims_[k]) continue;
    const Tilt tilt = tiltOf(k, start.state);
    const double sine = tilt.x.norm(), speed = tilt.rate.norm(), across = 2 * rims_[k]->radius;
    if (!(tilt.x.dot(tilt.rate) < 0) || (steps_.empty() && !(across * sine > flat))) continue;
    if (!(across * tilt.x.cross(tilt.rate).norm() <= flat * speed)) continue;
    const ConstrainedInstant now = instantOf(scene_, contacts_, start.state, start.time, start.slip);
    ConstrainedForces forces;
    forces.solve(now, redundant_);
    const Mat3 R = start.state.q.toRotationMatrix();
    const Vec3 d = scene_.model->shapeToWorld(R) * rims_[k]->axis, N = scene_.with[k].pose.R * rims_[k]->normal, &omega = now.body.omega;
    const Vec3 spin_rate = now.body.A * (forces.moment() - omega.cross(now.body.L));
    const Vec3 bend = RimOnFace::tilt(spin_rate.cross(d) + omega.cross(omega.cross(d)), N);
    const Vec3 axis = tilt.x / sine;
    const double under = speed * speed - 2 * sine * axis.dot(bend);
    if (!(under > 0)) continue;
    return FlatAhead{k, axis, 2 * sine / (speed + std::sqrt(under))};
  }
  return std::nullopt;
}

// A step whose end is where the tilt comes to 0: its nodes lie before, where all is smooth.
std::optional<ConstrainedStep> ConstrainedPath::stepToFlat(ConstrainedStepper& stepper, const ConstrainedStepper::Start& start, const FlatAhead& ahead) const {
  double length = ahead.time;
  const ConstrainedStep* like = steps_.empty() ? nullptr : &steps_.back();
  std::optional<ConstrainedStep> step;
  for (int round = 0; round < kLandings; ++round) {
    std::optional<ConstrainedStep> next = stepper.tried(start, length, like);
    if (!next) return std::nullopt;
    step = std::move(next);
    like = &*step;
    const Tilt tilt = tiltOf(ahead.contact, ContactStep::moved(step->from, step->changeAt(step->start + length)));
    const double rate = ahead.axis.dot(tilt.rate), move = -ahead.axis.dot(tilt.x) / rate;
    if (!(rate < 0)) return std::nullopt;
    if (std::abs(move) <= std::max({PathLimits::kSameEnd * length, 2e-16 * known_, kTiltRounding / -rate})) {
      const double noise = kNodeNoise * scene_.gravity.norm() / (scene_.speed * -rate);
      if (!(stepper.errorOf(*step) <= 1 + noise) || firstEnd(*step, true)) return std::nullopt;
      return step;
    }
    length += move;
    if (!(length > 0 && known_ + length > known_)) return std::nullopt;
  }
  return std::nullopt;
}

bool ConstrainedPath::beginsFlat() const {
  for (std::size_t k = 0; k < rims_.size(); ++k)
    if (rims_[k] && 2 * rims_[k]->radius * tiltOf(k, start_state_).x.norm() <= kFlat * std::max(1.0, start_state_.x.cwiseAbs().maxCoeff()))
      return true;
  return false;
}

// Whether a rim has come to tilt the other way since the last node, of which no node knows; or all but lies flat, where the step
// is better one that ends flat.
bool ConstrainedPath::passesFlat(const ConstrainedStep& step) const {
  const double last = step.start + Gauss::get().node[Gauss::kNodes - 1] * step.length;
  for (std::size_t k = 0; k < rims_.size(); ++k) {
    if (!rims_[k]) continue;
    const State state = step.stateAt(step.start + step.length);
    const Tilt before = tiltOf(k, step.stateAt(last)), end = tiltOf(k, state);
    const double flat = kFlat * std::max(1.0, state.x.cwiseAbs().maxCoeff()), across = 2 * rims_[k]->radius;
    if (!(before.x.dot(end.x) > 0)) return true;
    if (end.x.dot(end.rate) < 0 && across * end.x.norm() <= flat && across * end.x.cross(end.rate).norm() <= flat * end.rate.norm()) return true;
  }
  return false;
}

// A slip that was expected to end has not.
bool ConstrainedPath::passesBy(const ConstrainedStep& step, const Ending& end) const {
  if (end.guard.cause != TransitionCause::sticks) return false;
  const ConstrainedInstant now = instantOf(scene_, contacts_, step.stateAt(step.start + step.length), step.start + step.length,
                                    step.slipAtNode(Gauss::kNodes - 1));
  const auto k = static_cast<std::size_t>(end.guard.contact);
  return now.slipAt(k).norm() > (step.frozen[k] ? PathLimits::kStraightLeft : PathLimits::kNothingLeft) * scene_.speed;
}

std::optional<ConstrainedPath::Ending> ConstrainedPath::firstEnd(const ConstrainedStep& step, bool nodes_alone) const {
  if (guards_.empty()) return std::nullopt;
  Values values(*this, step);
  std::vector<double> last = values.atStart();
  return adjoint_detail::firstEnd(guards_, step.start, step.length, scene_.size, std::move(last), [&](double t) { return values.at(t); }, nodes_alone);
}

PathNearMiss ConstrainedPath::nearestMiss(double until) const {
  return adjoint_detail::nearestMiss(
      guards_, steps_, known_, until, scene_.length / scene_.speed, [&](const ConstrainedStep& step, double t) { return Values(*this, step).at(t); },
      [&](const ConstrainedGuard& guard) { return shareOfMargin(guard, scene_.length); });
}

}  // namespace carom::adjoint_detail
