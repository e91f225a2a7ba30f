// SPDX-License-Identifier: MIT
#include "editing/problem/margins/event_margins.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/numeric/elementary.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/margins/event_bars.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

using Way = EventMargin::Way;
using Vec7 = Eigen::Matrix<double, 7, 1>;

/// Directions of slip that are looked at; the nearest one is found between its neighbours.
constexpr int kDirections = 48;
constexpr int kRefinements = 40;

class MarginReader {
 public:
  MarginReader(DerivativeTape& tape, const std::function<Eigen::VectorXd(const SceneGradient&)>& byChanges)
      : tape_(tape),
        motion_(tape.motion()),
        by_changes_(byChanges),
        bodies_(dynamic_cast<const BodyGeometry*>(motion_.geometry.get())) {}

  std::vector<EventMargin> take() { return std::move(margins_); }

  void readEvent(int event) {
    const Event& e = motion_.events[static_cast<std::size_t>(event)];
    if (!e.counts()) return;
    const int contacts = static_cast<int>(e.contacts.size());
    for (int k = 0; k < contacts; ++k) {
      if (e.contacts[static_cast<std::size_t>(k)].held) continue;
      grazing(event, k);
      leaving(event, k);
      if (contacts > 1) parting(event, k);
    }
    if (contacts == 1) slipping(event);
  }

  // Of an impact and the next one that counts.
  void readOrder(int event) {
    int next = event + 1;
    while (next < static_cast<int>(motion_.events.size()) && !eventAt(next).counts()) ++next;
    if (!eventAt(event).counts() || next == static_cast<int>(motion_.events.size())) return;
    const Event &first = eventAt(event), &second = eventAt(next);
    EventMargin m = start(Way::order, event);
    m.value = second.time - first.time;
    m.gradient = timeGradient(next) - timeGradient(event);
    m.what = name(event, 0, second.time) + " and " + name(next, 0, first.time) + " change order";
    margins_.push_back(std::move(m));
  }

  void readInstant(int event, const ReadInstant& instant) {
    const Event& e = eventAt(event);
    if (!e.counts() || (instant.body >= 0 && !e.find(instant.body))) return;
    EventMargin m = start(Way::is_read, event);
    m.value = instant.time - e.time;
    m.gradient = -timeGradient(event);
    if (instant.end) {
      m.what = name(event, 0) + " comes after the end of the motion";
    } else {
      m.what = name(event, 0, instant.time) + (m.value >= 0 ? " comes after " : " comes before ") +
               briefBeside(instant.time, e.time) + " s (the time of a constraint)";
    }
    margins_.push_back(std::move(m));
  }

  void readRest(const ReadInstant& instant) {
    EventMargin m = start(Way::is_read, instant.rest);
    m.value = instant.time - eventAt(instant.rest).time;
    StateSeed seed;
    seed.body = instant.body, seed.at = Instant::after(instant.rest), seed.time = -1;
    m.gradient = by_changes_(adjoint(tape_, std::span(&seed, 1)));
    m.what = "the rest of '" + bodyName(instant.body) + "' begins after the end of the motion";
    margins_.push_back(std::move(m));
  }

 private:
  const Event& eventAt(int event) const { return motion_.events[static_cast<std::size_t>(event)]; }
  const std::string& bodyName(int body) const { return motion_.scene->bodies[static_cast<std::size_t>(body)].name; }
  /// With its time, which is told from another one that is named beside it.
  std::string name(int event, int contact, double beside = kInfinity) const {
    const Contact& c = eventAt(event).contacts[static_cast<std::size_t>(contact)];
    return "the impact of '" + bodyName(c.a) + "' with '" + bodyName(c.b) + "' at " +
           briefBeside(eventAt(event).time, beside) + " s";
  }

  static EventMargin start(Way way, int event) {
    EventMargin m;
    m.way = way;
    m.event = event;
    return m;
  }

  Eigen::VectorXd gradientOf(const EventBars& bars) { return by_changes_(bars.gradient()); }

  const Eigen::VectorXd& timeGradient(int event) {
    times_.resize(motion_.events.size());
    Eigen::VectorXd& g = times_[static_cast<std::size_t>(event)];
    if (g.size() == 0) {
      EventBars bars(tape_, event);
      bars.addTime(1);
      g = gradientOf(bars);
    }
    return g;
  }

  // d (n.u)^2 = 2 (n.u) (u.dn + n.du)
  void grazing(int event, int k) {
    const Contact& c = eventAt(event).contacts[static_cast<std::size_t>(k)];
    EventBars bars(tape_, event);
    const Vec3 n = c.at.normal, u = bars.velocityAt(k);
    const double approach = n.dot(u);
    Vec7 contact = Vec7::Zero();
    contact.segment<3>(1) = 2 * approach * u;
    bars.addContact(k, contact);
    bars.addVelocity(k, 2 * approach * n);
    EventMargin m = start(Way::grazes, event);
    m.value = approach * approach;
    m.gradient = gradientOf(bars);
    m.what = name(event, k) + " grazes, and is missed";
    margins_.push_back(std::move(m));
  }

  // value = w.(R^T (p - x) - q) + l.R^T n
  void leaving(int event, int k) {
    if (!bodies_) return;
    const Contact& c = eventAt(event).contacts[static_cast<std::size_t>(k)];
    const EventBars nothing(tape_, event);
    for (const FeatureLimit& limit : bodies_->limits(c.a, c.b, c.features, nothing.poseOf(c.a), nothing.poseOf(c.b))) {
      EventBars bars(tape_, event);
      const Pose pose = bars.poseOf(limit.body);
      const Vec3 r = c.at.point - pose.x, w = pose.R * limit.point_weight, l = pose.R * limit.normal_weight;
      Vec7 contact = Vec7::Zero();
      contact.segment<3>(1) = l;
      contact.tail<3>() = w;
      bars.addContact(k, contact);
      bars.addPose(limit.body, -w, w.cross(r) + l.cross(c.at.normal));
      if (limit.border_rates.cols() > 0) bars.addSize(limit.body, -limit.border_rates.transpose() * limit.point_weight);
      if (limit.normal_rates.cols() > 0)
        bars.addSize(limit.body, limit.normal_rates.transpose() * (pose.R.transpose() * c.at.normal));
      EventMargin m = start(Way::leaves, event);
      m.value = w.dot(r) - limit.point_weight.dot(limit.border) + l.dot(c.at.normal);
      m.gradient = gradientOf(bars);
      m.what = name(event, k) + " moves from " + motion_.geometry->describe(c.a, c.b, c.features) + " to " +
               limit.beyond + " of '" + bodyName(limit.body) + "'";
      margins_.push_back(std::move(m));
    }
  }

  void parting(int event, int k) {
    EventBars bars(tape_, event);
    bars.addContact(k, Vec7::Unit(0));
    EventMargin m = start(Way::parts, event);
    m.gradient = gradientOf(bars);
    m.what = "the contacts of " + name(event, k) + " are no longer simultaneous";
    margins_.push_back(std::move(m));
  }

  // Gradient of direction . P, P the impulse of `terms`, with the part along the normal taken off when it is
  // tangential: w.dP - P_n w.dn.
  Eigen::VectorXd impulseGradient(int event, const FrictionTerms<double>& terms, const Vec3& direction,
                                  const Vec3& normal_bar) {
    ImpactProblemDerivative bar(1);
    terms.pullback(direction, bar);
    EventBars bars(tape_, event);
    bars.addLaw(0, bar.K, bar.normal[0] + normal_bar, bar.pair[0]);
    bars.addVelocity(0, bar.u);
    return gradientOf(bars);
  }

  void slipping(int event) {
    const Event& e = eventAt(event);
    const Contact& c = e.contacts[0];
    const EventBars nothing(tape_, event);
    FrictionTerms<double> terms(ContactProblem{nothing.matrixAt(0), nothing.velocityAt(0), c.impulse_normal, c.pair});
    terms.stick();
    const Vec3 n = terms.n, P = terms.impulse();
    const double P_n = n.dot(P), mu = c.pair.friction;
    const Vec3 P_t = P - P_n * n, t1 = P_t.norm() > 0 ? P_t.normalized() : n.unitOrthogonal(), t2 = n.cross(t1);
    EventBars friction(tape_, event);
    friction.addLaw(0, Mat3::Zero(), Vec3::Zero(), {0, P_n, 0});
    const Eigen::VectorXd by_friction = gradientOf(friction);
    if (e.mode == ImpactMode::frictionless && by_friction.isZero(0)) return;  // it stays without
    const Eigen::VectorXd along_n = impulseGradient(event, terms, n, P),
                          along_1 = impulseGradient(event, terms, t1, -P_n * t1);
    const Eigen::VectorXd cone = mu * along_n + by_friction;

    const bool slides = branchOf(e.mode) == ImpactMode::slide;
    EventMargin m = start(slides ? Way::sticks : Way::slides, event);
    m.value = mu * P_n - P_t.norm();
    m.gradient = cone - along_1;
    m.what = name(event, 0) + (slides ? " sticks" : " starts to slide");
    if (e.mode == ImpactMode::stick) {
      const Eigen::VectorXd along_2 = impulseGradient(event, terms, t2, -P_n * t2);
      nearestDirection(mu * P_n, P_t.norm(), cone, along_1, along_2, m);
    }
    margins_.push_back(std::move(m));
  }

  // The cone is left through the direction w = cos t1 + sin t2 for which |mu P_n - w.P_t| / |gradient| is least.
  static void nearestDirection(double radius, double along, const Eigen::VectorXd& cone, const Eigen::VectorXd& by_1,
                               const Eigen::VectorXd& by_2, EventMargin& m) {
    const auto at = [&](double angle) {
      EventMargin one = m;
      const auto [sine, cosine] = elementary::sincos(angle);
      one.value = radius - cosine * along;
      one.gradient = cone - cosine * by_1 - sine * by_2;
      return one;
    };
    constexpr double kStep = 2 * std::numbers::pi / kDirections;
    double best = 0;
    for (int i = 1; i < kDirections; ++i)
      if (at(i * kStep).distance() < at(best).distance()) best = i * kStep;
    double low = best - kStep, high = best + kStep;
    for (int i = 0; i < kRefinements; ++i) {
      const double third = (high - low) / 3;
      if (at(low + third).distance() < at(high - third).distance()) {
        high -= third;
      } else {
        low += third;
      }
    }
    const EventMargin refined = at(0.5 * (low + high)), coarse = at(best);
    m = refined.distance() < coarse.distance() ? refined : coarse;
  }

  DerivativeTape& tape_;
  const Motion& motion_;
  const std::function<Eigen::VectorXd(const SceneGradient&)>& by_changes_;
  const BodyGeometry* bodies_;
  std::vector<Eigen::VectorXd> times_;  // of the events, on demand
  std::vector<EventMargin> margins_;
};

}  // namespace

double EventMargin::distance() const {
  // What is 0 already changes with the least influence; rounding is none.
  constexpr double kNoInfluence = 1e-12;
  const double slope = gradient.norm();
  return slope > kNoInfluence ? std::abs(value) / slope : std::numeric_limits<double>::infinity();
}

std::vector<EventMargin> eventMargins(DerivativeTape& tape, std::size_t count, const std::vector<ReadInstant>& instants,
                                      const std::function<Eigen::VectorXd(const SceneGradient&)>& byChanges) {
  MarginReader reader(tape, byChanges);
  const int all = static_cast<int>(tape.motion().events.size()), counted = std::min(all, static_cast<int>(count));
  for (int e = 0; e < counted; ++e) {
    reader.readEvent(e);
    reader.readOrder(e);
  }
  for (const ReadInstant& instant : instants)
    if (instant.rest >= 0) reader.readRest(instant);
  for (const ReadInstant& instant : instants)
    for (int e = 0; instant.rest < 0 && e < (instant.end ? counted : all); ++e) reader.readInstant(e, instant);
  return reader.take();
}

}  // namespace carom::editing_detail
