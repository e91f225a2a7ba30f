// SPDX-License-Identifier: MIT
#include "adjoint/held/held_path.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"

namespace carom::adjoint_detail {
namespace {


// A slip that ends goes straight from this share of the unit of speed on; what is left of it across is rounding.
constexpr double kStraight = 1e-8;
// A slip slower than this has no direction of its own.
constexpr double kNoDirection = 1e-7;
// The first step turns the body by about so much, rad, and steps are never longer than this share of the first guess.
constexpr double kFirstTurn = 0.3;
constexpr int kTries = 200;
constexpr std::size_t kMostSteps = 200'000;

std::vector<Vec3> slipAtNode(const HeldStep& step, int node) {
  std::vector<Vec3> slip;
  for (const auto& of : step.slip) slip.push_back(of[static_cast<std::size_t>(node)]);
  return slip;
}

}  // namespace

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
  const HeldDynamics<double> forces(now.body, now.contacts, redundant_);
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

// Which slips are about to end: they are slow, and become slower.
std::vector<char> HeldPath::endingSlips(const State& from, const std::vector<Vec3>& slip) const {
  std::vector<char> ending(contacts_.size(), 0);
  const HeldInstant now = instantOf(scene_, contacts_, from, slip);
  std::optional<HeldDynamics<double>> forces;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (contacts_[k].mode != HeldMode::slides || !(contacts_[k].friction > 0)) continue;
    if (contacts_[k].begins && steps_.empty()) continue;
    if (!(now.slipAt(k).norm() < kStraight * scene_.speed)) continue;
    if (!forces) forces.emplace(now.body, now.contacts, redundant_);
    ending[k] = slip[k].dot(forces->slipRate(k)) < 0;
  }
  return ending;
}

void HeldPath::extend() {
  if (end_ || !(known_ < until_)) return;
  if (steps_.size() >= kMostSteps) throw NotComputable("its path in contact takes more than 200000 steps");
  take(stepFrom(last_));
}

// The longest step that is as good as is asked for, or that ends where a guard falls to 0.
HeldStep HeldPath::stepFrom(const State& from) {
  const HeldStepper stepper(scene_, contacts_, redundant_);
  const std::vector<Vec3> slip = slipAfter();
  const std::vector<char> frozen = endingSlips(from, slip);
  const HeldStep* before = steps_.empty() ? nullptr : &steps_.back();
  double length = next_length_;  // not only to the end of the motion: its length must not matter
  for (int tries = 0; tries < kTries; ++tries) {
    if (!(known_ + length > known_)) break;
    std::optional<HeldStep> step = stepper.tried(from, known_, length, slip, frozen, before);
    if (!step) {
      length *= 0.4;
      continue;
    }
    std::optional<End> end = firstEnd(*step);
    const double error = stepper.errorOf(*step);
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -1.0 / 11), 0.2, 2.0);
    if (!(error <= 1)) {
      // what lies beyond an end need not be followed
      length = end && end->time < known_ + 0.95 * length && end->time > known_ ? std::max(end->time - known_, factor * length)
                                                                             : factor * length;
      continue;
    }
    next_length_ = factor * length;
    if (!end) return *step;
    if (!(end->time > known_)) {  // at once
      end_ = end;
      step->length = 0;
      return *step;
    }
    // The state of an event is that at the end of a step.
    for (int round = 0; round < 3; ++round) {
      const double shorter = end->time - known_;
      if (shorter == step->length) break;
      std::optional<HeldStep> ending = stepper.tried(from, known_, shorter, slip, frozen, &*step);
      if (!ending) break;
      step = std::move(ending);
      if (round == 1) break;
      const auto which = static_cast<std::size_t>(
          std::ranges::find_if(guards_, [&](const HeldGuard& g) { return g.isSame(end->guard); }) - guards_.begin());
      const std::vector<Vec3> last = slipAtNode(*step, Gauss::kNodes - 1);
      const double h = step->length, value = valuesAt(*step, known_ + h, last)[which],
                   earlier = valuesAt(*step, known_ + 0.999 * h, last)[which];
      const double move = -value * (0.001 * h) / (value - earlier);
      if (!(std::abs(move) <= 1e-6 * h) || std::abs(move) <= 1e-16 * known_) break;
      end->time += move;
    }
    if (end->guard.cause == TransitionCause::sticks) {
      const auto k = static_cast<std::size_t>(end->guard.contact);
      const HeldInstant now = instantOf(scene_, contacts_, step->stateAt(step->start + step->length), slipAtNode(*step, Gauss::kNodes - 1));
      if (now.slipAt(k).norm() > 10 * kNoDirection * scene_.speed) {  // it passed by
        length *= 0.5;
        continue;
      }
    }
    end->time = step->start + step->length;
    end_ = end;
    return *step;
  }
  throw NotComputable("its path in contact cannot be followed beyond t = " + std::to_string(known_) + " s");
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
  steps_.push_back(std::move(step));
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
  const HeldDynamics<double> forces(now.body, now.contacts, redundant_);
  StateDerivative rate;
  rate.x = now.body.v, rate.theta = now.body.omega, rate.v = forces.acceleration(), rate.L = forces.moment();
  return rate;
}

std::vector<double> HeldPath::valuesAt(const HeldStep& step, double t, const std::vector<Vec3>& slip) const {
  const State s = step.stateAt(t);
  HeldInstant now = instantOf(scene_, contacts_, s, slip);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    ContactInstant<double>& c = now.contacts[k];
    if (c.mode != HeldMode::slides || !(c.friction > 0)) continue;
    c.slip = (c.slip - c.n.dot(c.slip) * c.n).normalized();
  }
  const HeldDynamics<double> forces(now.body, now.contacts, redundant_);
  const Pose own{s.x, scene_.model->shapeToWorld(s.q.toRotationMatrix())};
  std::vector<double> values;
  values.reserve(guards_.size());
  for (const HeldGuard& guard : guards_) values.push_back(guardValue(guard, scene_, contacts_, own, now, forces));
  return values;
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
  std::vector<double> last = valuesAt(step, before, slip);
  for (int i = 0; i <= Gauss::kNodes; ++i) {
    const double t = i < Gauss::kNodes ? step.start + gauss.node[i] * step.length : step.start + step.length;
    const std::vector<Vec3> here = slipAtNode(step, std::min(i, Gauss::kNodes - 1));
    const std::vector<double> now = valuesAt(step, t, here);
    std::optional<End> first;
    for (std::size_t g = 0; g < guards_.size(); ++g) {
      const double rounding = guardRounding(guards_[g]);
      if (!(now[g] < -rounding) || !(now[g] < last[g])) continue;
      const double root = last[g] <= 0 ? before : rootOf(step, g, before, t, slip);
      if (!first || root < first->time) first = End{root, guards_[g]};
    }
    if (first) return first;
    before = t, last = now, slip = here;
  }
  return std::nullopt;
}

double HeldPath::rootOf(const HeldStep& step, std::size_t guard, double above, double below,
                        const std::vector<Vec3>& slip) const {
  const auto value = [&](double t) { return valuesAt(step, t, slip)[guard]; };
  double high = value(above), low = value(below);
  if (!(high > 0)) return above;
  int side = 0;
  for (int k = 0; k < 100 && std::nextafter(above, below) < below && low < 0; ++k) {
    // the chord, drawn towards the end that has not moved (Illinois), with halving where it does not help
    double t = k % 8 == 7 ? 0.5 * (above + below) : above + (below - above) * (high / (high - low));
    t = std::clamp(t, std::nextafter(above, below), std::nextafter(below, above));
    const double now = value(t);
    if (now > 0) {
      above = t, high = now;
      if (side == 1) low *= 0.5;
      side = 1;
    } else {
      below = t, low = now;
      if (side == -1) high *= 0.5;
      side = -1;
    }
    if (below - above <= 4e-16 * std::max(std::abs(below), step.length) || now == 0) break;
  }
  return below;
}

}  // namespace carom::adjoint_detail
