// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_event.hpp"

#include "adjoint/impact/tilt_frame.hpp"
#include "adjoint/impact/double_double_impact.hpp"
#include "adjoint/derivative/transition_guard.hpp"
#include "adjoint/motion/guard.hpp"

// What EventPass is made of, in dual numbers. Its formulae are those of the reverse pass in doubles; what goes in has
// another text here, for a first derivative is asked for far more often, and needs neither the full inertia tensor nor
// rotations as matrices of duals.

namespace carom::adjoint_detail {
namespace {

using Part = ContactPart<Num>;

class EventMaker {
 public:
  EventMaker(const Lanes& lanes, int event)
      : lanes_(lanes), index_(event), event_(lanes.motion().events[static_cast<std::size_t>(event)]) {
    for (const Participant& p : event_.participants)
      before_.push_back(
          lanes.stateAt(p.body, p.arc, lanes.eventTime(event), p.before, lanes.tape().until(p, event_.time)));
  }

  DualEvent take() {
    EventPass<Num> pass = passOf();
    const auto begins = [](const Contact& c) { return c.lasts && !c.held; };
    if (std::ranges::any_of(event_.contacts, begins)) {
      const Motion& motion = lanes_.motion();
      pass.setBends([&motion, &event = event_, lanes = lanes_.size()](std::size_t contact, const auto& w) {
        return bendOf(motion, event, lanes, event.contacts[contact], w);
      });
    }
    return {std::move(before_), std::move(pass)};
  }

 private:
  // w has no values, so that only its rates count. Turns do not commute: (9.5).
  static EventPass<Num>::Bend bendOf(const Motion& motion, const Event& event, std::size_t lanes, const Contact& c,
                                     const EventPass<Num>::Vec12& w) {
    const Pose A = poseBefore(motion, event, c.a), B = poseBefore(motion, event, c.b);
    const ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, A, B);
    std::vector<PairTangent> along(lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      along[lane].pose = ratesOf(w, lane);
      along[lane].size_a = Eigen::VectorXd::Zero(J.size_a.cols());
      along[lane].size_b = Eigen::VectorXd::Zero(J.size_b.cols());
    }
    const std::vector<ContactJacobian> dJ = motion.geometry->jacobianRates(c.a, c.b, c.features, A, B, along);
    EventPass<Num>::Bend bend;
    bend.size_a = VectorOf<Num>::Zero(J.size_a.cols());
    bend.size_b = VectorOf<Num>::Zero(J.size_b.cols());
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      Eigen::Matrix<double, 12, 1> pose = dJ[lane].pose.row(0).transpose();
      for (const Eigen::Index theta : {3, 9}) {
        const Vec3 row = J.pose.block<1, 3>(0, theta).transpose(), turn = along[lane].pose.segment<3>(theta);
        pose.segment<3>(theta) += row.cross(turn);
      }
      setRates(bend.pose, pose, lane);
      setRates(bend.size_a, Eigen::VectorXd(dJ[lane].size_a.row(0).transpose()), lane);
      setRates(bend.size_b, Eigen::VectorXd(dJ[lane].size_b.row(0).transpose()), lane);
    }
    return bend;
  }

  EventPass<Num> passOf() const {
    ImpactInputs<Num> inputs;
    std::vector<StateBar> rate_before, rate_after;
    const Num time = lanes_.eventTime(index_);
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const Participant& p = event_.participants[i];
      const DualModel& m = lanes_.model(p.body);
      const DualState& s = before_[i];
      const bool moves = !m.kinematic && !p.stays;
      inputs.bodies.push_back({!moves, p.stays, moves ? m.inverse_mass : Num(0), s.R, m.A, s.x, s.v, s.L});
      rate_before.push_back(lanes_.rate(p.body, p.arc, time, s));
      rate_after.push_back(lanes_.rate(p.body, p.next(), time, lanes_.startOf(p.body, p.next())));
    }
    std::vector<Part> parts;
    const std::vector<double> weights = guardWeights(event_);
    for (std::size_t k = 0; k < weights.size(); ++k) parts.push_back(partOf(event_.contacts[k], weights[k], inputs));
    EventGuard<Num> guard = guardOf(parts, inputs);
    return {event_,
            usesDoubleDouble(event_, *lanes_.motion().models),
            std::move(inputs),
            std::move(parts),
            std::move(guard),
            std::move(rate_before),
            std::move(rate_after)};
  }

  // Rates of the poses at the time of the event, which moves along.
  PairTangent pairTangent(const Part& part, std::size_t lane) const {
    PairTangent t;
    const auto& scene_bodies = lanes_.direction(lane).scene.bodies;
    const auto fill = [&](const Part::Side& side, Eigen::Index at, Eigen::VectorXd& size) {
      const BodyDerivative& written = scene_bodies[static_cast<std::size_t>(side.body)];
      size = written.size;
      if (side.participant < 0) {
        t.pose.segment<3>(at) = written.position;
        t.pose.segment<3>(at + 3) = written.orientation;
        return;
      }
      const DualState& s = before_[static_cast<std::size_t>(side.participant)];
      t.pose.segment<3>(at) = ratesOf(s.x, lane);
      t.pose.segment<3>(at + 3) = 0.5 * unskew(Mat3(ratesOf(s.R, lane) * valuesOf(s.R).transpose()));
    };
    fill(part.a, 0, t.size_a);
    fill(part.b, 6, t.size_b);
    return t;
  }

  ContactPart<Num> partOf(const Contact& c, double weight, ImpactInputs<Num>& inputs) const {
    const Motion& motion = lanes_.motion();
    Part part;
    part.a = {c.a, participantOf(event_, c.a)};
    part.b = {c.b, participantOf(event_, c.b)};
    part.guard[0] = event_.kind == EventKind::transition ? 0 : weight;
    part.material_a = materialIndexOf(*motion.scene, c.a);
    part.material_b = materialIndexOf(*motion.scene, c.b);
    part.rules = inForce(lanes_.rules(c.a, c.b), event_, c);
    part.closes = c.lasts;
    const Pose A = poseBefore(motion, event_, c.a), B = poseBefore(motion, event_, c.b);
    const ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, A, B);
    std::vector<PairTangent> along;
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) along.push_back(pairTangent(part, lane));
    const std::vector<ContactJacobian> dJ = motion.geometry->jacobianRates(c.a, c.b, c.features, A, B, along);
    part.pose = J.pose.cast<Num>();
    part.size_a = J.size_a.cast<Num>();
    part.size_b = J.size_b.cast<Num>();
    Eigen::Matrix<Num, 7, 1> at;
    at << Num(c.at.gap), constant(c.at.normal), constant(c.at.point);
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      setRates(part.pose, dJ[lane].pose, lane);
      setRates(part.size_a, dJ[lane].size_a, lane);
      setRates(part.size_b, dJ[lane].size_b, lane);
      setRates(at, J.along(along[lane]), lane);
    }
    part.gap = at[0];
    part.gap.value = 0;
    const NVec normal = tiltNormal(c, at.segment<3>(1), part);
    NVec surface = NVec::Zero();
    part.surface = surfaceOf(c, part, at);
    if (part.surface) surface = part.surface->sign * part.surface->motion.at(part.surface->point, part.surface->normal);
    inputs.contacts.push_back({part.a.participant, part.b.participant, at.tail<3>(), normal, part.rules.values(), c.kept, surface,
                               !c.surface_velocity.isZero(0)});
    return part;
  }

  // Of the body that impacts do not move, if one is such.
  std::optional<SurfacePart<Num>> surfaceOf(const Contact& c, const Part& part, const Eigen::Matrix<Num, 7, 1>& at) const {
    const Motion& motion = lanes_.motion();
    for (const auto& side : {part.a, part.b}) {
      const Body& body = motion.scene->bodies[static_cast<std::size_t>(side.body)];
      if (!body.immovable()) continue;
      const Pose pose = poseBefore(motion, event_, side.body);
      NMat R = constant(pose.R);
      NVec x = constant(pose.x), velocity = constant(body.surface_velocity), spin = constant(body.surface_angular_velocity);
      for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
        const PairTangent along = pairTangent(part, lane);
        const Eigen::Index from = side.body == c.a ? 0 : 6;
        const BodyDerivative& rates = lanes_.direction(lane).scene.bodies[static_cast<std::size_t>(side.body)];
        setRates(x, Vec3(along.pose.segment<3>(from)), lane);
        turn(R, along.pose.segment<3>(from + 3), lane);
        setRates(velocity, rates.surface_velocity, lane);
        setRates(spin, rates.surface_angular_velocity, lane);
      }
      const NVec center = R * lanes_.model(side.body).center;
      return SurfacePart<Num>{side.body, side.participant, side.body == c.a ? 1.0 : -1.0, {velocity, spin, R, x - center},
                              center, at.template tail<3>(), at.template segment<3>(1)};
    }
    return std::nullopt;
  }

  // The normal of the impulse.
  NVec tiltNormal(const Contact& c, const NVec& normal, Part& part) const {
    part.tilted = c.tilt_a >= 0 || c.tilt_b >= 0;
    if (!part.tilted) return normal;
    const auto tiltOf = [&](int t) {
      V2<Num> tilt = V2<Num>::Zero();
      if (t < 0) return tilt;
      const auto tt = static_cast<std::size_t>(t);
      tilt = lanes_.motion().scene->tilts[tt].value.cast<Num>();
      for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
        setRates(tilt, lanes_.direction(lane).scene.tilts[tt], lane);
      return tilt;
    };
    const V2<Num> tilt_a = tiltOf(c.tilt_a), tilt_b = tiltOf(c.tilt_b);
    part.tilt = tiltJacobian<Num>(normal, tilt_a, tilt_b);
    const Eigen::Matrix<double, 3, 7> J = valuesOf(part.tilt);
    NVec tilted = constant(c.impulse_normal);
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      Eigen::Matrix<double, 7, 1> by;
      by << ratesOf(normal, lane), ratesOf(tilt_a, lane), ratesOf(tilt_b, lane);
      setRates(tilted, Vec3(J * by), lane);
    }
    return tilted;
  }

  EventGuard<Num> guardOf(std::vector<Part>& parts, const ImpactInputs<Num>& inputs) const {
    EventGuard<Num> guard;
    if (event_.kind != EventKind::transition) return guard;
    const Motion& motion = lanes_.motion();
    const Contact& c = event_.contacts[0];
    if (event_.cause == TransitionCause::slip_ends) {
      guard.by_slip = true;
      guard.slip = constant(slipDirectionAtEnd(motion, event_));
      return guard;
    }
    const FeatureLimit limit = borderOf(motion, event_);
    const Pose pose = poseBefore(motion, event_, limit.body);
    NMat R = constant(pose.R);
    NVec x = constant(pose.x);
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      const PairTangent along = pairTangent(parts[0], lane);
      const Eigen::Index at = limit.body == c.a ? 0 : 6;
      setRates(x, Vec3(along.pose.segment<3>(at)), lane);
      turn(R, along.pose.segment<3>(at + 3), lane);
    }
    return EventGuard<Num>::atBorder(limit, participantOf(event_, limit.body), x, R, inputs.contacts[0].point, parts[0]);
  }

  const Lanes& lanes_;
  int index_;
  const Event& event_;
  std::vector<DualState> before_;  // of the participants
};

}  // namespace

DualEvent dualEvent(const Lanes& lanes, int event) { return EventMaker(lanes, event).take(); }

}  // namespace carom::adjoint_detail
