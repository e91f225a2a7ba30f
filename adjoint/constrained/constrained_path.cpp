// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_path.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/constrained_dynamics.hpp"
#include "adjoint/constrained/constrained_start.hpp"
#include "adjoint/constrained/slip_ahead.hpp"
#include "adjoint/constrained/slip_stop.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// Of the unit of speed: slower than that is what rounding leaves of speeds that an impact law stops.
constexpr double kStopped = 1e-14;
// Most steps of a path, and of one whose rims go round.
constexpr std::size_t kMostOfRims = 100'000;
// What a step leaves of speeds that contacts keep at 0 is less than this share of the unit of speed.
constexpr double kMostTakenBack = 1e-10;
// A rim that comes to lie flat before so many steps have passed is brought there by the next one.
constexpr double kLooksForFlat = 1.5;

}  // namespace

ConstrainedPath::ConstrainedPath(ConstrainedScene scene, std::vector<PersistentContact> contacts, bool redundant, std::vector<ConstrainedGuard> guards,
                   const State& start, double time, double until, std::vector<Vec3> stopped)
    : scene_(std::move(scene)),
      contacts_(std::move(contacts)),
      redundant_(redundant),
      guards_(std::move(guards)),
      start_state_(start),
      last_(start),
      start_(time),
      until_(until),
      known_(time),
      stopped_(std::move(stopped)) {
  findRims();
  const ConstrainedInstant now = instantOf(scene_, contacts_, start, time, slipAfter());
  const double spin = now.body.omega.norm() + std::sqrt(scene_.gravity.norm() / scene_.length);
  next_length_ = PathLimits::kFirstTurn / spin;
  ConstrainedForces forces;
  forces.solve(now, redundant_);
  bounds_.acceleration = forces.acceleration();
  bounds_.straight = false;
  for (const ContactInstant<double>& c : now.contacts)
    rolls_ = rolls_ || (c.mode == ContactMode::sticks && (c.point_rate - c.support_velocity).norm() > 1e-6 * scene_.speed);
  rides_ = goesWithSupport(now);
  if (start_ < until_) extend();
}

void ConstrainedPath::extendTo(const Arc&, double t) {
  while (!end_ && known_ < std::min(t, until_)) extend();
}

std::vector<Vec3> ConstrainedPath::slipAfter() const {
  if (!steps_.empty()) return steps_.back().slipAtNode(Gauss::kNodes - 1);
  std::vector<Vec3> slip;
  for (const PersistentContact& c : contacts_) slip.push_back(c.slip);
  return slip;
}

// Looks at the slips with which a step starts: those that are about to end, as they are slow and become slower, are
// frozen. Gives how long the step may be as they come to an end or turn.
double ConstrainedPath::lookAtSlips(ConstrainedStepper::Start& start) const {
  double longest = kInfinity;
  if (!slides()) return longest;
  const ConstrainedInstant now = instantOf(scene_, contacts_, start.state, start.time, start.slip);
  ConstrainedForces forces;
  forces.solve(now, redundant_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != ContactMode::slides || !(contacts_[k].friction > 0)) continue;
    if (contacts_[k].begins && steps_.empty()) continue;
    const SlipAhead ahead = slipAhead(now.slipAt(k).norm(), start.slip[k], forces.slipRate(k), now.contacts[k].n, scene_.speed);
    if (ahead.frozen) start.frozen[k] = true;
    longest = std::min(longest, ahead.longest);
  }
  return longest;
}

void ConstrainedPath::extend() {
  if (end_ || !(known_ < until_)) return;
  const bool goes_round = std::ranges::any_of(rims_, [](const auto& rim) { return rim.has_value(); });
  if (steps_.size() >= (goes_round ? kMostOfRims : PathLimits::kMostSteps)) throw NotComputable(tooManySteps());
  take(nextStep());
}

// The longest step that is as good as is asked for, or that ends where a guard falls to 0.
ConstrainedStep ConstrainedPath::nextStep() {
  ConstrainedStepper stepper(scene_, contacts_, redundant_);
  ConstrainedStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  double length = std::min(next_length_, lookAtSlips(start));  // however long the motion is: that must not matter
  if (const std::optional<FlatAhead> ahead = flatAhead(start); ahead && ahead->time < kLooksForFlat * length) {
    if (std::optional<ConstrainedStep> last = stepToFlat(stepper, start, *ahead)) {
      end_ = Ending{last->start + last->length, {TransitionCause::leaves, static_cast<int>(ahead->contact), -1, {}}};
      return *std::move(last);
    }
    length = std::min(length, 0.5 * ahead->time);
  }
  const ConstrainedStep* like = steps_.empty() ? nullptr : &steps_.back();
  std::optional<ConstrainedStep> too_long;
  for (int tries = 0; tries < PathLimits::kTries && known_ + length > known_; ++tries) {
    std::optional<ConstrainedStep> step = stepper.tried(start, length, like);
    if (!step) {
      length *= 0.4;
      continue;
    }
    std::optional<Ending> end;
    try {
      end = firstEnd(*step);
    } catch (const NotComputable&) {  // as in ConstrainedStepper::tried
      if (!(known_ + 1e-3 * length > known_)) throw;
      length *= 0.4;
      continue;
    }
    const double error = stepper.errorOf(*step);
    if (!(error <= 1)) {
      length = shorterLength(length, error, end);
      too_long = std::move(step);
      like = &*too_long;
      continue;
    }
    next_length_ = PathLimits::factorFor(error) * length;
    if (!end && passesFlat(*step)) {
      length *= 0.5;
      continue;
    }
    if (!end) return *step;
    if (!(end->time > known_)) {  // at once
      step->length = 0;
    } else {
      const double left = end->time - known_;
      const bool comes = endAt(stepper, start, *step, *end);
      if (comes ? passesBy(*step, *end) : left > PathLimits::kAtOnceOfStep * length) {
        length *= 0.5;
        continue;
      }
      if (!comes) step->length = 0;
      end->time = step->start + step->length;
    }
    end_ = end;
    return *step;
  }
  throw NotComputable("its path in contact cannot be computed beyond t = " + std::to_string(known_) + " s" + jamAt(start));
}

// What lies beyond an end need not be followed.
double ConstrainedPath::shorterLength(double length, double error, const std::optional<Ending>& end) const {
  const double shorter = PathLimits::factorFor(error) * length;
  if (!end || !(end->time > known_) || !(end->time < known_ + 0.95 * length)) return shorter;
  return std::max(end->time - known_, shorter);
}

// What steps leave out adds up: gaps and speeds that are 0 are taken back to it, as at the start, by as little as rounding.
State ConstrainedPath::stayingOn(const State& state, double t) const {
  std::vector<PersistentContact> contacts = contacts_;
  for (PersistentContact& c : contacts) c.begins = false;
  return constrainedStart(scene_, contacts, state, t, 1);
}

void ConstrainedPath::take(ConstrainedStep step) {
  if (step.length > 0) {
    widen(bounds_, step.slopes, step.length);
    known_ = step.start + step.length;
    const State end = step.stateAt(known_);
    last_ = endsFlat() ? end : stayingOn(end, known_);
    if (!((last_.v - end.v).norm() <= kMostTakenBack * scene_.speed))
      throw NotComputable("the normal velocity left at the contacts of its path is more than rounding");
  }
  steps_.add(std::move(step));
}

// Where what lies beyond a border is looked for, the path is seen a little beyond its end: further than a step is long its
// polynomial tells nothing there, but how the body moves at the end.
State ConstrainedPath::stateAt(double t) const {
  if (!(t > start_)) return start_state_;
  if (steps_.move()) {
    const ConstrainedStep& step = stepAt(t);
    if (!(t > known_) || t - step.start <= 2 * step.length) return step.stateAt(t);
  }
  const State& end = steps_.move() ? last_ : start_state_;
  const double beyond = t - known_;
  return beyond > 0 ? ContactStep::goingOn(end, *scene_.model, beyond) : end;
}

Vec3 ConstrainedPath::velocityAt(const Arc&, double t) const {
  if (!(t > start_) || !steps_.move()) return start_state_.v;
  const ConstrainedStep& step = stepAt(t);
  return step.from.v + step.changeAt(t).segment<3>(6);
}

std::optional<std::size_t> ConstrainedPath::contactThatStops() const {
  if (!end_ || end_->guard.cause != TransitionCause::sticks) return std::nullopt;
  return static_cast<std::size_t>(end_->guard.contact);
}

// Where a slip is 0 it goes along its acceleration, u' = -|u'| d, which the direction at a node comes near to: Newton's
// method on (n x d).u' = 0, for all that stop there together.
void ConstrainedPath::alignStop(ConstrainedInstant& now) const {
  const std::optional<std::size_t> first = contactThatStops();
  const auto stops = [&](std::size_t k) {
    return contacts_[k].mode == ContactMode::slides && contacts_[k].friction > 0 &&
           !(now.slipAt(k).norm() > PathLimits::kStraightAnyway * scene_.speed);
  };
  if (!first || !stops(*first)) return;
  std::vector<std::size_t> turning;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (stops(k)) turning.push_back(k);
  const auto size = static_cast<Eigen::Index>(turning.size());
  Eigen::MatrixXd J(size, size);
  Eigen::VectorXd r(size);
  for (int round = 0; round < kAlignRounds; ++round) {
    const ConstrainedDynamics forces(now.body, now.contacts, redundant_);
    for (Eigen::Index j = 0; j < size; ++j) {
      const std::vector<Vec3> answer = forces.answerToTurn(turning[static_cast<std::size_t>(j)], redundant_);
      for (Eigen::Index i = 0; i < size; ++i) {
        const std::size_t k = turning[static_cast<std::size_t>(i)];
        const ContactInstant<double>& c = now.contacts[k];
        const Vec3 across = c.n.cross(c.slip), rate = forces.slipRate(k);
        J(i, j) = across.dot(forces.responseAt(c.r, answer)) - (i == j ? c.slip.dot(rate) : 0.0);
        r[i] = across.dot(rate);
      }
    }
    const std::optional<Eigen::VectorXd> turn = turnsAtStop(J, r, scene_.gravity.norm());
    if (!turn) return;
    for (Eigen::Index i = 0; i < size; ++i) {
      ContactInstant<double>& c = now.contacts[turning[static_cast<std::size_t>(i)]];
      c.slip = (c.slip + (*turn)[i] * c.n.cross(c.slip)).normalized();
    }
  }
}

ConstrainedInstant ConstrainedPath::instantAt(double t) const {
  std::vector<Vec3> slip;
  if (!steps_.move()) {
    slip = slipAfter();
  } else {
    stepAt(t).placeSlips(t, slip);
    if (!(t > start_))
      for (std::size_t k = 0; k < contacts_.size(); ++k) slip[k] = contacts_[k].slip;
  }
  ConstrainedInstant now = instantOf(scene_, contacts_, stateAt(t), t, slip);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != ContactMode::slides || !(contacts_[k].friction > 0)) continue;
    ContactInstant<double>& c = now.contacts[k];
    const Vec3 u = now.slipAt(k);
    if (u.norm() > kNoDirection * scene_.speed) c.slip = u;
    c.slip = inPlane(c.slip, c.n);
  }
  if (t > start_) alignStop(now);
  return now;
}

StateDerivative ConstrainedPath::rateAt(double t) const {
  if (endsFlat() && !(t < known_)) {  // the rim that lies flat there has no lowest point
    const ConstrainedVector slope = steps_.back().slopeAt(known_);
    StateDerivative rate;
    rate.x = last_.v, rate.v = slope.segment<3>(6), rate.L = slope.tail<3>();
    rate.theta = scene_.model->inverseInertiaWorld(last_.q.toRotationMatrix()) * last_.L;
    return rate;
  }
  const ConstrainedInstant now = instantAt(t);
  ConstrainedForces forces;
  forces.solve(now, redundant_);
  StateDerivative rate;
  rate.x = now.body.v, rate.theta = now.body.omega, rate.v = forces.acceleration(), rate.L = forces.moment();
  return rate;
}

bool ConstrainedPath::stopsSpeeds() const {
  const double rounding = kStopped * scene_.speed * scene_.model->mass;
  return std::ranges::any_of(stopped_, [&](const Vec3& impulse) { return impulse.norm() > rounding; });
}

}  // namespace carom::adjoint_detail
