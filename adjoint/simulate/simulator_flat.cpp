// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "adjoint/simulate/simulator.hpp"

// Rims that lie flat on a face: where a body that rocks comes down on its cap, and how it goes on from there (11.26).

namespace carom::adjoint_detail {
namespace {

// A rim whose heights differ by less lies flat, m for bodies of 1 m (docs/collision.md).
constexpr double kLiesFlat = 4e-13;
// Its lowest point goes down where it does so with more than this share of the speed with which the rim tilts.
constexpr double kGoesDown = 1e-9;
// A rim that tilts more slowly than this share of what the lowest bounce falls with stays where it is.
constexpr double kTiltsNot = 1e-3;
// A place on a rim is that of a mark, to this share of its size: what goes down there does so by less than the share above.
constexpr double kOneMark = 1e-5;
// Marks that a rim has to stand on to lie flat.
constexpr std::size_t kFewestMarks = 3;

}  // namespace

bool Simulator::isSameRim(const Contact& c, const Contact& d) const {
  if (c.a != d.a || c.b != d.b) return false;
  const auto first = rimOf(motion_, c), second = rimOf(motion_, d);
  return first && second && first->of_first == second->of_first && first->features == second->features;
}

bool Simulator::liesFlat(const Prediction& p, double time) {
  Contact c;
  c.a = p.a, c.b = p.b, c.features = p.features;
  return rimLiesFlat(motion_, c, poseAt(p.a, time), poseAt(p.b, time));
}

// Those of the event that stand for the rim of a contact.
std::vector<Contact> Simulator::marksOf(const Contact& of) const {
  const auto rim = rimOf(motion_, of);
  std::vector<Contact> marks;
  for (const Contact& c : draft_.event.contacts)
    if (rim && !(c.features == rim->features) && isSameRim(c, of)) marks.push_back(c);
  return marks;
}

// Of a body at `state` whose rim lies flat: the point of the rim that goes down as it moves like `moves`; none where the rim
// does not tilt, or where that point hangs over the border of the face.
std::optional<Simulator::Lowest> Simulator::lowestOf(const Contact& of, int body, const State& state, const State& moves) const {
  const auto rim = rimOf(motion_, of);
  if (!rim || (rim->of_first ? of.a : of.b) != body) return std::nullopt;
  const BodyModel& model = (*motion_.models)[index(body)];
  const int other = of.a == body ? of.b : of.a;
  const State& stands = motion_.world_lines[index(other)].arcs.back().startState();
  const Pose own = shapePose(motion_, body, state), face = shapePose(motion_, other, stands);
  const Vec3 d = own.R * rim->axis, N = face.R * rim->normal, center = own.x + own.R * rim->center;
  const Vec3 omega = model.inverseInertiaWorld(moves.q.toRotationMatrix()) * moves.L;
  const Vec3 rate = RimOnFace::tilt(omega.cross(d), N);
  const double size = std::max(1.0, state.x.cwiseAbs().maxCoeff());
  if (2 * rim->radius * RimOnFace::tilt(d, N).norm() > kLiesFlat * size) return std::nullopt;
  const double pull = motion_.lowest_bounce * scene_.gravity.norm();
  if (!(2 * rim->radius * rate.norm() > kTiltsNot * std::sqrt(2 * pull))) return std::nullopt;
  Lowest found{of, 2 * rim->radius * rate.norm()};
  Contact& lowest = found.at;
  lowest.features = rim->features;
  lowest.held = lowest.lasts = lowest.kept = lowest.captured = false;
  lowest.impulse = Vec3::Zero();
  lowest.pair = builder_.pairOf(of.a, of.b);
  lowest.at.gap = 0;
  lowest.at.point = center + rim->radius * d.cross(Vec3(rate.normalized()));
  if (const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get()))
    for (const FeatureLimit& limit : bodies->limits(of.a, of.b, of.features, of.a == body ? own : face, of.a == body ? face : own)) {
      if (limit.body != other || limit.point_weight.isZero(0)) continue;
      const Vec3 at = face.R.transpose() * (lowest.at.point - face.x);
      const Vec3 to = at - (limit.border + limit.radius * limit.point_weight);
      const double room = limit.radius > 0 ? limit.radius - (to - limit.axis.dot(to) * limit.axis).norm()
                                           : limit.point_weight.dot(at - limit.border);
      if (!(room >= 0)) return std::nullopt;
    }
  const Vec3 n = (of.a == body ? 1.0 : -1.0) * of.at.normal;
  lowest.approach = n.dot(moves.v + omega.cross(lowest.at.point - state.x));
  lowest.impulse_normal = lowest.at.normal;
  return found;
}

// A rim that held the body has come to lie flat: its cap lands, on the marks of the rim beside the point that it was held at; or,
// where the body goes over, on these and the point opposite.
void Simulator::resolveFlat(const Onward& from, int body) {
  Event& event = draft_.event;
  const Contact rim = from.held[index(from.why.contact)];
  std::erase_if(onward_[index(body)].held, [&](const Contact& c) { return isSameRim(c, rim); });
  for (Contact& c : contactsAt(from, event.time, event.time, 0))
    if (c.approach <= scaleOf(c.a, c.b, event.time).neither()) event.contacts.push_back(std::move(c));
  event.kind = EventKind::impact;
  const std::vector<Contact> marks = marksOf(rim);
  if (marks.size() < kFewestMarks)
    giveUp("contact", rim.a, rim.b, event.time, NotComputable("its cap comes down on less of the face than carries it"));
  const State before = snapshots_[snapshot(body, event.time)].state;
  const auto add = [&](const Lowest& lowest) -> Contact& {
    const Kinematics k = arcOf(body).kinematicsOf(before);
    Contact& c = event.contacts.emplace_back(lowest.at);
    c.approach = (c.a == body ? 1.0 : -1.0) * c.at.normal.dot(k.v + k.w.cross(c.at.point - k.x));
    return c;
  };
  State backwards = before;
  backwards.L = -backwards.L;
  const std::optional<Lowest> held = lowestOf(marks.front(), body, before, backwards);
  const auto isMark = [&](const Vec3& point) {
    return std::ranges::any_of(marks, [&](const Contact& mark) {
      return (mark.at.point - point).norm() <= kOneMark * (marks.front().at.point - marks.back().at.point).norm();
    });
  };
  if (held && !isMark(held->at.at.point)) {
    Contact& c = add(*held);
    c.held = true, c.counted = false;
  }
  const auto solve = [&] {
    do {
      solveDraft();
      predictDraft();
    } while (joinInstant());
  };
  solve();
  const std::optional<Lowest> after = lowestOf(marks.front(), body, before, stateAfter(body)),
                              opposite = lowestOf(marks.front(), body, before, before);
  if (!after || !opposite || !(after->at.approach < -kGoesDown * after->tilts)) return;
  std::erase_if(event.contacts, [&](const Contact& c) { return c.features == rim.features && isSameRim(c, rim); });
  add(*opposite);
  solve();
}

// A rim that stands on its marks needs no point of its own.
void Simulator::dropFlatRims(std::vector<Contact>& closed) const {
  const std::vector<Contact> all = closed;
  std::erase_if(closed, [&](const Contact& c) {
    const auto rim = rimOf(motion_, c);
    return rim && c.features == rim->features && std::ranges::any_of(all, [&](const Contact& mark) {
      return !(mark.features == c.features) && isSameRim(mark, c);
    });
  });
}

// Of a rim that all but lies flat: where its tilt and what is left of tilting have no more energy than a fall from the lowest bounce,
// all of its marks part without speed (11.27). True where there are more of them than before.
bool Simulator::settlesFlat() {
  Event& event = draft_.event;
  const double lowest = motion_.lowest_bounce;
  bool more = false;
  for (std::size_t i = 0; i < event.contacts.size(); ++i) {
    const Contact c = event.contacts[i];
    const auto rim = rimOf(motion_, c);
    if (!rim) continue;
    const int body = rim->of_first ? c.a : c.b, other = rim->of_first ? c.b : c.a;
    if (!isMoved(body) || !isFixed(other)) continue;
    const Pose own = shapePose(motion_, body, stateAfter(body)), face = shapePose(motion_, other, stateAfter(other));
    const BodyModel& model = (*motion_.models)[index(body)];
    const Vec3 N = face.R * rim->normal;
    const double height = rim->radius * RimOnFace::tilt(own.R * rim->axis, N).norm();
    const double pull = -model.gravity_factor * N.dot(scene_.gravity);
    if (!(height <= lowest && pull > 0)) continue;
    const Kinematics k = arcOf(body).kinematicsOf(stateAfter(body));
    const Vec3 tilts = k.w - N.dot(k.w) * N, R_tilts = stateAfter(body).q.inverse() * tilts;
    const double rises = N.dot(k.v), moving = 0.5 * R_tilts.dot(model.inertia.cwiseProduct(R_tilts)) + 0.5 * model.mass * rises * rises;
    if (!(model.mass * pull * height + moving <= model.mass * pull * lowest)) continue;
    for (const FeaturePair& f : contacts_.touching(c.a, c.b, arcOf(c.a), arcOf(c.b), event.time, 4 * lowest)) {
      if (inDraft(c.a, c.b, f)) continue;
      Contact mark = makeContact(event.time, c.a, c.b, f);
      if (!isSameRim(mark, c)) continue;
      mark.counted = false;
      mark.kept = true;
      mark.pair.elasticity = 0;
      event.contacts.insert(event.contacts.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(mark));
      more = true;
    }
    for (Contact& at : event.contacts) {
      if (!isSameRim(at, c) || at.captured || at.kept) continue;
      (at.held || !(at.approach < 0) ? at.kept : at.captured) = true;
      at.pair.elasticity = 0;
      more = true;
    }
  }
  return more;
}

// Where contacts of a rim that lies flat do not keep it so it goes on about its lowest point, which takes the place of its marks
// among `closed`, from where it lies. Gives these marks; none where nothing tilts.
std::vector<Contact> Simulator::tiltFrom(std::vector<Contact>& closed, int body, State& after) const {
  for (const Contact& c : closed) {
    if (!lowestOf(c, body, after, after)) continue;
    std::vector<Contact> marks = marksOf(c);
    if (marks.size() < kFewestMarks) continue;
    State flat = after;
    closeGaps(motion_, body, flat, marks);
    std::optional<Lowest> lowest = lowestOf(marks.front(), body, flat, flat);
    if (!lowest || !(std::abs(lowest->at.approach) <= kGoesDown * lowest->tilts)) continue;
    lowest->at.lasts = true;
    after = flat;
    std::erase_if(closed, [&](const Contact& other) { return isSameRim(other, lowest->at); });
    closed.push_back(lowest->at);
    return marks;
  }
  dropFlatRims(closed);
  return {};
}

}  // namespace carom::adjoint_detail
