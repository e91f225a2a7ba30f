// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>
#include <sstream>

#include "tests/random/checks.h"
#include "tests/random/impact_law.h"

namespace carom::brute {
namespace {

constexpr Real kTime = 1e-9L;       // s
constexpr Real kPositionRounding = 1e-15L;  // m, of what positions in double leave open of a gap
constexpr Real kTie = 1e-9L;        // m
constexpr Real kVelocity = 1e-10L;  // relative to the larger of 1 and the speed
constexpr Real kOwnSlip = 4;        // slips below so many times the approach count as none where a bounce is captured
constexpr Real kFlight = 1e-11L;    // the same, and m, rad

using PairOfBodies = std::pair<int, int>;

class SequenceCheck {
 public:
  SequenceCheck(const Motion& motion, Findings& findings)
      : motion_(motion), findings_(findings), brute_(*motion.scene) {}

  void run() {
    for (index_ = 0; index_ < motion_.events.size() && findings_.failures.empty(); ++index_) {
      const Event& event = motion_.events[index_];
      ++findings_.events;
      for (const carom::Contact& c : event.contacts) ++findings_.kinds[kindOfContact(c)];
      pairs_.clear();
      for (const carom::Contact& c : event.contacts) pairs_.insert(std::minmax(c.a, c.b));
      brute_.lookUntil(event.time);
      compareTouches(event);
      compareFlights(event);
      if (event.contacts.size() == 1)
        compareLaw(event);
      else
        compareJoint(event);
      if (std::ranges::any_of(event.contacts, [](const carom::Contact& c) { return c.lasts; })) return;
      restart(event);
    }
    if (!findings_.failures.empty()) return;
    brute_.lookUntil(motion_.end);
    for (const auto& t : brute_.touches())
      if (t.time < motion_.end - kTime) fail("missed: ", t.a, t.b, "meet at t = ", t.time, "and no event follows");
  }

 private:
  template <class... Parts>
  void fail(const Parts&... parts) {
    std::ostringstream out;
    out << std::setprecision(17) << "event " << index_;
    if (index_ < motion_.events.size())
      out << " (t = " << motion_.events[index_].time << ": " << motion_.describeEvent(static_cast<int>(index_)) << ")";
    out << ": ";
    ((out << parts << " "), ...);
    findings_.fail(out.str());
  }

  // Approach along the separating direction, m/s; < 0 when the bodies close.
  Real approach(int a, int b, Real t) {
    Real least = 1e30L;
    const Kinematic ka = brute_.stateAt(a, t), kb = brute_.stateAt(b, t);
    for (const Contact& c : contactsOf(brute_.solid(a), {ka.x, ka.R}, brute_.solid(b), {kb.x, kb.R}, kTie))
      least = std::min(least, c.n.dot(ka.v + ka.w.cross(c.p - ka.x) - kb.v - kb.w.cross(c.p - kb.x)));
    return least;
  }

  std::string kindOfContact(const carom::Contact& c) const {
    const auto name = [&](int body) {
      return kindOf(motion_.scene->bodies[static_cast<std::size_t>(body)].shape).name;
    };
    const std::string features = motion_.geometry->describe(c.a, c.b, c.features);
    const bool edges = features.find("edge") != std::string::npos;
    return std::min<std::string>(name(c.a), name(c.b)) + "-" + std::max<std::string>(name(c.a), name(c.b)) +
           (edges ? " (edge)" : "");
  }

  void compareTouches(const Event& event) {
    const Real t = event.time;
    bool any = false;
    for (const auto& [a, b] : pairs_) any = compareTouch(event, a, b) || any;
    if (!any && findings_.failures.empty()) ++findings_.undecided;
    for (const auto& touch : brute_.touches())
      if (!pairs_.count({touch.a, touch.b}) && touch.time < t - kTime)
        fail("missed: bodies", touch.a, "and", touch.b, "meet at t =", touch.time);
  }

  // True when the pair is seen to meet at the time of the event.
  bool compareTouch(const Event& event, int a, int b) {
    const Real t = event.time, gap = std::abs(brute_.separationAt(a, b, t).value);
    findings_.worst_gap = std::max(findings_.worst_gap, gap);
    if (!(gap <= kTie)) fail("bodies", a, "and", b, "are", gap, "m from touching");
    const Real rate = std::abs(approach(a, b, t)), open = kPositionRounding / std::max(rate, Real(1e-30L));
    const auto touch = brute_.lookAt(a, b, t + std::max(kTime, open));
    if (touch && std::abs(*touch - t) <= kTime) {
      findings_.worst_time = std::max(findings_.worst_time, std::abs(*touch - t));
      return true;
    }
    if (event.contacts.size() > 1) return false;  // one of those that join the instant may only rest against the other
    if (touch && std::abs(*touch - t) <= open) return false;
    if (!touch && !brute_.hasParted(a, b) && gap <= kPositionRounding)
      return false;  // a bounce lower than the start's rounding
    if (touch)
      fail("bodies", a, "and", b, "meet at t =", *touch, ", off by", *touch - t, "s; approach", rate);
    else
      fail("invented: bodies", a, "and", b, "do not meet; gap", gap, "approach", rate);
    return false;
  }

  void compareFlights(const Event& event) {
    for (const Participant& p : event.participants) {
      const BodyState s = motion_.stateBefore(static_cast<int>(index_), p.body);
      const Kinematic k = brute_.stateAt(p.body, event.time);
      Real error = (widen(s.position) - k.x).norm() + (widen(s.velocity) - k.v).norm() / std::max(Real(1), k.v.norm()) +
                   (widen(s.angular_velocity) - k.w).norm() / std::max(Real(1), k.w.norm());
      if (brute_.solid(p.body).kind == Solid::Kind::box)
        error += (s.orientation.toRotationMatrix().cast<Real>() - k.R).norm();
      findings_.worst_flight = std::max(findings_.worst_flight, error);
      if (!(error <= kFlight)) fail("state of body", p.body, "before the impact is off by", error);
    }
  }

  Kinematic after(const Event& event, int body) {
    const Participant* p = event.find(body);
    if (!p) return brute_.stateAt(body, event.time);
    const Arc& arc = motion_.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(p->next())];
    const Kinematics k = arc.kinematicsAt(arc.start());
    return {widen(k.x), widen(k.v), widen(k.w), k.R.cast<Real>()};
  }

  void compareLaw(const Event& event) {
    ++findings_.single;
    const int a = event.contacts[0].a, b = event.contacts[0].b;
    const auto& bodies = motion_.scene->bodies;
    auto c = combined(*motion_.scene, bodies[static_cast<std::size_t>(a)], bodies[static_cast<std::size_t>(b)]);
    if (event.contacts[0].captured) c.elasticity = 0;
    const Kinematic ka = brute_.stateAt(a, event.time), kb = brute_.stateAt(b, event.time);
    const Kinematic found_a = after(event, a), found_b = after(event, b);
    const auto candidates = contactsOf(brute_.solid(a), {ka.x, ka.R}, brute_.solid(b), {kb.x, kb.R}, kTie);
    if (candidates.size() > 1) ++findings_.tied;
    Real best = 1e30L;
    for (const Contact& contact : candidates) {
      auto expected_after = afterImpact(brute_.mass(a), ka, brute_.mass(b), kb, contact, c);
      const auto& [va, vb] = expected_after;
      const Vector u = va.v + va.w.cross(contact.p - ka.x) - vb.v - vb.w.cross(contact.p - kb.x);
      const Real left = (velocityAt(contact.p, found_a) - velocityAt(contact.p, found_b)).norm();
      if (event.contacts[0].captured && left <= kVelocity && u.norm() <= kOwnSlip * std::abs(event.contacts[0].approach))
        expected_after = stoppedAt(brute_.mass(a), ka, brute_.mass(b), kb, contact, expected_after);
      const auto error = [](const Vector& found, const Vector& expected) {
        return (found - expected).norm() / std::max(Real(1), expected.norm());
      };
      best = std::min(best, std::max({error(found_a.v, va.v), error(found_a.w, va.w), error(found_b.v, vb.v),
                                      error(found_b.w, vb.w)}));
    }
    findings_.worst_velocity = std::max(findings_.worst_velocity, best);
    if (!(best <= kVelocity)) fail("velocities after it are off by", best, "margin", event.margins.smallest());
  }

  static Vector velocityAt(const Vector& p, const Kinematic& k) { return k.v + k.w.cross(p - k.x); }

  void compareJoint(const Event& event) {
    ++findings_.joint;
    const auto& bodies = motion_.scene->bodies;
    Real largest = 0;
    for (const carom::Contact& c : event.contacts) largest = std::max(largest, widen(c.impulse).norm());
    for (const carom::Contact& c : event.contacts) {
      const Vector p = widen(c.at.point);
      auto pair = combined(*motion_.scene, bodies[static_cast<std::size_t>(c.a)], bodies[static_cast<std::size_t>(c.b)]);
      if (c.captured) pair.elasticity = 0;
      const JointContact one{
          widen(c.at.normal), widen(c.impulse),
          velocityAt(p, brute_.stateAt(c.a, event.time)) - velocityAt(p, brute_.stateAt(c.b, event.time)),
          velocityAt(p, after(event, c.a)) - velocityAt(p, after(event, c.b)), pair};
      const Real violation = violationOf(one, largest);
      findings_.worst_velocity = std::max(findings_.worst_velocity, violation);
      if (!(violation <= kVelocity)) fail("bodies", c.a, "and", c.b, "are off equation 4.4 by", violation);
    }
  }

  void restart(const Event& event) {
    for (const Participant& p : event.participants) {
      const auto& arcs = motion_.world_lines[static_cast<std::size_t>(p.body)].arcs;
      brute_.restart(p.body, event.time, arcs[static_cast<std::size_t>(p.next())].startState());
    }
    for (const auto& [a, b] : pairs_) brute_.leaveContact(a, b, event.time);
  }

  const Motion& motion_;
  Findings& findings_;
  BruteForce brute_;
  std::size_t index_ = 0;
  std::set<PairOfBodies> pairs_;
};

}  // namespace

void checkSequence(const Motion& motion, Findings& findings) { SequenceCheck(motion, findings).run(); }

}  // namespace carom::brute
