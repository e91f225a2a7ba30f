// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "adjoint/motion/guard.hpp"
#include "adjoint/motion/rim_geometry.hpp"
#include "adjoint/numeric/so3.hpp"
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
// A body whose rim tilts by less than this share of what gravity would make of it stays flat.
constexpr double kStaysFlat = 1e-9;
// The heights of a rim that begins to tilt differ by so much, m for bodies of 1 m: less than is known of them, more than their rounding.
constexpr double kBeginsTilted = 5e-14;
// Where on its rim a body begins to tip: what it turns towards the point is less than this share of g/rho, in so many rounds, and it is no
// further than this from where it was looked for, rad.
constexpr double kTipsAt = 1e-12, kFurthestTurn = 1.2, kTurns = 0.1;
constexpr int kTipRounds = 60;
// Marks and crossings that a rim has to stand on to lie flat.
constexpr std::size_t kFewestMarks = 3;
// Normals this alike are those of one plane.
constexpr double kOnePlane = 1e-9;

}  // namespace

// Whether it is a rim itself that touches a face, not a mark of it.
bool Simulator::isRim(const Contact& c) const {
  const auto rim = rimOf(motion_, c);
  return rim && rim->features == c.features;
}

// Whether a contact is at the rim of `of`, as a mark, or where the rim crosses the border of the face, in the plane of that face: all that
// stands still is one ground, be it of one body or of several.
bool Simulator::isOnRim(const Contact& c, const Contact& of) const {
  const auto rim = rimOf(motion_, of);
  if (!rim) return false;
  const int body = rim->of_first ? of.a : of.b;
  if (c.a != body && c.b != body) return false;
  const bool first = c.a == body;
  const auto* rims = dynamic_cast<const RimGeometry*>(motion_.geometry.get());
  if (rims->rimOfBody(c.a, c.b, c.features, first) != (rim->of_first ? rim->features.a : rim->features.b)) return false;
  return ((first ? 1 : -1) * c.at.normal - (rim->of_first ? 1 : -1) * of.at.normal).norm() <= kOnePlane;
}

bool Simulator::liesFlat(const PredictedEvent& p, double time) {
  Contact c;
  c.a = p.a, c.b = p.b, c.features = p.features;
  return rimLiesFlat(motion_, c, poseAt(p.a, time), poseAt(p.b, time));
}

// Those of the event that stand for the rim of a contact, its marks first.
std::vector<Contact> Simulator::marksOf(const Contact& of) const {
  std::vector<Contact> marks;
  for (const bool crossing : {false, true})
    for (const Contact& c : draft_.event.contacts)
      if (crossing != rimOf(motion_, c).has_value() && !isRim(c) && isOnRim(c, of)) marks.push_back(c);
  return marks;
}

// On the face of the first of these on which there is one.
std::optional<Simulator::Lowest> Simulator::lowestOf(const std::vector<Contact>& marks, int body, const State& state,
                                                     const State& moves) const {
  for (const Contact& mark : marks)
    if (std::optional<Lowest> lowest = lowestOf(mark, body, state, moves)) return lowest;
  return std::nullopt;
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
void Simulator::resolveFlat(const BodyContactState& from, int body) {
  Event& event = draft_.event;
  const Contact rim = from.held[index(from.why.contact)];
  std::erase_if(contact_states_[index(body)].held, [&](const Contact& c) { return isOnRim(c, rim); });
  for (Contact& c : contactsAt(from, event.time, event.time, 0))
    if (c.approach <= scaleOf(c.a, c.b, event.time).neither()) event.contacts.push_back(std::move(c));
  event.kind = EventKind::impact;
  const std::vector<Contact> marks = marksOf(rim);
  if (marks.size() < kFewestMarks)
    giveUp("contact", rim.a, rim.b, event.time, NotComputable("its cap lands on too little of the face to support it"));
  const State before = snapshots_[snapshot(body, event.time)].state;
  const auto add = [&](const Lowest& lowest) -> Contact& {
    const Kinematics k = arcOf(body).kinematicsOf(before);
    Contact& c = event.contacts.emplace_back(lowest.at);
    c.approach = (c.a == body ? 1.0 : -1.0) * c.at.normal.dot(k.v + k.w.cross(c.at.point - k.x));
    return c;
  };
  State backwards = before;
  backwards.L = -backwards.L;
  const std::optional<Lowest> held = lowestOf(marks, body, before, backwards);
  const double radius = rimOf(motion_, rim)->radius;
  const auto isMark = [&](const Vec3& point) {
    return std::ranges::any_of(marks, [&](const Contact& mark) {
      return (mark.at.point - point).norm() <= kOneMark * radius;
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
  const std::optional<Lowest> after = lowestOf(marks, body, before, stateAfter(body)), opposite = lowestOf(marks, body, before, before);
  if (!after || !opposite || !(after->at.approach < -kGoesDown * after->tilts)) return;
  std::erase_if(event.contacts, [&](const Contact& c) { return isRim(c) && isOnRim(c, rim); });
  add(*opposite);
  solve();
}

// A rim that stands on its marks needs no point of its own.
void Simulator::dropFlatRims(std::vector<Contact>& closed) const {
  const std::vector<Contact> all = closed;
  std::erase_if(closed, [&](const Contact& c) {
    return isRim(c) && std::ranges::any_of(all, [&](const Contact& mark) {
      return rimOf(motion_, mark) && !isRim(mark) && isOnRim(mark, c);
    });
  });
}

// The point of a rim that lies flat which goes down as its body begins to turn with `alpha`, from no turn; `tilted`: the body is, by
// less than is known of it, so that this is its lowest point.
std::optional<Simulator::Lowest> Simulator::tipsOver(const std::vector<Contact>& marks, int body, const State& flat, const Vec3& alpha,
                                                     State& tilted) const {
  const BodyModel& model = (*motion_.models)[index(body)];
  const Mat3 R = flat.q.toRotationMatrix();
  const auto rim = rimOf(motion_, marks.front());
  if (!rim || !(alpha.norm() > 0)) return std::nullopt;
  State moves = flat;
  const Vec3 turns = std::sqrt(scene_.gravity.norm() / rim->radius) * alpha.normalized();
  moves.L = R * model.inertia.cwiseProduct(R.transpose() * turns);
  std::optional<Lowest> lowest = lowestOf(marks, body, flat, moves);
  if (!lowest) return std::nullopt;
  const double size = std::max(1.0, flat.x.cwiseAbs().maxCoeff());
  const Vec3 turn = kBeginsTilted * size / rim->radius * alpha.normalized();
  tilted = flat;
  tilted.q = (expSO3(turn) * flat.q).normalized();
  lowest->at.lasts = lowest->at.held = true;
  return lowest;
}

// The root of a function that may have no value; that which is found first in steps to both sides of 0.
template <class F>
std::optional<double> rootNear0(const F& of, double small) {
  std::array<double, 2> at = {0, 0};
  const std::optional<double> first = of(0);
  if (!first) return std::nullopt;
  std::array<double, 2> value = {*first, *first};
  for (double far = kTurns; far < kFurthestTurn; far += kTurns)
    for (const std::size_t side : {0u, 1u}) {
      const double turn = side == 0 ? far : -far;
      const std::optional<double> there = of(turn);
      if (!there) continue;
      if (*there * value[side] > 0) {
        at[side] = turn, value[side] = *there;
        continue;
      }
      double low = at[side], high = turn, f_low = value[side], f_high = *there;
      for (int round = 0; round < kTipRounds; ++round) {  // the chord, with halving where it is slow
        const double next = round % 3 == 2 ? 0.5 * (low + high) : low - f_low * (high - low) / (f_high - f_low);
        const std::optional<double> f = of(next);
        if (!f || std::abs(*f) <= small) return f ? std::optional(next) : std::nullopt;
        (*f * f_low > 0 ? low : high) = next;
        (*f * f_low > 0 ? f_low : f_high) = *f;
      }
      return std::nullopt;
    }
  return std::nullopt;
}

// A body that stands flat on a rim and begins to tip does so about the point of the rim that goes down: marks to both sides of it would
// let that point into the face. Which point it is follows from how the body begins to turn, and that from the point: where both
// agree the turn has no part towards it. None where it goes on flat, or the point hangs over the border of the face.
std::optional<ContactChoice> Simulator::beginTilt(std::vector<Contact>& closed, int body, State& after, const ContactChoice& flat) const {
  const auto stands = std::ranges::find_if(closed, [&](const Contact& c) {
    const auto rim = rimOf(motion_, c);
    return rim && !isRim(c) && (rim->of_first ? c.a : c.b) == body;
  });
  if (stands == closed.end()) return std::nullopt;
  const Contact mark = *stands;
  const std::vector<Contact> marks = marksOf(mark);
  const Vec3 n = (mark.a == body ? 1.0 : -1.0) * mark.at.normal;
  const auto alongFace = [&](const Vec3& v) { return Vec3(v - n.dot(v) * n); };
  const double radius = rimOf(motion_, mark)->radius, most = scene_.gravity.norm() / radius, least = kStaysFlat * most;
  Vec3 alpha = alongFace(flat.modes.spin_rate);
  if (marks.size() < kFewestMarks || lowestOf(marks, body, after, after) || !(alpha.norm() > least)) return std::nullopt;
  std::vector<Contact> others = closed;
  std::erase_if(others, [&](const Contact& c) { return isOnRim(c, mark); });
  ContactChoice choice;
  std::vector<Contact> at;
  State tilted;
  // What follows has of a turn towards the point; none where nothing follows, rad/s^2.
  const auto missAt = [&](double turn) -> std::optional<double> {
    const Vec3 about = expSO3(Vec3(turn * n)) * alpha;
    const std::optional<Lowest> lowest = tipsOver(marks, body, after, about, tilted);
    if (!lowest) return std::nullopt;
    at = others;
    at.push_back(lowest->at);
    choice = tiltingPathOf(motion_, body, tilted, pointersTo(marks), pointersTo(at), draft_.event.time, hintOf(at));
    if (!choice.path || choice.path->form != PathForm::held || !choice.beyond.empty()) return std::nullopt;
    return n.dot(about.normalized().cross(choice.modes.spin_rate));
  };
  const std::optional<double> turn = rootNear0(missAt, kTipsAt * most);
  const std::optional<double> miss = turn ? missAt(*turn) : std::nullopt;
  if (!miss || !(std::abs(*miss) <= kTipsAt * most)) return std::nullopt;
  if (!(choice.modes.spin_rate.dot(expSO3(Vec3(*turn * n)) * alpha) > least * alpha.norm())) return std::nullopt;
  closed = std::move(at), after = tilted;
  return tiltingPathOf(motion_, body, after, pointersTo(marks), pointersTo(closed), draft_.event.time, hintOf(closed));
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
      if (isRim(mark) || !isOnRim(mark, c)) continue;
      mark.counted = false;
      mark.kept = true;
      mark.pair.elasticity = 0;
      event.contacts.insert(event.contacts.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(mark));
      more = true;
    }
    for (Contact& at : event.contacts) {
      if (!isOnRim(at, c) || at.captured || at.kept) continue;
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
    std::optional<Lowest> lowest = lowestOf(marks, body, flat, flat);
    if (!lowest || !(std::abs(lowest->at.approach) <= kGoesDown * lowest->tilts)) continue;
    lowest->at.lasts = true;
    after = flat;
    std::erase_if(closed, [&](const Contact& other) { return isOnRim(other, lowest->at); });
    closed.push_back(lowest->at);
    return marks;
  }
  dropFlatRims(closed);
  return {};
}

}  // namespace carom::adjoint_detail
