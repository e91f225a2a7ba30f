// SPDX-License-Identifier: MIT
#include "editing/report/event_bars.hpp"

#include "adjoint/derivative/adjoint.h"
#include "adjoint/impact/tilt.hpp"

namespace carom {
namespace {

using Vec7 = Eigen::Matrix<double, 7, 1>;

}  // namespace

EventBars::EventBars(const Motion& motion, int event)
    : motion_(motion),
      event_(motion.events[static_cast<std::size_t>(event)]),
      models_(event_.participants.size()),
      direct_(*motion.scene) {
  for (const Participant& p : event_.participants) {
    const BodyModel& model = (*motion.models)[static_cast<std::size_t>(p.body)];
    Moving m{&model, p.before.q.toRotationMatrix(), Mat3::Zero(), Vec3::Zero()};
    m.A = model.inverseInertiaWorld(m.R);
    m.omega = m.A * p.before.L;
    moving_.push_back(m);
    StateSeed& seed = seeds_.emplace_back();
    seed.body = p.body;
    seed.at = Instant::before(event);
  }
}

template <class Visit>
void EventBars::eachArm(int contact, const Visit& visit) const {
  const Contact& c = event_.contacts[static_cast<std::size_t>(contact)];
  for (std::size_t i = 0; i < event_.participants.size(); ++i) {
    const Participant& p = event_.participants[i];
    if (p.body != c.a && p.body != c.b) continue;
    visit(i, p.body == c.a ? 1.0 : -1.0, Vec3(c.at.point - p.before.x));
  }
}

Pose EventBars::poseOf(int body) const {
  const BodyModel& model = (*motion_.models)[static_cast<std::size_t>(body)];
  const Participant* p = event_.find(body);
  const State& s = p ? p->before : motion_.world_lines[static_cast<std::size_t>(body)].arcs[0].startState();
  return {s.x, model.shapeToWorld(s.q.toRotationMatrix())};
}

Vec3 EventBars::velocityAt(int contact) const {
  Vec3 u = Vec3::Zero();
  eachArm(contact, [&](std::size_t i, double sign, const Vec3& r) {
    u += sign * (event_.participants[i].before.v + moving_[i].omega.cross(r));
  });
  return u;
}

Mat3 EventBars::matrixAt(int contact) const {
  Mat3 K = Mat3::Zero();
  eachArm(contact, [&](std::size_t i, double, const Vec3& r) {
    if (moving_[i].model->kinematic) return;
    K += moving_[i].model->inverse_mass * Mat3::Identity() - skew(r) * moving_[i].A * skew(r);
  });
  return K;
}

void EventBars::addPose(int body, const Vec3& x_bar, const Vec3& theta_bar) {
  for (StateSeed& seed : seeds_) {
    if (seed.body != body) continue;
    seed.center_of_mass += x_bar;
    seed.orientation += theta_bar;
    return;
  }
  BodyDerivative& fixed = direct_.bodies[static_cast<std::size_t>(body)];
  fixed.position += x_bar;
  fixed.orientation += theta_bar;
}

void EventBars::addSize(int body, const Eigen::VectorXd& size_bar) {
  if (size_bar.size() > 0) direct_.bodies[static_cast<std::size_t>(body)].size += size_bar;
}

void EventBars::addTime(double time_bar) { seeds_[0].time += time_bar; }

void EventBars::addContact(int contact, const Vec7& bar) {
  const Contact& c = event_.contacts[static_cast<std::size_t>(contact)];
  const ContactJacobian J = motion_.geometry->jacobian(c.a, c.b, c.features, poseOf(c.a), poseOf(c.b));
  const Eigen::Matrix<double, 12, 1> d = J.pose.transpose() * bar;
  addPose(c.a, d.segment<3>(0), d.segment<3>(3));
  addPose(c.b, d.segment<3>(6), d.segment<3>(9));
  addSize(c.a, J.size_a.transpose() * bar);
  addSize(c.b, J.size_b.transpose() * bar);
}

void EventBars::addPoint(int contact, const Vec3& point_bar) {
  Vec7 bar = Vec7::Zero();
  bar.tail<3>() = point_bar;
  addContact(contact, bar);
}

// u_bar.(v + omega x r), r = p - x.
void EventBars::addVelocity(int contact, const Vec3& u_bar) {
  Vec3 point_bar = Vec3::Zero();
  eachArm(contact, [&](std::size_t i, double sign, const Vec3& r) {
    const Vec3 r_bar = sign * u_bar.cross(moving_[i].omega);
    seeds_[i].velocity += sign * u_bar;
    seeds_[i].angular_velocity += sign * r.cross(u_bar);
    seeds_[i].center_of_mass -= r_bar;
    point_bar += r_bar;
  });
  addPoint(contact, point_bar);
}

// K = sum 1/m - [r]x A [r]x, dA = [theta]x A - A [theta]x - A R dJ R^T A.
void EventBars::addLaw(int contact, const Mat3& K_bar, const Vec3& impulse_normal_bar,
                       const PairCoefficients& pair_bar) {
  const Contact& c = event_.contacts[static_cast<std::size_t>(contact)];
  Vec7 contact_bar = Vec7::Zero();
  eachArm(contact, [&](std::size_t i, double, const Vec3& r) {
    const Moving& m = moving_[i];
    if (m.model->kinematic) return;
    const Mat3 r_x = skew(r), A_bar = -r_x * K_bar * r_x;
    const Vec3 r_bar = unskew(K_bar * r_x * m.A) + unskew(m.A * r_x * K_bar);
    seeds_[i].orientation += unskew(A_bar * m.A - m.A * A_bar);
    seeds_[i].center_of_mass -= r_bar;
    contact_bar.tail<3>() += r_bar;
    models_[i].addInertiaBar(-(m.R.transpose() * m.A * A_bar * m.A * m.R));
    models_[i].mass -= K_bar.trace() * m.model->inverse_mass * m.model->inverse_mass;
  });
  if (c.tilt_a < 0 && c.tilt_b < 0) {
    contact_bar.segment<3>(1) += impulse_normal_bar;
  } else {
    const auto tilt = [&](int t) {
      return t < 0 ? Vec2(0, 0) : motion_.scene->tilts[static_cast<std::size_t>(t)].value;
    };
    const Vec7 by = tiltedNormalJacobian(c.at.normal, tilt(c.tilt_a), tilt(c.tilt_b)).transpose() * impulse_normal_bar;
    contact_bar.segment<3>(1) += by.head<3>();
    if (c.tilt_a >= 0) direct_.tilts[static_cast<std::size_t>(c.tilt_a)] += by.segment<2>(3);
    if (c.tilt_b >= 0) direct_.tilts[static_cast<std::size_t>(c.tilt_b)] += by.segment<2>(5);
  }
  addContact(contact, contact_bar);

  const Scene& scene = *motion_.scene;
  MaterialDerivative unused;
  const auto slot = [&](int body) -> MaterialDerivative& {
    const int m = materialIndexOf(scene, body);
    return m < 0 ? unused : direct_.materials[static_cast<std::size_t>(m)];
  };
  combinePullback(materialOf(scene, scene.bodies[static_cast<std::size_t>(c.a)]),
                  materialOf(scene, scene.bodies[static_cast<std::size_t>(c.b)]), pair_bar, slot(c.a), slot(c.b));
}

SceneGradient EventBars::gradient(DerivativeTape& tape) const {
  SceneGradient g = adjoint(tape, seeds_);
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const auto b = static_cast<std::size_t>(event_.participants[i].body);
    if (!models_[i].isZero()) modelPullback(motion_.scene->bodies[b], (*motion_.models)[b], models_[i], g.bodies[b]);
  }
  for (std::size_t i = 0; i < direct_.tilts.size(); ++i) g.tilts[i] += direct_.tilts[i];
  for (std::size_t i = 0; i < direct_.materials.size(); ++i) {
    g.materials[i].elasticity += direct_.materials[i].elasticity;
    g.materials[i].friction += direct_.materials[i].friction;
    g.materials[i].tangential_elasticity += direct_.materials[i].tangential_elasticity;
  }
  for (std::size_t i = 0; i < direct_.bodies.size(); ++i) {
    g.bodies[i].position += direct_.bodies[i].position;
    g.bodies[i].orientation += direct_.bodies[i].orientation;
    g.bodies[i].size += direct_.bodies[i].size;
  }
  return g;
}

}  // namespace carom
