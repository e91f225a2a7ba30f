// SPDX-License-Identifier: MIT
#include "ode_bridge/first_impact.hpp"
#include "ode_bridge/ode_contacts_state.hpp"
#include "ode_bridge/touching.hpp"

// What stands still is one ground: searches beside contacts with fixed bodies that lie flush.

namespace carom {
namespace {

// Normals this alike are those of one plane.
constexpr double kPlaneOfGround = 1e-9;
// What has parts below a plane comes this far below it, as a share of its size and of that of positions.
constexpr double kPartBelow = 1e-9;
// Room for the tolerance of contact, in so many of it.
constexpr double kPlaneRoom = 100;

}  // namespace

void OdeContacts::State::takeGround(const std::vector<Arc>& arcs, const std::vector<BodyExtent>& extents) {
  std::vector<Ground::Standing> standing;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const BodyExtent& e = extents[i];
    if (!arcs[i].stays()) continue;
    const Kinematics k = arcs[i].kinematicsAt(arcs[i].start());
    standing.push_back({static_cast<int>(i), e.half_space, e.box, e.normal, e.offset, Placed(geometry->solids()[i], k.x, k.R)});
  }
  ground.begin(arcs.size(), std::move(standing));
}

// Whether all of a fixed body, or a part of it, lies on the other side of the plane through p across n than what is held there.
bool OdeContacts::State::mayBeBeyond(int body, const Vec3& n, const Vec3& p, double room) const {
  const BodyExtent& e = neighbours.extents()[static_cast<std::size_t>(body)];
  if (e.half_space) return (e.normal - n).norm() <= kPlaneOfGround && e.offset <= n.dot(p) + room;
  const Placed& standing = *ground.placedOf(body);
  if (standing.solid->pieces.size() == 1) {
    const PlacedPiece piece{&standing, &standing.solid->pieces[0]};
    return extentAlong(piece, n) + piece.piece->radius + n.dot(standing.k.x - p) <= room;
  }
  const Vec3 lowest = (n.array() > 0).select(e.box.low, e.box.high);
  return n.dot(lowest - p) <= -kPartBelow * (standing.solid->bound() + p.norm());
}

std::optional<PredictedImpact> OdeContacts::firstImpactOnGround(int a, int b, std::span<const PersistentFeatures> held, Arc& arc_a,
                                                                Arc& arc_b, double from, double until) {
  for (int body : {a, b}) state_->checkedBody("firstImpactOnGround", body);
  for (double t : {from, until}) checkedNumber("firstImpactOnGround", "the time", t);
  const bool moves_a = !arc_a.stays();
  const int moving = moves_a ? a : b, fixed = moves_a ? b : a;
  Arc& arc = moves_a ? arc_a : arc_b;
  std::vector<FeaturePair> own;
  std::vector<ConstrainedElsewhere> elsewhere;
  arc.extendTo(from);
  for (const PersistentFeatures& h : held) {
    state_->checkedBody("firstImpactOnGround", h.a), state_->checkedBody("firstImpactOnGround", h.b);
    state_->geometry->checkFeatures(h.a, h.b, h.features);
    if (h.a == a && h.b == b) {
      own.push_back(h.features);
      continue;
    }
    const bool first = h.a == moving;
    const Placed* with = state_->ground.placedOf(first ? h.b : h.a);
    if (!with || (!first && h.b != moving)) continue;
    const Placed body(state_->geometry->solid(moving), arc, from);
    const ContactPoint c = first ? contactAt(body, *with, h.features) : contactAt(*with, body, h.features);
    if (state_->mayBeBeyond(fixed, first ? c.normal : Vec3(-c.normal), c.point, kPlaneRoom * touchTolerance(body, *with)))
      elsewhere.push_back({with, h.features, first});
  }
  if (elsewhere.empty())
    return own.empty() ? firstImpact(a, b, arc_a, arc_b, from, until)
                       : firstImpactBeside(a, b, own, arc_a, arc_b, from, until);
  const auto isQuickBody = [&](int body) { return isQuick(state_->quick[static_cast<std::size_t>(body)]); };
  if (isQuickBody(a) && isQuickBody(b)) {  // a ball that rolls on in the plane
    const Placed at_a(state_->geometry->solid(a), arc_a, from), at_b(state_->geometry->solid(b), arc_b, from);
    if (!own.empty() || PersistentPlanes(at_a, at_b, own, elsewhere, moves_a).keepApart(0, 0)) return std::nullopt;
    return firstImpact(a, b, arc_a, arc_b, from, until);
  }
  return findFirstImpact({a, b, *state_->geometry, state_->narrow_phase, arc_a, arc_b, work(), state_->ground.besideOf(a, b)},
                         from, until, own, elsewhere);
}

std::span<const int> OdeContacts::groundBeside(int body) const {
  state_->checkedBody("groundBeside", body);
  return state_->ground.beside(body);
}

}  // namespace carom
