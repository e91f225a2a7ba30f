// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/derivative/seed.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/scene/farthest_from.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/least_in_time.hpp"
#include "editing/problem/rows/shape_clearance.hpp"

// The clearance is that of the point of the body which reaches farthest along a direction n: the normal of a face, or
// away from the centre of a sphere. As it is the least over all points, the way of that point along the shape does not
// count, nor does a turn of n:
//   d clearance = -(n.dx + (R p x n).theta + ds/dsize dsize),  s the reach of the shape, x its origin, p in its axes.

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

/// What may lie below the least clearance that is found, as a share of the sizes.
constexpr double kBelowInside = 1e-10;

/// The region's side of the matter: a face, or a sphere.
struct Border {
  bool sphere = false;
  Vec3 center = Vec3::Zero(), normal = Vec3::Zero();  ///< world; the normal of a face
  double reach = 0;  ///< m: of the face from the centre, or the radius, less the margin
};

Border borderOf(const BoundRegion& bound, int component) {
  Border border;
  border.center = bound.region.position;
  if (const auto* sphere = std::get_if<Sphere>(&bound.region.shape)) {
    border.sphere = true;
    border.reach = sphere->radius - bound.margin;
    return border;
  }
  const int k = component / 2;
  border.normal = (component % 2 == 0 ? 1 : -1) * (bound.region.orientation.normalized() * Vec3::Unit(k));
  border.reach = 0.5 * std::get<Box>(bound.region.shape).size[k] - bound.margin;
  return border;
}

/// Where the body reaches farthest, in one pose.
struct Outermost {
  FarthestPoint farthest;
  Vec3 x, n, p;  ///< the shape's origin and the direction, world; the point, in the axes of the shape
  Mat3 R;
  double distance = 0;   ///< m, from the centre of a sphere, or along n from that of a box
  bool defined = true;   ///< the direction is
  Vec3 arm() const { return R * p; }
};

Outermost outermostOf(const Shape& shape, const Border& border, const Vec3& x, const Mat3& R) {
  Outermost of;
  of.x = x, of.R = R, of.n = border.normal;
  if (border.sphere) {
    FarthestFrom far = farthestFrom(shape, R.transpose() * (border.center - x));
    of.defined = far.distance > far.farthest.ball;
    of.n = R * far.direction;
    of.distance = far.distance;
    of.farthest = std::move(far.farthest);
    of.p = of.farthest.point(far.direction);
  } else {
    const Vec3 n = R.transpose() * of.n;
    of.farthest = kindOf(shape).farthest(shape, n);
    of.p = of.farthest.point(n);
    of.distance = of.n.dot(x - border.center) + of.farthest.reach(n);
  }
  return of;
}

StateSeed seedOfOutermost(const Outermost& of) {
  const Vec3 n = of.R.transpose() * of.n;
  StateSeed seed;
  seed.position = -of.n;
  seed.orientation = -of.arm().cross(of.n);
  seed.size.resize(of.farthest.ball_rates.size());
  for (Eigen::Index d = 0; d < seed.size.size(); ++d) seed.size[d] = -of.farthest.sizeRate(n, d);
  return seed;
}

/// How the direction and the arm of the outermost point change with the state of the body and its dimensions.
struct OutermostRate {
  Vec3 n = Vec3::Zero();    ///< world
  Vec3 arm = Vec3::Zero();  ///< world
  Vec3 turned = Vec3::Zero();  ///< of n, in the axes of the shape
};

// Away from a centre, D n = y + p(n) with y the shape's origin seen from it, so that (D - dp/dn) dn = dy + dp/dsize dsize
// - n dD, and n.dn = 0.
OutermostRate rateOfOutermost(const Outermost& of, const Border& border, const BodyStateRate& rate) {
  const Vec3 n = of.R.transpose() * of.n;
  Vec3 by_size = Vec3::Zero();
  for (Eigen::Index d = 0; d < rate.size.size(); ++d) by_size += rate.size[d] * of.farthest.pointRate(n, d);
  const Mat3 bend = of.farthest.bend(n);
  OutermostRate out;
  if (border.sphere) {
    const Vec3 dy = of.R.transpose() * (rate.position - rate.orientation.cross(of.x - border.center)) + by_size;
    const Mat3 stiff = of.distance * Mat3::Identity() - bend;
    out.turned = stiff.ldlt().solve(dy - n * n.dot(dy));
    out.turned -= n * n.dot(out.turned);
    out.n = rate.orientation.cross(of.n) + of.R * out.turned;
  } else {
    out.turned = -(of.R.transpose() * rate.orientation.cross(of.n));
  }
  out.arm = rate.orientation.cross(of.arm()) + of.R * (bend * out.turned + by_size);
  return out;
}

StateSeed seedRateOfOutermost(const Outermost& of, const Border& border, const BodyStateRate& rate) {
  const OutermostRate d = rateOfOutermost(of, border, rate);
  const Vec3 n = of.R.transpose() * of.n;
  StateSeed seed;
  seed.position = -d.n;
  seed.orientation = -(d.arm.cross(of.n) + of.arm().cross(d.n));
  seed.size.resize(of.farthest.ball_rates.size());
  for (Eigen::Index k = 0; k < seed.size.size(); ++k) seed.size[k] = -of.farthest.pointRate(n, k).dot(d.turned);
  return seed;
}

/// The clearance falls at n.(v + w x a), a the arm of the outermost point from the centre of mass.
class StationaryTime {
 public:
  StationaryTime(const Motion& motion, int body, double time, Outermost of, const Border& border)
      : of_(std::move(of)), border_(border), now_(rateInTime(motion, body, time)) {
    arm_ = of_.x + of_.arm() - readPlace(motion, body, Instant::at(time)).state.x;
    velocity_ = now_.velocityOf(arm_);
    bend_ = fallOf(now_.rate);
  }

  double rateAlong(const BodyStateRate& d) const { return -fallOf(d) / bend_; }

 private:
  struct Now {
    BodyStateRate rate;
    explicit Now(BodyStateRate r) : rate(std::move(r)) {}
    Vec3 velocityOf(const Vec3& arm) const { return rate.center_of_mass + rate.orientation.cross(arm); }
  };
  double fallOf(const BodyStateRate& d) const {
    const OutermostRate r = rateOfOutermost(of_, border_, d);
    const Vec3 darm = d.position + r.arm - d.center_of_mass;
    return r.n.dot(velocity_) +
           of_.n.dot(d.velocity + d.angular_velocity.cross(arm_) + now_.rate.orientation.cross(darm));
  }

  Outermost of_;
  Border border_;
  Now now_;
  Vec3 arm_, velocity_;
  double bend_ = 0;
};

class InsideRow {
 public:
  InsideRow(const Motion& motion, int body, const BoundRegion& bound, int component)
      : motion_(motion),
        body_(body),
        bound_(bound),
        border_(borderOf(bound, component)),
        shape_(motion.scene->bodies[static_cast<std::size_t>(body)].shape),
        center_((*motion.models)[static_cast<std::size_t>(body)].center) {
    // a ball that spins about its own centre looks the same from all sides
    radius_ = std::holds_alternative<Sphere>(shape_) ? center_.norm() : farthestFrom(shape_, center_).distance;
  }

 private:
  Outermost outermost(const Kinematics& k) const { return outermostOf(shape_, border_, k.x - k.R * center_, k.R); }

  auto searchOf(const Arc& arc, double from, double to) const {
    const auto read = [this, &arc](double t) {
      const Kinematics k = arc.kinematicsAt(t);
      const Outermost of = outermost(k);
      const Vec3 arm = of.R * (of.p - center_);
      return ValueInTime{t, border_.reach - of.distance, -of.n.dot(k.v + k.w.cross(arm))};
    };
    const Vec3& g = arc.acceleration();
    const double pull = (border_.sphere ? g.norm() : std::abs(border_.normal.dot(g))) + arc.accelerationVariation();
    const double spin = arc.spinBound(), turning = (spin * spin + arc.spinRateBound()) * radius_;
    const double bend = pull + (radius_ > 0 ? turning : 0);
    const double size = std::abs(border_.reach) + radius_ + (arc.positionAt(from) - border_.center).norm();
    return LeastInTime(read, bend, kBelowInside * size, from, to);
  }

 public:
  ShapeClearance find() {
    const WorldLine& line = motion_.world_lines[static_cast<std::size_t>(body_)];
    Instant at;
    ShapeClearance out;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < line.arcs.size(); ++k) {
      const bool last = k + 1 == line.arcs.size();
      const double start = line.arcs[k].start(), end = last ? motion_.end : line.arcs[k + 1].start();
      if (end < bound_.from || start > bound_.to) continue;
      const double from = std::max(bound_.from, start), to = std::min(bound_.to, end);
      auto search = searchOf(line.arcs[k], from, to);
      const ValueInTime found = search.find();
      out.below = std::max(out.below, search.slack());
      if (!(found.value < least)) continue;
      // the start of a later arc is the end of the one before
      if (found.time == from && from > bound_.from && std::isfinite(least)) continue;
      least = found.value;
      out.time = found.time;
      out.keeps = found.time > from && found.time < to ? Clearance::Keeps::least : Clearance::Keeps::place;
      const bool at_event = !last && found.time == to && to == end && end < bound_.to;
      at = at_event ? Instant::before(line.events[k]) : Instant::at(found.time);
    }
    read(at, out);
    return out;
  }

 private:
  void read(const Instant& at, ShapeClearance& out) const {
    const Kinematics k = motion_.world_lines[static_cast<std::size_t>(body_)].arcs[0].kinematicsOf(
        readPlace(motion_, body_, at).state);
    const Outermost of = outermost(k);
    RowReading& reading = out.reading;
    reading.value = border_.reach - of.distance;
    reading.second_order = true;
    const std::string name = "'" + motion_.scene->bodies[static_cast<std::size_t>(body_)].name + "'";
    const std::string when = " at t = " + number(out.time) + " s";
    if (!of.defined) {
      reading.doubt = name + " is at the centre of the sphere that it stays inside" + when +
                      ", where its clearance has no derivative";
      out.keeps = Clearance::Keeps::place;
      return;
    }
    const double size = kindOf(shape_).boundingRadius(shape_);
    if (!(of.farthest.margin > kReliableMargin * size))
      reading.doubt = "several points of " + name + " are equally near to the boundary of a region" + when +
                      ": the derivative of its clearance is one-sided, that of one of them";
    StateSeed seed = seedOfOutermost(of);
    seed.body = body_;
    seed.at = at;
    reading.seeds = {std::move(seed)};
    reading.seed_rates = [of, border = border_](std::span<const BodyStateRate> rates) {
      return std::vector<StateSeed>{seedRateOfOutermost(of, border, rates[0])};
    };
    if (out.keeps != Clearance::Keeps::least) return;
    out.time_rate = [time = StationaryTime(motion_, body_, out.time, of, border_), body = body_, at](
                        DerivativeTape& tape, std::span<const ReadingDirection> controls) {
      Eigen::VectorXd r(static_cast<Eigen::Index>(controls.size()));
      for (std::size_t j = 0; j < controls.size(); ++j)
        r[static_cast<Eigen::Index>(j)] = time.rateAlong(tangent(tape, controls[j].scene).at(body, at));
      return r;
    };
  }

  const Motion& motion_;
  int body_;
  const BoundRegion& bound_;
  Border border_;
  const Shape& shape_;
  Vec3 center_;
  double radius_ = 0;
};

}  // namespace

BodyStateRate rateInTime(const Motion& motion, int body, double time) {
  const ReadPlace place = readPlace(motion, body, Instant::at(time));
  const auto b = static_cast<std::size_t>(body);
  const BodyModel& model = (*motion.models)[b];
  const StateDerivative rate =
      motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(time, place.state);
  BodyStateRate out;
  out.center_of_mass = rate.x, out.orientation = rate.theta, out.velocity = rate.v;
  out.angular_velocity = angularVelocityTangent(model, place.state, rate, BodyModelDerivative{});
  out.position = originTangent(model, place.state, rate, BodyModelDerivative{});
  return out;
}

std::optional<ShapeClearance> clearanceInside(const Motion& motion, int body, const BoundRegion& region,
                                              int component) {
  if (!(motion.end >= region.to)) return std::nullopt;
  return InsideRow(motion, body, region, component).find();
}

}  // namespace carom::editing_detail
