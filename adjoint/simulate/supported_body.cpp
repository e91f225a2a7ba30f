// SPDX-License-Identifier: MIT
#include "adjoint/simulate/supported_body.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/contact/cone_program.hpp"
#include "adjoint/impact/complementarity.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/flat_disc.hpp"
#include "adjoint/simulate/lasting_kinds.hpp"
#include "adjoint/simulate/normal_contacts.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Normals that differ by less are those of one face.
constexpr double kSameNormal = 1e-9;
// Acceleration left by the forces of rest, as a share of gravity.
constexpr double kAtRest = 1e-9;
// What is left in rounding of forces and moments that cancel, as a share of them: a body that hardly resists a turn would
// not rest for it.
constexpr double kCancelled = 1e-13;
// What bears less than this share of the weight bears nothing.
constexpr double kLoaded = 1e-9;
// Velocities of contacts that depend on each other but for so much of them do.
constexpr double kIndependent = 1e-9;
// A spin across the axis that is a smaller share of the whole is none.
constexpr double kNoTilting = 1e-9;

}  // namespace

SupportedBody::SupportedBody(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& closed, double time)
    : motion_(motion),
      body_(body),
      model_((*motion.models)[asIndex(body)]),
      state_(state),
      gravity_(model_.gravity_factor * motion.scene->gravity),
      time_(time),
      R_(state.q.toRotationMatrix()),
      omega_(model_.inverseInertiaWorld(R_) * state.L) {
  for (const Contact* c : closed) reach_ = std::max(reach_, armOf(*c).norm());
  findPressed(closed);
}

void SupportedBody::findPressed(const std::vector<const Contact*>& closed) {
  acceleration_ = freeAcceleration(model_, state_, motion_.scene->gravity);
  if (closed.empty()) return;
  Eigen::VectorXd alpha(closed.size());
  for (std::size_t k = 0; k < closed.size(); ++k) alpha[static_cast<Index>(k)] = freeGapAcceleration(*closed[k]);
  if (closed.size() == 1) {
    if (!(alpha[0] < 0)) return;
    pressed_ = closed;
    const NormalContacts pressing(model_, state_, body_, pressed_);
    push(-alpha[0] / pressing.mobility()(0, 0) * pressing.moved.col(0));
    return;
  }
  const NormalContacts along(model_, state_, body_, closed);
  const std::vector<int> active = activeContacts(along.mobility(), alpha);
  if (active.empty()) return;
  for (int k : active) pressed_.push_back(closed[asIndex(k)]);
  const NormalContacts pressing(model_, state_, body_, pressed_);
  const LeastNormSolve forces(pressing.mobility(), alpha(active));
  push(pressing.moved * forces.y);
  const Eigen::MatrixXd answers = along.rows.transpose() * pressing.moved * forces.y.asDiagonal();
  std::vector<char> stays;  // closed, as far as can be told
  for (Index k = 0; k < alpha.size(); ++k) {
    const double left = alpha[k] + answers.row(k).sum(), size = std::abs(alpha[k]) + answers.row(k).cwiseAbs().sum();
    stays.push_back(std::abs(left) <= kAtRest * gravity_.norm() + kCancelled * size);
  }
  pressed_ = wholeFaces(closed, active, stays);
}

std::vector<const Contact*> SupportedBody::wholeFaces(const std::vector<const Contact*>& closed,
                                                    const std::vector<int>& active,
                                                    const std::vector<char>& stays) const {
  std::vector<const Contact*> pressed;
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const bool on_face = std::ranges::any_of(active, [&](int i) {
      const Contact& c = *closed[asIndex(i)];
      if ((normalOf(c) - normalOf(*closed[k])).norm() > kSameNormal) return false;
      if (otherOf(c) == otherOf(*closed[k])) return true;  // what stands still is one ground
      return std::abs(normalOf(c).dot(c.at.point - closed[k]->at.point)) <= kSameNormal * reach_;
    });
    const bool is_active = std::ranges::binary_search(active, static_cast<int>(k));
    if (is_active || (stays[k] && on_face)) pressed.push_back(closed[k]);
  }
  return pressed;
}

double SupportedBody::freeGapAcceleration(const Contact& c) const {
  const ContactSide own{state_, acceleration_}, other = givenSide(motion_, otherOf(c), time_);
  return c.a == body_ ? gapAcceleration(motion_, c, own, other) : gapAcceleration(motion_, c, other, own);
}

void SupportedBody::push(const Eigen::Matrix<double, 6, 1>& acceleration) {
  acceleration_.v += acceleration.head<3>();
  acceleration_.w += acceleration.tail<3>();
}

ContactJacobian SupportedBody::jacobianOf(const Contact& c) const {
  const auto poseOf = [&](int body) {
    return shapePose(motion_, body, body == body_ ? state_ : motion_.world_lines[asIndex(body)].arcs.back().startState());
  };
  return motion_.geometry->jacobian(c.a, c.b, c.features, poseOf(c.a), poseOf(c.b));
}

bool SupportedBody::isBall() const { return isUniformBall(shape(), model_); }

bool SupportedBody::isAxle() const {
  if (!isRoundAboutAxis(shape(), model_)) return false;
  const Vec3 axis = R_ * this->axis();
  return (omega_ - axis.dot(omega_) * axis).isZero(kNoTilting * omega_.norm()) && liesOnItsSide();
}

bool SupportedBody::liesOnItsSide() const {
  const auto* cylinder = std::get_if<Cylinder>(&shape());
  if (!isRoundAboutAxis(shape(), model_)) return false;
  const double radius = cylinder ? cylinder->radius : std::get<Capsule>(shape()).radius;
  const Vec3 axis = R_ * this->axis(), n = normalOf(*pressed_.front());
  if (pressed_.size() < 2 || std::abs(axis.dot(n)) > kSameNormal) return false;
  // a side that crosses an edge is held at another place of its line all the time, where it may begin to tip
  const Vec3 ahead = axis.cross(n);
  return std::ranges::all_of(pressed_, [&](const Contact* c) {
    const Mat3 follows = jacobianOf(*c).pose.block<3, 3>(4, c->a == body_ ? 0 : 6);
    return std::abs(armOf(*c).dot(n) + radius) <= kSameNormal * radius && (follows * ahead - ahead).norm() <= kSameNormal;
  });
}

Vec3 SupportedBody::axis() const { return model_.has_offset ? Vec3(model_.R_BG * Vec3::UnitZ()) : Vec3(Vec3::UnitZ()); }

bool SupportedBody::isDriven() const {
  return std::ranges::any_of(pressed_, [&](const Contact* c) { return drivesContacts(motion_, otherOf(*c)); });
}

bool SupportedBody::isOneFace() const {
  const Contact& first = *pressed_.front();
  for (const Contact* c : pressed_) {
    if (otherOf(*c) != otherOf(first) || (normalOf(*c) - normalOf(first)).norm() > kSameNormal) return false;
    if (isBall() && !jacobianOf(*c).pose.block<3, 6>(1, c->a == body_ ? 0 : 6).isZero(0)) return false;
  }
  return true;
}

const std::vector<SupportedBody::Carrier>& SupportedBody::carriers() const {
  if (!carriers_) {
    carriers_ = whatCarries();
    loadCarriers(*carriers_);
  }
  return *carriers_;
}

// A disc may be carried between two marks of its rim, at the point of its border that the weight goes towards.
std::vector<SupportedBody::Carrier> SupportedBody::whatCarries() const {
  std::vector<Carrier> carriers;
  for (const Contact* c : pressed_) carriers.push_back({normalOf(*c), armOf(*c) / reach_, c->pair.friction});
  if (const auto disc = FlatDisc::of(motion_, pressed_)) {
    const Vec3& n = carriers.front().n;
    const Vec3 border = disc->borderAt(state_.x - n.dot(state_.x - disc->center) / n.dot(gravity_) * gravity_, n);
    if (border.allFinite()) carriers.push_back({n, (border - state_.x) / reach_, carriers.front().friction});
  }
  return carriers;
}

// A matter of statics: how the body resists a turn has no part in it, and so as if its mass were at its contacts.
void SupportedBody::loadCarriers(std::vector<Carrier>& carriers) const {
  const auto n = static_cast<Index>(carriers.size());
  ConeProgramOf<double> q;
  q.K.resize(3 * n, 3 * n);
  q.b.resize(3 * n);
  for (Index k = 0; k < n; ++k) {
    const Carrier& c = carriers[static_cast<std::size_t>(k)];
    for (Index l = 0; l < n; ++l)
      q.K.block<3, 3>(3 * k, 3 * l) =
          model_.inverse_mass * (Mat3::Identity() - skew(c.arm) * skew(carriers[static_cast<std::size_t>(l)].arm));
    q.b.segment<3>(3 * k) = gravity_;
    q.normal.push_back(c.n);
    q.friction.push_back(c.friction);
  }
  q.offset.assign(carriers.size(), 0);
  q.free.assign(carriers.size(), 0);
  const ConePointOf<double> at = solveConeProgram(q);
  for (std::size_t k = 0; k < carriers.size(); ++k) {
    Carrier& c = carriers[k];
    if (at.state[k] == ConeState::inside) c.force = at.f[k];
    if (at.state[k] == ConeState::slides) c.force = at.pressure[k] * (c.n + c.friction * at.direction[k]);
  }
}

bool SupportedBody::canRest() const {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  for (const Carrier& c : carriers()) force += c.force, moment += c.arm.cross(c.force);
  const double most = kAtRest * gravity_.norm();
  return (gravity_ + model_.inverse_mass * force).norm() <= most && (model_.inverse_mass * moment).norm() <= most;
}

// A motion goes on by itself if no contact with a load slips or opens in it.
bool SupportedBody::isConstrainedFirmly() const {
  const double load = kLoaded * gravity_.norm() / model_.inverse_mass;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3 * static_cast<Index>(carriers().size()), 6);
  Index row = 0;
  for (const Carrier& c : carriers()) {
    if (!(c.force.norm() > load)) continue;
    if (c.friction > 0) {
      rows.middleRows<3>(row) << Mat3::Identity(), -skew(c.arm);
    } else {
      rows.row(row) << c.n.transpose(), c.arm.cross(c.n).transpose();
    }
    row += 3;
  }
  return FullLu(rows, kIndependent).rank() == 6;
}

PathInputs<double> SupportedBody::inputs(double reach) const {
  PathInputs<double> in;
  in.x = state_.x, in.v = state_.v, in.L = state_.L, in.R = R_;
  in.gravity = gravity_;
  in.normal = normalOf(*pressed_.front());
  in.friction = pressed_.front()->pair.friction;
  in.mass = model_.mass;
  in.J = model_.inertia.asDiagonal();
  in.reach = reach;
  in.axis = axis();
  return in;
}

PersistentContact SupportedBody::candidate(const Contact& c) const {
  PersistentContact held;
  held.with = otherOf(c), held.is_first = c.a == body_;
  held.features = c.features;
  held.friction = c.pair.friction;
  return held;
}

ConstrainedScene SupportedBody::constrainedScene(const std::vector<const Contact*>& contacts) const {
  ConstrainedScene scene;
  scene.geometry = motion_.geometry;
  scene.model = motion_.modelOf(body_);
  scene.body = body_;
  scene.gravity = gravity_;
  for (const Contact* c : contacts)
    scene.with.push_back(supportOf(motion_, otherOf(*c), time_));
  scene.time = time_;
  scene.length = reach_ > 0 ? reach_ : kindOf(shape()).boundingRadius(shape()) + model_.center.norm();
  scene.size = scene.length + state_.x.lpNorm<Eigen::Infinity>();
  scene.speed = std::sqrt(gravity_.norm() * scene.length + state_.v.squaredNorm()) + omega_.norm() * scene.length;
  return scene;
}

}  // namespace carom::adjoint_detail
