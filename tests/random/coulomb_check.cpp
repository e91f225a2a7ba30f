// SPDX-License-Identifier: MIT
#include "tests/random/coulomb_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

namespace carom::test {
namespace on_grounds {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

constexpr double kDepth = 1e-9, kEnergy = 1e-11, kForce = 1e-5, kImpulse = 1e-6;
constexpr double kTouches = 2e-8;   // m, of a point
constexpr double kNoSlip = 1e-7;    // of the speeds there are
// s, between the times of differences: of states that are known to 1e-16 shorter ones tell nothing.
constexpr double kLongest = 2e-5, kShortest = 1e-8;
// Of the speeds there are: where contacts would bounce below the lowest one, n.u = 0 before and after is kept by a pull.
constexpr double kKept = 1e-10;
constexpr std::size_t kMostKept = 8;  // of them any may pull, without friction
// Of the speed of the lowest bounce: where contacts are captured from below it, slips of up to four times that speed are
// stopped as the path begins, at up to three places that are independent.
constexpr double kStopped = 12;
constexpr int kDirections = 48;

// min |G y - w| over y >= 0, by Lawson and Hanson's active set; gives the rest.
Vec6 leastRest(const Eigen::Matrix<double, 6, Eigen::Dynamic>& G, const Vec6& w) {
  std::vector<Eigen::Index> in;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(G.cols());
  for (int round = 0; round < 400; ++round) {
    const Eigen::VectorXd pull = G.transpose() * (w - G * y);
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < G.cols(); ++i)
      if (std::ranges::find(in, i) == in.end() && (best < 0 || pull[i] > pull[best])) best = i;
    if (best < 0 || !(pull[best] > 1e-13 * w.norm())) break;
    in.push_back(best);
    while (!in.empty()) {
      Eigen::Matrix<double, 6, Eigen::Dynamic> part(6, static_cast<Eigen::Index>(in.size()));
      for (std::size_t c = 0; c < in.size(); ++c) part.col(static_cast<Eigen::Index>(c)) = G.col(in[c]);
      const Eigen::VectorXd to = part.completeOrthogonalDecomposition().solve(w);
      double step = 1;
      std::size_t leave = in.size();
      for (std::size_t c = 0; c < in.size(); ++c) {
        const double from = y[in[c]], next = to[static_cast<Eigen::Index>(c)];
        if (next <= 0 && from / (from - next + 1e-300) < step) step = from / (from - next + 1e-300), leave = c;
      }
      for (std::size_t c = 0; c < in.size(); ++c) y[in[c]] += step * (to[static_cast<Eigen::Index>(c)] - y[in[c]]);
      if (leave == in.size()) break;
      y[in[leave]] = 0;
      in.erase(in.begin() + static_cast<std::ptrdiff_t>(leave));
    }
  }
  return w - G * y;
}

class Check {
 public:
  Check(const Motion& motion, const std::vector<Ground>& grounds)
      : motion_(motion), grounds_(grounds), model_((*motion.models)[0]), shape_(motion.scene->bodies[0].shape) {
    size_ = kindOf(shape_).boundingRadius(shape_) + model_.center.norm();
    friction_ = motion.scene->materials[0].friction;
    gravity_ = motion.scene->gravity;
  }

  CoulombFindings run() {
    const std::vector<Arc>& arcs = motion_.world_lines[0].arcs;
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const double from = arcs[a].start(), until = a + 1 < arcs.size() ? arcs[a + 1].start() : motion_.end;
      for (int i = 0; i <= 8; ++i) look(arcs[a].stateAt(std::min(until, from + (until - from) * i / 8)), from);
      const double h = std::min(kLongest, 0.004 * (until - from));
      for (const double share : {0.2, 0.5, 0.8}) rates(arcs[a], from + share * (until - from), h);
      if (a + 1 < arcs.size()) jump(arcs[a].stateAt(until), arcs[a + 1].startState(), until);
    }
    return found_;
  }

 private:
  PlacedShape placed(const State& s) const {
    const Mat3 R = turned(s);
    return {shape_, R, s.x - R * model_.center};
  }
  Mat3 turned(const State& s) const { return model_.shapeToWorld(s.q.toRotationMatrix()); }
  Vec3 spin(const State& s) const { return model_.inverseInertiaWorld(s.q.toRotationMatrix()) * s.L; }

  double speedOf(const State& s) const {
    return s.v.norm() + size_ * spin(s).norm() + std::sqrt(gravity_.norm() * size_) * 1e-2;
  }

  void fail(double value, double allowed, double& worst, double time, const char* what) {
    if (!(value <= worst)) worst = value;
    if (value <= allowed || !found_.first.empty()) return;
    std::ostringstream out;
    out << what << " by " << value << " at t = " << time;
    found_.first = out.str();
  }

  // From the centre of mass.
  std::vector<GroundTouch> touching(const State& s, double reach) {
    const PlacedShape body = placed(s);
    std::vector<GroundTouch> touches;
    for (const Ground& ground : grounds_)
      for (const GroundTouch& t : touchesOf(ground, body, reach)) touches.push_back({t.n, body.x - s.x + t.r});
    return touches;
  }

  void look(const State& s, double time) {
    double depth = 0;
    for (const Ground& ground : grounds_) depth = std::max(depth, depthIn(ground, placed(s)));
    fail(depth, kDepth, found_.worst_depth, time, "in the ground");
    const double energy = 0.5 * model_.mass * s.v.squaredNorm() + 0.5 * s.L.dot(spin(s)) - model_.mass * gravity_.dot(s.x);
    const double unit = model_.mass * gravity_.norm() * (size_ + s.x.norm());
    fail((energy - least_) / (std::abs(energy) + unit), kEnergy, found_.worst_growth, time, "energy grows");
    least_ = std::min(least_, energy);
  }

  // What forces of Coulomb's law at the points in touch cannot give; moments over the size of the body.
  Vec6 columnOf(const GroundTouch& t, const Vec3& f) const {
    Vec6 column;
    column << f, t.r.cross(f) / size_;
    return column.normalized();
  }

  double rest(const std::vector<GroundTouch>& touches, const State& s, const Vec3& force, const Vec3& moment, bool slips,
              std::vector<Vec6> columns = {}) {
    Vec6 w;
    w << force, moment / size_;
    const Vec3 omega = spin(s);
    const double speed = speedOf(s);
    const auto add = [&](const GroundTouch& t, const Vec3& f) { columns.push_back(columnOf(t, f)); };
    for (const GroundTouch& t : touches) {
      Vec3 u = s.v + omega.cross(t.r);
      u -= t.n.dot(u) * t.n;
      if (friction_ <= 0) {
        add(t, t.n);
      } else if (slips && u.norm() > kNoSlip * speed) {
        add(t, t.n - friction_ * u.normalized());
      } else {
        const Vec3 along = t.n.unitOrthogonal(), across = t.n.cross(along);
        const double outer = friction_ / std::cos(std::numbers::pi / kDirections);
        for (int i = 0; i < kDirections; ++i) {
          const double a = 2 * std::numbers::pi * i / kDirections;
          add(t, t.n + outer * (std::cos(a) * along + std::sin(a) * across));
        }
      }
    }
    if (columns.empty()) return w.norm();
    Eigen::Matrix<double, 6, Eigen::Dynamic> G(6, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) G.col(static_cast<Eigen::Index>(c)) = columns[c];
    return leastRest(G, w).norm();
  }

  // Over times that are short beside those in which slips turn.
  double shortEnough(const State& s, double h) {
    const Vec3 omega = spin(s);
    for (const GroundTouch& t : touching(s, kTouches)) {
      Vec3 u = s.v + omega.cross(t.r);
      u -= t.n.dot(u) * t.n;
      if (friction_ > 0 && u.norm() > kNoSlip * speedOf(s)) h = std::min(h, 0.002 * u.norm() / gravity_.norm());
    }
    return h;
  }

  struct Rates {
    double velocity, force;  // what dx/dt leaves of v, and Coulomb's law of the rates of momentum
  };
  Rates ratesOver(const Arc& arc, const State& s, double t, double h) {
    const State far = arc.stateAt(t - 2 * h), near = arc.stateAt(t - h), next = arc.stateAt(t + h), last = arc.stateAt(t + 2 * h);
    const auto rate = [&](const Vec3 State::* of) -> Vec3 {
      return ((far.*of - last.*of) + 8 * (next.*of - near.*of)) / (12 * h);
    };
    const double speed = s.v.norm() + std::sqrt(gravity_.norm() * size_);
    const Vec3 force = model_.mass * (rate(&State::v) - gravity_), moment = rate(&State::L);
    const double unit = model_.mass * gravity_.norm() + force.norm() + moment.norm() / size_ +
                        1e-7 * model_.mass * speed / h;
    return {(rate(&State::x) - s.v).norm() / speed, rest(touching(s, kTouches), s, force, moment, true) / unit};
  }

  // What a body that wobbles fast does between two times says little: shorter ones are tried until what is seen fits.
  void rates(const Arc& arc, double t, double longest) {
    const State s = arc.stateAt(t);
    double h = shortEnough(s, longest);
    if (!(h > kShortest)) return;
    ++found_.looks;
    Rates least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (; h > kShortest; h /= 4) {
      const Rates seen = ratesOver(arc, s, t, h);
      least.velocity = std::min(least.velocity, seen.velocity), least.force = std::min(least.force, seen.force);
      if (least.velocity <= kForce && least.force <= kForce) break;
    }
    fail(least.velocity, kForce, found_.worst_force, t, "dx/dt is not v,");
    fail(least.force, kForce, found_.worst_force, t, "Coulomb's law is broken");
  }

  void jump(const State& before, const State& after, double t) {
    const Vec3 force = model_.mass * (after.v - before.v), moment = after.L - before.L;
    const double size = force.norm() + moment.norm() / size_, speed = speedOf(before) + speedOf(after);
    if (!(size > 0)) return;
    const std::vector<GroundTouch> touches = touching(before, kTouches);
    const auto parts = [&](const State& s, const GroundTouch& of) { return of.n.dot(s.v + spin(s).cross(of.r)); };
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < touches.size() && kept.size() < kMostKept; ++k)
      if (std::abs(parts(before, touches[k])) <= kKept * speed && std::abs(parts(after, touches[k])) <= kKept * speed) kept.push_back(k);
    const double unit = size + kStopped / kImpulse * model_.mass * std::sqrt(2 * motion_.lowest_bounce * gravity_.norm());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t set = 0; set < std::size_t{1} << kept.size() && !(least <= kImpulse * unit); ++set) {
      std::vector<GroundTouch> push = touches;
      std::vector<Vec6> pulls;
      for (std::size_t k = kept.size(); k-- > 0;)
        if (set >> k & 1) {
          pulls.push_back(columnOf(touches[kept[k]], -touches[kept[k]].n));
          push.erase(push.begin() + static_cast<std::ptrdiff_t>(kept[k]));
        }
      least = std::min(least, rest(push, before, force, moment, false, pulls));
    }
    fail(least / unit, kImpulse, found_.worst_impulse, t, "an impulse leaves the cones of friction");
  }

  const Motion& motion_;
  const std::vector<Ground>& grounds_;
  const BodyModel& model_;
  const Shape& shape_;
  double friction_ = 0, size_ = 1, least_ = std::numeric_limits<double>::infinity();
  Vec3 gravity_ = Vec3::Zero();
  CoulombFindings found_;
};

}  // namespace
}  // namespace on_grounds

void CoulombFindings::add(const CoulombFindings& other) {
  worst_depth = std::max(worst_depth, other.worst_depth);
  worst_growth = std::max(worst_growth, other.worst_growth);
  worst_force = std::max(worst_force, other.worst_force);
  worst_impulse = std::max(worst_impulse, other.worst_impulse);
  looks += other.looks;
  if (first.empty()) first = other.first;
}

CoulombFindings checkOnGrounds(const Motion& motion, const std::vector<Ground>& grounds) {
  return on_grounds::Check(motion, grounds).run();
}

CoulombFindings checkAmongPlanes(const Motion& motion) {
  std::vector<Ground> grounds;
  for (std::size_t b = 1; b < motion.scene->bodies.size(); ++b) {
    const Body& body = motion.scene->bodies[b];
    const auto& plane = std::get<Plane>(body.shape);
    const Vec3 n = body.orientation * plane.normal.normalized();
    grounds.push_back({n, plane.offset + n.dot(body.position), std::nullopt});
  }
  return checkOnGrounds(motion, grounds);
}

}  // namespace carom::test
