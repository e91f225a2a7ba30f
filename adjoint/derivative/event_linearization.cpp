// SPDX-License-Identifier: MIT
#include "adjoint/derivative/event_linearization.hpp"

#include <algorithm>

#include "adjoint/derivative/flat_landing.hpp"
#include "adjoint/constrained/constrained_linearization.hpp"
#include "adjoint/derivative/transition_guard.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/impact/single_laws.hpp"
#include "adjoint/impact/tilt.hpp"
#include "adjoint/impact/tilt_frame.hpp"
#include "adjoint/impact/double_double_impact.hpp"
#include "adjoint/motion/contact_surface.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {
namespace {

using Pass = EventPass<double>;
using Part = Pass::Part;
using Vec7 = Pass::Vec7;

// Of the body that impacts do not move, if one is such.
std::optional<SurfacePart<double>> surfaceOf(const Motion& motion, const Event& event, const Contact& c) {
  for (const int body : {c.a, c.b}) {
    if (!motion.scene->bodies[static_cast<std::size_t>(body)].immovable()) continue;
    const Pose pose = poseBefore(motion, event, body);
    return SurfacePart<double>{body, participantOf(event, body), body == c.a ? 1.0 : -1.0, surfaceMotionOf(motion, body, pose),
                               pose.R * (*motion.models)[static_cast<std::size_t>(body)].center, c.at.point, c.at.normal};
  }
  return std::nullopt;
}

Part partOf(const Motion& motion, const Event& event, const Contact& c, double weight) {
  Part part;
  part.a = {c.a, participantOf(event, c.a)};
  part.b = {c.b, participantOf(event, c.b)};
  part.guard[0] = event.kind == EventKind::transition ? 0 : weight;
  part.closes = c.lasts;
  if (!placeFlatRim(motion, event, c, part)) {
    ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, poseBefore(motion, event, c.a),
                                                  poseBefore(motion, event, c.b));
    part.pose = J.pose;
    part.size_a = std::move(J.size_a);
    part.size_b = std::move(J.size_b);
    keepPlaceOnRim(motion, event, c, part);
  }
  part.surface = surfaceOf(motion, event, c);
  part.tilted = c.tilt_a >= 0 || c.tilt_b >= 0;
  if (part.tilted)
    part.tilt = tiltJacobian<double>(c.at.normal, tiltOf(*motion.scene, c.tilt_a), tiltOf(*motion.scene, c.tilt_b));
  part.material_a = materialIndexOf(*motion.scene, c.a);
  part.material_b = materialIndexOf(*motion.scene, c.b);
  part.rules = inForce(rulesOf(materialOf(*motion.scene, motion.scene->bodies[static_cast<std::size_t>(c.a)]),
                               materialOf(*motion.scene, motion.scene->bodies[static_cast<std::size_t>(c.b)])),
                       event, c);
  return part;
}

// Of a transition; adds the weights of contacts to their parts.
EventGuard<double> guardOf(const Motion& motion, const Event& event, std::vector<Part>& parts) {
  EventGuard<double> guard;
  if (event.kind != EventKind::transition) return guard;
  if (const std::shared_ptr<const PathGuard> by_path = pathGuardOf(motion, event)) {
    guard.by_path = by_path;
    return guard;
  }
  if (event.cause == TransitionCause::slip_ends) {
    guard.by_slip = true;
    guard.slip = slipDirectionAtEnd(motion, event);
    return guard;
  }
  const FeatureLimit limit = borderOf(motion, event);
  const Pose pose = poseBefore(motion, event, limit.body);
  return EventGuard<double>::atBorder(limit, participantOf(event, limit.body), pose.x, pose.R,
                                      event.contacts[0].at.point, parts[0]);
}

Pass passOf(const Motion& motion, const Event& event) {
  std::vector<Part> parts;
  const std::vector<double> weights = guardWeights(event);
  parts.reserve(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    parts.push_back(partOf(motion, event, event.contacts[k], weights[k]));
  closeMarks(motion, event, parts);
  EventGuard<double> guard = guardOf(motion, event, parts);
  std::vector<StateDerivative> rate_before, rate_after;
  rate_before.reserve(event.participants.size()), rate_after.reserve(event.participants.size());
  for (const Participant& p : event.participants) {
    const auto& arcs = motion.world_lines[static_cast<std::size_t>(p.body)].arcs;
    const Arc& next = arcs[static_cast<std::size_t>(p.next())];
    rate_before.push_back(arcs[static_cast<std::size_t>(p.arc)].rateAt(event.time, p.before));
    rate_after.push_back(p.stays ? rate_before.back() : next.startRate());
  }
  return {event,
          usesDoubleDouble(event, *motion.models),
          impactInputs(event, *motion.models),
          std::move(parts),
          std::move(guard),
          std::move(rate_before),
          std::move(rate_after)};
}

// d(gap, normal, point)
Vec7 contactTangent(const Part& part, const Event& event, const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                    const std::vector<BodyModelDerivative>& dmodel) {
  if (part.rim) {
    const std::size_t p = part.rim->participant;
    return part.rim->tangent(before[p], dscene, dmodel[static_cast<std::size_t>(event.participants[p].body)]);
  }
  Pass::Vec12 poses = Pass::poses(part, before);
  Eigen::Index at = 0;
  for (const auto& side : {part.a, part.b}) {
    const BodyDerivative& body = dscene.bodies[static_cast<std::size_t>(side.body)];
    if (side.participant < 0) poses.segment<6>(at) << body.position, body.orientation;
    at += 6;
  }
  Vec7 d = part.pose * poses;
  if (part.size_a.cols() > 0) d += part.size_a * dscene.bodies[static_cast<std::size_t>(part.a.body)].size;
  if (part.size_b.cols() > 0) d += part.size_b * dscene.bodies[static_cast<std::size_t>(part.b.body)].size;
  return d;
}

// d(surface velocity) of a contact where d(gap, normal, point) is `contact`.
Vec3 surfaceTangent(const Part& part, const Vec7& contact, const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                    const std::vector<BodyModelDerivative>& dmodel) {
  if (!part.surface) return Vec3::Zero();
  const SurfacePart<double>& surface = *part.surface;
  const BodyDerivative& dbody = dscene.bodies[static_cast<std::size_t>(surface.body)];
  SurfaceMotion<double>::Derivative d;
  d.velocity = dbody.surface_velocity;
  d.spin = dbody.surface_angular_velocity;
  d.normal = contact.segment<3>(1);
  d.point = contact.tail<3>();
  d.position = dbody.position;
  d.theta = dbody.orientation;
  if (surface.participant >= 0) {
    const StateDerivative& state = before[static_cast<std::size_t>(surface.participant)];
    d.theta = state.theta;
    d.position = state.x - state.theta.cross(surface.center) -
                 surface.motion.R * dmodel[static_cast<std::size_t>(surface.body)].center;
  }
  return surface.sign * surface.motion.tangent(surface.point, surface.normal, d);
}

}  // namespace

namespace {

// Of the trajectory on which one participant starts.
std::shared_ptr<const PathStart> startMapOf(const Motion& motion, const Event& event) {
  for (std::size_t i = 0; i < event.participants.size(); ++i) {
    const Participant& p = event.participants[i];
    const Arc& next = motion.world_lines[static_cast<std::size_t>(p.body)].arcs[static_cast<std::size_t>(p.next())];
    if (auto map = next.trajectory().mapOfStart(motion, static_cast<int>(i))) return map;
  }
  return nullptr;
}

}  // namespace

EventLinearization::EventLinearization(const Motion& motion, int index)
    : EventPass(passOf(motion, motion.events[static_cast<std::size_t>(index)])) {
  setStart(startMapOf(motion, event()));
}

FromZero EventLinearization::frictionFromZero() const {
  if (event().kind == EventKind::transition || event().kind == EventKind::placed) return {};
  const ImpactProblem& p = impact().problem();
  if (std::none_of(p.pair.begin(), p.pair.end(), [](const PairCoefficients& c) { return c.friction == 0; })) return {};
  if (p.contacts() > 1) {
    try {
      return fromZero(p);
    } catch (const NotComputable&) {  // in doubles
      return {.margin = 0};
    }
  }
  const FrictionTerms<double> t(onlyContact(p));
  return {.margin = t.slides ? t.margin : 0};
}

double EventLinearization::guardTangent(const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                                        const std::vector<BodyModelDerivative>& dmodel) const {
  double d = 0;
  if (guard().by_path) {
    std::vector<BodyModelDerivative> dmodels;
    for (const Participant& p : event().participants) dmodels.push_back(dmodel[static_cast<std::size_t>(p.body)]);
    for (std::size_t i = 0; i < guard().by_path->by_state.size(); ++i) d += guard().by_path->by_state[i].dot(before[i]);
    return d + guard().by_path->tangent(dscene, dmodels);
  }
  for (const Part& part : parts())
    if (!part.guard.isZero(0)) d += part.guard.dot(contactTangent(part, event(), before, dscene, dmodel));
  if (guard().by_slip) {
    std::vector<BodyModelDerivative> dmodels;
    for (const Participant& p : event().participants) dmodels.push_back(dmodel[static_cast<std::size_t>(p.body)]);
    const Vec7 contact = contactTangent(parts()[0], event(), before, dscene, dmodel);
    d += guard().slip.dot(velocityTangent(impact().inputs(), before, contact, dmodels));
  }
  if (guard().border_body < 0) return d;
  const BodyDerivative& border = dscene.bodies[static_cast<std::size_t>(guard().border_body)];
  const int p = guard().border_participant;
  d += p < 0 ? guard().borderTangent(border.position, border.orientation)
             : guard().borderTangent(before[static_cast<std::size_t>(p)].x, before[static_cast<std::size_t>(p)].theta);
  if (guard().border_rates.size() > 0) d -= guard().border_rates.dot(border.size);
  return d;
}

EventLinearization::Tangent EventLinearization::tangent(const std::vector<StateDerivative>& before,
                                                        const SceneTangent& dscene,
                                                        const std::vector<BodyModelDerivative>& dmodel) const {
  Tangent out;
  if (!hasFixedTime()) out.time = -guardTangent(before, dscene, dmodel) / guardRate();

  // at the moved time of the impact
  std::vector<StateDerivative> moved = before;
  std::vector<BodyModelDerivative> dmodels;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i].addScaled(out.time, rateBefore()[i]);
    dmodels.push_back(dmodel[static_cast<std::size_t>(event().participants[i].body)]);
  }
  std::vector<Vec7> dcontact;
  std::vector<Vec3> dsurface;
  std::vector<PairCoefficients> dpair;
  for (std::size_t k = 0; k < parts().size(); ++k) {
    const Part& part = parts()[k];
    const Contact& c = event().contacts[k];
    Vec7 d = contactTangent(part, event(), moved, dscene, dmodel);
    dsurface.push_back(surfaceTangent(part, d, moved, dscene, dmodel));
    if (part.tilted) {
      Vec7 by;
      by << d.segment<3>(1), Vec2(0, 0), Vec2(0, 0);
      if (c.tilt_a >= 0) by.segment<2>(3) = dscene.tilts[static_cast<std::size_t>(c.tilt_a)];
      if (c.tilt_b >= 0) by.segment<2>(5) = dscene.tilts[static_cast<std::size_t>(c.tilt_b)];
      d.segment<3>(1) = part.tilt * by;
    }
    dcontact.push_back(d);
    const auto dmaterial = [&](int m) {
      return m < 0 ? MaterialDerivative() : dscene.materials[static_cast<std::size_t>(m)];
    };
    dpair.push_back(part.rules.tangent(dmaterial(part.material_a), dmaterial(part.material_b)));
  }
  out.after = hasLaw() ? impactTangent(impact().inputs(), wide(), moved, dcontact, dsurface, dpair, dmodels) : moved;
  const std::vector<std::size_t>& lasting = projection().lasting();
  if (!lasting.empty()) {
    Eigen::VectorXd gaps(lasting.size());
    for (std::size_t k = 0; k < lasting.size(); ++k)
      gaps[static_cast<Eigen::Index>(k)] = contactTangent(parts()[lasting[k]], event(), moved, dscene, dmodel)[0];
    projection().apply(gaps, out.after);
  }
  if (start()) {
    const std::size_t i = start()->participant;
    out.after[i] = start()->tangent(out.after[i], dscene, dmodels[i]);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) out.after[i].addScaled(-out.time, rateAfter()[i]);
  return out;
}

}  // namespace carom::adjoint_detail
