// SPDX-License-Identifier: MIT
#include "ode_bridge/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/numeric/elementary.hpp"

namespace carom::ode_bridge_detail {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// Lists of this mean length are wanted: longer ones cost searches, shorter ones cost new boxes.
constexpr double kListLength = 14;
// All boxes are laid anew after about this many single ones a body.
constexpr double kRenewals = 16;
// Of the range of a body in its box, the share that it gets on its present path; the rest is room for when it is
// struck.
constexpr double kAhead = 0.7;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Adds or takes out a number of an increasing list.
void add(std::vector<int>& list, int value) {
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place == list.end() || *place != value) list.insert(place, value);
}
void take(std::vector<int>& list, int value) {
  const auto place = std::lower_bound(list.begin(), list.end(), value);
  if (place != list.end() && *place == value) list.erase(place);
}

}  // namespace

void Neighbours::begin(std::vector<BodyExtent> extents, const Vec3& gravity, std::size_t few, CollisionClasses classes) {
  few_ = few;
  gravity_ = {gravity, 0};
  classes_ = std::move(classes);
  extents_ = std::move(extents);
  const std::size_t n = extents_.size();
  accelerations_.assign(n, gravity_);
  of_their_own_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!extents_[i].moving) continue;
    accelerations_[i] = inFlight(static_cast<int>(i));
    of_their_own_ += !(accelerations_[i] == gravity_);
  }
  paths_.assign(n, {});
  boxes_.assign(n, {});
  until_.assign(n, kNever);
  lists_.assign(n, {});
  half_spaces_.clear();
  moving_ = 0;
  all_until_ = -kNever;
  span_ = range_ = end_ = 0;
  broad_phase_.reset(n);
  for (std::size_t i = 0; i < n; ++i) {
    const BodyExtent& e = extents_[i];
    moving_ += e.moving;
    paths_[i].radius = e.radius;
    boxes_[i] = e.box;
    if (!e.half_space) continue;
    half_spaces_.push_back(static_cast<int>(i));
    boxes_[i] = {Vec3::Constant(kNever), Vec3::Constant(-kNever)};  // meets no box: half spaces are asked by themselves
    broad_phase_.setHalfSpace(static_cast<int>(i), e.normal, e.offset);
  }
}

bool Neighbours::touches(int body, int other) const {
  if (!classes_.collide(body, other)) return false;
  const BodyExtent& e = extents_[at(other)];
  const Bounds& b = boxes_[at(body)];
  if (!e.half_space) return meet(b, boxes_[at(other)]);
  const double lowest = e.normal.cwiseMax(0).dot(b.low) + e.normal.cwiseMin(0).dot(b.high);
  return lowest <= e.offset + roundingRoom(b);
}

Acceleration Neighbours::inFlight(int body) const {
  return {extents_[at(body)].gravity_factor * gravity_.mean, 0};
}

void Neighbours::renewPath(int body, const Vec3& x, const Vec3& v, double t) {
  FlightPath& mine = paths_[at(body)];
  mine.x = x, mine.v = v, mine.start = t;
}

void Neighbours::setPath(int body, const FlightPath& path, const Acceleration& acceleration, double from, double until) {
  if (!(of_their_own_ == 0 && acceleration == gravity_)) {
    Acceleration& own = accelerations_[at(body)];
    of_their_own_ -= !(own == gravity_);
    of_their_own_ += !(acceleration == gravity_);
    own = acceleration;
  }
  const double radius = paths_[at(body)].radius;
  FlightPath& mine = paths_[at(body)];
  mine = path;
  mine.radius = radius;
  end_ = std::max(end_, until);
  if (few()) {
    const Bounds centre = sweptCentre(mine, accelerationOf(body), from, until);
    const Bounds box = grown(centre, radius);
    boxes_[at(body)] = grown(box, roundingRoom(box));
    return;
  }
  if (all_until_ == -kNever) return;  // no boxes yet
  const Bounds inner = grown(boxes_[at(body)], -radius - roundingRoom(boxes_[at(body)]));
  until_[at(body)] = std::min(all_until_, leavingTime(mine, accelerationOf(body), from, inner));
}

double Neighbours::window(int body, double t) {
  if (few()) return kNever;
  if (t >= all_until_) {
    renewAll(t);
  } else if (t >= until_[at(body)]) {
    renew(body, t);
  }
  return until_[at(body)];
}

void Neighbours::list(int body, std::vector<int>& out) {
  const bool opened = all_until_ != -kNever;
  if (!few() && opened) {
    out = lists_[at(body)];
    return;
  }
  // without windows that were asked for, nothing is known of many: everyone may be near
  out.clear();
  for (int other = 0; other < static_cast<int>(extents_.size()); ++other)
    if (other != body && (few() ? touches(body, other) : classes_.collide(body, other))) out.push_back(other);
}

// The box for the path from t on, up to where it has used its share of the range. Returns the time for which that is.
double Neighbours::layBox(int body, double t) {
  const FlightPath& path = paths_[at(body)];
  const Acceleration gravity = accelerationOf(body);
  const Vec3 x = path.positionAt(t, gravity.mean);
  const Bounds cube{x.array() - kAhead * range_, x.array() + kAhead * range_};
  const double leaves = std::max(leavingTime(path, gravity, t, cube), std::nextafter(t, kNever));
  const Bounds centre = sweptCentre(path, gravity, t, std::min(leaves, std::max(end_, t)));
  const double room = (1 - kAhead) * range_, rounding = 2 * roundingRoom(grown(centre, room + path.radius));
  boxes_[at(body)] = grown(centre, room + path.radius + rounding);
  const Bounds inner = grown(boxes_[at(body)], -path.radius - roundingRoom(boxes_[at(body)]));
  until_[at(body)] = std::min(all_until_, std::max(leavingTime(path, gravity, t, inner), std::nextafter(t, kNever)));
  return leaves - t;
}

// A body alone: its box, and the changes of the lists that it stands in.
void Neighbours::renew(int body, double t) {
  ++renewals_;
  layBox(body, t);
  grid_.move(body, boxes_);
  found_.clear();
  grid_.find(body, boxes_, found_);
  if (!classes_.trivial())
    found_.erase(std::remove_if(found_.begin(), found_.end(), [&](int o) { return !classes_.collide(body, o); }),
                 found_.end());
  for (int plane : half_spaces_)
    if (touches(body, plane)) found_.push_back(plane);
  std::sort(found_.begin(), found_.end());
  relist(body);
}

// Puts found_ in place of the list of a body. The changes are gathered first, so that the lists that they concern are
// fetched side by side.
void Neighbours::relist(int body) {
  std::vector<int>& list = lists_[at(body)];
  changes_.clear();
  auto left = list.begin();
  auto right = found_.begin();
  const auto note = [&](int other, bool joins) {
    if (!extents_[at(other)].moving) return;
    __builtin_prefetch(lists_[at(other)].data());
    changes_.push_back({other, joins});
  };
  while (left != list.end() || right != found_.end()) {
    if (right == found_.end() || (left != list.end() && *left < *right)) {
      note(*left++, false);
    } else if (left == list.end() || *right < *left) {
      note(*right++, true);
    } else {
      ++left, ++right;
    }
  }
  for (const auto& [other, joins] : changes_) joins ? add(lists_[at(other)], body) : take(lists_[at(other)], body);
  list.assign(found_.begin(), found_.end());
}

void Neighbours::pairs(std::vector<std::pair<int, int>>& out) {
  for (std::size_t i = 0; i < extents_.size(); ++i)
    if (!extents_[i].half_space) broad_phase_.setBounds(static_cast<int>(i), boxes_[i], extents_[i].moving);
  broad_phase_.pairs(out);
  const auto apart = [&](const std::pair<int, int>& p) {
    return extents_[at(p.first)].moving ? !touches(p.first, p.second) : !touches(p.second, p.first);
  };
  out.erase(std::remove_if(out.begin(), out.end(), apart), out.end());
}

void Neighbours::renewAll(double t) {
  chooseRange(t);
  // the mean rate at which boxes will be left says how long it takes to make so many single renewals
  double rate = 0;
  all_until_ = kNever;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    if (!extents_[i].moving) continue;
    rate += 1 / layBox(static_cast<int>(i), t);
    sizes.push_back((boxes_[i].high - boxes_[i].low).maxCoeff());
  }
  const double wanted = kRenewals * static_cast<double>(moving_);
  if (span_ == 0) {
    span_ = rate > 0 ? wanted / rate : kNever;
  } else {
    span_ *= std::clamp(wanted / static_cast<double>(renewals_ + 1), 0.5, 2.0);
  }
  all_until_ = t + span_;
  renewals_ = 0;
  pairs(pairs_);
  for (std::vector<int>& list : lists_) list.clear();
  for (const auto& [a, b] : pairs_) {
    if (extents_[at(a)].moving) lists_[at(a)].push_back(b);
    if (extents_[at(b)].moving) lists_[at(b)].push_back(a);
  }
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    if (!extents_[i].moving) continue;
    std::sort(lists_[i].begin(), lists_[i].end());
    until_[i] = std::min(until_[i], all_until_);
  }
  // the grid is laid out for all but the largest few
  const auto ordinary = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() - 1 - sizes.size() / 32);
  std::nth_element(sizes.begin(), ordinary, sizes.end());
  grid_.rebuild(boxes_, 0.55 * *ordinary);
}

// How far a body may get in its box: from the room that a body has at the start, later from the length that the lists
// turned out to have.
void Neighbours::chooseRange(double t) {
  double radius = 0;
  for (const BodyExtent& e : extents_) radius += e.moving ? e.radius : 0;
  radius /= static_cast<double>(moving_);
  if (range_ == 0) {
    Bounds all{Vec3::Constant(kNever), Vec3::Constant(-kNever)};
    for (std::size_t i = 0; i < extents_.size(); ++i) {
      if (!extents_[i].moving) continue;
      const Vec3 x = paths_[i].positionAt(t, accelerationOf(static_cast<int>(i)).mean);
      all = {all.low.cwiseMin(x), all.high.cwiseMax(x)};
    }
    const Vec3 size = (all.high - all.low).cwiseMax(2 * radius);
    const double spacing = elementary::cbrt(size.prod() / static_cast<double>(moving_));
    // a box of half size h has about (4 h / spacing)^3 neighbours; on the mean half of the range is in use
    range_ = std::max(2 * (0.6 * spacing - radius), 0.25 * radius);
    return;
  }
  std::size_t total = 0;
  for (std::size_t i = 0; i < extents_.size(); ++i) total += lists_[i].size();
  const double length = static_cast<double>(total) / static_cast<double>(moving_);
  // a list is as long as a box of about range + radius is large
  const double factor = std::clamp(elementary::cbrt(kListLength / std::max(length, 0.1)), 0.5, 2.0);
  range_ = std::max(factor * (range_ + radius) - radius, 0.1 * radius);
}

}  // namespace carom::ode_bridge_detail
