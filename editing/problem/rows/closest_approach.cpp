// SPDX-License-Identifier: MIT
#include "editing/problem/rows/closest_approach.hpp"

#include <algorithm>
#include <array>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/seed.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/instants.hpp"
#include "editing/problem/rows/pose_seeds.hpp"

namespace carom::editing_detail {
namespace {

DistanceReading placeAt(const Motion& motion, int a, int b, const Instant& at) {
  DistanceReading d;
  d.a = a, d.b = b, d.at = at;
  d.time = timeOf(motion, at);
  d.geometry = motion.geometry;
  d.pose_a = shapePoseAt(motion, a, at), d.pose_b = shapePoseAt(motion, b, at);
  return d;
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
  const Arc& arc = motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)];
  const StateDerivative rate = arc.rateAt(time, place.state);
  return {sixOf(rate.x, rate.theta),
          sixOf(rate.v, angularVelocityTangent(model, place.state, rate, BodyModelDerivative{}))};
}

BodyRates alongControl(const BodyStateRate& d) {
  return {sixOf(d.center_of_mass, d.orientation), sixOf(d.velocity, d.angular_velocity)};
}

ContactJacobian nothing() {
  ContactJacobian J;
  J.size_a.setZero(7, 0), J.size_b.setZero(7, 0);
  return J;
}

std::vector<StateSeed> seedPair(const DistanceReading& d, const ContactJacobian& J) {
  return seedsOfPair(J, 0, d.a, d.b, d.at);
}

}  // namespace

const BodyDistance& distancesOf(const Motion& motion) {
  const auto* distances = dynamic_cast<const BodyDistance*>(motion.geometry.get());
  if (!distances)
    throw InputError("the contact source has no distances between bodies, expected one that has");
  return *distances;
}

std::vector<StateSeed> DistanceReading::seeds() const {
  if (!nearest.apart()) return seedPair(*this, nothing());
  return seedPair(*this, geometry->jacobian(a, b, nearest.features, pose_a, pose_b));
}

std::vector<StateSeed> DistanceReading::seedRates(const BodyStateRate& da, const BodyStateRate& db) const {
  if (!nearest.apart()) return seedPair(*this, nothing());
  const std::array<PairTangent, 1> direction{tangentOfPair(da, db)};
  return seedPair(*this, geometry->jacobianRates(a, b, nearest.features, pose_a, pose_b, direction)[0]);
}

DistanceReading readDistance(const Motion& motion, int a, int b, const Instant& at) {
  DistanceReading d = placeAt(motion, a, b, at);
  d.nearest = distancesOf(motion).nearest(a, b, d.pose_a, d.pose_b);
  return d;
}

// g_t = J (velocities), so that along a direction  dg_t = dJ (velocities) + J d(velocities), and g_tt is that along the
// motion itself.
Eigen::VectorXd ClosestApproach::timeRate(DerivativeTape& tape, std::span<const ReadingDirection> controls) const {
  if (keeps == Clearance::Keeps::place) return {};
  const Motion& motion = tape.motion();
  const BodyRates a_in_time = inTime(motion, a, time), b_in_time = inTime(motion, b, time);
  const PoseRate velocities = both(a_in_time.pose, b_in_time.pose);
  std::vector<PairTangent> directions{{velocities, {}, {}}};
  std::vector<PoseRate> accelerations{both(a_in_time.velocity, b_in_time.velocity)};
  for (const ReadingDirection& control : controls) {
    const MotionTangent moved = tangent(tape, control.scene);
    const BodyStateRate da = moved.at(a, at), db = moved.at(b, at);
    directions.push_back(tangentOfPair(da, db));
    accelerations.push_back(both(alongControl(da).velocity, alongControl(db).velocity));
  }
  const ContactJacobian J = geometry->jacobian(a, b, nearest.features, pose_a, pose_b);
  const auto rates = geometry->jacobianRates(a, b, nearest.features, pose_a, pose_b, directions);
  const auto rateOf = [&](std::size_t k) {
    return rates[k].pose.row(0).dot(velocities) + J.pose.row(0).dot(accelerations[k]);
  };
  Eigen::VectorXd r(static_cast<Eigen::Index>(controls.size()));
  for (std::size_t j = 0; j < controls.size(); ++j) r[static_cast<Eigen::Index>(j)] = -rateOf(j + 1) / rateOf(0);
  return r;
}

double lengthOfSmaller(const Scene& scene, int a, int b) {
  double length = kInfinity;
  for (const int body : {a, b}) {
    const Shape& shape = scene.bodies[static_cast<std::size_t>(body)].shape;
    const double radius = kindOf(shape).boundingRadius(shape);
    if (radius > 0) length = std::min(length, radius);
  }
  return std::isfinite(length) ? length : 1;
}

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

namespace {

// Of the two bodies with each other.
std::optional<int> meetingWithin(const Motion& motion, int a, int b, double from, double to) {
  for (const int e : motion.world_lines[static_cast<std::size_t>(a)].events) {
    const Event& event = motion.events[static_cast<std::size_t>(e)];
    if (event.time >= from && event.time <= to && event.touches(a, b)) return e;
  }
  return std::nullopt;
}

ClosestApproach approachAt(const Motion& motion, int a, int b, const Instant& at, const Nearest& nearest) {
  ClosestApproach approach;
  static_cast<DistanceReading&>(approach) = placeAt(motion, a, b, at);
  approach.nearest = nearest;
  return approach;
}

Nearest touching() {
  Nearest touch;
  touch.gap = 0;
  return touch;
}

}  // namespace

std::optional<ClosestApproach> closestApproach(const Motion& motion, int a, int b, double from, double to) {
  if (!(motion.end >= to)) return std::nullopt;
  const BodyDistance& distances = distancesOf(motion);
  for (const auto& [body, other] : {std::pair{a, b}, std::pair{b, a}})
    if (const auto e = meetingWithin(motion, body, other, from, to))
      return approachAt(motion, a, b, Instant::before(*e), touching());
  std::vector<int> events = eventsWithin(motion, a, b, from, to);
  std::optional<ClosestApproach> best;
  double start = from;
  for (std::size_t k = 0; k <= events.size(); ++k) {
    const bool last = k == events.size();
    const double end = last ? to : motion.events[static_cast<std::size_t>(events[k])].time;
    const double under = best ? best->value() : std::numeric_limits<double>::infinity();
    const auto found =
        distances.nearestInTime(a, b, arcFrom(motion, a, start), arcFrom(motion, b, start), start, end, under);
    // the start of a later stretch is the end of the one before
    if (found && !(k > 0 && found->time == start)) {
      const bool at_event = !last && found->time == end;
      best = approachAt(motion, a, b, at_event ? Instant::before(events[k]) : Instant::at(found->time), found->nearest);
      best->below = found->below;
      if (found->time > start && found->time < end) best->keeps = Clearance::Keeps::least;
      if (!found->nearest.apart()) break;
    } else if (found && best) {
      best->below = std::max(best->below, found->below + best->value() - found->nearest.gap);
    }
    start = end;
  }
  if (best && !best->nearest.apart()) best->keeps = Clearance::Keeps::place;
  return best;
}

namespace {

std::string namesIn(const QuantityPlace& place) {
  const std::vector<Body>& bodies = place.motion.scene->bodies;
  const auto name = [&](int body) { return "'" + bodies[static_cast<std::size_t>(body)].name + "'"; };
  return name(place.body) + " and " + name(place.to);
}

RowReading rowOf(const DistanceReading& reading, const QuantityPlace& place) {
  RowReading out;
  out.value = reading.value();
  out.seeds = reading.seeds();
  out.second_order = true;
  out.seed_rates = [reading](std::span<const BodyStateRate> rates) { return reading.seedRates(rates[0], rates[1]); };
  const std::string when = " at t = " + number(reading.time) + " s";
  if (!reading.nearest.apart()) {
    out.doubt = namesIn(place) + " touch" + when + ", and their distance stays 0 as long as they do";
  } else if (reading.nearest.several) {
    out.doubt = namesIn(place) + " are nearest to each other in several places" + when +
                ", where the derivative of their distance is one-sided";
  }
  return out;
}

}  // namespace

RowReading readDistanceRow(const QuantityPlace& place) {
  return rowOf(readDistance(place.motion, place.body, place.to, place.at), place);
}

RowReading readClosestApproachRow(const QuantityPlace& place) {
  if (const auto closest = closestApproach(place.motion, place.body, place.to, place.from, place.until))
    return rowOf(*closest, place);
  RowReading out;
  out.missing = "The motion ends at " + number(place.motion.end) + " s, before " + number(place.until) +
                " s, up to which the closest approach of " + namesIn(place) + " counts. " + place.motion.message;
  return out;
}

}  // namespace carom::editing_detail
