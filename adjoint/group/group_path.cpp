// SPDX-License-Identifier: MIT
#include "adjoint/group/group_path.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/constrained_inputs.hpp"
#include "adjoint/constrained/slip_ahead.hpp"
#include "adjoint/constrained/slip_stop.hpp"
#include "adjoint/group/group_guards.hpp"
#include "adjoint/group/group_start.hpp"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

constexpr double kMostLeftOfSpeed = 1e-9;
// Forces that have grown to so many times the weight grow without bound.
constexpr double kJams = 1e3;

}  // namespace

GroupPath::GroupPath(GroupScene scene, std::vector<GroupContact> contacts, bool redundant, std::vector<State> start, double until,
                     const Ends& ends)
    : scene_(std::move(scene)), contacts_(std::move(contacts)), redundant_(redundant), start_(std::move(start)), last_(start_),
      start_time_(scene_.time), until_(until), known_(scene_.time), bounds_(start_.size()), kinds_(start_.size(), ArcKind::pivot) {
  guards_ = guardsOf(scene_, contacts_, start_, start_time_);
  if (ends) std::erase_if(guards_, [&](const ConstrainedGuard& guard) { return !ends(guard); });
  const GroupInstant now = instantOf(scene_, contacts_, start_, start_time_, slipAfter());
  double spin = std::sqrt(scene_.pull() / scene_.length);
  for (const MemberInstant& m : now.members) spin = std::max(spin, m.w.norm());
  next_length_ = PathLimits::kFirstTurn / spin;
  GroupForces forces;
  forces.solve(contacts_, now, redundant_);
  for (std::size_t m = 0; m < start_.size(); ++m) {
    bounds_[m].acceleration = forces.acceleration(m);
    bounds_[m].straight = false;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const GroupContact& c = contacts_[k];
      if (c.member_a != static_cast<int>(m) && c.member_b != static_cast<int>(m)) continue;
      if (c.mode == ContactMode::slides) kinds_[m] = ArcKind::slide;
      const MemberInstant& body = now.members[m];
      const Vec3 material = body.v + body.w.cross(Vec3(now.contacts[k].point - body.x));
      if (c.mode == ContactMode::sticks && kinds_[m] == ArcKind::pivot && (now.contacts[k].point_rate - material).norm() > 1e-6 * scene_.speed)
        kinds_[m] = ArcKind::roll;
    }
  }
  if (start_time_ < until_) extend();
}

std::shared_ptr<GroupPath> GroupPath::endedBy(const Ends& ends) const {
  return std::make_shared<GroupPath>(scene_, contacts_, redundant_, start_, until_, ends);
}

void GroupPath::extendTo(const Arc&, double t) {
  while (!end_ && known_ < std::min(t, until_)) extend();
}

void GroupPath::extend() {
  if (end_ || !(known_ < until_)) return;
  if (steps_.size() >= PathLimits::kMostSteps) throw NotComputable(textOf(6, "their path in contact takes more than ", steps_.size(), " steps"));
  take(nextStep());
}

std::vector<Vec3> GroupPath::slipAfter() const {
  if (!steps_.empty()) return steps_.back().slipAtNode(Gauss::kNodes - 1);
  std::vector<Vec3> slip;
  for (const GroupContact& c : contacts_) slip.push_back(c.slip);
  return slip;
}

// Slips that are about to end are frozen; gives how long the step may be as others come to an end or turn.
double GroupPath::lookAtSlips(GroupStepper::Start& start) const {
  double longest = kInfinity;
  if (std::ranges::none_of(contacts_, &GroupContact::turns)) return longest;
  const GroupInstant now = instantOf(scene_, contacts_, start.states, start.time, start.slip);
  GroupForces forces;
  forces.solve(contacts_, now, redundant_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (!contacts_[k].turns() || (contacts_[k].begins && steps_.empty())) continue;
    const GroupContactInstant& c = now.contacts[k];
    const SlipAhead ahead = slipAhead(c.slipVelocity().norm(), start.slip[k], forces.slipRate(k), c.n, scene_.speed);
    if (ahead.frozen) start.frozen[k] = true;
    longest = std::min(longest, ahead.longest);
  }
  return longest;
}

GroupStep GroupPath::nextStep() {
  GroupStepper stepper(scene_, contacts_, redundant_);
  GroupStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  double length = std::min(next_length_, lookAtSlips(start));
  const GroupStep* like = steps_.empty() ? nullptr : &steps_.back();
  std::optional<GroupStep> too_long;
  std::optional<Ending> at_once;  // an end that no step is short enough to come to
  for (int tries = 0; tries < PathLimits::kTries && known_ + length > known_; ++tries) {
    std::optional<GroupStep> step = stepper.tried(start, length, like);
    if (!step) {
      length *= 0.4;
      continue;
    }
    std::optional<Ending> end;
    try {
      end = firstEnd(guards_, step->start, step->length, scene_.size, valuesAt(*step, step->start), [&](double t) { return valuesAt(*step, t); });
    } catch (const NotComputable&) {
      if (!(known_ + 1e-3 * length > known_)) throw;
      length *= 0.4;
      continue;
    }
    const double error = stepper.errorOf(*step);
    if (!(error <= 1)) {
      const double shorter = PathLimits::factorFor(error) * length;
      length = end && end->time > known_ && end->time < known_ + 0.95 * length ? std::max(end->time - known_, shorter) : shorter;
      too_long = std::move(step);
      like = &*too_long;
      continue;
    }
    next_length_ = PathLimits::factorFor(error) * length;
    if (!end) return *step;
    if (!(end->time > known_)) {
      step->length = 0;
    } else {
      const double left = end->time - known_;
      const std::size_t which = indexOf(guards_, end->guard);
      const bool comes = endAt(stepper, start, *step, *end, guardRounding(end->guard, scene_.size),
                               [&](const GroupStep& of, double t) { return valuesAt(of, t)[which]; });
      if (comes ? passesBy(*step, *end) : left > PathLimits::kAtOnceOfStep * length) {
        at_once.reset();
        if (left <= PathLimits::kAtOnce * known_) at_once = end, too_long = std::move(step);
        length *= 0.5;
        continue;
      }
      if (!comes) step->length = 0;
      end->time = step->start + step->length;
    }
    end_ = end;
    return *step;
  }
  if (at_once) {
    too_long->length = 0;
    at_once->time = known_;
    end_ = at_once;
    return *too_long;
  }
  throw NotComputable("their path in contact cannot be computed beyond t = " + std::to_string(known_) + " s" + jamAt(start));
}

// Where the friction of contacts that slide has all but used up what their forces accelerate, forces grow beyond any bound: they jam
// (Painleve).
std::string GroupPath::jamAt(const GroupStepper::Start& start) const {
  const GroupInstant now = instantOf(scene_, contacts_, start.states, start.time, start.slip);
  GroupForces forces;
  forces.solve(contacts_, now, redundant_);
  double most = 0;
  bool slides = false;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    slides = slides || (contacts_[k].mode == ContactMode::slides && contacts_[k].friction > 0);
    most = std::max(most, forces.pressing(k) / scene_.forceUnit(contacts_[k]));
  }
  if (!slides || !(most > kJams)) return {};
  return textOf(3, ": they jam there (Painleve): the force of a contact has grown to ", most, " times the weight of its bodies");
}

void GroupPath::take(GroupStep step) {
  if (step.length > 0) {
    for (std::size_t m = 0; m < start_.size(); ++m) widen(bounds_[m], step.slopesOf(m), step.length);
    known_ = step.start + step.length;
    const std::vector<State> end = step.statesAt(known_);
    std::vector<GroupContact> contacts = contacts_;
    for (GroupContact& c : contacts) c.begins = false;
    last_ = groupStart(scene_, contacts, end, known_, 1);
    for (std::size_t m = 0; m < end.size(); ++m)
      if (!((last_[m].v - end[m].v).norm() <= kMostLeftOfSpeed * scene_.speed))
        throw NotComputable("the speed left at the contacts of their path is more than rounding");
  }
  steps_.add(std::move(step));
}

std::vector<double> GroupPath::valuesAt(const GroupStep& step, double t) const {
  std::vector<Vec3> slip;
  step.placeSlips(t, slip);
  if (!(t > step.start) && steps_.empty())
    for (std::size_t k = 0; k < slip.size(); ++k)
      if (!contacts_[k].slip.isZero(0)) slip[k] = contacts_[k].slip;
  const std::vector<State> states = step.statesAt(t);
  GroupInstant now = instantOf(scene_, contacts_, states, t, slip);
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (contacts_[k].turns()) now.contacts[k].slip = inPlane(slip[k], now.contacts[k].n);
  GroupForces forces;
  forces.solve(contacts_, now, redundant_);
  return guardValues(guards_, scene_, contacts_, states, t, now, forces, redundant_);
}

// A slip that was expected to end has not.
bool GroupPath::passesBy(const GroupStep& step, const Ending& end) const {
  if (end.guard.cause != TransitionCause::sticks) return false;
  const double t = step.start + step.length;
  const GroupInstant now = instantOf(scene_, contacts_, step.statesAt(t), t, step.slipAtNode(Gauss::kNodes - 1));
  const auto k = static_cast<std::size_t>(end.guard.contact);
  return now.contacts[k].slipVelocity().norm() > (step.frozen[k] ? PathLimits::kStraightLeft : PathLimits::kNothingLeft) * scene_.speed;
}

State GroupPath::stateAt(std::size_t member, double t) const {
  if (!(t > start_time_)) return start_[member];
  if (steps_.move()) {
    const GroupStep& step = steps_.at(t, known_);
    if (!(t > known_) || t - step.start <= 2 * step.length) return step.stateAt(member, t);
  }
  const State& end = steps_.move() ? last_[member] : start_[member];
  const double beyond = t - known_;
  return beyond > 0 ? ContactStep::goingOn(end, *scene_.members[member].model, beyond) : end;
}

std::vector<State> GroupPath::statesAt(double t) const {
  std::vector<State> states;
  for (std::size_t m = 0; m < start_.size(); ++m) states.push_back(stateAt(m, t));
  return states;
}

std::optional<std::size_t> GroupPath::contactThatStops() const {
  if (!end_ || end_->guard.cause != TransitionCause::sticks) return std::nullopt;
  return static_cast<std::size_t>(end_->guard.contact);
}

// Where a slip is 0 it goes along its acceleration, u' = -|u'| d, which the direction at a node comes near to: Newton's method on
// (n x d).u' = 0, for all that stop there together.
void GroupPath::alignStop(GroupInstant& now) const {
  const std::optional<std::size_t> first = contactThatStops();
  const auto stops = [&](std::size_t k) {
    return contacts_[k].turns() && !(now.contacts[k].slipVelocity().norm() > PathLimits::kStraightAnyway * scene_.speed);
  };
  if (!first || !stops(*first)) return;
  std::vector<std::size_t> turning;
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (stops(k)) turning.push_back(k);
  Eigen::MatrixXd J(turning.size(), turning.size());
  Eigen::VectorXd r(turning.size());
  for (int round = 0; round < kAlignRounds; ++round) {
    GroupForces forces;
    forces.solve(contacts_, now, redundant_);
    for (std::size_t j = 0; j < turning.size(); ++j) {
      const Eigen::VectorXd answer = forces.answerToTurn(turning[j]);
      for (std::size_t i = 0; i < turning.size(); ++i) {
        const GroupContactInstant& c = now.contacts[turning[i]];
        const Vec3 across = c.n.cross(c.slip), rate = forces.slipRate(turning[i]);
        J(rowAt(i), rowAt(j)) = across.dot(forces.responseAt(answer, turning[i])) - (i == j ? c.slip.dot(rate) : 0.0);
        r[rowAt(i)] = across.dot(rate);
      }
    }
    const std::optional<Eigen::VectorXd> turn = turnsAtStop(J, r, scene_.pull());
    if (!turn) return;
    for (std::size_t i = 0; i < turning.size(); ++i) {
      GroupContactInstant& c = now.contacts[turning[i]];
      c.slip = (c.slip + (*turn)[rowAt(i)] * c.n.cross(c.slip)).normalized();
    }
  }
}

GroupInstant GroupPath::instantAt(double t) const {
  std::vector<Vec3> slip;
  if (steps_.move() && t > start_time_) steps_.at(t, known_).placeSlips(t, slip);
  else
    for (const GroupContact& c : contacts_) slip.push_back(c.slip);
  GroupInstant now = instantOf(scene_, contacts_, statesAt(t), t, slip);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (!contacts_[k].turns()) continue;
    GroupContactInstant& c = now.contacts[k];
    if (const Vec3 u = c.slipVelocity(); u.norm() > kNoDirection * scene_.speed) c.slip = u;
    c.slip = inPlane(c.slip, c.n);
  }
  if (t > start_time_) alignStop(now);
  return now;
}

Eigen::VectorXd GroupPath::ratesAt(double t) const {
  const GroupInstant now = instantAt(t);
  GroupForces forces;
  forces.solve(contacts_, now, redundant_);
  Eigen::VectorXd rates(12 * rowAt(start_.size()));
  for (std::size_t m = 0; m < start_.size(); ++m)
    rates.segment<12>(12 * rowAt(m)) << now.members[m].v, now.members[m].w, forces.acceleration(m), forces.moment(m);
  return rates;
}

StateDerivative GroupPath::rateAt(const Arc& arc, double t, const State&) const {
  return asState(ratesAt(t).segment<12>(12 * rowAt(slotOf(arc))));
}

TrajectoryEnd GroupPath::end() const {
  if (!end_) return {};
  return {end_->time, end_->guard.cause, end_->guard.contact, end_->guard.limit};
}

std::optional<std::pair<std::vector<State>, double>> GroupPath::beyondEnd() const {
  if (!end_ || (end_->guard.cause != TransitionCause::slips && end_->guard.cause != TransitionCause::lifts)) return std::nullopt;
  const std::size_t which = indexOf(guards_, end_->guard);
  GroupStepper stepper(scene_, contacts_, redundant_);
  const GroupStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  const auto step = stepBeyond<GroupStep>(stepper, start, scene_.length / scene_.speed,
                                          [&](const GroupStep& of, double t) { return valuesAt(of, t)[which]; });
  if (!step) return std::nullopt;
  const double later = step->start + step->length;
  return std::pair(step->statesAt(later), later);
}

PathNearMiss GroupPath::nearestMiss(double until) const {
  return adjoint_detail::nearestMiss(
      guards_, steps_, known_, until, scene_.length / scene_.speed, [&](const GroupStep& step, double t) { return valuesAt(step, t); },
      [&](const ConstrainedGuard& guard) { return shareOfMargin(guard, scene_.length); });
}

}  // namespace carom::adjoint_detail
