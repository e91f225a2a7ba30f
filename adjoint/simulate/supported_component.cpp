// SPDX-License-Identifier: MIT
#include "adjoint/simulate/supported_component.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "adjoint/impact/complementarity.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;
using Member = SupportedComponent::Member;

// Normals that differ by less are those of one face.
constexpr double kOneFaceOf = 1e-9;
// Accelerations that are left at rest, as a share of gravity, and in rounding, as a share of what they are made of.
constexpr double kLeftAtRest = 1e-9, kLeftInRounding = 1e-13;
// Room of a cone that friction may lack at the limit, as a share of the weights there.
constexpr double kLackingRoom = 1e-9;
// What bears less than this share of the weights bears nothing.
constexpr double kBears = 1e-9;
// Gravity along the axis of a carrier but for this share is along it.
constexpr double kParallel = 1e-15;
// The angle at which a carrier no longer holds what it carries is known to this, rad; a turn is looked at in so many parts.
constexpr double kAngleKnown = 1e-12;
constexpr int kParts = 8;

// Contacts along their normals: rows of the bodies' velocities, and how an impulse of 1 along each moves the bodies.
struct NormalRows {
  Eigen::MatrixXd rows, moved;  // 6n x N

  NormalRows(const Motion& motion, const std::vector<Member>& members, const std::vector<const Contact*>& contacts)
      : rows(Eigen::MatrixXd::Zero(6 * static_cast<Index>(members.size()), static_cast<Index>(contacts.size()))), moved(rows) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      const BodyModel& model = (*motion.models)[asIndex(members[i].body)];
      const Mat3 A = model.mobilityWorld(members[i].state.q.toRotationMatrix());
      const auto at = 6 * static_cast<Index>(i);
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        const Contact& c = *contacts[k];
        if (c.a != members[i].body && c.b != members[i].body) continue;
        const Vec3 n = (c.a == members[i].body ? 1.0 : -1.0) * c.at.normal, turns = (c.at.point - members[i].state.x).cross(n);
        const auto column = static_cast<Index>(k);
        rows.block<6, 1>(at, column) << n, turns;
        moved.block<6, 1>(at, column) << model.inverse_mass * n, A * turns;
      }
    }
  }
  Eigen::MatrixXd mobility() const { return rows.transpose() * moved; }
};

}  // namespace

SupportedComponent::SupportedComponent(const Motion& motion, std::vector<Member> members, std::vector<const Contact*> closed, double time)
    : motion_(motion), time_(time), members_(std::move(members)), closed_(std::move(closed)), reach_(members_.size(), 0) {
  std::vector<const Contact*> outer;
  std::ranges::copy_if(closed_, std::back_inserter(outer), [&](const Contact* c) { return memberOf(c->a) < 0 || memberOf(c->b) < 0; });
  carried_ = carriedBy(motion, outer, time);
  if (carried_.by) frame_ = carried_.by->at(time);
  if (carried_.by) std::erase_if(closed_, [&](const Contact* c) { return std::ranges::find(carried_.passing, c) != carried_.passing.end(); });
  for (const Member& m : members_) free_.push_back(freeAcceleration((*motion.models)[asIndex(m.body)], m.state, motion.scene->gravity));
  pressed_ = free_;
  presses_.assign(closed_.size(), 0);
  for (const Contact* c : closed_)
    for (const int body : {c->a, c->b})
      if (const int i = memberOf(body); i >= 0)
        reach_[asIndex(i)] = std::max(reach_[asIndex(i)], (c->at.point - members_[asIndex(i)].state.x).norm());
  if (closed_.empty()) return;
  Eigen::VectorXd alpha(closed_.size());
  for (std::size_t k = 0; k < closed_.size(); ++k)
    alpha[static_cast<Index>(k)] = gapAcceleration(motion_, *closed_[k], sideOf(closed_[k]->a, free_), sideOf(closed_[k]->b, free_));
  const NormalRows along(motion_, members_, closed_);
  const std::vector<int> active = activeContacts(along.mobility(), alpha);
  if (active.empty()) return;
  std::vector<const Contact*> pressing;
  for (const int k : active) pressing.push_back(closed_[asIndex(k)]), presses_[asIndex(k)] = 1;
  const NormalRows by(motion_, members_, pressing);
  const Eigen::VectorXd force = LeastNormSolve(by.mobility(), alpha(active)).y, move = by.moved * force;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    pressed_[i].v += move.segment<3>(6 * static_cast<Index>(i));
    pressed_[i].w += move.segment<3>(6 * static_cast<Index>(i) + 3);
  }
  const Eigen::MatrixXd answers = along.rows.transpose() * by.moved * force.asDiagonal();
  for (std::size_t k = 0; k < closed_.size(); ++k) {  // a face stands on all of its corners that do not lift
    const auto row = static_cast<Index>(k);
    const double left = alpha[row] + answers.row(row).sum(), size = std::abs(alpha[row]) + answers.row(row).cwiseAbs().sum();
    if (!(std::abs(left) <= kLeftAtRest * motion_.scene->gravity.norm() + kLeftInRounding * size)) continue;
    const bool on_face = std::ranges::any_of(active, [&](int i) {
      const Contact& c = *closed_[asIndex(i)];
      return c.a == closed_[k]->a && c.b == closed_[k]->b && (c.at.normal - closed_[k]->at.normal).norm() <= kOneFaceOf;
    });
    if (on_face) presses_[k] = 1;
  }
}

int SupportedComponent::memberOf(int body) const {
  const auto found = std::ranges::find(members_, body, &Member::body);
  return found == members_.end() ? -1 : static_cast<int>(found - members_.begin());
}

ContactSide SupportedComponent::sideOf(int body, const std::vector<FreeAcceleration>& accelerations) const {
  const int i = memberOf(body);
  if (i < 0) return givenSide(motion_, body, time_);
  return {members_[asIndex(i)].state, accelerations[asIndex(i)]};
}

double SupportedComponent::speedOf(std::size_t member) const {
  const State& state = members_[member].state;
  return (state.v - frame_.velocityAt(state.x)).norm();
}

double SupportedComponent::spinOf(std::size_t member) const {
  const Member& m = members_[member];
  return ((*motion_.models)[asIndex(m.body)].inverseInertiaWorld(m.state.q.toRotationMatrix()) * m.state.L - frame_.w).norm();
}

std::vector<const Contact*> SupportedComponent::pressed() const {
  std::vector<const Contact*> out;
  for (std::size_t k = 0; k < closed_.size(); ++k)
    if (presses_[k]) out.push_back(closed_[k]);
  return out;
}

// A matter of statics, as for one body: moments count by the arm of the farthest contact. Without loads and units.
RestProgram SupportedComponent::programOf(const std::vector<const Contact*>& contacts) const {
  RestProgram program;
  program.load.setZero(6 * static_cast<Index>(members_.size()));
  for (const Member& m : members_) program.mass.push_back((*motion_.models)[asIndex(m.body)].mass);
  for (const Contact* c : contacts) {
    RestProgram::Contact& at = program.contacts.emplace_back();
    at.a = memberOf(c->a), at.b = memberOf(c->b);
    at.normal = c->at.normal, at.friction = c->pair.friction;
    if (at.a >= 0) at.arm_a = (c->at.point - members_[asIndex(at.a)].state.x) / reach_[asIndex(at.a)];
    if (at.b >= 0) at.arm_b = (c->at.point - members_[asIndex(at.b)].state.x) / reach_[asIndex(at.b)];
  }
  return program;
}

// With what the bodies are pressed by where their carrier turns: m (g - a) and the moment -W x J W.
RestProgram SupportedComponent::loadedProgram(const std::vector<const Contact*>& contacts, const Vec3& gravity) const {
  RestProgram program = programOf(contacts);
  const double pull = pullOf(gravity);
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const BodyModel& model = (*motion_.models)[asIndex(members_[i].body)];
    const auto at = 6 * static_cast<Index>(i);
    program.load.segment<3>(at) = model.mass * (model.gravity_factor * gravity);
    if (frame_.w.isZero(0)) continue;
    const Mat3 R = members_[i].state.q.toRotationMatrix();
    const Vec3 momentum = R * model.inertia.cwiseProduct(R.transpose() * frame_.w);
    program.load.segment<3>(at) -= model.mass * frame_.accelerationAt(members_[i].state.x);
    program.load.segment<3>(at + 3) = -frame_.w.cross(momentum) / reach_[i];
  }
  for (RestProgram::Contact& at : program.contacts) {
    at.unit = std::numeric_limits<double>::infinity();
    for (const int i : {at.a, at.b})
      if (i >= 0) at.unit = std::min(at.unit, program.mass[asIndex(i)] * pull);
  }
  return program;
}

double SupportedComponent::pullOf(const Vec3& gravity) const {
  double pull = 0;
  for (const Member& m : members_) pull = std::max(pull, ((*motion_.models)[asIndex(m.body)].gravity_factor * gravity).norm());
  return pull;
}

bool SupportedComponent::holds(const RestForces& forces) const {
  return forces.room >= -kLackingRoom && forces.unbalanced <= kLeftAtRest * pullOf(motion_.scene->gravity);
}

SupportedComponent::Rest SupportedComponent::restOn(const std::vector<const Contact*>& contacts) const {
  Rest rest;
  if (!carried_.alike) return rest;
  const RestProgram program = loadedProgram(contacts, motion_.scene->gravity);
  const RestForces forces = restForces(program);
  rest.holds = holds(forces);
  if (!rest.holds) return rest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double bears = kBears * program.contacts[k].unit;
    least = std::min(least, bears);
    if (forces.force[k].norm() > bears) rest.bearing.push_back(contacts[k]);
  }
  rest.opposed = opposesEveryMotion(program, forces.force, least);
  return rest;
}

// In the frame of the carrier gravity goes round W. What forces within the cones undo is convex: between two angles all of it is
// undone where that of both is, and that of where the tangents there meet.
double SupportedComponent::heldUntil(const std::vector<const Contact*>& contacts, double until) const {
  const Vec3 &g = motion_.scene->gravity, &w = frame_.w;
  const double rate = w.norm();
  if (!carried_.by || !(w.cross(g).norm() > kParallel * rate * g.norm())) return until;
  const Vec3 axis = w / rate, level = axis * axis.dot(g);
  const auto isHeldAt = [&](double angle, double further) {
    const Vec3 turned = level + further * (expSO3(-angle * axis) * Vec3(g - level));
    return holds(restForces(loadedProgram(contacts, turned)));
  };
  // from an angle at which they are held
  const auto fails = [&](const auto& self, double from, double to) -> std::optional<double> {
    const bool held = isHeldAt(to, 1);
    if (held && isHeldAt(0.5 * (from + to), 1 / elementary::cos(0.5 * (to - from)))) return std::nullopt;
    if (to - from <= kAngleKnown) return held ? std::nullopt : std::optional(to);
    const double middle = 0.5 * (from + to);
    if (const auto first = self(self, from, middle)) return first;
    return self(self, middle, to);
  };
  const double turn = 2 * std::numbers::pi, all = std::min(turn, rate * (until - time_));
  for (int k = 0; k < kParts; ++k)
    if (const auto angle = fails(fails, all * k / kParts, all * (k + 1) / kParts)) return time_ + *angle / rate;
  return until;
}

bool SupportedComponent::holdImpulses(const std::vector<const Contact*>& contacts, const std::vector<const Contact*>& struck,
                                      double slow) const {
  RestProgram program = programOf(contacts);
  double most = 0;
  for (const Contact* c : struck) {
    most = std::max(most, c->impulse.norm());
    for (const bool of_a : {true, false}) {
      const int i = memberOf(of_a ? c->a : c->b);
      if (i < 0) continue;
      const Vec3 P = (of_a ? 1.0 : -1.0) * c->impulse, arm = (c->at.point - members_[asIndex(i)].state.x) / reach_[asIndex(i)];
      program.load.segment<3>(6 * i) += P;
      program.load.segment<3>(6 * i + 3) += arm.cross(P);
    }
  }
  if (!(most > 0)) return true;
  for (RestProgram::Contact& at : program.contacts) at.unit = most;
  const RestForces impulses = restForces(program);
  return impulses.room >= -kLackingRoom && impulses.unbalanced <= slow;
}

void closeGaps(const Motion& motion, std::vector<Member>& members, std::vector<Contact>& closed, double time) {
  std::vector<const Contact*> contacts;
  for (const Contact& c : closed) contacts.push_back(&c);
  const NormalRows along(motion, members, contacts);
  Eigen::VectorXd gaps(closed.size());
  for (std::size_t k = 0; k < closed.size(); ++k) gaps[static_cast<Index>(k)] = closed[k].at.gap;
  const Eigen::VectorXd move = along.moved * LeastNormSolve(along.mobility(), gaps).y;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Vec3 turn = move.segment<3>(6 * static_cast<Index>(i) + 3);
    State& state = members[i].state;
    state.x += move.segment<3>(6 * static_cast<Index>(i));
    if (turn.norm() > 0) state.q = (expSO3(turn) * state.q).normalized();
  }
  for (Contact& c : closed) {
    const auto pose = [&](int b) {
      const auto own = std::ranges::find(members, b, &Member::body);
      return shapePose(motion, b, own != members.end() ? own->state : givenSide(motion, b, time).state);
    };
    c.at = motion.geometry->contact(c.a, c.b, c.features, pose(c.a), pose(c.b));
  }
}

}  // namespace carom::adjoint_detail
