// SPDX-License-Identifier: MIT
#include "tests/reference/die_replay.h"

#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/numeric/double_double.hpp"

namespace carom::reference {
namespace {

using adjoint_detail::PersistentContact;
using adjoint_detail::ContactMode;
using adjoint_detail::ConstrainedPath;
using adjoint_detail::ImpactProblemOf;
using adjoint_detail::DoubleDouble;

// What the series leave out varies with the numbers no more than they do.
constexpr int kConstrainedOrder = 16;
const Real kConstrainedTolerance("1e-17");
const Real kLineFrom("1e-13");  // of its time: what is left of a slip then goes along a line

DoubleDouble wide(const Real& x) {
  const double high = static_cast<double>(x);
  return DoubleDouble(high) + static_cast<double>(Real(x - high));
}
Eigen::Matrix<DoubleDouble, 3, 1> wide(const RVec& v) { return {wide(v[0]), wide(v[1]), wide(v[2])}; }
Real real(const DoubleDouble& x) { return Real(x.high) + x.low; }

// The corner of the box that an arm goes to, in its axes.
RVec cornerAt(const Vec3& arm, const RVec& size) {
  RVec corner;
  for (int i = 0; i < 3; ++i) corner[i] = Real(arm[i] > 0 ? 1 : -1) * size[i] / 2;
  return corner;
}

}  // namespace

DieNumbers::DieNumbers(const Scene& scene) {
  const Body &die = scene.bodies[0], &plane = scene.bodies[1];
  gravity = RVec(scene.gravity), x = RVec(die.position), v = RVec(die.velocity), spin = RVec(die.angular_velocity);
  size = RVec(std::get<Box>(die.shape).size), R = rotationOf(die.orientation);
  floor = RVec(plane.position), floor_R = rotationOf(plane.orientation);
  elasticity = scene.materials[0].elasticity, friction = scene.materials[0].friction, mass = *die.mass;
}

ConstrainedBody DieNumbers::body() const {
  const RVec square = times(size, size);
  return {mass, (mass / 12) * RVec{square[1] + square[2], square[2] + square[0], square[0] + square[1]}, gravity};
}

DieReplay::DieReplay(const DieNumbers& numbers, const Motion& like, const DieReplay* near)
    : n_(numbers), body_(numbers.body()), state_{n_.x, n_.R, n_.v, n_.spin} {
  const WorldLine& line = like.world_lines[0];
  startArc(line.arcs[0], nullptr);
  for (std::size_t k = 0; k < line.events.size(); ++k) {
    const Event& event = like.events[static_cast<std::size_t>(line.events[k])];
    when.push_back(near ? near->when[k] : Real(event.time));
    const auto placeOf = [&](std::size_t i) { return near ? &near->places_[2 * k + i] : nullptr; };
    follow(event, line.arcs[k], near);
    before.push_back(state_);
    const BodyModel& model = (*like.models)[0];
    takeOver(event.participants[0].before, model, event.time, placeOf(0));
    if (event.kind != EventKind::transition) strike(event);
    settle(line.arcs[k + 1], event);
    takeOver(line.arcs[k + 1].startState(), model, line.arcs[k + 1].start(), placeOf(1));
    startArc(line.arcs[k + 1], &event);
  }
  end = state_;
}

// Moves the present state to that of the motion.
void DieReplay::takeOver(const State& s, const BodyModel& model, const Real& at_time, const Place* near) {
  const ConstrainedState led = state_;
  const Real time = start_;
  if (near) {
    RMat change;
    for (std::size_t c = 0; c < 3; ++c) change.column[c] = led.R.column[c] - near->led.R.column[c];
    const RMat back = transpose(near->led.R) * near->state.R;
    start_ = near->time + (time - near->time_led);
    state_.x = near->state.x + (led.x - near->led.x), state_.v = near->state.v + (led.v - near->led.v);
    state_.spin = near->state.spin + (led.spin - near->led.spin);
    for (std::size_t c = 0; c < 3; ++c) state_.R.column[c] = near->state.R.column[c] + change * back.column[c];
    return;
  }
  start_ = at_time;
  state_ = {RVec(s.x), rotationOf(s.q), RVec(s.v), RVec(toBodyState(model, s).angular_velocity)};
  worst_position = std::max<Real>(worst_position, norm(state_.x - led.x));
  worst_velocity = std::max<Real>(worst_velocity, norm(state_.v - led.v));
  places_.push_back({start_, time, state_, led});
}

// What the start of an arc is projected to.
void DieReplay::settle(const Arc& arc, const Event& event) {
  if (arc.kind() == ArcKind::rest) {
    state_.v = state_.spin = RVec();
  } else if (arc.kind() != ArcKind::flight) {
    if (!arc.isIntegrated()) state_.spin = RVec();
    state_ = projected(body_, cornersOf(arc, event), state_);
  }
}

RVec DieReplay::cornerOf(const Contact& c) const {
  return cornerAt(rounded(state_.R).transpose() * (c.at.point - state_.x.rounded()), n_.size);
}

// A block that slides without turning is one on all its corners.
std::vector<ConstrainedCorner> DieReplay::cornersOf(const Arc& arc, const Event& after) const {
  const auto* path = arc.trajectory().constrained();
  if (!path) {
    std::vector<ConstrainedCorner> corners;
    for (const Contact& c : after.contacts)
      if (c.lasts) corners.push_back({cornerOf(c), n_.normal(), dot(n_.normal(), n_.floor), n_.friction, false, false, {}});
    return corners;
  }
  const State start = path->stateAt(path->start());
  const auto now = path->instantAt(path->start());
  std::vector<ConstrainedCorner> corners;
  for (std::size_t k = 0; k < path->contacts().size(); ++k) {
    const PersistentContact& c = path->contacts()[k];
    ConstrainedCorner corner;
    corner.at = cornerAt(start.q.conjugate() * now.contacts[k].r, n_.size);
    corner.normal = n_.normal(), corner.offset = dot(corner.normal, n_.floor), corner.friction = n_.friction;
    corner.sticks = c.mode == ContactMode::sticks, corner.begins = c.begins, corner.slip = RVec(c.slip);
    corners.push_back(corner);
  }
  return corners;
}

// Goes on from state_ on an arc of that kind.
void DieReplay::startArc(const Arc& arc, const Event* after) {
  held_.reset(), turning_.reset();
  if (arc.kind() == ArcKind::flight) {
    const RVec L = state_.R * times(body_.inertia, transposeTimes(state_.R, state_.spin));
    turning_ = std::make_unique<FreeRotation>(body_.inertia, state_.R, L);
  } else if (arc.kind() != ArcKind::rest) {
    settle(arc, *after);
    held_ = std::make_unique<ConstrainedSeries>(body_, cornersOf(arc, *after), state_, kConstrainedOrder, kConstrainedTolerance);
  }
}

ConstrainedState DieReplay::at(const Real& time) {
  Real s = time - start_;
  if (turning_) {
    const RMat R = turning_->orientationAt(s);
    return {state_.x + s * state_.v + (s * s / 2) * n_.gravity, R, state_.v + s * n_.gravity, turning_->spinAt(R)};
  }
  for (; held_->longest() < s; s = time - start_) {
    const Real step = held_->longest();
    held_->advance(step), start_ += step;
  }
  return held_->at(s);
}

Real DieReplay::gap(const RVec& corner, const ConstrainedState& s) const {
  return dot(n_.normal(), s.x + s.R * corner - n_.floor);
}

// Of the corners that meet, weighted by their impulses.
std::array<Real, 2> DieReplay::meanGap(const Event& event, const ConstrainedState& s) const {
  Real sum = 0, rate = 0, total = 0;
  for (const Contact& c : event.contacts) {
    const Real weight = Real(c.impulse_normal.dot(c.impulse));
    if (c.held || !(weight > 0)) continue;
    const RVec corner = cornerAt(rounded(s.R).transpose() * (c.at.point - s.x.rounded()), n_.size);
    sum += weight * gap(corner, s), rate += weight * dot(n_.normal(), s.v + cross(s.spin, s.R * corner)), total += weight;
  }
  return {sum / total, rate / total};
}

// When the mean gap is that.
Real DieReplay::meet(const Event& event, Real guess, const Real& gap) {
  for (int i = 0; i < 40; ++i) {
    const auto [now, rate] = meanGap(event, at(guess));
    const Real change = (gap - now) / rate;
    guess += change;
    if (abs(change) < Real("1e-32")) return guess;
  }
  throw std::runtime_error("the time of an impact is not found");
}

std::vector<RVec> DieReplay::impulsesOf(const Event& event, const std::vector<RVec>& arms) const {
  const RVec n = n_.normal();
  RVec inverse;
  for (int i = 0; i < 3; ++i) inverse[i] = 1 / body_.inertia[i];
  const Contact& first = event.contacts[0];
  if (arms.size() == 1 && !first.kept) {
    const Side side{true, 1 / n_.mass, inverse, state_.R, arms[0], state_.v, state_.spin};
    ImpactMode mode = event.mode;
    return {impulseOf(side, Side(), n, {first.captured ? Real(0) : n_.elasticity, n_.friction, 0}, mode, false)};
  }
  const auto m = static_cast<Eigen::Index>(3 * arms.size());
  ImpactProblemOf<DoubleDouble> p;
  p.K.setZero(m, m), p.u.setZero(m);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    p.u.segment<3>(row) = wide(state_.v + cross(state_.spin, arms[k]));
    for (std::size_t l = 0; l < arms.size(); ++l)
      for (int c = 0; c < 3; ++c) {
        const RVec P = axisVector(c), turn = state_.R * times(inverse, transposeTimes(state_.R, cross(arms[l], P)));
        p.K.col(static_cast<Eigen::Index>(3 * l) + c).segment<3>(row) = wide((1 / n_.mass) * P + cross(turn, arms[k]));
      }
    p.normal.push_back(wide(n));
    const Contact& c = event.contacts[k];
    p.pair.push_back({c.captured || c.kept ? DoubleDouble(0) : wide(n_.elasticity), wide(n_.friction), DoubleDouble(0)});
    if (c.kept) p.held.resize(arms.size()), p.held[k] = 1;
  }
  const auto solution = adjoint_detail::solveLaw(p);
  std::vector<RVec> impulses;
  for (Eigen::Index k = 0; k < m; k += 3)
    impulses.push_back({real(solution.P[k]), real(solution.P[k + 1]), real(solution.P[k + 2])});
  return impulses;
}

void DieReplay::strike(const Event& event) {
  std::vector<RVec> corners, arms;
  for (const Contact& c : event.contacts) corners.push_back(cornerOf(c)), arms.push_back(state_.R * corners.back());
  const std::vector<RVec> impulses = impulsesOf(event, arms);
  RVec L = state_.R * times(body_.inertia, transposeTimes(state_.R, state_.spin));
  std::vector<ConstrainedCorner> lasting;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    state_.v = state_.v + (1 / n_.mass) * impulses[k], L = L + cross(arms[k], impulses[k]);
    if (event.contacts[k].lasts)
      lasting.push_back({corners[k], n_.normal(), dot(n_.normal(), n_.floor), n_.friction, true, false, {}});
  }
  RVec own = transposeTimes(state_.R, L);
  for (int i = 0; i < 3; ++i) own[i] /= body_.inertia[i];
  state_.spin = state_.R * own;
  if (!lasting.empty()) state_ = withoutGaps(body_, lasting, state_);
}

// Up to an event.
void DieReplay::follow(const Event& event, const Arc& arc, const DieReplay* near) {
  Real& time = when.back();
  arc_start_ = start_;
  if (event.kind != EventKind::transition) {
    const std::size_t k = gaps_.size();
    gaps_.push_back(near ? near->gaps_[k] : meanGap(event, at(time))[0]);
    if (near) time = meet(event, time, gaps_[k]);
    state_ = at(time);
    start_ = time;
    return;
  }
  if (!held_) throw UnknownTransition();
  const auto* path = arc.trajectory().constrained();
  if (event.cause == TransitionCause::slip_ends) {
    time = endSlip(0);
  } else if (event.cause == TransitionCause::sticks) {
    time = endSlip(static_cast<std::size_t>(path->ending()->guard.contact));
  } else {
    time = root(event, arc, time);
    state_ = at(time);
  }
  start_ = time;
}

Real DieReplay::endSlip(std::size_t k) {
  for (int step = 0; step < 2000; ++step) {
    const RVec u = held_->slip(k, 0);
    const Real size = norm(u), along = dot(u, held_->slipRate(k)) / size;
    Real left = along < 0 ? Real(-size / along) : Real(1);
    if (left < kLineFrom * (start_ + left - arc_start_)) {
      state_ = held_->at(left);
      return start_ + left;
    }
    left = std::min<Real>(left / 2, held_->longest());
    held_->advance(left), start_ += left;
  }
  throw std::runtime_error("a slip does not end");
}

// Of two corners that stick, with the push between them that leaves most: min(room_1, room_2) is concave in it (11.25).
Real DieReplay::sharedRoom(std::size_t a, std::size_t b, const Real& s) const {
  const std::array<std::size_t, 2> corner{a, b};
  std::array<RVec, 2> f, n, along;
  along[1] = unit(held_->corners()[b].at - held_->corners()[a].at), along[0] = -along[1];
  for (std::size_t i = 0; i < 2; ++i) f[i] = held_->force(corner[i], s), n[i] = held_->normal(corner[i], s);
  const auto rooms = [&](const Real& push) {
    std::array<Real, 2> room, slope;
    for (std::size_t i = 0; i < 2; ++i) {
      const RVec g = f[i] + push * along[i];
      const Real pressing = dot(n[i], g), by = dot(n[i], along[i]);
      const RVec side = g - pressing * n[i];
      room[i] = n_.friction * pressing - norm(side), slope[i] = n_.friction * by - dot(side, along[i] - by * n[i]) / norm(side);
    }
    return std::pair(room, slope);
  };
  Real high = 10 * (norm(f[0]) + norm(f[1])), low = -high;
  for (int i = 0; i < 170; ++i) {
    const Real middle = (low + high) / 2;
    const auto [room, slope] = rooms(middle);
    (room[0] < room[1] ? slope[0] : slope[1]) > 0 ? low = middle : high = middle;
  }
  const auto room = rooms(low).first;
  return std::min(room[0], room[1]);
}

Real DieReplay::value(TransitionCause cause, std::size_t k, const Real& time) {
  at(time);
  const Real s = time - start_, pressing = held_->pressing(k, s);
  if (cause == TransitionCause::lifts) return pressing;
  std::vector<std::size_t> stick;
  for (std::size_t i = 0; i < held_->corners().size(); ++i)
    if (held_->corners()[i].sticks) stick.push_back(i);
  if (stick.size() == 2) return sharedRoom(stick[0], stick[1], s);
  const RVec f = held_->force(k, s);
  return n_.friction * pressing - sqrt(dot(f, f) - pressing * pressing);
}

// By secants; a guard that falls through 0 by 1e-30 of the time has.
Real DieReplay::root(const Event& event, const Arc& arc, const Real& guess) {
  const auto* path = arc.trajectory().constrained();
  if (!path) throw UnknownTransition();
  const auto corner = static_cast<std::size_t>(path->ending()->guard.contact);
  if (event.cause != TransitionCause::lifts && event.cause != TransitionCause::slips)
    throw UnknownTransition();
  Real a = guess - Real("1e-12"), fa = value(event.cause, corner, a), b = guess;
  for (int i = 0; i < 30; ++i) {
    const Real fb = value(event.cause, corner, b), change = -fb * (b - a) / (fb - fa);
    a = b, fa = fb, b += change;
    if (abs(change) < Real("1e-30")) return b;
  }
  throw std::runtime_error("the root of a guard is not found");
}

}  // namespace carom::reference
