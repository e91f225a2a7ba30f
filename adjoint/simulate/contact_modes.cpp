// SPDX-License-Identifier: MIT
#include "adjoint/simulate/contact_modes.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/constrained/constrained_start.hpp"
#include "adjoint/simulate/flat_disc.hpp"
#include "adjoint/simulate/lasting_kinds.hpp"
#include "adjoint/simulate/supported_body.hpp"
#include "adjoint/simulate/support_polygon.hpp"

namespace carom::adjoint_detail {
namespace {

// Slower slip than this, times sqrt(g l), counts as none (section 11 of docs/equations.md).
constexpr double kNoSlip = 1e-9;
// Where a slip ends, all that are slower than so many times the slowest end with it.
constexpr double kEndTogether = 1e3;

// A block on whose border of support the force is, to this share of its size, tips.
constexpr double kTips = 1e-12;

class Chooser {
 public:
  Chooser(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& closed, double time)
      : motion_(motion), index_(body), state_(state), closed_(closed), body_(motion, body, state, closed, time) {
    no_slip_ = least_slip_ = leastSlip(body_.reach());
  }

  void ignoreSlips(double slower) { no_slip_ = std::max(no_slip_, slower); }
  void slipEnds() { no_slip_ *= kEndTogether, least_slip_ = no_slip_; }

  ContactChoice follow(PathForm form, const std::vector<const Contact*>& contacts) {
    body_.hold(contacts);
    for (const Contact* c : contacts) least_slip_ = std::max(least_slip_, leastSlip(body_.armOf(*c).norm()));
    return form == PathForm::rest ? rests() : stays(form, body_.height());
  }

  ContactChoice restOn(const std::vector<const Contact*>& contacts, bool loose) {
    body_.hold(contacts);
    ContactChoice choice = stays(PathForm::rest, 1);
    choice.path->loose = loose;
    return choice;
  }

  /// As forces within the cones of friction hold it; without friction where none are found.
  FreeAcceleration acceleration() const {
    if (body_.pressed().empty()) return body_.acceleration();
    std::vector<PersistentContact> candidates;
    for (const Contact* c : closed_) candidates.push_back(body_.candidate(*c));
    const ConstrainedModes modes = chooseModes(body_.constrainedScene(closed_), candidates, state_, {}, no_slip_);
    if (!modes.unresolved.empty()) return body_.acceleration();
    return {modes.acceleration, modes.spin_rate};
  }

  ContactChoice choose(const ModeHint& hint) {
    if (body_.pressed().empty()) return {};
    if (body_.isDriven()) return held(hint);
    if (standsStill(state_.v, body_.spin())) return rests();
    ContactChoice closed_form;
    if (body_.isOneFace() && frictionPressesNoOther()) {
      if (body_.isBall()) {
        if (body_.pressed().size() == 1) closed_form = ball();
      } else if (body_.isAxle()) {
        closed_form = axle();
      } else if (isSlow(body_.reach() * body_.spin()) && hint.cause != TransitionCause::tips) {
        closed_form = block();
      }
    }
    return closed_form.path ? closed_form : held(hint);
  }

  ContactChoice tilts(const std::vector<const Contact*>& contacts, const ModeHint& hint) {
    closed_ = contacts;
    return held(hint);
  }

  ContactChoice constrainedAs(const std::vector<const Contact*>& contacts, const std::vector<PersistentContact>& like) {
    body_.hold(contacts);
    ContactChoice choice = onConstrainedPath();
    std::vector<PersistentContact> held;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      held.push_back(body_.candidate(*contacts[k]));
      held.back().mode = like[k].mode, held.back().begins = like[k].begins;
    }
    choice.modes = modesAs(choice.scene, held, state_);
    if (!choice.modes.unresolved.empty()) return beyond(choice.modes.unresolved);
    begin(choice);
    return choice;
  }

 private:
  double leastSlip(double reach) const { return adjoint_detail::leastSlip(body_.gravity().norm(), reach); }
  bool isSlow(const Vec3& v) const { return v.norm() <= no_slip_; }
  // What counts as no slip stops what can move by slipping alone: what rolls goes on, however slow.
  bool standsStill(const Vec3& v, const Vec3& spin) const {
    if (!isSlow(v) || !isSlow(body_.reach() * spin) || !body_.canRest()) return false;
    return std::max(v.norm(), body_.reach() * spin.norm()) <= leastSlip(body_.reach()) || body_.isConstrainedFirmly();
  }

  ContactChoice onConstrainedPath() const {
    ContactChoice choice;
    choice.path = std::make_shared<ContactPath>();
    choice.path->form = PathForm::held;
    choice.path->inputs = body_.inputs(1);
    choice.path->body = index_;
    choice.path->face = body_.otherOf(*body_.pressed().front());
    choice.contacts = body_.pressed();
    choice.scene = body_.constrainedScene(body_.pressed());
    return choice;
  }
  void begin(ContactChoice& choice) const {
    choice.start = constrainedStart(choice.scene, choice.modes.contacts, state_, choice.scene.time, 2, &choice.stopped);
    choice.path->inputs.x = choice.start.x, choice.path->inputs.v = choice.start.v, choice.path->inputs.L = choice.start.L;
  }

  // Whether contacts that gravity does not press, as of a ball that spins beside a wall, are not pressed by friction.
  bool frictionPressesNoOther() const {
    if (body_.pressed().size() == closed_.size()) return true;
    std::vector<PersistentContact> candidates;
    for (const Contact* c : closed_) candidates.push_back(body_.candidate(*c));
    const ConstrainedModes modes = chooseModes(body_.constrainedScene(closed_), candidates, state_, {}, no_slip_);
    return modes.unresolved.empty() && std::ranges::all_of(modes.held, [&](std::size_t k) {
             return std::ranges::find(body_.pressed(), closed_[k]) != body_.pressed().end();
           });
  }

  // Any contacts, in the modes that forces allow.
  ContactChoice held(const ModeHint& hint) {
    std::vector<PersistentContact> candidates;
    for (const Contact* c : closed_) candidates.push_back(body_.candidate(*c));
    const ConstrainedScene all = body_.constrainedScene(closed_);
    ConstrainedModes modes = chooseModes(all, candidates, state_, hint, no_slip_);
    if (!modes.unresolved.empty()) return beyond(modes.unresolved);
    if (modes.held.empty()) return {};
    std::vector<const Contact*> holding;
    for (const std::size_t k : modes.held) holding.push_back(closed_[k]);
    body_.hold(holding);
    ContactChoice choice = onConstrainedPath();
    choice.modes = std::move(modes);
    begin(choice);
    return !body_.isDriven() && comesToRest(choice) ? rests() : choice;
  }

  // Whether contacts that came to hold it leave the body no motion.
  bool comesToRest(const ContactChoice& choice) const {
    const State& start = choice.start;
    const Vec3 spin = choice.scene.model->inverseInertiaWorld(start.q.toRotationMatrix()) * start.L;
    return standsStill(start.v, spin);
  }

  // A ball, or what lies on its side, stays where it is, and would roll if anything were a little different.
  ContactChoice rests() const {
    PathForm varied = PathForm::rest;
    const bool opposed = body_.isConstrainedFirmly();
    if (!opposed && body_.isOneFace() && body_.pressed().front()->pair.friction > 0) {
      if (body_.isBall() && body_.pressed().size() == 1) varied = PathForm::roll_ball;
      if (body_.liesOnItsSide()) varied = PathForm::roll_axle;
    }
    ContactChoice choice = stays(PathForm::rest, varied == PathForm::rest ? 1 : body_.height(), varied);
    choice.path->loose = !opposed && varied == PathForm::rest;
    return choice;
  }

  ContactChoice ball() {
    const PathInputs<double> in = body_.inputs(body_.height());
    const Tier derivative = motion_.plan.bodies[asIndex(index_)].derivative_tier;
    if (!keepsBall(derivative)) return {};
    if (body_.slipOf(*body_.pressed().front()).norm() > least_slip_) return stays(PathForm::glide_ball, in.reach);
    const Vec3 slope = alongFace(in.normal, in.gravity);
    const double k = ballInertia(in) / (in.mass * in.reach * in.reach);
    const bool rolls = slope.norm() * k / (1 + k) <= in.friction * pressingGravity(in);
    return stays(rolls ? PathForm::roll_ball : PathForm::glide_ball, in.reach);
  }

  ContactChoice axle() {
    const PathInputs<double> in = body_.inputs(body_.height());
    for (const Contact* c : body_.pressed())
      if (body_.slipOf(*c).norm() > least_slip_) return {};
    const RollPath<double> path = RollPath<double>::axle(in);
    const Vec3 friction = alongFace(in.normal, in.gravity) - path.acceleration();
    if (!(friction.norm() <= in.friction * pressingGravity(in))) return {};
    return stays(PathForm::roll_axle, in.reach);
  }

  ContactChoice block() {
    PathInputs<double> in = body_.inputs(body_.height());
    beginSlip(in, PathForm::glide_block);
    const bool stands = !in.begins && in.friction > 0 && alongFace(in.normal, in.v).norm() <= least_slip_;
    if (stands) return {};  // but cannot rest: it tips
    const Vec3 ahead = slipDirectionAt<double>(PathForm::glide_block, in, 0);
    const SupportPolygon support(body_.pressed(), in.normal);
    const Vec3 force = in.x + in.friction * in.reach * ahead;
    double room = support.roomAround(force);
    if (const auto disc = FlatDisc::of(motion_, body_.pressed())) room = std::max(room, disc->roomAround(force, in.normal));
    if (!(room > kTips * body_.reach())) return {};
    return stays(PathForm::glide_block, in.reach);
  }

  // A slip that is next to none says nothing of its direction, be it rounding or not: what gravity keeps up begins along the
  // slope (11.6). What is left of it is stopped at the contact, as where a ball rolls.
  void beginSlip(PathInputs<double>& in, PathForm form) const {
    const GlidePath<double> path = glideOf(form, in);
    const Vec3& s = path.slip().start();
    const double friction = path.slip().friction();
    if (!(friction > 0) || !(path.slip().slope().norm() > friction) || s.norm() > least_slip_) return;
    in.begins = true;
    if (form == PathForm::glide_block) {
      in.v -= s;
      return;
    }
    const double inertia = ballInertia(in), k = inertia / (in.mass * in.reach * in.reach);
    in.v -= k / (1 + k) * s;
    in.L += inertia * in.normal.cross(s) / ((1 + k) * in.reach);
  }

  ContactChoice beyond(std::string what) const {
    ContactChoice choice;
    choice.start = state_, choice.contacts = body_.pressed(), choice.beyond = std::move(what);
    return choice;
  }

  ContactChoice stays(PathForm form, double reach, PathForm when_varied = PathForm::rest) const {
    ContactChoice choice;
    choice.path = std::make_shared<ContactPath>();
    ContactPath& path = *choice.path;
    path.form = form, path.when_varied = when_varied;
    path.inputs = body_.inputs(reach);
    path.body = index_;
    path.face = body_.otherOf(*body_.pressed().front());
    if (path.variedForm() != PathForm::rest) {
      const ContactJacobian J = body_.jacobianOf(*body_.pressed().front());
      path.reach_rates = -(body_.pressed().front()->a == index_ ? J.size_a : J.size_b).row(0);
    }
    if (form == PathForm::glide_block) path.inputs.L.setZero();
    if (glides(form)) beginSlip(path.inputs, form);
    const PathState<double> start = pathStateAt<double>(form, path.inputs, 0);
    choice.start = {start.x, state_.q, start.v, start.L};
    path.inputs.v = start.v;
    path.inputs.L = start.L;
    if (const auto end = slipEnd(form, path.inputs)) path.slip_end = *end;
    choice.contacts = body_.pressed();
    return choice;
  }

  const Motion& motion_;
  int index_;
  const State& state_;
  std::vector<const Contact*> closed_;
  SupportedBody body_;
  double no_slip_ = 0;
  double least_slip_ = 0;  // of what can glide: that ends by itself
};

// Of a scene that is replayed: what stood still may move there, and closed forms are not carried along.
void requireStill(const Motion& motion, int body, const std::vector<const Contact*>& contacts) {
  const std::vector<Body>& bodies = motion.scene->bodies;
  for (const Contact* c : contacts) {
    const auto with = static_cast<std::size_t>(c->a == body ? c->b : c->a);
    if (!motion.world_lines[with].arcs.back().stays() || bodies[with].surfaceMoves())
      throw NotComputable("'" + bodies[with].name + "', on which '" + bodies[static_cast<std::size_t>(body)].name + "' lies, moves");
  }
}

}  // namespace

double leastSlip(double gravity, double reach) { return kNoSlip * std::sqrt(gravity * reach); }

ContactChoice restPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& contacts, bool loose,
                         double time) {
  return Chooser(motion, body, state, {}, time).restOn(contacts, loose);
}

FreeAcceleration pressedAcceleration(const Motion& motion, int body, const State& state,
                                     const std::vector<const Contact*>& closed, double time) {
  return Chooser(motion, body, state, closed, time).acceleration();
}

ContactChoice contactPathOf(const Motion& motion, int body, const State& state,
                            const std::vector<const Contact*>& contacts, PathForm form, double time) {
  requireStill(motion, body, contacts);
  return Chooser(motion, body, state, {}, time).follow(form, contacts);
}

ContactChoice chooseContactPath(const Motion& motion, int body, const State& state,
                                const std::vector<const Contact*>& closed, double time, const ModeHint& hint) {
  Chooser chooser(motion, body, state, closed, time);
  chooser.ignoreSlips(hint.no_slip);
  if (hint.cause != TransitionCause::sticks && hint.cause != TransitionCause::slip_ends) return chooser.choose(hint);
  Chooser ends = chooser;
  ends.slipEnds();
  ContactChoice choice = ends.choose(hint);
  return choice.beyond.empty() ? choice : chooser.choose(hint);  // not all end together
}

ContactChoice tiltingPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& marks,
                            const std::vector<const Contact*>& contacts, double time, const ModeHint& hint) {
  Chooser chooser(motion, body, state, marks, time);
  chooser.ignoreSlips(hint.no_slip);
  return chooser.tilts(contacts, hint);
}

ContactChoice constrainedPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& contacts,
                         const std::vector<PersistentContact>& like, double time) {
  return Chooser(motion, body, state, contacts, time).constrainedAs(contacts, like);
}

}  // namespace carom::adjoint_detail
