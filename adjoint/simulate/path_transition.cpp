// SPDX-License-Identifier: MIT
#include "adjoint/simulate/path_transition.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/flat_disc.hpp"
#include "adjoint/simulate/support_polygon.hpp"

namespace carom::adjoint_detail {
namespace {

// From the middle of a disc, where no direction leads to its border, so far, as a share of the arm of the contact.
constexpr double kFromMiddle = 1e-6;
// No path is longer, s: no motion is.
constexpr double kLongest = 1e9;

class Search {
 public:
  Search(const Motion& motion, const ContactChoice& choice, double until)
      : motion_(motion), choice_(choice), path_(*choice.path), found_{until, TransitionCause::none, -1, -1} {}

  std::optional<double> leaves(int contact, int limit) {
    if (const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get())) leave(*bodies, contact, limit);
    if (found_.cause == TransitionCause::none) return std::nullopt;
    return found_.elapsed;
  }

  PathTransition run() {
    if (path_.form == PathForm::rest) return {};
    if (path_.slip_end <= found_.elapsed) take(path_.slip_end, TransitionCause::slip_ends, -1, -1);
    const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
    for (std::size_t k = 0; bodies && k < choice_.contacts.size(); ++k) leave(*bodies, static_cast<int>(k));
    if (path_.form == PathForm::glide_block) tip();
    if (found_.cause == TransitionCause::none) return {};
    return found_;
  }

 private:
  void take(double elapsed, TransitionCause cause, int contact, int limit) { found_ = {elapsed, cause, contact, limit}; }

  Pose poseOf(int body, const State& s) const { return shapePose(motion_, body, s); }
  const State& stateOf(int body) const {
    return body == path_.body ? choice_.start : motion_.world_lines[asIndex(body)].arcs.back().startState();
  }

  // How the point of a contact moves with the centre of mass, at the start or some time after it.
  Mat3 pointBy(const Contact& c, double elapsed = 0) const {
    const Pose A = poseAfter(c.a, elapsed), B = poseAfter(c.b, elapsed);
    const ContactJacobian J = motion_.geometry->jacobian(c.a, c.b, c.features, A, B);
    return J.pose.block<3, 3>(4, c.a == path_.body ? 0 : 6);
  }
  Pose poseAfter(int body, double elapsed) const {
    return poseOf(body, body == path_.body && elapsed > 0 ? path_.stateAt(choice_.start, path_.start + elapsed) : stateOf(body));
  }

  // Where a rim crosses an edge the point moves as the root of what the centre does.
  bool movesAlike(const Contact& c, const Mat3& by) const {
    const double speed = choice_.start.v.norm();
    if (path_.form != PathForm::glide_block || !(speed > 0)) return true;
    const Mat3 later = pointBy(c, std::min(found_.elapsed, 1e-3 * (c.at.point - choice_.start.x).norm() / speed));
    return (later - by).norm() <= 1e-9 * by.norm();
  }

  // From tangent to tangent, which come from above where the point slows down along its edge; halved where they pass by.
  void leaveCrossing(const BodyGeometry& bodies, int k, std::size_t i) {
    const Contact& c = *choice_.contacts[asIndex(k)];
    const auto look = [&](double t, double& rate) {
      const Pose A = poseAfter(c.a, t), B = poseAfter(c.b, t);
      const FeatureLimit limit = bodies.limits(c.a, c.b, c.features, A, B)[i];
      const Pose& pose = limit.body == c.a ? A : B;
      const Vec3 v = pathCenterAt(path_.form, path_.inputs, t).v, weight = pose.R * limit.point_weight;
      const Vec3 moves = pointBy(c, t) * v - (limit.body == path_.body ? v : Vec3(Vec3::Zero()));
      rate = weight.dot(moves);
      return weight.dot(motion_.geometry->contact(c.a, c.b, c.features, A, B).point - pose.x) - limit.point_weight.dot(limit.border);
    };
    const double end = std::min(found_.elapsed, kLongest), far = 0.1 * (c.at.point - choice_.start.x).norm();
    double above = 0, below = kInfinity, t = 0;
    for (int step = 0; step < 2000 && above < end; ++step) {
      double rate;
      const double room = look(t, rate);
      if (room > 0) {
        above = t;
        const double speed = pathCenterAt(path_.form, path_.inputs, t).v.norm();
        t += std::min(far / speed, rate < 0 ? std::max(room / -rate, 1e-15 * t) : kInfinity);
      } else {
        below = t;
      }
      if (!(t < below)) t = 0.5 * (above + below);
      if (!(above < t && t < below) && below < kInfinity) break;
      t = std::min(t, end);
    }
    if (below < end) take(below, TransitionCause::leaves, k, static_cast<int>(i));
  }

  // The body turns about an axis that leaves its contacts where they are below it, so a point moves as the centre does.
  void leave(const BodyGeometry& bodies, int k, int only = -1) {
    const Contact& c = *choice_.contacts[asIndex(k)];
    const Mat3 by = pointBy(c);
    const std::vector<FeatureLimit> limits =
        bodies.limits(c.a, c.b, c.features, poseOf(c.a, stateOf(c.a)), poseOf(c.b, stateOf(c.b)));
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const FeatureLimit& limit = limits[i];
      if (limit.point_weight.isZero(0) || (only >= 0 && only != static_cast<int>(i))) continue;
      if (limit.body == path_.body && path_.form != PathForm::glide_block) continue;
      if (limit.body != path_.body && limit.radius > 0) {
        leaveDisc(bodies, k, static_cast<int>(i));
        continue;
      }
      if (!movesAlike(c, by)) {
        leaveCrossing(bodies, k, i);
        continue;
      }
      const Pose pose = poseOf(limit.body, stateOf(limit.body));
      const Vec3 weight = pose.R * limit.point_weight;
      // weight . (p - x_body - border), p = p0 + by (x - x0)
      Vec3 along = by.transpose() * weight;
      double value = along.dot(choice_.start.x) - weight.dot(c.at.point - pose.x - pose.R * limit.border);
      if (limit.body == path_.body) along -= weight, value -= weight.dot(choice_.start.x);
      if (along.norm() < 1e-12) continue;
      if (const auto t = firstDescent(path_.form, path_.inputs, along, 0, value, found_.elapsed); t && *t < found_.elapsed)
        take(*t, TransitionCause::leaves, k, static_cast<int>(i));
    }
  }

  // A round border: no nearer than it is, over the fastest speed, can it be reached.
  void leaveDisc(const BodyGeometry& bodies, int k, int i) {
    const Contact& c = *choice_.contacts[asIndex(k)];
    const auto room = [&](double t) {
      const State now = path_.stateAt(choice_.start, path_.start + t);
      const Pose A = poseOf(c.a, c.a == path_.body ? now : stateOf(c.a)), B = poseOf(c.b, c.b == path_.body ? now : stateOf(c.b));
      const std::vector<FeatureLimit> limits = bodies.limits(c.a, c.b, c.features, A, B);
      if (i >= static_cast<int>(limits.size())) return kInfinity;  // in the middle
      const FeatureLimit& limit = limits[asIndex(i)];
      const Pose& pose = limit.body == c.a ? A : B;
      const Vec3 point = motion_.geometry->contact(c.a, c.b, c.features, A, B).point;
      return limit.point_weight.dot(pose.R.transpose() * (point - pose.x) - limit.border);
    };
    const double end = std::min(found_.elapsed, kLongest);
    const double slope = path_.inputs.gravity.norm() * (1 + path_.inputs.friction);
    const double arm = (c.at.point - choice_.start.x).norm();
    double t = 0;
    for (int step = 0; step < 2000; ++step) {
      if (!(t < end)) return;
      const double left = room(t), speed = pathCenterAt(path_.form, path_.inputs, t).v.norm();
      // speed dt + slope dt^2 / 2 = way
      const double way = std::isfinite(left) ? left : kFromMiddle * arm;
      const double next = t + 2 * way / (speed + std::sqrt(speed * speed + 2 * slope * way));
      if (left <= 1e-15 * (arm + choice_.start.x.norm()) || next == t) {
        take(t, TransitionCause::leaves, k, i);
        return;
      }
      t = next;
    }
    throw NotComputable("the time at which a contact reaches the boundary of a round face was not found");
  }

  // The point that the force of the face goes through is h mu ahead of the foot of the centre of mass, along the slip.
  void tip() {
    const double ahead = path_.inputs.reach * path_.inputs.friction;
    if (const auto disc = FlatDisc::of(motion_, choice_.contacts)) {
      tipWhere([&](const Vec3& slip) { return disc->roomAround(choice_.start.x + ahead * slip, path_.inputs.normal); });
      return;
    }
    const SupportPolygon support(choice_.contacts, path_.inputs.normal);
    for (const SupportPolygon::Side& side : support.sides()) {
      const Mat3 by = pointBy(*choice_.contacts[asIndex(side.from)]);
      const Vec3 follows = by.transpose() * side.inward;
      const double room = side.inward.dot(choice_.start.x - support.pointOf(side.from));
      if ((follows - side.inward).norm() < 1e-9) {
        tipOver(side.inward, room, ahead);
      } else if (const auto t = firstDescent(path_.form, path_.inputs, side.inward - follows, ahead,
                                             (side.inward - follows).dot(choice_.start.x) - room, found_.elapsed);
                 t && *t < found_.elapsed) {
        take(*t, TransitionCause::tips, -1, -1);
      }
    }
  }

  // Over a side that goes with the body: where the slip turns towards it.
  void tipOver(const Vec3& inward, double room, double ahead) {
    tipWhere([&](const Vec3& slip) { return room + ahead * inward.dot(slip); });
  }

  // Where the room that is left by the direction of the slip comes to 0.
  template <class Room>
  void tipWhere(const Room& room) {
    const auto left = [&](double t) { return room(slipDirectionAt<double>(path_.form, path_.inputs, t)); };
    const double end = std::min({found_.elapsed, path_.slip_end, kLongest});
    double low = 0, high = end;
    if (left(high) >= 0) return;
    for (int step = 0; step < 200 && std::nextafter(low, high) < high; ++step) {
      const double middle = 0.5 * (low + high);
      (left(middle) >= 0 ? low : high) = middle;
    }
    take(high, TransitionCause::tips, -1, -1);
  }

  const Motion& motion_;
  const ContactChoice& choice_;
  const ContactPath& path_;
  PathTransition found_;
};

}  // namespace

PathTransition firstTransition(const Motion& motion, const ContactChoice& choice, double until) {
  return Search(motion, choice, until).run();
}

std::optional<double> whenContactLeaves(const Motion& motion, const ContactChoice& choice, int contact, int limit,
                                        double until) {
  return Search(motion, choice, until).leaves(contact, limit);
}

}  // namespace carom::adjoint_detail
