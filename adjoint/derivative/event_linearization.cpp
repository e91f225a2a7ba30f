// SPDX-License-Identifier: MIT
#include "adjoint/derivative/event_linearization.hpp"

#include <algorithm>

#include "adjoint/impact/tilt.hpp"

namespace carom {
namespace {

Pose poseBefore(const Motion& motion, const Event& event, int body) {
  const BodyModel& model = (*motion.models)[static_cast<std::size_t>(body)];
  const Participant* p = event.find(body);
  const State& s = p ? p->before : motion.world_lines[static_cast<std::size_t>(body)].arcs[0].startState();
  return {s.x, model.shapeToWorld(s.q.toRotationMatrix())};
}

}  // namespace

EventLinearization::EventLinearization(const Motion& motion, int index)
    : motion_(motion), event_(motion.events[static_cast<std::size_t>(index)]), assembly_(event_, *motion.models) {
  const auto participantOf = [&](int body) {
    const Participant* p = event_.find(body);
    return p ? static_cast<int>(p - event_.participants.data()) : -1;
  };
  P_.resize(3 * static_cast<Eigen::Index>(event_.contacts.size()));
  double total = 0;
  for (std::size_t k = 0; k < event_.contacts.size(); ++k) {
    const Contact& c = event_.contacts[k];
    P_.segment<3>(3 * static_cast<Eigen::Index>(k)) = c.impulse;
    ContactPart& part = parts_.emplace_back();
    part.a = {c.a, participantOf(c.a)};
    part.b = {c.b, participantOf(c.b)};
    part.weight = std::max(0.0, c.impulse_normal.dot(c.impulse));
    total += part.weight;
    part.jacobian = motion.geometry->jacobian(c.a, c.b, c.features, poseBefore(motion, event_, c.a),
                                              poseBefore(motion, event_, c.b));
    part.tilted = c.tilt_a >= 0 || c.tilt_b >= 0;
    const auto tiltOf = [&](int t) {
      return t < 0 ? Vec2(0, 0) : motion.scene->tilts[static_cast<std::size_t>(t)].value;
    };
    if (part.tilted) part.tilt = tiltedNormalJacobian(c.at.normal, tiltOf(c.tilt_a), tiltOf(c.tilt_b));
    part.material_a = materialIndexOf(*motion.scene, c.a);
    part.material_b = materialIndexOf(*motion.scene, c.b);
  }
  for (ContactPart& part : parts_)
    part.weight = total > 0 ? part.weight / total : 1.0 / static_cast<double>(parts_.size());

  for (const Participant& p : event_.participants) {
    const auto& arcs = motion.world_lines[static_cast<std::size_t>(p.body)].arcs;
    const Arc& next = arcs[static_cast<std::size_t>(p.arc) + 1];
    rate_before_.push_back(arcs[static_cast<std::size_t>(p.arc)].rate(p.before));
    rate_after_.push_back(next.rate(next.startState()));
  }
  for (const ContactPart& part : parts_)
    D_ += part.weight * part.jacobian.pose.row(0).dot(poses(part, rate_before_, nullptr));
}

double EventLinearization::frictionFromZero() const {
  const ImpactProblem& p = assembly_.problem();
  if (std::none_of(p.pair.begin(), p.pair.end(), [](const PairCoefficients& c) { return c.friction == 0; })) return 1;
  return p.contacts() > 1 ? 0 : frictionFromZeroMargin(onlyContact(p));
}

EventLinearization::Vec12 EventLinearization::poses(const ContactPart& part, const std::vector<StateDerivative>& before,
                                                    const SceneTangent* dscene) const {
  Vec12 d = Vec12::Zero();
  int at = 0;
  for (const Side& side : {part.a, part.b}) {
    if (side.participant >= 0) {
      d.segment<3>(at) = before[static_cast<std::size_t>(side.participant)].x;
      d.segment<3>(at + 3) = before[static_cast<std::size_t>(side.participant)].theta;
    } else if (dscene) {
      d.segment<3>(at) = dscene->bodies[static_cast<std::size_t>(side.body)].position;
      d.segment<3>(at + 3) = dscene->bodies[static_cast<std::size_t>(side.body)].orientation;
    }
    at += 6;
  }
  return d;
}

EventLinearization::Vec7 EventLinearization::contactTangent(const ContactPart& part,
                                                            const std::vector<StateDerivative>& before,
                                                            const SceneTangent& dscene) const {
  const ContactJacobian& J = part.jacobian;
  Vec7 d = J.pose * poses(part, before, &dscene);
  if (J.size_a.cols() > 0) d += J.size_a * dscene.bodies[static_cast<std::size_t>(part.a.body)].size;
  if (J.size_b.cols() > 0) d += J.size_b * dscene.bodies[static_cast<std::size_t>(part.b.body)].size;
  return d;
}

void EventLinearization::scatter(const ContactPart& part, const Vec7& bar, std::vector<StateDerivative>& before_bar,
                                 SceneGradient& scene_bar) const {
  const ContactJacobian& J = part.jacobian;
  const Vec12 d = J.pose.transpose() * bar;
  int at = 0;
  for (const Side& side : {part.a, part.b}) {
    BodyDerivative& body = scene_bar.bodies[static_cast<std::size_t>(side.body)];
    if (side.participant < 0) {
      body.position += d.segment<3>(at);
      body.orientation += d.segment<3>(at + 3);
    } else {
      before_bar[static_cast<std::size_t>(side.participant)].x += d.segment<3>(at);
      before_bar[static_cast<std::size_t>(side.participant)].theta += d.segment<3>(at + 3);
    }
    at += 6;
  }
  if (J.size_a.cols() > 0) scene_bar.bodies[static_cast<std::size_t>(part.a.body)].size += J.size_a.transpose() * bar;
  if (J.size_b.cols() > 0) scene_bar.bodies[static_cast<std::size_t>(part.b.body)].size += J.size_b.transpose() * bar;
}

EventLinearization::Tangent EventLinearization::tangent(const std::vector<StateDerivative>& before,
                                                        const SceneTangent& dscene,
                                                        const std::vector<BodyModelDerivative>& dmodel) const {
  Tangent out;
  double dgap = 0;
  for (const ContactPart& part : parts_) dgap += part.weight * contactTangent(part, before, dscene)[0];
  out.time = -dgap / D_;

  // at the moved time of the impact
  std::vector<StateDerivative> moved = before;
  std::vector<BodyModelDerivative> dmodels;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i].addScaled(out.time, rate_before_[i]);
    dmodels.push_back(dmodel[static_cast<std::size_t>(event_.participants[i].body)]);
  }
  std::vector<Vec7> dcontact;
  std::vector<PairCoefficients> dpair;
  const MaterialDerivative none;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ContactPart& part = parts_[k];
    const Contact& c = event_.contacts[k];
    Vec7 d = contactTangent(part, moved, dscene);
    if (part.tilted) {
      Vec7 by;
      by << d.segment<3>(1), Vec2(0, 0), Vec2(0, 0);
      if (c.tilt_a >= 0) by.segment<2>(3) = dscene.tilts[static_cast<std::size_t>(c.tilt_a)];
      if (c.tilt_b >= 0) by.segment<2>(5) = dscene.tilts[static_cast<std::size_t>(c.tilt_b)];
      d.segment<3>(1) = part.tilt * by;
    }
    dcontact.push_back(d);
    const auto dmaterial = [&](int m) { return m < 0 ? none : dscene.materials[static_cast<std::size_t>(m)]; };
    dpair.push_back(combineTangent(materialOf(*motion_.scene, motion_.scene->bodies[static_cast<std::size_t>(c.a)]),
                                   materialOf(*motion_.scene, motion_.scene->bodies[static_cast<std::size_t>(c.b)]),
                                   dmaterial(part.material_a), dmaterial(part.material_b)));
  }
  out.after = assembly_.tangent(P_, moved, dcontact, dpair, dmodels);
  for (std::size_t i = 0; i < moved.size(); ++i) out.after[i].addScaled(-out.time, rate_after_[i]);
  return out;
}

std::vector<StateDerivative> EventLinearization::pullback(const std::vector<StateDerivative>& after_bar,
                                                          const std::vector<StateDerivative>& read_bar, double time_bar,
                                                          SceneGradient& scene_bar,
                                                          std::vector<BodyModelDerivative>& model_bar) const {
  std::vector<StateDerivative> before_bar(after_bar.size());
  const bool through = std::any_of(after_bar.begin(), after_bar.end(), [](const auto& s) { return !s.isZero(); });
  if (through) {  // lambda- = C_s^T lambda+, u_bar += C_u^T lambda+
    std::vector<Vec7> contact_bar(parts_.size(), Vec7::Zero());
    std::vector<PairCoefficients> pair_bar(parts_.size());
    std::vector<BodyModelDerivative> models(after_bar.size());
    before_bar = assembly_.pullback(P_, after_bar, contact_bar, pair_bar, models);
    for (std::size_t i = 0; i < models.size(); ++i)
      model_bar[static_cast<std::size_t>(event_.participants[i].body)] += models[i];
    MaterialDerivative unused;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ContactPart& part = parts_[k];
      const Contact& c = event_.contacts[k];
      if (part.tilted) {
        const Vec7 by = part.tilt.transpose() * contact_bar[k].segment<3>(1);
        contact_bar[k].segment<3>(1) = by.head<3>();
        if (c.tilt_a >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_a)] += by.segment<2>(3);
        if (c.tilt_b >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_b)] += by.segment<2>(5);
      }
      scatter(part, contact_bar[k], before_bar, scene_bar);
      const auto slot = [&](int m) -> MaterialDerivative& {
        return m < 0 ? unused : scene_bar.materials[static_cast<std::size_t>(m)];
      };
      combinePullback(materialOf(*motion_.scene, motion_.scene->bodies[static_cast<std::size_t>(c.a)]),
                      materialOf(*motion_.scene, motion_.scene->bodies[static_cast<std::size_t>(c.b)]), pair_bar[k],
                      slot(part.material_a), slot(part.material_b));
    }
  }
  // sigma = (lambda+ . F+ - lambda- . F- - time_bar) / D; lambda- += phi_s^T sigma, u_bar += phi_u^T sigma
  double sigma = -time_bar;
  for (std::size_t i = 0; i < before_bar.size(); ++i) {
    before_bar[i] += read_bar[i];
    sigma += after_bar[i].dot(rate_after_[i]) - before_bar[i].dot(rate_before_[i]);
  }
  sigma /= D_;
  for (const ContactPart& part : parts_) {
    Vec7 gap_bar = Vec7::Zero();
    gap_bar[0] = sigma * part.weight;
    scatter(part, gap_bar, before_bar, scene_bar);
  }
  return before_bar;
}

}  // namespace carom
