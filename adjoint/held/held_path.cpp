// SPDX-License-Identifier: MIT
#include "adjoint/held/held_path.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {
namespace {

// A slip that ends goes straight from this share of the unit of speed on, if what is left of it across is rounding, or from
// the lesser one.
constexpr double kStraight = 1e-8, kStraightAnyway = 1e-11;
// A slip slower than this has no direction of its own.
constexpr double kNoDirection = 1e-7;
// A slip goes straight where it changes across its direction by no more than this share.
constexpr double kTurns = 1e-4;
// The first step turns the body by about so much, rad, and steps are never longer than this share of the first guess.
constexpr double kFirstTurn = 0.3;
// See lengthBeforeEnd.
constexpr double kLeftOutOfSlip = 3e-13;
// Guards that fall to 0 nearer to one another than this share of the time do so at once.
constexpr double kAtOnce = 1e-13;
constexpr int kTries = 200;
constexpr std::size_t kMostSteps = 20'000;

// By which a step may be longer, or has to be shorter.
double factorFor(double error) {
  return std::clamp(0.9 * elementary::pow(std::max(error, 1e-12), -1.0 / 11), 0.2, 2.0);
}

// How far before its end a slip can be followed in one step, as a share of the time that is left of it: polynomials
// through the nodes converge like 1/R^12 on the ellipse of axes R + 1/R that reaches to the end, and what they leave out
// counts by the share that the slip has of the unit of speed.
double lengthBeforeEnd(double share) {
  const double R = elementary::pow(share / kLeftOutOfSlip, 1.0 / Gauss::kNodes);
  return 2.6 / (0.5 * (R + 1 / R) + 1);
}

std::vector<Vec3> slipAtNode(const HeldStep& step, int node) {
  std::vector<Vec3> slip;
  for (const auto& of : step.slip) slip.push_back(of[static_cast<std::size_t>(node)]);
  return slip;
}

}  // namespace

// The values of all guards at times of one step.
struct HeldPath::Values {
  const HeldPath& path;
  const HeldStep& step;
  HeldInstant now;
  HeldForces forces;
  std::vector<double> values;

  Values(const HeldPath& of, const HeldStep& in) : path(of), step(in), values(of.guards_.size()) {}

  const std::vector<double>& at(double t, const std::vector<Vec3>& slip) {
    const State s = step.stateAt(t);
    const Mat3 R = s.q.toRotationMatrix();
    placeInstant(path.scene_, path.contacts_, s, R, now);
    for (std::size_t k = 0; k < slip.size(); ++k) {
      ContactInstant<double>& c = now.contacts[k];
      c.slip = slip[k];
      if (c.mode == HeldMode::slides && c.friction > 0) c.slip = (c.slip - c.n.dot(c.slip) * c.n).normalized();
    }
    forces.solve(now, path.redundant_);
    const Pose own{s.x, path.scene_.model->shapeToWorld(R)};
    for (std::size_t g = 0; g < values.size(); ++g)
      values[g] = guardValue(path.guards_[g], path.scene_, path.contacts_, own, now, forces);
    return values;
  }
};

HeldPath::HeldPath(HeldScene scene, std::vector<HeldContact> contacts, bool redundant, std::vector<HeldGuard> guards,
                   const State& start, double time, double until)
    : scene_(std::move(scene)),
      contacts_(std::move(contacts)),
      redundant_(redundant),
      guards_(std::move(guards)),
      start_state_(start),
      last_(start),
      start_(time),
      until_(until),
      known_(time) {
  const HeldInstant now = instantOf(scene_, contacts_, start, slipAfter());
  const double spin = now.body.omega.norm() + std::sqrt(scene_.gravity.norm() / scene_.length);
  next_length_ = kFirstTurn / spin;
  HeldForces forces;
  forces.solve(now, redundant_);
  bounds_.acceleration = forces.acceleration();
  bounds_.straight = false;
  for (const ContactInstant<double>& c : now.contacts)
    rolls_ = rolls_ || (c.mode == HeldMode::sticks && c.point_rate.norm() > 1e-6 * scene_.speed);
  if (start_ < until_) extend();
}

bool HeldPath::slides() const {
  return std::ranges::any_of(contacts_, [](const HeldContact& c) { return c.mode == HeldMode::slides; });
}

void HeldPath::extendTo(double t) {
  while (!end_ && known_ < std::min(t, until_)) extend();
}

std::vector<Vec3> HeldPath::slipAfter() const {
  if (!steps_.empty()) return slipAtNode(steps_.back(), Gauss::kNodes - 1);
  std::vector<Vec3> slip;
  for (const HeldContact& c : contacts_) slip.push_back(c.slip);
  return slip;
}

// Looks at the slips with which a step starts: those that are about to end, as they are slow and become slower, are
// frozen. Gives how long the step may be as they come to an end or turn.
double HeldPath::lookAtSlips(HeldStepper::Start& start) const {
  double longest = kInfinity;
  if (!slides()) return longest;
  const HeldInstant now = instantOf(scene_, contacts_, start.state, start.slip);
  HeldForces forces;
  forces.solve(now, redundant_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != HeldMode::slides || !(contacts_[k].friction > 0)) continue;
    if (contacts_[k].begins && steps_.empty()) continue;
    const ContactInstant<double>& c = now.contacts[k];
    const double slip = now.slipAt(k).norm(), share = slip / scene_.speed;
    Vec3 rate = forces.slipRate(k);
    rate -= c.n.dot(rate) * c.n;
    const double along = start.slip[k].dot(rate), across = (rate - along * start.slip[k]).norm();
    if (share < kStraightAnyway || (share < kStraight && share * across < kLeftOutOfSlip * rate.norm())) {
      start.frozen[k] = along < 0;
    } else if (across > kTurns * rate.norm()) {
      longest = std::min(longest, slip / rate.norm() * lengthBeforeEnd(share));
    }
  }
  return longest;
}

void HeldPath::extend() {
  if (end_ || !(known_ < until_)) return;
  if (steps_.size() >= kMostSteps) throw NotComputable("its path in contact takes more than 20000 steps: it turns too fast");
  take(nextStep());
}

// The longest step that is as good as is asked for, or that ends where a guard falls to 0.
HeldStep HeldPath::nextStep() {
  HeldStepper stepper(scene_, contacts_, redundant_);
  HeldStepper::Start start{last_, known_, slipAfter(), std::vector<char>(contacts_.size(), 0)};
  double length = std::min(next_length_, lookAtSlips(start));  // however long the motion is: that must not matter
  const HeldStep* like = steps_.empty() ? nullptr : &steps_.back();
  std::optional<HeldStep> too_long;
  for (int tries = 0; tries < kTries && known_ + length > known_; ++tries) {
    std::optional<HeldStep> step = stepper.tried(start, length, like);
    if (!step) {
      length *= 0.4;
      continue;
    }
    std::optional<End> end = firstEnd(*step);
    const double error = stepper.errorOf(*step);
    if (!(error <= 1)) {
      length = shorterLength(length, error, end);
      too_long = std::move(step);
      like = &*too_long;
      continue;
    }
    next_length_ = factorFor(error) * length;
    if (!end) return *step;
    if (!(end->time > known_)) {  // at once
      step->length = 0;
    } else {
      endAt(stepper, start, *step, *end);
      if (passesBy(*step, *end)) {
        length *= 0.5;
        continue;
      }
      end->time = step->start + step->length;
    }
    end_ = end;
    return *step;
  }
  throw NotComputable("its path in contact cannot be followed beyond t = " + std::to_string(known_) + " s");
}

// What lies beyond an end need not be followed.
double HeldPath::shorterLength(double length, double error, const std::optional<End>& end) const {
  const double shorter = factorFor(error) * length;
  if (!end || !(end->time > known_) || !(end->time < known_ + 0.95 * length)) return shorter;
  return std::max(end->time - known_, shorter);
}

// The state of an event is that at the end of a step: the step is made anew up to the root, which is found once more there.
void HeldPath::endAt(HeldStepper& stepper, const HeldStepper::Start& start, HeldStep& step, End& end) const {
  const auto which = static_cast<std::size_t>(
      std::ranges::find_if(guards_, [&](const HeldGuard& g) { return g.isSame(end.guard); }) - guards_.begin());
  for (int round = 0; round < 2; ++round) {
    const double shorter = end.time - known_;
    if (shorter == step.length) return;
    std::optional<HeldStep> ending = stepper.tried(start, shorter, &step);
    if (!ending) return;
    step = std::move(*ending);
    if (round == 1) return;
    Values values(*this, step);
    const std::vector<Vec3> last = slipAtNode(step, Gauss::kNodes - 1);
    const double h = step.length, value = values.at(known_ + h, last)[which],
                 earlier = values.at(known_ + 0.999 * h, last)[which];
    const double move = -value * (0.001 * h) / (value - earlier);
    if (!(std::abs(move) <= 1e-6 * h) || std::abs(move) <= 1e-16 * known_) return;
    end.time += move;
  }
}

// A slip that was expected to end has not.
bool HeldPath::passesBy(const HeldStep& step, const End& end) const {
  if (end.guard.cause != TransitionCause::sticks) return false;
  const HeldInstant now = instantOf(scene_, contacts_, step.stateAt(step.start + step.length),
                                    slipAtNode(step, Gauss::kNodes - 1));
  const auto k = static_cast<std::size_t>(end.guard.contact);
  return now.slipAt(k).norm() > (step.frozen[k] ? 10 * kNoDirection : kStraightAnyway) * scene_.speed;
}

void HeldPath::take(HeldStep step) {
  const HeldSlopes& c = step.slopes;
  if (step.length > 0) {
    const auto most = [&](int row) { return c.middleRows<3>(row).colwise().norm().eval(); };
    const auto push = most(6), turn = most(3);
    bounds_.variation = std::max(bounds_.variation, (Vec3(c.block<3, 1>(6, 0)) - bounds_.acceleration).norm() +
                                                        push.tail(Gauss::kNodes - 1).sum());
    // |P_k| <= 1 and |P_k'| <= k (k + 1)/2, of (x + 1)/2 twice that; omega = J theta' with |J| <= 1, |J'| <= |theta'|
    double bend = 0;
    for (int k = 1; k < Gauss::kNodes; ++k) bend += turn[k] * k * (k + 1) / step.length;
    const double spin = turn.sum();
    bounds_.spin = std::max(bounds_.spin, spin);
    bounds_.spin_rate = std::max(bounds_.spin_rate, bend + spin * spin);
    known_ = step.start + step.length;
    last_ = step.stateAt(known_);
  }
  steps_.add(std::move(step));
}

const HeldStep& HeldPath::stepAt(double t) const {
  std::size_t low = 0, high = steps_.size();
  while (high - low > 1) {  // the last one that starts before t
    const std::size_t middle = (low + high) / 2;
    (steps_[middle].start < t && steps_[middle].length > 0 ? low : high) = middle;
  }
  return steps_[low];
}

State HeldPath::stateAt(double t) const {
  if (!(t > start_) || steps_.empty() || !(steps_.front().length > 0)) return start_state_;
  return stepAt(t).stateAt(t);
}

Vec3 HeldPath::velocityAt(double t) const {
  if (!(t > start_) || steps_.empty() || !(steps_.front().length > 0)) return start_state_.v;
  const HeldStep& step = stepAt(t);
  return step.from.v + step.changeAt(t).segment<3>(6);
}

HeldInstant HeldPath::instantAt(double t) const {
  std::vector<Vec3> slip;
  if (steps_.empty() || !(steps_.front().length > 0)) {
    slip = slipAfter();
  } else {
    const HeldStep& step = stepAt(t);
    slip = slipAtNode(step, t - step.start < 0.5 * step.length ? 0 : Gauss::kNodes - 1);
    if (!(t > start_))
      for (std::size_t k = 0; k < contacts_.size(); ++k) slip[k] = contacts_[k].slip;
  }
  HeldInstant now = instantOf(scene_, contacts_, stateAt(t), slip);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != HeldMode::slides || !(contacts_[k].friction > 0)) continue;
    const Vec3 u = now.slipAt(k);
    if (u.norm() > kNoDirection * scene_.speed) now.contacts[k].slip = u.normalized();
  }
  return now;
}

StateDerivative HeldPath::rateAt(double t) const {
  const HeldInstant now = instantAt(t);
  HeldForces forces;
  forces.solve(now, redundant_);
  StateDerivative rate;
  rate.x = now.body.v, rate.theta = now.body.omega, rate.v = forces.acceleration(), rate.L = forces.moment();
  return rate;
}

// The first guard that falls through 0, looked for at the nodes and at both ends.
std::optional<HeldPath::End> HeldPath::firstEnd(const HeldStep& step) const {
  if (guards_.empty()) return std::nullopt;
  const Gauss& gauss = Gauss::get();
  double before = step.start;
  std::vector<Vec3> slip;
  for (const auto& of : step.slip) slip.push_back(of.front());
  if (steps_.empty())
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      if (!contacts_[k].slip.isZero(0)) slip[k] = contacts_[k].slip;
  Values values(*this, step);
  std::vector<double> last = values.at(before, slip);
  for (int i = 0; i <= Gauss::kNodes; ++i) {
    const double t = i < Gauss::kNodes ? step.start + gauss.node[i] * step.length : step.start + step.length;
    const std::vector<Vec3> here = slipAtNode(step, std::min(i, Gauss::kNodes - 1));
    const std::vector<double> now = values.at(t, here);
    std::optional<End> first;
    for (std::size_t g = 0; g < guards_.size(); ++g) {
      if (!(now[g] < -guardRounding(guards_[g])) || !(now[g] < last[g])) continue;
      const double root = last[g] <= 0 ? before : rootOf(values, g, before, t, slip);
      // what comes at one instant comes in the order of the guards, whatever the rounding
      if (!first || root < first->time - kAtOnce * std::abs(root)) first = End{root, guards_[g]};
    }
    if (first) return first;
    before = t, last = now, slip = here;
  }
  return std::nullopt;
}

double HeldPath::rootOf(Values& values, std::size_t guard, double above, double below,
                        const std::vector<Vec3>& slip) const {
  const double length = below - above;
  double high = values.at(above, slip)[guard], low = values.at(below, slip)[guard];
  if (!(high > 0)) return above;
  int side = 0;
  for (int k = 0; k < 100 && std::nextafter(above, below) < below && low < 0; ++k) {
    // the chord, drawn towards the end that has not moved (Illinois), with halving where it does not help
    double t = k % 8 == 7 ? 0.5 * (above + below) : above + (below - above) * (high / (high - low));
    t = std::clamp(t, std::nextafter(above, below), std::nextafter(below, above));
    const double now = values.at(t, slip)[guard];
    if (now > 0) {
      above = t, high = now;
      if (side == 1) low *= 0.5;
      side = 1;
    } else {
      below = t, low = now;
      if (side == -1) high *= 0.5;
      side = -1;
    }
    if (below - above <= 4e-16 * std::max(std::abs(below), length) || now == 0) break;
  }
  return below;
}

}  // namespace carom::adjoint_detail
