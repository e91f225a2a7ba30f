// SPDX-License-Identifier: MIT
#include "editing/problem/margins/event_bars.hpp"

#include "adjoint/derivative/adjoint.h"
#include "adjoint/motion/guard.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

EventBars::EventBars(DerivativeTape& tape, int event)
    : tape_(tape),
      motion_(tape.motion()),
      event_(motion_.events[static_cast<std::size_t>(event)]),
      pass_(tape.event(event)),
      problem_(static_cast<int>(event_.contacts.size())),
      contacts_(event_.contacts.size(), Eigen::Matrix<double, 7, 1>::Zero()),
      direct_(*motion_.scene) {
  for (const Participant& p : event_.participants) {
    StateSeed& seed = seeds_.emplace_back();
    seed.body = p.body;
    seed.at = Instant::before(event);
  }
}

Pose EventBars::poseOf(int body) const { return poseBefore(motion_, event_, body); }

Vec3 EventBars::velocityAt(int contact) const { return pass_.impact().problem().u.segment<3>(3 * contact); }

Mat3 EventBars::matrixAt(int contact) const { return pass_.impact().problem().K.block<3, 3>(3 * contact, 3 * contact); }

void EventBars::addPose(int body, const Vec3& x_bar, const Vec3& theta_bar) {
  const int i = participantOf(event_, body);
  if (i >= 0) {
    seeds_[static_cast<std::size_t>(i)].center_of_mass += x_bar;
    seeds_[static_cast<std::size_t>(i)].orientation += theta_bar;
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

void EventBars::addContact(int contact, const Eigen::Matrix<double, 7, 1>& bar) {
  contacts_[static_cast<std::size_t>(contact)] += bar;
}

void EventBars::addVelocity(int contact, const Vec3& u_bar) { problem_.u.segment<3>(3 * contact) += u_bar; }

void EventBars::addLaw(int contact, const Mat3& K_bar, const Vec3& impulse_normal_bar,
                       const PairCoefficients& pair_bar) {
  problem_.K.block<3, 3>(3 * contact, 3 * contact) += K_bar;
  problem_.normal[static_cast<std::size_t>(contact)] += impulse_normal_bar;
  problem_.pair[static_cast<std::size_t>(contact)] += pair_bar;
}

SceneGradient EventBars::gradient() const {
  auto bars = pass_.impact().noBars();
  auto between = pass_.impact().nothingBetween();
  pass_.impact().problemPullback(problem_, between, bars);
  std::vector<StateSeed> seeds = seeds_;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    seeds[i].velocity += bars.before[i].v;
    seeds[i].angular_velocity += between.omega[i];
    between.omega[i].setZero();
  }
  pass_.impact().betweenPullback(between, bars);
  SceneGradient direct = direct_;
  std::vector<BodyModelDerivative> models(motion_.scene->bodies.size());
  for (std::size_t i = 0; i < bars.model.size(); ++i)
    models[static_cast<std::size_t>(event_.participants[i].body)] += bars.model[i];
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    pass_.contactPullback(k, bars.contact[k], bars.pair[k], bars.before, direct, models);
    pass_.surfacePullback(pass_.parts()[k], bars.surface[k], bars.before, direct, models);
    pass_.scatter(pass_.parts()[k], contacts_[k], bars.before, direct, models);
  }
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    seeds[i].center_of_mass += bars.before[i].x;
    seeds[i].orientation += bars.before[i].theta;
  }

  SceneGradient g = adjoint(tape_, seeds);
  for (std::size_t b = 0; b < models.size(); ++b)
    if (!models[b].isZero()) modelPullback(motion_.scene->bodies[b], (*motion_.models)[b], models[b], g.bodies[b]);
  for (std::size_t i = 0; i < direct.tilts.size(); ++i) g.tilts[i] += direct.tilts[i];
  for (std::size_t i = 0; i < direct.materials.size(); ++i) {
    g.materials[i].elasticity += direct.materials[i].elasticity;
    g.materials[i].friction += direct.materials[i].friction;
    g.materials[i].tangential_elasticity += direct.materials[i].tangential_elasticity;
  }
  for (std::size_t i = 0; i < direct.bodies.size(); ++i) {
    g.bodies[i].position += direct.bodies[i].position;
    g.bodies[i].orientation += direct.bodies[i].orientation;
    g.bodies[i].size += direct.bodies[i].size;
    g.bodies[i].surface_velocity += direct.bodies[i].surface_velocity;
    g.bodies[i].surface_angular_velocity += direct.bodies[i].surface_angular_velocity;
  }
  return g;
}

}  // namespace carom::editing_detail
