// SPDX-License-Identifier: MIT
#include "adjoint/derivative/single_impact.hpp"

#include "adjoint/impact/single_laws.hpp"
#include "adjoint/motion/contact_surface.hpp"
#include "adjoint/motion/guard.hpp"

namespace carom::adjoint_detail {
namespace {

// What the laws of one contact add their adjoints to.
struct ProblemBar {
  Mat3 K = Mat3::Zero();
  Vec3 u = Vec3::Zero();
  std::array<Vec3, 1> normal = {Vec3::Zero()};
  std::array<PairCoefficients, 1> pair = {};
};

// As FrictionlessLaw and FrictionLaw of laws.hpp have it.
ProblemBar lawPullback(const ContactProblem& problem, const Vec3& impulse_bar) {
  ProblemBar bar;
  const FrictionTerms<double> friction(problem);
  if (problem.pair.friction > 0) {
    friction.pullback(impulse_bar, bar);
  } else {
    FrictionlessTerms<double>(problem).pullback(impulse_bar, bar);
    if (slipsWithoutFriction(friction)) bar.pair[0].friction += rateByFrictionFromZero(friction).dot(impulse_bar);
  }
  return bar;
}

const Material& materialAt(const Scene& scene, int index) {
  static const Material kNone;
  return index < 0 ? kNone : scene.materials[static_cast<std::size_t>(index)];
}

}  // namespace

bool SingleImpact::is(const Event& event) {
  if (event.kind != EventKind::impact || event.wide || event.contacts.size() != 1) return false;
  const Contact& c = event.contacts[0];
  return c.tilt_a < 0 && c.tilt_b < 0 && !c.held && !c.lasts && !c.captured && !c.kept;
}

SingleImpact::SingleImpact(const Motion& motion, const Event& event, const std::vector<int>& materials)
    : impulse_(event.contacts[0].impulse), count_(event.participants.size()) {
  const Contact& c = event.contacts[0];
  a_ = {c.a, participantOf(event, c.a)};
  b_ = {c.b, participantOf(event, c.b)};
  const Pose pose_a = poseBefore(motion, event, c.a), pose_b = poseBefore(motion, event, c.b);
  J_ = motion.geometry->jacobian(c.a, c.b, c.features, pose_a, pose_b);
  material_a_ = materials[static_cast<std::size_t>(c.a)];
  material_b_ = materials[static_cast<std::size_t>(c.b)];
  rules_ = rulesOf(materialAt(*motion.scene, material_a_), materialAt(*motion.scene, material_b_));
  problem_ = {Mat3::Zero(), c.surface_velocity, c.impulse_normal, c.pair};
  for (const int body : {c.a, c.b}) {
    if (!motion.scene->bodies[static_cast<std::size_t>(body)].immovable()) continue;
    const Pose& pose = body == c.a ? pose_a : pose_b;
    surface_ = {body, participantOf(event, body), body == c.a ? 1.0 : -1.0, surfaceMotionOf(motion, body, pose),
                pose.R * (*motion.models)[static_cast<std::size_t>(body)].center, c.at.point, c.at.normal};
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const Participant& p = event.participants[i];
    const BodyModel& model = (*motion.models)[static_cast<std::size_t>(p.body)];
    const auto& arcs = motion.world_lines[static_cast<std::size_t>(p.body)].arcs;
    const Arc &arc = arcs[static_cast<std::size_t>(p.arc)], &next = arcs[static_cast<std::size_t>(p.next())];
    Mover& m = movers_[i];
    m.body = p.body;
    m.sign = p.body == c.a ? 1 : -1;
    m.moves = !model.kinematic && !p.stays;
    m.round = (model.inverse_inertia.array() == model.inverse_inertia[0]).all();
    m.inverse_mass = m.moves ? model.inverse_mass : 0;
    m.R = p.before.q.toRotationMatrix();
    m.A = m.round ? Mat3(model.inverse_inertia[0] * Mat3::Identity()) : model.inverseInertiaWorld(m.R);
    m.r = c.at.point - p.before.x;
    m.L = p.before.L;
    m.omega = m.A * m.L;
    m.rate_before = !arc.isFlight() ? arc.rateAt(event.time, p.before)
                               : StateDerivative{p.before.v, m.omega, arc.acceleration(), Vec3::Zero()};
    const State& after = next.startState();  // with the orientation of before
    m.rate_after = !next.isFlight() ? next.startRate()
                               : StateDerivative{after.v, m.A * after.L, next.acceleration(), Vec3::Zero()};
    problem_.u += m.sign * (p.before.v + m.omega.cross(m.r));
    if (!m.moves) continue;
    const Mat3 arm = skew(m.r);
    problem_.K += m.inverse_mass * Mat3::Identity() - arm * m.A * arm;
  }
  for (const auto& [side, at] : {std::pair(a_, 0), std::pair(b_, 6)}) {
    if (side.participant < 0) continue;
    const StateDerivative& rate = movers_[static_cast<std::size_t>(side.participant)].rate_before;
    guard_rate_ += J_.pose.block<1, 3>(0, at).dot(rate.x) + J_.pose.block<1, 3>(0, at + 3).dot(rate.theta);
  }
}

template <class SizeA, class SizeB>
void SingleImpact::scatter(const Vec12& pose, const SizeA& size_a, const SizeB& size_b, Pair& bar,
                           SceneGradient& scene_bar) const {
  for (const auto& [side, at] : {std::pair(a_, 0), std::pair(b_, 6)}) {
    BodyDerivative& body = scene_bar.bodies[static_cast<std::size_t>(side.body)];
    if (side.participant < 0) {
      body.position += pose.segment<3>(at);
      body.orientation += pose.segment<3>(at + 3);
    } else {
      StateDerivative& state = bar[static_cast<std::size_t>(side.participant)];
      state.x += pose.segment<3>(at);
      state.theta += pose.segment<3>(at + 3);
    }
  }
  if (J_.size_a.cols() > 0) scene_bar.bodies[static_cast<std::size_t>(a_.body)].size.noalias() += size_a;
  if (J_.size_b.cols() > 0) scene_bar.bodies[static_cast<std::size_t>(b_.body)].size.noalias() += size_b;
}

void SingleImpact::throughLaw(const States& after_bar, Pair& bar, SceneGradient& scene_bar,
                              std::vector<BodyModelDerivative>& model_bar) const {
  Vec3 impulse_bar = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const Mover& m = movers_[i];
    if (m.moves) impulse_bar += m.sign * (m.inverse_mass * after_bar[i].v + after_bar[i].L.cross(m.r));
  }
  const ProblemBar problem = lawPullback(problem_, impulse_bar);
  Vec7 contact = Vec7::Zero();
  contact.segment<3>(1) = problem.normal[0];
  for (std::size_t i = 0; i < count_; ++i) {
    const Mover& m = movers_[i];
    BodyModelDerivative& model = model_bar[static_cast<std::size_t>(m.body)];
    Vec3 r_bar = Vec3::Zero();
    Mat3 A_bar = Mat3::Zero();
    if (m.moves) {
      const Vec3 P = m.sign * impulse_;
      const double inverse_mass_bar = P.dot(after_bar[i].v) + problem.K.trace();
      model.mass -= inverse_mass_bar * m.inverse_mass * m.inverse_mass;
      const Mat3 arm = skew(m.r), K_arm = problem.K * arm, arm_K = arm * problem.K;
      A_bar = -arm * K_arm;                                               // <K_bar, -[r]x dA [r]x>
      r_bar = P.cross(after_bar[i].L) + unskew(K_arm * m.A) + unskew(m.A * arm_K);
    }
    const Vec3 u_bar = m.sign * problem.u, omega_bar = m.r.cross(u_bar);
    r_bar += u_bar.cross(m.omega);
    bar[i].v += u_bar;
    bar[i].x -= r_bar;
    contact.tail<3>() += r_bar;
    A_bar += omega_bar * m.L.transpose();
    bar[i].L += m.A * omega_bar;
    // dA = [theta]x A - A [theta]x - A R dJ R^T A
    if (m.round) {
      const double a = m.A(0, 0);
      model.addInertiaBar(-(a * a) * (m.R.transpose() * A_bar * m.R));
    } else {
      bar[i].theta += unskew(A_bar * m.A - m.A * A_bar);
      const Mat3 AR = m.A * m.R;
      model.addInertiaBar(-(AR.transpose() * A_bar * AR));
    }
  }
  if (surface_) surfacePullback(problem.u, contact, bar, scene_bar, model_bar);
  const Vec12 pose = J_.pose.transpose() * contact;
  scatter(pose, J_.size_a.transpose() * contact, J_.size_b.transpose() * contact, bar, scene_bar);
  MaterialDerivative unused;
  const auto slot = [&](int m) -> MaterialDerivative& {
    return m < 0 ? unused : scene_bar.materials[static_cast<std::size_t>(m)];
  };
  rules_.pullback(problem.pair[0], slot(material_a_), slot(material_b_));
}

// As EventPass::surfacePullback has it.
void SingleImpact::surfacePullback(const Vec3& u_bar, Vec7& contact, Pair& bar, SceneGradient& scene_bar,
                                   std::vector<BodyModelDerivative>& model_bar) const {
  const auto d = surface_->motion.pullback(surface_->point, surface_->normal, surface_->sign * u_bar);
  BodyDerivative& body = scene_bar.bodies[static_cast<std::size_t>(surface_->body)];
  body.surface_velocity += d.velocity;
  body.surface_angular_velocity += d.spin;
  contact.segment<3>(1) += d.normal;
  contact.tail<3>() += d.point;
  if (surface_->participant < 0) {
    body.position += d.position;
    body.orientation += d.theta;
    return;
  }
  StateDerivative& before = bar[static_cast<std::size_t>(surface_->participant)];
  before.x += d.position;
  before.theta += d.theta - surface_->center.cross(d.position);
  model_bar[static_cast<std::size_t>(surface_->body)].center -= surface_->motion.R.transpose() * d.position;
}

SingleImpact::Pair SingleImpact::pullback(const States& after_bar, const States& read_bar, double time_bar,
                                          SceneGradient& scene_bar, std::vector<BodyModelDerivative>& model_bar) const {
  Pair bar;
  bool through = false;
  for (std::size_t i = 0; i < count_; ++i) {
    bar[i] = after_bar[i];
    through = through || !after_bar[i].isZero();
  }
  if (through) throughLaw(after_bar, bar, scene_bar, model_bar);
  double sigma = -time_bar;
  for (std::size_t i = 0; i < count_; ++i) {
    bar[i] += read_bar[i];
    sigma += after_bar[i].dot(movers_[i].rate_after) - bar[i].dot(movers_[i].rate_before);
  }
  sigma /= guard_rate_;
  const Vec12 pose = sigma * J_.pose.row(0).transpose();
  scatter(pose, sigma * J_.size_a.row(0).transpose(), sigma * J_.size_b.row(0).transpose(), bar, scene_bar);
  return bar;
}

}  // namespace carom::adjoint_detail
