// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/motion/body_geometry.h"
#include "adjoint/simulate/simulator.hpp"

// What stands still is one ground: contacts with fixed bodies that lie flush. And supports that move.

namespace carom::adjoint_detail {
namespace {

// Contacts at one place, as a share of the size of positions (Simulator::sizeAt), with one normal.
constexpr double kSameSpot = 1e-9, kSameWay = 1e-9;
// A face that goes on bends by no more.
constexpr double kStraightOn = 1e-3;
// What is as near to a border as this share of that lies on it.
constexpr double kOnBorder = 1e-11;

}  // namespace

// The pairs that hold a body, and those of it and the fixed bodies that its faces may go on with.
std::vector<std::pair<int, int>> Simulator::persistentPairs(const BodyContactState& from) {
  std::vector<std::pair<int, int>> pairs;
  const auto add = [&](int a, int b) {
    const std::pair pair{std::min(a, b), std::max(a, b)};
    if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
  };
  for (const Contact& h : from.held) add(h.a, h.b);
  const int body = isMoved(from.held.front().a) ? from.held.front().a : from.held.front().b;
  for (const Contact& h : from.held)
    for (int beside : contacts_.groundBeside(body == h.a ? h.b : h.a)) add(body, beside);
  std::vector<int> near;
  contacts_.neighbours(body, near);
  for (int other : near)
    if (isFixed(other)) add(body, other);
  return pairs;
}

// Whether a contact with another fixed body than those that hold a body goes on with a face that holds it.
bool Simulator::onSameFace(const BodyContactState& from, const Contact& c) const {
  return std::ranges::any_of(from.held, [&](const Contact& h) {
    if (h.a == c.a && h.b == c.b) return true;
    const Vec3 n = isMoved(h.a) ? h.at.normal : Vec3(-h.at.normal), m = isMoved(c.a) ? c.at.normal : Vec3(-c.at.normal);
    return (n - m).norm() <= kStraightOn;
  });
}

// The size of positions there, m: of the place, or of the body that is moved.
double Simulator::sizeAt(const Contact& c) const {
  return std::max(c.at.point.norm(), scales_.radius(isMoved(c.a) ? c.a : c.b));
}

BorderMotion Simulator::borderMotion(const Contact& c, const FeatureLimit& limit) {
  const Kinematics &a = snapshots_[snapshot(c.a, draft_.event.time)].k, &b = snapshots_[snapshot(c.b, draft_.event.time)].k;
  const ContactMotion moves = motion_.geometry->motion(c.a, c.b, c.features, {a.x, a.R}, {b.x, b.R}, {a.v, a.w}, {b.v, b.w});
  const Kinematics& of = limit.body == c.a ? a : b;
  const Vec3 weight = of.R * limit.point_weight, way = of.R * limit.normal_weight;
  const Vec3 point_rate = moves.point_rate - of.v - of.w.cross(c.at.point - of.x), normal_rate = moves.normal_rate - of.w.cross(c.at.normal);
  return {limit.point_weight.dot(of.R.transpose() * (c.at.point - of.x) - limit.border) + way.dot(c.at.normal),
          weight.dot(point_rate) + way.dot(normal_rate), point_rate.norm()};
}

// Whether the place of a contact is at a border of the fixed body's feature, or of one that moves, and leaves it.
bool Simulator::isLeaving(const Contact& c, bool of_moving) {
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  if (!bodies) return false;
  const Kinematics &a = snapshots_[snapshot(c.a, draft_.event.time)].k, &b = snapshots_[snapshot(c.b, draft_.event.time)].k;
  return std::ranges::any_of(bodies->limits(c.a, c.b, c.features, {a.x, a.R}, {b.x, b.R}), [&](const FeatureLimit& limit) {
    if (!isFixed(limit.body) && (!of_moving || limit.radius > 0 || limit.point_weight.isZero(0))) return false;
    const BorderMotion moves = borderMotion(c, limit);
    return std::abs(moves.inside) <= kOnBorder * sizeAt(c) && moves.rate < 0;
  });
}

// Whether two contacts of a body with fixed ones are one.
bool Simulator::isDouble(const Contact& c, const Contact& d) const {
  if (isFixed(c.a) == isFixed(c.b) || isFixed(d.a) == isFixed(d.b)) return false;
  const bool first_c = isFixed(c.b), first_d = isFixed(d.b);
  if ((first_c ? c.a : c.b) != (first_d ? d.a : d.b) || (c.a == d.a && c.b == d.b)) return false;
  const Vec3 n = first_c ? c.at.normal : Vec3(-c.at.normal), m = first_d ? d.at.normal : Vec3(-d.at.normal);
  return (n - m).norm() <= kSameWay && (c.at.point - d.at.point).norm() <= kSameSpot * sizeAt(c);
}

// Of contacts that are one, that with what the body slides towards is kept, else that with the body listed first; or the
// earlier one in any case.
void Simulator::dropDoubles(std::size_t first, bool keep_earlier) {
  std::vector<Contact>& contacts = draft_.event.contacts;
  for (std::size_t i = first; i < contacts.size(); ++i)
    for (std::size_t j = i + 1; j < contacts.size();) {
      if (!isDouble(contacts[i], contacts[j])) {
        ++j;
        continue;
      }
      const auto listed = [&](const Contact& c) { return isFixed(c.b) ? c.b : c.a; };
      const auto isBetter = [&] {
        const bool leaves_i = isLeaving(contacts[i]), leaves_j = isLeaving(contacts[j]);
        return leaves_i != leaves_j ? leaves_i : listed(contacts[j]) < listed(contacts[i]);
      };
      const bool swap = !keep_earlier && isBetter();
      if (swap) contacts[i] = contacts[j];
      contacts.erase(contacts.begin() + static_cast<std::ptrdiff_t>(j));
      if (swap) j = i + 1;
    }
}

// Supports that move take part in what changes contacts with them, and stay as they are.
void Simulator::addCarriers() {
  Event& event = draft_.event;
  for (const Contact& c : event.contacts)
    for (const int body : {c.a, c.b}) {
      if (isMoved(body) || isFixed(body) || std::ranges::find(bodies_, body) != bodies_.end()) continue;
      const State& now = snapshots_[snapshot(body, event.time)].state;
      bodies_.push_back(body);
      event.participants.push_back({body, static_cast<int>(motion_.world_lines[index(body)].arcs.size()) - 1, 0, now, true});
      if (event.kind == EventKind::transition) draft_.after.push_back(now);  // there is no law that gives it
    }
}

}  // namespace carom::adjoint_detail
