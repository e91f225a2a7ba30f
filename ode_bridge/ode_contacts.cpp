#include "ode_bridge/ode_contacts.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "adjoint/errors.h"
#include "ode_bridge/broad_phase.h"
#include "ode_bridge/first_impact.h"

namespace carom {
namespace {

// Bodies that overlap by less than this at the start are taken to touch, m (times their size where that is above 1).
constexpr double kOverlap = 1e-9;

// Everywhere that the body can be on a flight between two times: the parabola's ends and its summits.
Bounds sweptBounds(const Solid& solid, const Arc& arc, double from, double until) {
  const Vec3 p = arc.positionAt(from), q = arc.positionAt(until);
  Bounds b{p.cwiseMin(q), p.cwiseMax(q)};
  const Vec3 v = arc.velocityAt(from), g = arc.acceleration();
  for (int k = 0; k < 3; ++k) {
    if (g[k] == 0) continue;
    const double summit = -v[k] / g[k];
    if (!(summit > 0 && summit < until - from)) continue;
    const double x = p[k] + 0.5 * v[k] * summit;
    b.low[k] = std::min(b.low[k], x);
    b.high[k] = std::max(b.high[k], x);
  }
  // room for the rounding of positions and for the tolerance of contact
  const double scale = std::max({1.0, b.low.cwiseAbs().maxCoeff(), b.high.cwiseAbs().maxCoeff()});
  const Vec3 room = Vec3::Constant(solid.bound() + 1e-9 * scale);
  b.low -= room;
  b.high += room;
  return b;
}

}  // namespace

struct OdeContacts::State {
  BroadPhase broad_phase;
  NarrowPhase narrow_phase;
  std::shared_ptr<const FeatureGeometry> geometry;

  void refuseOverlap(const Scene& scene, const std::vector<BodyModel>& models);
};

OdeContacts::OdeContacts(const Scene& scene) : state_(std::make_unique<State>()) { begin(scene); }

OdeContacts::~OdeContacts() = default;

void OdeContacts::begin(const Scene& scene) {
  std::vector<Solid> solids;
  std::vector<BodyModel> models;
  for (const Body& body : scene.bodies) {
    solids.push_back(solidOf(body.shape));
    models.push_back(modelOf(body));
  }
  state_->geometry = std::make_shared<const FeatureGeometry>(std::move(solids));
  state_->broad_phase.reset(scene.bodies.size());
  state_->narrow_phase.reset(state_->geometry->solids());
  state_->refuseOverlap(scene, models);
}

void OdeContacts::State::refuseOverlap(const Scene& scene, const std::vector<BodyModel>& models) {
  std::vector<Arc> arcs;
  arcs.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    arcs.emplace_back(models[i], Tier::none, Vec3::Zero(), 0.0, startState(scene.bodies[i], models[i]));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      if (scene.bodies[i].fixed && scene.bodies[j].fixed) continue;
      const Placed a(geometry->solids()[i], arcs[i], 0), b(geometry->solids()[j], arcs[j], 0);
      const Witness w = findWitness(a, b);
      if (w.separation >= -kOverlap * std::max(1.0, touchTolerance(a, b) / 1e-13)) continue;
      std::ostringstream text;
      text << "found '" << scene.bodies[i].name << "' and '" << scene.bodies[j].name << "' overlapping by "
           << -w.separation << " m at the start, expected bodies apart or touching";
      throw InputError("/bodies/" + std::to_string(j), text.str());
    }
}

void OdeContacts::setPath(int body, const Arc& arc, double from, double until) {
  const Solid& solid = state_->geometry->solid(body);
  if (!solid.plane) {
    state_->broad_phase.setBounds(body, sweptBounds(solid, arc, from, until), arc.moving());
    return;
  }
  const Kinematics k = arc.kinematicsAt(from);
  const Vec3 normal = k.R * solid.faces[0].direction;
  state_->broad_phase.setHalfSpace(body, normal, normal.dot(k.x) + solid.faces[0].point.dot(solid.faces[0].direction));
}

void OdeContacts::neighbours(int body, std::vector<int>& out) { state_->broad_phase.neighbours(body, out); }

std::optional<PredictedImpact> OdeContacts::firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                        double until) {
  return findFirstImpact({a, b, *state_->geometry, state_->narrow_phase, arc_a, arc_b}, from, until);
}

std::vector<FeaturePair> OdeContacts::touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t,
                                               double reach) {
  const Placed placed_a(state_->geometry->solid(a), arc_a, t), placed_b(state_->geometry->solid(b), arc_b, t);
  const Witness witness = findWitness(placed_a, placed_b);
  const double tolerance = std::max(reach, 4 * touchTolerance(placed_a, placed_b));
  if (witness.bounding || witness.separation > tolerance) return {};
  return touchingFeatures(placed_a, placed_b, witness, tolerance);
}

std::shared_ptr<const ContactGeometry> OdeContacts::geometry() const { return state_->geometry; }

}  // namespace carom
