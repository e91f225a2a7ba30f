// SPDX-License-Identifier: MIT
#include "bench/charts/frozen_flights.h"

#include <cmath>

#include "adjoint/impact/impact.hpp"

namespace carom::charts {

using namespace adjoint_detail;

namespace {

struct Flight {
  double start = 0;
  State state;
};

class Player {
 public:
  Player(const Motion& like, const FlightModel& model, double step) : like_(like), model_(model), step_(step) {
    for (const WorldLine& line : like.world_lines) flights_.push_back({0, line.arcs.front().startState()});
  }

  void impact(const Event& written) {
    Event event = written;
    const int a = event.contacts[0].a, b = event.contacts[0].b;
    // Newton's method: the rotation is carried once to near the impact, then over the small changes of time
    double t = event.time;
    State A = stateAt(a, t), B = stateAt(b, t);
    for (int i = 0; i < 4; ++i) {
      event.contacts[0].at = like_.geometry->contact(a, b, event.contacts[0].features, poseOf(a, A), poseOf(b, B));
      const ContactPoint& at = event.contacts[0].at;
      const double change = -at.gap / at.normal.dot(velocityAt(a, A, at.point) - velocityAt(b, B, at.point));
      if (std::abs(change) < 1e-15) break;
      t += change;
      A = advanced(a, A, change), B = advanced(b, B, change);
    }
    event.time = t;
    event.contacts[0].impulse_normal = event.contacts[0].at.normal;
    for (Participant& p : event.participants) p.before = p.body == a ? A : B;
    std::vector<State> after;
    solveImpact(event, *like_.models, after);
    for (std::size_t i = 0; i < after.size(); ++i)
      flights_[static_cast<std::size_t>(event.participants[i].body)] = {t, after[i]};
  }

  States end(double t) const {
    States states;
    for (std::size_t i = 0; i < flights_.size(); ++i)
      states.push_back(toBodyState((*like_.models)[i], stateAt(static_cast<int>(i), t)));
    return states;
  }

 private:
  const BodyModel& modelOf(int body) const { return (*like_.models)[static_cast<std::size_t>(body)]; }

  State advanced(int body, State s, double t) const {
    const BodyModel& m = modelOf(body);
    if (!m.moving) return s;
    const Vec3& g = like_.scene->gravity;
    s.x += t * s.v + 0.5 * t * t * g;
    s.v += t * g;
    s.q = model_.rotate(m.inverse_inertia, s.q, s.L, t, step_);
    return s;
  }
  State stateAt(int body, double t) const {
    const Flight& f = flights_[static_cast<std::size_t>(body)];
    return advanced(body, f.state, t - f.start);
  }
  Pose poseOf(int body, const State& s) const { return {s.x, modelOf(body).shapeToWorld(s.q.toRotationMatrix())}; }
  Vec3 velocityAt(int body, const State& s, const Vec3& point) const {
    const BodyModel& m = modelOf(body);
    if (!m.moving) return Vec3::Zero();
    const Vec3 w = s.q * m.inverse_inertia.cwiseProduct(s.q.conjugate() * s.L);
    return s.v + w.cross(point - s.x);
  }

  const Motion& like_;
  const FlightModel& model_;
  double step_;
  std::vector<Flight> flights_;
};

}  // namespace

States endByModel(const Motion& like, const FlightModel& model, double step) {
  Player player(like, model, step);
  for (const Event& event : like.events) player.impact(event);
  return player.end(like.end);
}

}  // namespace carom::charts
