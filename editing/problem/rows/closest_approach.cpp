// SPDX-License-Identifier: MIT
#include "editing/problem/rows/closest_approach.hpp"

#include <algorithm>
#include <array>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::editing_detail {
namespace {

struct Poses {
  Pose a, b;
};

Pose poseAt(const Motion& motion, int body, const Instant& at) {
  return shapePose(motion, body, readPlace(motion, body, at).state);
}
Poses posesOf(const Motion& motion, const DistanceReading& d) {
  return {poseAt(motion, d.a, d.at), poseAt(motion, d.b, d.at)};
}

ContactJacobian jacobianOf(const Motion& motion, const DistanceReading& d) {
  const Poses p = posesOf(motion, d);
  return motion.geometry->jacobian(d.a, d.b, d.nearest.features, p.a, p.b);
}

StateSeed seedOf(int body, const Instant& at, const Eigen::Matrix<double, 1, 6>& by_pose) {
  StateSeed seed;
  seed.body = body;
  seed.at = at;
  seed.center_of_mass = by_pose.head<3>().transpose();
  seed.orientation = by_pose.tail<3>().transpose();
  return seed;
}

using PoseRate = Eigen::Matrix<double, 12, 1>;

// Of a pose and its time derivative, for one body.
struct BodyRates {
  Eigen::Matrix<double, 6, 1> pose, velocity;
};

PoseRate both(const Eigen::Matrix<double, 6, 1>& a, const Eigen::Matrix<double, 6, 1>& b) {
  PoseRate rate;
  rate << a, b;
  return rate;
}

Eigen::Matrix<double, 6, 1> sixOf(const Vec3& x, const Vec3& theta) {
  Eigen::Matrix<double, 6, 1> six;
  six << x, theta;
  return six;
}

// Along the motion itself.
BodyRates inTime(const Motion& motion, int body, double time) {
  const ReadPlace place = readPlace(motion, body, Instant::at(time));
  const auto b = static_cast<std::size_t>(body);
  const BodyModel& model = (*motion.models)[b];
  const StateDerivative rate = motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(time, place.state);
  return {sixOf(rate.x, rate.theta),
          sixOf(rate.v, angularVelocityTangent(model, place.state, rate, BodyModelDerivative{}))};
}

BodyRates alongControl(const BodyStateRate& d) {
  return {sixOf(d.center_of_mass, d.orientation), sixOf(d.velocity, d.angular_velocity)};
}

}  // namespace

const BodyDistance& distancesOf(const Motion& motion) {
  const auto* distances = dynamic_cast<const BodyDistance*>(motion.geometry.get());
  if (!distances)
    throw InputError("the source of contacts does not know how far bodies are from each other, expected one that does");
  return *distances;
}

std::vector<StateSeed> DistanceReading::seeds(const Motion& motion) const {
  ContactJacobian J;
  if (nearest.apart()) J = jacobianOf(motion, *this);
  return {seedOf(a, at, J.pose.row(0).head<6>()), seedOf(b, at, J.pose.row(0).tail<6>())};
}

Eigen::VectorXd DistanceReading::bySize(const Motion& motion, bool second) const {
  if (!nearest.apart()) return {};
  const ContactJacobian J = jacobianOf(motion, *this);
  return (second ? J.size_b : J.size_a).row(0).transpose();
}

std::vector<StateSeed> DistanceReading::seedRates(const Motion& motion, const BodyStateRate& da,
                                                  const BodyStateRate& db) const {
  ContactJacobian J;
  if (nearest.apart()) {
    const Poses p = posesOf(motion, *this);
    const std::array<PairTangent, 1> direction{{{both(alongControl(da).pose, alongControl(db).pose), {}, {}}}};
    J = motion.geometry->jacobianRates(a, b, nearest.features, p.a, p.b, direction)[0];
  }
  return {seedOf(a, at, J.pose.row(0).head<6>()), seedOf(b, at, J.pose.row(0).tail<6>())};
}

DistanceReading readDistance(const Motion& motion, int a, int b, const Instant& at) {
  DistanceReading d{a, b, at, at.event >= 0 ? motion.events[static_cast<std::size_t>(at.event)].time : at.time, {}};
  const Poses p = posesOf(motion, d);
  d.nearest = distancesOf(motion).nearest(a, b, p.a, p.b);
  return d;
}

// g_t = J (velocities), so that along a direction  dg_t = dJ (velocities) + J d(velocities), and g_tt is that along the
// motion itself.
Eigen::VectorXd ClosestApproach::timeRate(DerivativeTape& tape, std::span<const ReadingDirection> controls) const {
  if (keeps == Clearance::Keeps::place) return {};
  const Motion& motion = tape.motion();
  const Poses p = posesOf(motion, *this);
  const BodyRates a_in_time = inTime(motion, a, time), b_in_time = inTime(motion, b, time);
  const PoseRate velocities = both(a_in_time.pose, b_in_time.pose);
  std::vector<PairTangent> directions{{velocities, {}, {}}};
  std::vector<PoseRate> accelerations{both(a_in_time.velocity, b_in_time.velocity)};
  for (const ReadingDirection& control : controls) {
    const MotionTangent moved = tangent(tape, control.scene);
    const BodyRates da = alongControl(moved.at(a, at)), db = alongControl(moved.at(b, at));
    directions.push_back({both(da.pose, db.pose), {}, {}});
    accelerations.push_back(both(da.velocity, db.velocity));
  }
  const ContactJacobian J = motion.geometry->jacobian(a, b, nearest.features, p.a, p.b);
  const auto rates = motion.geometry->jacobianRates(a, b, nearest.features, p.a, p.b, directions);
  const auto rateOf = [&](std::size_t k) {
    return rates[k].pose.row(0).dot(velocities) + J.pose.row(0).dot(accelerations[k]);
  };
  Eigen::VectorXd r(static_cast<Eigen::Index>(controls.size()));
  for (std::size_t j = 0; j < controls.size(); ++j) r[static_cast<Eigen::Index>(j)] = -rateOf(j + 1) / rateOf(0);
  return r;
}

namespace {

// The events at which one of two bodies goes over to its next arc within a span, in order of time.
std::vector<int> eventsWithin(const Motion& motion, int a, int b, double from, double to) {
  std::vector<int> events;
  for (const int body : {a, b})
    for (const int e : motion.world_lines[static_cast<std::size_t>(body)].events) {
      const double t = motion.events[static_cast<std::size_t>(e)].time;
      if (t > from && t < to) events.push_back(e);
    }
  std::sort(events.begin(), events.end());
  events.erase(std::unique(events.begin(), events.end()), events.end());
  return events;
}

const Arc& arcFrom(const Motion& motion, int body, double time) {
  return motion.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(motion.arcAt(body, time))];
}

// Of the two bodies with each other.
std::optional<int> meetingWithin(const Motion& motion, int a, int b, double from, double to) {
  for (const int e : motion.world_lines[static_cast<std::size_t>(a)].events) {
    const Event& event = motion.events[static_cast<std::size_t>(e)];
    if (event.time >= from && event.time <= to && event.touches(a, b)) return e;
  }
  return std::nullopt;
}

ClosestApproach touchAt(int a, int b, const Instant& at, double time) {
  ClosestApproach touch;
  touch.a = a, touch.b = b, touch.at = at, touch.time = time;
  touch.nearest.gap = 0;
  return touch;
}

}  // namespace

std::optional<ClosestApproach> closestApproach(const Motion& motion, int a, int b, double from, double to) {
  if (!(motion.end >= to)) return std::nullopt;
  const BodyDistance& distances = distancesOf(motion);
  for (const auto& [body, other] : {std::pair{a, b}, std::pair{b, a}})
    if (const auto e = meetingWithin(motion, body, other, from, to))
      return touchAt(a, b, Instant::before(*e), motion.events[static_cast<std::size_t>(*e)].time);
  std::vector<int> events = eventsWithin(motion, a, b, from, to);
  std::optional<ClosestApproach> best;
  double start = from;
  for (std::size_t k = 0; k <= events.size(); ++k) {
    const bool last = k == events.size();
    const double end = last ? to : motion.events[static_cast<std::size_t>(events[k])].time;
    const double under = best ? best->value() : std::numeric_limits<double>::infinity();
    const auto found = distances.nearestInTime(a, b, arcFrom(motion, a, start), arcFrom(motion, b, start), start, end, under);
    // the start of a later stretch is the end of the one before
    if (found && !(k > 0 && found->time == start)) {
      best = touchAt(a, b, Instant::at(found->time), found->time);
      best->nearest = found->nearest;
      best->below = found->below;
      if (found->time > start && found->time < end) best->keeps = Clearance::Keeps::least;
      if (!last && found->time == end) best->at = Instant::before(events[k]);
      if (!found->nearest.apart()) break;
    } else if (found && best) {
      best->below = std::max(best->below, found->below + best->value() - found->nearest.gap);
    }
    start = end;
  }
  if (best && !best->nearest.apart()) best->keeps = Clearance::Keeps::place;
  return best;
}

}  // namespace carom::editing_detail
