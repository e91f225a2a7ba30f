// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "adjoint/derivative/seed.hpp"
#include "adjoint/motion/guard.hpp"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/problem/rows/shape_clearance.hpp"

// The region is a second body, which stands still. Where the least separation is that of one pair of features, its
// derivative is theirs. Where, inside of each other, one pair ceases to rule and another begins to, both have the value
// at a time that moves so that they stay equal: the derivative is their mean that is stationary in time.

namespace carom::editing_detail {

namespace {

Body standingRegion(const Region& region) {
  Body body;
  body.name = "region";
  body.fixed = true;
  body.shape = std::visit([](const auto& shape) { return Shape(shape); }, region.shape);
  body.position = region.position;
  body.orientation = region.orientation.normalized();
  return body;
}

/// A pair of features and its share in the derivative.
struct RulingPair {
  FeaturePair features;
  double share = 1;
};

/// The separation in one pose of the body.
struct RegionSeparation {
  std::shared_ptr<const ContactGeometry> geometry;  ///< of the body and the region
  Pose pose, region;
  std::vector<RulingPair> parts;  ///< one or two

  ContactJacobian jacobian(const RulingPair& part) const { return geometry->jacobian(0, 1, part.features, pose, region); }
  ContactJacobian jacobianRate(const RulingPair& part, const BodyStateRate& d) const {
    PairTangent tangent;
    tangent.pose << d.center_of_mass, d.orientation, Vec3::Zero(), Vec3::Zero();
    tangent.size_a = d.size;
    return geometry->jacobianRates(0, 1, part.features, pose, region, std::span(&tangent, 1))[0];
  }
};

void addPair(StateSeed& seed, const ContactJacobian& J, double share) {
  seed.center_of_mass += share * J.pose.row(0).head<3>().transpose();
  seed.orientation += share * J.pose.row(0).segment<3>(3).transpose();
  if (seed.size.size() == 0) seed.size.setZero(J.size_a.cols());
  seed.size += share * J.size_a.row(0).transpose();
}

/// Velocity and acceleration of the pose of a body along its motion, and how they change with the controls.
struct PoseMotion {
  Eigen::Matrix<double, 6, 1> velocity, acceleration;
};

PoseMotion poseMotionOf(const BodyStateRate& d) {
  PoseMotion m;
  m.velocity << d.center_of_mass, d.orientation;
  m.acceleration << d.velocity, d.angular_velocity;
  return m;
}

/// Of one pair of features g_t = 0, so that t_j = -g_tj / g_tt; of two g = h, so that t_j = -(g_j - h_j) / (g_t - h_t).
class TimeOfLeast {
 public:
  TimeOfLeast(RegionSeparation separation, BodyStateRate now) : separation_(std::move(separation)), now_(std::move(now)) {
    bend_ = rateAlong(now_);
  }
  double along(const BodyStateRate& d) const { return -rateAlong(d) / bend_; }

 private:
  double rateAlong(const BodyStateRate& d) const {
    const std::vector<RulingPair>& parts = separation_.parts;
    if (parts.size() == 2) return valueRate(parts[0], d) - valueRate(parts[1], d);
    const ContactJacobian J = separation_.jacobian(parts[0]), dJ = separation_.jacobianRate(parts[0], d);
    const PoseMotion now = poseMotionOf(now_), moved = poseMotionOf(d);
    return dJ.pose.row(0).head<6>().dot(now.velocity) + J.pose.row(0).head<6>().dot(moved.acceleration);
  }
  double valueRate(const RulingPair& part, const BodyStateRate& d) const {
    const ContactJacobian J = separation_.jacobian(part);
    double rate = J.pose.row(0).head<6>().dot(poseMotionOf(d).velocity);
    if (d.size.size() > 0) rate += J.size_a.row(0).dot(d.size);
    return rate;
  }

  RegionSeparation separation_;
  BodyStateRate now_;
  double bend_ = 0;
};

class OutsideRow {
 public:
  OutsideRow(const Motion& motion, int body, const BoundRegion& bound)
      : motion_(motion),
        body_(body),
        bound_(bound),
        region_(standingRegion(bound.region)),
        region_model_(modelOf(region_)),
        still_(region_model_, Tier::none, Vec3::Zero(), 0, startState(region_, region_model_)),
        geometry_(distancesOf(motion).ofTwo(motion.scene->bodies[static_cast<std::size_t>(body)], region_)) {}

  ShapeClearance find() {
    const auto& distances = dynamic_cast<const BodyDistance&>(*geometry_);
    const WorldLine& line = motion_.world_lines[static_cast<std::size_t>(body_)];
    std::optional<NearestInTime> best;
    Instant at;
    ShapeClearance out;
    for (std::size_t k = 0; k < line.arcs.size(); ++k) {
      const bool last = k + 1 == line.arcs.size();
      const double start = line.arcs[k].start(), end = last ? motion_.end : line.arcs[k + 1].start();
      if (end < bound_.from || start > bound_.to) continue;
      const double from = std::max(bound_.from, start), to = std::min(bound_.to, end);
      const double under = best ? best->nearest.gap : std::numeric_limits<double>::infinity();
      const auto found = distances.leastSeparation(0, 1, line.arcs[k], still_, from, to, under);
      // the start of a later arc is the end of the one before
      if (!found || (best && found->time == from && from > bound_.from)) continue;
      best = found;
      const bool at_event = !last && found->time == to && to == end && end < bound_.to;
      at = at_event ? Instant::before(line.events[k]) : Instant::at(found->time);
      const bool within = found->time > from && found->time < to;
      out.keeps = found->other ? Clearance::Keeps::two_faces
                  : within     ? Clearance::Keeps::least
                               : Clearance::Keeps::place;
    }
    out.time = best->time;
    out.below = best->below;
    read(*best, at, out);
    return out;
  }

 private:
  std::string name() const { return "'" + motion_.scene->bodies[static_cast<std::size_t>(body_)].name + "'"; }

  void read(const NearestInTime& found, const Instant& at, ShapeClearance& out) const {
    RowReading& reading = out.reading;
    reading.value = found.nearest.gap - bound_.margin;
    reading.second_order = true;
    const std::string when = " at t = " + number(out.time) + " s";
    if (!found.nearest.apart()) {
      reading.doubt = name() + " is so deep inside a region to avoid" + when +
                      " that no way out is the shortest, and its clearance has no derivative";
      out.keeps = Clearance::Keeps::place;
      return;
    }
    if (found.nearest.several)
      reading.doubt = name() + " is equally near to a region to avoid at several points" + when +
                      ", where the derivative of its clearance is one-sided";
    RegionSeparation separation{geometry_, shapePose(motion_, body_, readPlace(motion_, body_, at).state),
                          {region_.position, region_.orientation.toRotationMatrix()},
                          partsOf(found)};
    StateSeed seed;
    seed.body = body_;
    seed.at = at;
    for (const RulingPair& part : separation.parts) addPair(seed, separation.jacobian(part), part.share);
    reading.seeds = {std::move(seed)};
    reading.seed_rates = [separation](std::span<const BodyStateRate> rates) {
      StateSeed rate;
      for (const RulingPair& part : separation.parts) addPair(rate, separation.jacobianRate(part, rates[0]), part.share);
      return std::vector<StateSeed>{std::move(rate)};
    };
    if (out.keeps == Clearance::Keeps::place) return;
    out.time_rate = [time = TimeOfLeast(separation, rateInTime(motion_, body_, out.time)), body = body_, at](
                        DerivativeTape& tape, std::span<const ReadingDirection> controls) {
      Eigen::VectorXd r(static_cast<Eigen::Index>(controls.size()));
      for (std::size_t j = 0; j < controls.size(); ++j)
        r[static_cast<Eigen::Index>(j)] = time.along(tangent(tape, controls[j].scene).at(body, at));
      return r;
    };
  }

  static std::vector<RulingPair> partsOf(const NearestInTime& found) {
    if (!found.other) return {{found.nearest.features, 1}};
    const double share = found.other_rate / (found.other_rate - found.rate);
    return {{found.nearest.features, share}, {found.other->features, 1 - share}};
  }

  const Motion& motion_;
  int body_;
  const BoundRegion& bound_;
  Body region_;
  BodyModel region_model_;
  Arc still_;  // of the region
  std::shared_ptr<const ContactGeometry> geometry_;
};

}  // namespace

std::optional<ShapeClearance> clearanceOutside(const Motion& motion, int body, const BoundRegion& region) {
  if (!(motion.end >= region.to)) return std::nullopt;
  return OutsideRow(motion, body, region).find();
}

}  // namespace carom::editing_detail
