// SPDX-License-Identifier: MIT
#include "adjoint/simulate/contact_modes.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/contact/cone_program.hpp"
#include "adjoint/held/held_start.hpp"
#include "adjoint/impact/complementarity.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/lasting_kinds.hpp"
#include "adjoint/simulate/normal_contacts.hpp"
#include "adjoint/simulate/support_polygon.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// Slower slip than this, times sqrt(g l), counts as none (section 11 of docs/equations.md).
constexpr double kNoSlip = 1e-9;
// Normals that differ by less are those of one face.
constexpr double kSameNormal = 1e-9;
// Acceleration left by the forces of rest, as a share of gravity.
constexpr double kAtRest = 1e-9;
// Where a slip ends, all that are slower than so many times the slowest end with it.
constexpr double kEndTogether = 1e3;

class Chooser {
 public:
  Chooser(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& closed)
      : motion_(motion),
        scene_(*motion.scene),
        body_(body),
        model_((*motion.models)[asIndex(body)]),
        state_(state),
        gravity_(model_.gravity_factor * scene_.gravity),
        R_(state.q.toRotationMatrix()),
        A_(model_.mobilityWorld(R_)),
        omega_(model_.inverseInertiaWorld(R_) * state.L) {
    for (const Contact* c : closed) reach_ = std::max(reach_, armOf(*c).norm());
    no_slip_ = least_slip_ = kNoSlip * std::sqrt(gravity_.norm() * reach_);
    closed_ = closed;
    press(closed);
  }

  void ignoreSlips(double slower) { no_slip_ = std::max(no_slip_, slower); }
  void slipEnds() { no_slip_ *= kEndTogether, least_slip_ = no_slip_; }

  ContactChoice follow(PathForm form, const std::vector<const Contact*>& contacts) {
    pressed_ = contacts;
    return stays(form, form == PathForm::rest ? 1 : heightOf());
  }

  /// As forces within the cones of friction hold it; without friction where none are found.
  FreeAcceleration acceleration() const {
    if (pressed_.empty()) return free_;
    std::vector<HeldContact> candidates;
    for (const Contact* c : closed_) candidates.push_back(candidate(*c));
    const HeldModes modes = chooseModes(heldScene(closed_), candidates, state_, {}, no_slip_);
    if (!modes.unresolved.empty()) return free_;
    return {modes.acceleration, modes.spin_rate};
  }

  ContactChoice choose(const ModeHint& hint) {
    if (pressed_.empty()) return {};
    if (isSlow(state_.v) && isSlow(reach_ * omega_) && canRest()) return stays(PathForm::rest, 1);
    ContactChoice closed_form;
    if (isOneFace()) {
      if (isBall()) {
        if (pressed_.size() == 1) closed_form = ball();
      } else if (isAxle()) {
        closed_form = axle();
      } else if (isSlow(reach_ * omega_) && hint.cause != TransitionCause::tips) {
        closed_form = block();
      }
    }
    return closed_form.path ? closed_form : held(hint);
  }

  ContactChoice heldAs(const std::vector<const Contact*>& contacts, const HeldModes& like) {
    pressed_ = contacts;
    ContactChoice choice = onHeldPath();
    choice.modes = like;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      HeldContact& c = choice.modes.contacts[k];
      const HeldContact now = candidate(*contacts[k]);
      c.with = now.with, c.is_first = now.is_first, c.features = now.features, c.friction = now.friction;
    }
    begin(choice);
    return choice;
  }

 private:
  double signOf(const Contact& c) const { return c.a == body_ ? 1 : -1; }
  int otherOf(const Contact& c) const { return c.a == body_ ? c.b : c.a; }
  Vec3 armOf(const Contact& c) const { return c.at.point - state_.x; }
  Vec3 normalOf(const Contact& c) const { return signOf(c) * c.at.normal; }  // towards the body
  Vec3 slipOf(const Contact& c) const {
    const Vec3 u = state_.v + omega_.cross(armOf(c)), n = normalOf(c);
    return u - n.dot(u) * n;
  }
  bool isSlow(const Vec3& v) const { return v.norm() <= no_slip_; }

  // Of the closed contacts, those that a force without friction has to keep closed.
  void press(const std::vector<const Contact*>& closed) {
    free_ = freeAcceleration(model_, state_, scene_.gravity);
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
  }

  double freeGapAcceleration(const Contact& c) const {
    const ContactSide own{state_, free_},
        other{motion_.world_lines[asIndex(otherOf(c))].arcs.back().startState(), std::nullopt};
    return c.a == body_ ? gapAcceleration(motion_, c, own, other) : gapAcceleration(motion_, c, other, own);
  }
  void push(const Eigen::Matrix<double, 6, 1>& acceleration) {
    free_.v += acceleration.head<3>();
    free_.w += acceleration.tail<3>();
  }

  bool isOneFace() const {
    const Contact& first = *pressed_.front();
    for (const Contact* c : pressed_) {
      if (otherOf(*c) != otherOf(first) || (normalOf(*c) - normalOf(first)).norm() > kSameNormal) return false;
      if (isBall() && !jacobianOf(*c).pose.block<3, 6>(1, c->a == body_ ? 0 : 6).isZero(0)) return false;
    }
    return true;
  }

  ContactJacobian jacobianOf(const Contact& c) const {
    const auto poseOf = [&](int body) {
      return shapePose(motion_, body, body == body_ ? state_ : motion_.world_lines[asIndex(body)].arcs.back().startState());
    };
    return motion_.geometry->jacobian(c.a, c.b, c.features, poseOf(c.a), poseOf(c.b));
  }

  // Forces within the cones of friction that undo gravity.
  bool canRest() const {
    const auto n = static_cast<Index>(pressed_.size());
    ConeProgramOf<double> q;
    q.K.resize(3 * n, 3 * n);
    q.b.resize(3 * n);
    for (Index k = 0; k < n; ++k) {
      const Contact& c = *pressed_[static_cast<std::size_t>(k)];
      for (Index l = 0; l < n; ++l)
        q.K.block<3, 3>(3 * k, 3 * l) = model_.inverse_mass * Mat3::Identity() -
                                        skew(armOf(c)) * A_ * skew(armOf(*pressed_[static_cast<std::size_t>(l)]));
      q.b.segment<3>(3 * k) = gravity_;
      q.normal.push_back(normalOf(c));
      q.friction.push_back(c.pair.friction);
    }
    q.offset.assign(static_cast<std::size_t>(n), 0);
    q.free.assign(static_cast<std::size_t>(n), 0);
    const ConePointOf<double> at = solveConeProgram(q);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t k = 0; k < pressed_.size(); ++k) {
      Vec3 f = Vec3::Zero();
      if (at.state[k] == ConeState::inside) f = at.f[k];
      if (at.state[k] == ConeState::slides)
        f = at.pressure[k] * (q.normal[k] + q.friction[k] * at.direction[k]);
      force += f;
      moment += armOf(*pressed_[k]).cross(f);
    }
    const double most = kAtRest * gravity_.norm();
    return (gravity_ + model_.inverse_mass * force).norm() <= most && (A_ * moment).norm() * reach_ <= most;
  }

  HeldContact candidate(const Contact& c) const {
    HeldContact held;
    held.with = otherOf(c), held.is_first = c.a == body_;
    held.features = c.features;
    held.friction = c.pair.friction;
    return held;
  }
  HeldScene heldScene(const std::vector<const Contact*>& contacts) const {
    HeldScene scene;
    scene.geometry = motion_.geometry;
    scene.model = &model_;
    scene.body = body_;
    scene.gravity = gravity_;
    for (const Contact* c : contacts)
      scene.with.push_back(
          shapePose(motion_, otherOf(*c), motion_.world_lines[asIndex(otherOf(*c))].arcs.back().startState()));
    scene.length = reach_ > 0 ? reach_ : 1;
    scene.speed = std::sqrt(gravity_.norm() * scene.length + state_.v.squaredNorm()) + omega_.norm() * scene.length;
    return scene;
  }
  ContactChoice onHeldPath() const {
    ContactChoice choice;
    choice.path = std::make_shared<ContactPath>();
    choice.path->form = PathForm::held;
    choice.path->inputs = inputs(1);
    choice.path->body = body_;
    choice.path->face = otherOf(*pressed_.front());
    choice.contacts = pressed_;
    choice.scene = heldScene(pressed_);
    return choice;
  }
  void begin(ContactChoice& choice) const {
    choice.start = heldStart(choice.scene, choice.modes.contacts, state_);
    choice.path->inputs.x = choice.start.x, choice.path->inputs.v = choice.start.v, choice.path->inputs.L = choice.start.L;
  }

  // Any contacts, in the modes that forces allow.
  ContactChoice held(const ModeHint& hint) {
    std::vector<HeldContact> candidates;
    for (const Contact* c : closed_) candidates.push_back(candidate(*c));
    const HeldScene all = heldScene(closed_);
    HeldModes modes = chooseModes(all, candidates, state_, hint, no_slip_);
    if (!modes.unresolved.empty()) return beyond(modes.unresolved);
    if (modes.held.empty()) return {};
    pressed_.clear();
    for (const std::size_t k : modes.held) pressed_.push_back(closed_[k]);
    ContactChoice choice = onHeldPath();
    choice.modes = std::move(modes);
    begin(choice);
    return choice;
  }

  bool isBall() const { return isUniformBall(scene_.bodies[asIndex(body_)].shape, model_); }
  // Of a cylinder or capsule that lies on its side, all of whose contacts are on the line below its axis.
  bool isAxle() const {
    const Shape& shape = scene_.bodies[asIndex(body_)].shape;
    const auto* cylinder = std::get_if<Cylinder>(&shape);
    if (!isRoundAboutAxis(shape, model_)) return false;
    const double radius = cylinder ? cylinder->radius : std::get<Capsule>(shape).radius;
    const Vec3 axis = R_ * axisOf(), n = normalOf(*pressed_.front());
    if (pressed_.size() < 2 || std::abs(axis.dot(n)) > kSameNormal) return false;
    if (!(omega_ - axis.dot(omega_) * axis).isZero(kNoSlip * omega_.norm())) return false;
    return std::ranges::all_of(pressed_, [&](const Contact* c) {
      return std::abs(armOf(*c).dot(n) + radius) <= kSameNormal * radius;
    });
  }
  Vec3 axisOf() const { return model_.has_offset ? Vec3(model_.R_BG * Vec3::UnitZ()) : Vec3(Vec3::UnitZ()); }

  PathInputs<double> inputs(double reach) const {
    PathInputs<double> in;
    in.x = state_.x, in.v = state_.v, in.L = state_.L, in.R = R_;
    in.gravity = gravity_;
    in.normal = normalOf(*pressed_.front());
    in.friction = pressed_.front()->pair.friction;
    in.mass = model_.mass;
    in.J = model_.inertia.asDiagonal();
    in.reach = reach;
    in.axis = axisOf();
    return in;
  }
  double heightOf() const { return -armOf(*pressed_.front()).dot(normalOf(*pressed_.front())); }

  ContactChoice ball() {
    const PathInputs<double> in = inputs(heightOf());
    const Tier derivative = motion_.plan.bodies[asIndex(body_)].derivative_tier;
    if (!keepsBall(derivative)) return {};
    if (slipOf(*pressed_.front()).norm() > least_slip_) return stays(PathForm::glide_ball, in.reach);
    const Vec3 slope = alongFace(in.normal, in.gravity);
    const double k = ballInertia(in) / (in.mass * in.reach * in.reach);
    const bool rolls = slope.norm() * k / (1 + k) <= in.friction * pressingGravity(in);
    return stays(rolls ? PathForm::roll_ball : PathForm::glide_ball, in.reach);
  }

  ContactChoice axle() {
    const PathInputs<double> in = inputs(heightOf());
    for (const Contact* c : pressed_)
      if (slipOf(*c).norm() > least_slip_) return {};
    const RollPath<double> path = RollPath<double>::axle(in);
    const Vec3 friction = alongFace(in.normal, in.gravity) - path.acceleration();
    if (!(friction.norm() <= in.friction * pressingGravity(in))) return {};
    return stays(PathForm::roll_axle, in.reach);
  }

  ContactChoice block() {
    const PathInputs<double> in = inputs(heightOf());
    const Vec3 ahead = slipDirectionAt<double>(PathForm::glide_block, in, 0);
    const SupportPolygon support(pressed_, in.normal);
    if (!(support.roomAround(in.x + in.friction * in.reach * ahead) > 0)) return {};
    return stays(PathForm::glide_block, in.reach);
  }

  ContactChoice beyond(std::string what) const {
    ContactChoice choice;
    choice.start = state_, choice.contacts = pressed_, choice.beyond = std::move(what);
    return choice;
  }

  ContactChoice stays(PathForm form, double reach) const {
    ContactChoice choice;
    choice.path = std::make_shared<ContactPath>();
    ContactPath& path = *choice.path;
    path.form = form;
    path.inputs = inputs(reach);
    if (form == PathForm::roll_ball || form == PathForm::roll_axle) {  // what is left of a slip is stopped at the contact
      const double inertia = form == PathForm::roll_ball ? ballInertia(path.inputs)
                                                         : path.inputs.axis.dot(path.inputs.J * path.inputs.axis);
      const double k = inertia / (path.inputs.mass * reach * reach);
      path.inputs.v -= k / (1 + k) * slipOf(*pressed_.front());
    }
    path.body = body_;
    path.face = otherOf(*pressed_.front());
    if (form != PathForm::rest) {
      const ContactJacobian J = jacobianOf(*pressed_.front());
      path.reach_rates = -(pressed_.front()->a == body_ ? J.size_a : J.size_b).row(0);
    }
    if (form == PathForm::glide_block) path.inputs.L.setZero();
    const PathState<double> start = pathStateAt<double>(form, path.inputs, 0);
    choice.start = {start.x, state_.q, start.v, start.L};
    path.inputs.v = start.v;
    path.inputs.L = start.L;
    if (const auto end = slipEnd(form, path.inputs)) path.slip_end = *end;
    choice.contacts = pressed_;
    return choice;
  }

  const Motion& motion_;
  const Scene& scene_;
  int body_;
  const BodyModel& model_;
  const State& state_;
  Vec3 gravity_;
  Mat3 R_, A_;
  Vec3 omega_;
  double reach_ = 0, no_slip_ = 0;
  double least_slip_ = 0;  // of what can glide: that ends by itself
  std::vector<const Contact*> closed_, pressed_;
  FreeAcceleration free_;
};

}  // namespace

FreeAcceleration pressedAcceleration(const Motion& motion, int body, const State& state,
                                     const std::vector<const Contact*>& closed) {
  return Chooser(motion, body, state, closed).acceleration();
}

ContactChoice contactPathOf(const Motion& motion, int body, const State& state,
                            const std::vector<const Contact*>& contacts, PathForm form) {
  return Chooser(motion, body, state, {}).follow(form, contacts);
}

ContactChoice chooseContactPath(const Motion& motion, int body, const State& state,
                                const std::vector<const Contact*>& closed, const ModeHint& hint) {
  Chooser chooser(motion, body, state, closed);
  chooser.ignoreSlips(hint.no_slip);
  if (hint.cause == TransitionCause::sticks || hint.cause == TransitionCause::slip_ends) chooser.slipEnds();
  return chooser.choose(hint);
}

ContactChoice heldPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& contacts,
                         const HeldModes& like) {
  return Chooser(motion, body, state, contacts).heldAs(contacts, like);
}

}  // namespace carom::adjoint_detail
