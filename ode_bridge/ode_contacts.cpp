// SPDX-License-Identifier: MIT
#include "ode_bridge/ode_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "ode_bridge/first_impact.hpp"
#include "ode_bridge/ode_contacts_state.hpp"
#include "ode_bridge/overlap.hpp"
#include "ode_bridge/parting.hpp"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/touching.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

// Bodies that are no further apart than this many tolerances of contact at the start are placed in contact.
constexpr double kPlaced = 10;

constexpr std::size_t kMostOverlaps = 100'000;

// The box that a solid stands in, with room for rounding and for the tolerance of contact.
Bounds standingBounds(const Solid& solid, const Kinematics& k) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Bounds bounds{Vec3::Constant(kInfinite), Vec3::Constant(-kInfinite)};
  const auto furthest = [&](const Piece& piece, const Vec3& direction) {
    return direction.dot(k.x + k.R * supportOf(solid, piece, k.R.transpose() * direction).at) + piece.radius;
  };
  for (const Piece& piece : solid.pieces)
    for (int axis = 0; axis < 3; ++axis) {
      bounds.high[axis] = std::max(bounds.high[axis], furthest(piece, Vec3::Unit(axis)));
      bounds.low[axis] = std::min(bounds.low[axis], -furthest(piece, -Vec3::Unit(axis)));
    }
  return grown(bounds, roundingRoom(bounds));
}

BodyExtent extentOf(const Solid& solid, const Arc& arc) {
  BodyExtent e;
  e.moving = arc.moving();
  e.gravity_factor = arc.model().gravity_factor;
  const Kinematics k = arc.kinematicsAt(arc.start());
  if (solid.plane) {
    e.half_space = true;
    e.normal = k.R * solid.faces[0].direction;
    e.offset = e.normal.dot(k.x) + solid.faces[0].point.dot(solid.faces[0].direction);
    return e;
  }
  e.radius = solid.ball ? solid.vertices[0].radius : solid.bound();
  e.box = standingBounds(solid, k);
  return e;
}

}  // namespace

OdeContacts::OdeContacts() : state_(std::make_unique<State>()) {}

OdeContacts::OdeContacts(const Scene& scene, WorkCount* work) : OdeContacts() {
  countIn(work);
  take(scene);
  countIn(nullptr);
  for (const StartOverlap& o : state_->overlaps)
    state_->accepted.emplace(scene.bodies[static_cast<std::size_t>(o.a)].name,
                             scene.bodies[static_cast<std::size_t>(o.b)].name);
}

OdeContacts::~OdeContacts() = default;

void OdeContacts::begin(const Scene& scene) {
  take(scene);
  for (const StartOverlap& overlap : state_->overlaps)
    if (!state_->isAccepted(scene, overlap)) refuseOverlap(scene, overlap);
}

void OdeContacts::take(const Scene& scene) {
  validate(scene);
  const std::size_t n = scene.bodies.size();
  state_->takeSolids(scene);
  const std::vector<Solid>& solids = state_->geometry->solids();
  std::vector<BodyModel> models;
  models.reserve(n);
  for (const Body& body : scene.bodies) models.push_back(modelOf(body));
  std::vector<Arc> arcs;
  std::vector<BodyExtent> extents;
  arcs.reserve(n);
  state_->quick.assign(n, Quick::fixed);
  state_->varied.clear();
  state_->end = 0;
  state_->in_series.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    arcs.emplace_back(models[i], Tier::none, Vec3::Zero(), 0.0, startState(scene.bodies[i], models[i]));
    extents.push_back(extentOf(solids[i], arcs[i]));
    if (solids[i].plane) state_->quick[i] = Quick::plane;
    if (models[i].moving) state_->quick[i] = solids[i].ball ? Quick::ball : Quick::moving;
  }
  state_->takeGround(arcs, extents);
  state_->neighbours.begin(std::move(extents), scene.gravity, Neighbours::kFew, CollisionClasses(scene));
  state_->lookAtStart(arcs, work());
}

// Scenes that differ in causes alone, as those of an edit do, share the solids.
void OdeContacts::State::takeSolids(const Scene& scene) {
  const bool known = geometry && std::equal(sources.begin(), sources.end(), scene.bodies.begin(), scene.bodies.end(),
                                            [](const SolidSource& s, const Body& b) { return s.isOf(b); });
  if (known) return;
  std::vector<Solid> solids;
  solids.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) solids.push_back(solidOf(body));
  sources = std::vector<SolidSource>(scene.bodies.begin(), scene.bodies.end());
  geometry = std::make_shared<const FeatureGeometry>(std::move(solids));
  narrow_phase.reset(geometry->solids());
}

// Who overlaps, and who touches.
void OdeContacts::State::lookAtStart(const std::vector<Arc>& arcs, WorkCount* work) {
  overlaps.clear();
  placed.clear();
  std::vector<std::pair<int, int>> near;
  neighbours.pairs(near);
  std::sort(near.begin(), near.end());
  for (const auto& [first, second] : near) {
    const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
    const Placed a(geometry->solids()[i], arcs[i], 0), b(geometry->solids()[j], arcs[j], 0);
    const double tolerance = touchTolerance(a, b);
    if (const auto depth = overlapOf(a, b, kOverlap * tolerance, work)) {
      overlaps.push_back({first, second, *depth, std::nullopt});
    } else if (auto features = touchingFeatures(a, b, kPlaced * tolerance, ground.besideOf(first, second)); !features.empty()) {
      placed.push_back({first, second, std::move(features)});
    }
    if (overlaps.size() > kMostOverlaps)
      throw InputError("/bodies", "found more than " + std::to_string(kMostOverlaps) +
                                      " pairs of bodies that overlap at the start, expected fewer");
  }
}

bool OdeContacts::State::isAccepted(const Scene& scene, const StartOverlap& overlap) const {
  const auto name = [&](int body) -> const std::string& { return scene.bodies[static_cast<std::size_t>(body)].name; };
  return accepted.contains({name(overlap.a), name(overlap.b)}) || accepted.contains({name(overlap.b), name(overlap.a)});
}

std::vector<StartOverlap> OdeContacts::overlaps() const { return state_->overlaps; }

std::vector<PlacedContact> OdeContacts::placed() const { return state_->placed; }

std::optional<double> OdeContacts::parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) {
  for (int body : {a, b}) state_->checkedBody("parting", body);
  for (double t : {from, until}) checkedNumber("parting", "the time", t);
  return partingTime(state_->geometry->solid(a), state_->geometry->solid(b), arc_a, arc_b, from, until,
                     work());
}

void OdeContacts::setPath(int body, const Arc& arc, double from, double until) {
  state_->checkedBody("setPath", body);
  checkedNumber("setPath", "the time", from);
  checkedNumber("setPath", "the time", until);
  if (!arc.moving()) return;
  state_->end = std::max(state_->end, until);  // a path of one body that is known no further ends no other
  state_->opened = -1;
  state_->in_series[static_cast<std::size_t>(body)] = arc.tier() == Tier::triaxial;
  const carom::State& s = arc.startState();
  const Acceleration acceleration{arc.acceleration(), arc.accelerationVariation()};
  state_->neighbours.setPath(body, {s.x, s.v, arc.start(), 0}, acceleration, from, until);
  if (acceleration.variation > 0 || !state_->varied.empty()) state_->keepVaried(body, arc);
}

void OdeContacts::State::keepVaried(int body, const Arc& arc) {
  if (arc.accelerationVariation() > 0) {
    varied.insert_or_assign(body, arc);
  } else {
    varied.erase(body);
  }
}

// The lists know a parabola, which is left further behind the longer ago it began: it begins anew with each window.
void OdeContacts::State::placeVaried(int body, double t) {
  const auto place = [&](int other, const Arc& arc) {
    neighbours.renewPath(other, arc.positionAt(t), arc.velocityAt(t), t);
  };
  if (neighbours.renewsAll(t)) {
    for (const auto& [other, arc] : varied) place(other, arc);
  } else if (const auto own = varied.find(body); own != varied.end()) {
    place(body, own->second);
  }
}

double OdeContacts::window(int body, double t) {
  state_->checkedBody("window", body);
  checkedNumber("window", "the time", t);
  if (!state_->varied.empty()) state_->placeVaried(body, t);
  const double until = state_->neighbours.window(body, t);
  state_->opened = body;
  state_->opened_from = t;
  state_->opened_until = std::min(until, state_->end);
  return until;
}

void OdeContacts::neighbours(int body, std::vector<int>& out) {
  state_->checkedBody("neighbours", body);
  state_->neighbours.list(body, out);
  if (state_->opened == body) state_->keepThoseThatMayMeet(body, out);
}

// Those that the body can meet on its present path in its window, as far as bounding balls tell.
void OdeContacts::State::keepThoseThatMayMeet(int body, std::vector<int>& others) const {
  const FlightPath& path = neighbours.path(body);
  if (neighbours.accelerationOf(body).variation > 0) return;
  const Vec3 gravity = neighbours.accelerationOf(body).mean;
  const bool is_ball = quick[static_cast<std::size_t>(body)] == Quick::ball;
  const double t = opened_from, until = opened_until;
  // the paths lie all over the memory: they are fetched side by side rather than one after the other
  for (int other : others) __builtin_prefetch(&neighbours.path(other));
  BallNow ball{path.positionAt(t, gravity), path.velocityAt(t, gravity), path.radius};
  ball.radius += 1e-9 * (ball.x.cwiseAbs().maxCoeff() + ball.radius);  // the tolerance of contact, and rounding
  const auto apart = [&](int other) {
    const Quick kind = quick[static_cast<std::size_t>(other)];
    if (kind == Quick::fixed) return false;
    if (kind != Quick::plane) {
      if (!neighbours.sameAcceleration(body, other)) return false;  // nothing so simple is known of them
      // what is inside touching balls may meet while they part
      const Approach a = approachOf(ball, neighbours.path(other), gravity, t, until);
      return !(a.meet || (a.overlap && !(is_ball && kind == Quick::ball)));
    }
    const BodyExtent& plane = neighbours.extents()[static_cast<std::size_t>(other)];
    return !mayTouch(ball, gravity, plane.normal, plane.offset, t, until);
  };
  others.erase(std::remove_if(others.begin(), others.end(), apart), others.end());
}

// Undecided unless both are of the quick kinds.
BallImpact OdeContacts::State::quickImpact(int a, int b, double from, double until) const {
  const Quick qa = quick[static_cast<std::size_t>(a)], qb = quick[static_cast<std::size_t>(b)];
  if (!isQuick(qa) || !isQuick(qb)) return {BallImpact::Found::undecided, 0};
  if (qa == Quick::ball && qb == Quick::ball) {
    if (!neighbours.sameAcceleration(a, b)) return {BallImpact::Found::undecided, 0};
    return ballBallImpact(neighbours.path(a), neighbours.path(b), neighbours.accelerationOf(a).mean, from, until);
  }
  const int ball = qa == Quick::ball ? a : b;
  const Acceleration& acceleration = neighbours.accelerationOf(ball);
  if (acceleration.variation > 0) return {BallImpact::Found::undecided, 0};
  const BodyExtent& plane = neighbours.extents()[static_cast<std::size_t>(ball == a ? b : a)];
  return ballPlaneImpact(neighbours.path(ball), acceleration.mean, plane.normal, plane.offset, from, until);
}

// The only features that balls and planes can meet with.
FeaturePair OdeContacts::State::quickFeatures(int a, int b) const {
  const auto isPlane = [&](int body) { return quick[static_cast<std::size_t>(body)] == Quick::plane; };
  return {isPlane(a) ? kPlanePoint : isPlane(b) ? kPointPlane : kPointPoint, 0, 0, 1};
}

double OdeContacts::State::quickGap(int a, int b, const Arc& arc_a, const Arc& arc_b, double t) const {
  if (quick[static_cast<std::size_t>(a)] == Quick::plane) return quickGap(b, a, arc_b, arc_a, t);
  const BodyExtent &ball = neighbours.extents()[static_cast<std::size_t>(a)],
                   &other = neighbours.extents()[static_cast<std::size_t>(b)];
  if (other.half_space) return other.normal.dot(arc_a.positionAt(t)) - other.offset - ball.radius;
  return (arc_a.positionAt(t) - arc_b.positionAt(t)).norm() - ball.radius - other.radius;
}

std::optional<PredictedImpact> OdeContacts::firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                        double until) {
  for (int body : {a, b}) state_->checkedBody("firstImpact", body);
  for (double t : {from, until}) checkedNumber("firstImpact", "the time", t);
  const BallImpact quick = state_->quickImpact(a, b, from, until);
  if (quick.found == BallImpact::Found::none) return std::nullopt;
  if (quick.found == BallImpact::Found::impact) {
    const auto inSeries = [&](int body) { return state_->in_series[static_cast<std::size_t>(body)] != 0; };
    if (inSeries(a)) arc_a.extendTo(quick.time);
    if (inSeries(b)) arc_b.extendTo(quick.time);
    return PredictedImpact{quick.time, state_->quickFeatures(a, b)};
  }
  return findFirstImpact({a, b, *state_->geometry, state_->narrow_phase, arc_a, arc_b, work(), state_->ground.besideOf(a, b)}, from, until);
}

std::optional<PredictedImpact> OdeContacts::firstImpactBeside(int a, int b, std::span<const FeaturePair> held,
                                                              Arc& arc_a, Arc& arc_b, double from, double until) {
  for (int body : {a, b}) state_->checkedBody("firstImpactBeside", body);
  for (double t : {from, until}) checkedNumber("firstImpactBeside", "the time", t);
  for (const FeaturePair& f : held) state_->geometry->checkFeatures(a, b, f);
  const auto quick = [&](int body) { return isQuick(state_->quick[static_cast<std::size_t>(body)]); };
  if (!held.empty() && quick(a) && quick(b)) return std::nullopt;  // a ball touches a plane in one place only
  return findFirstImpact({a, b, *state_->geometry, state_->narrow_phase, arc_a, arc_b, work(), state_->ground.besideOf(a, b)}, from, until, held);
}

std::vector<FeaturePair> OdeContacts::touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t,
                                               double tolerance) {
  for (double number : {t, tolerance}) checkedNumber("touching", "the time or the tolerance", number);
  const auto quick = [&](int body) { return isQuick(state_->quick[state_->checkedBody("touching", body)]); };
  if (quick(a) && quick(b)) {
    const double gap = state_->quickGap(a, b, arc_a, arc_b, t);
    const auto touch = [&] {
      double size = 0;
      for (const auto& [body, arc] : {std::pair{a, &arc_a}, std::pair{b, &arc_b}})
        if (const BodyExtent& e = state_->neighbours.extents()[static_cast<std::size_t>(body)]; !e.half_space)
          size = std::max({size, arc->positionAt(t).cwiseAbs().maxCoeff(), e.radius});
      return kTouch * size;
    };
    if (gap > tolerance && gap > 4 * touch()) return {};
    return {state_->quickFeatures(a, b)};
  }
  const Placed placed_a(state_->geometry->solid(a), arc_a, t), placed_b(state_->geometry->solid(b), arc_b, t);
  return touchingFeatures(placed_a, placed_b, std::max(tolerance, 4 * touchTolerance(placed_a, placed_b)),
                          state_->ground.besideOf(a, b));
}

std::shared_ptr<const ContactGeometry> OdeContacts::geometry() const { return state_->geometry; }

std::unique_ptr<ContactSource> OdeContacts::another() const {
  std::unique_ptr<OdeContacts> other(new OdeContacts());
  other->state_->accepted = state_->accepted;
  return other;
}

}  // namespace carom
