// SPDX-License-Identifier: MIT
#include "adjoint/second_order/dual_event.hpp"

#include <algorithm>

#include "adjoint/impact/impact_pass.hpp"
#include "adjoint/impact/joint_law.hpp"
#include "adjoint/impact/law.hpp"
#include "adjoint/impact/single_laws.hpp"
#include "adjoint/impact/tilt_frame.hpp"
#include "adjoint/impact/wide_impact.hpp"
#include "adjoint/second_order/wide_lanes.hpp"

// The formulae of event_linearization.cpp and impact/impact.cpp, which stay in doubles of fixed sizes: a first
// derivative is asked for far more often, and never needs the full tensor of A or rotations as matrices of duals. That
// both say the same is held by a test: the values of this pass are those of that one.

namespace carom::detail {
namespace {

using VecX = Eigen::Matrix<Num, Eigen::Dynamic, 1>;
using MatX = Eigen::Matrix<Num, Eigen::Dynamic, Eigen::Dynamic>;

struct OneContact {
  NMat K;
  NVec u, normal;
  PairNums pair;
};

// What 4.2 gives for a contact without friction that slips: the same impulse, and its derivatives by friction.
bool takesFriction(const OneContact& one, const FrictionTerms<Num>& terms) {
  return one.pair.friction > 0 || slipsWithoutFriction(terms);
}

PairNums narrowed(const ImpactPass<WideNum>::Pair& p) {
  return {narrowed(p.elasticity), narrowed(p.friction), narrowed(p.tangential_elasticity)};
}

// Slopes of the pair's coefficient by the two materials', see combinePullback.
struct Slopes {
  Num by_a, by_b;
};
Slopes slopesOf(Combine rule, const Num& a, const Num& b) {
  if (rule == Combine::multiply) return {b, a};
  if (rule == Combine::average || a == b) return {0.5, 0.5};
  const bool takes_a = (a < b) == (rule == Combine::minimum);
  return {takes_a ? 1.0 : 0.0, takes_a ? 0.0 : 1.0};
}

}  // namespace

DualEvent::DualEvent(const Lanes& lanes, int index)
    : lanes_(lanes), index_(index), event_(lanes.motion().events[static_cast<std::size_t>(index)]) {
  for (const Participant& p : event_.participants) addBody(p);
  double total = 0;
  for (const Contact& c : event_.contacts) total += std::max(0.0, c.impulse_normal.dot(c.impulse));
  for (const Contact& c : event_.contacts)
    addContact(c, total > 0 ? std::max(0.0, c.impulse_normal.dot(c.impulse)) / total
                            : 1.0 / static_cast<double>(event_.contacts.size()));
  assemble();
}

bool DualEvent::isKinematic(std::size_t participant) const {
  return lanes_.model(bodies_[participant].body).kinematic;
}

void DualEvent::addBody(const Participant& p) {
  MovingBody b;
  b.body = p.body;
  b.before = lanes_.stateAt(p.body, p.arc, lanes_.eventTime(index_), p.before, lanes_.tape().arc(p.body, p.arc));
  const DualModel& m = lanes_.model(p.body);
  b.A = b.before.R * m.A * b.before.R.transpose();
  b.omega = b.A * b.before.L;
  b.rate_before = lanes_.rate(p.body, b.before);
  b.rate_after = lanes_.rate(p.body, lanes_.startOf(p.body, p.arc + 1));
  bodies_.push_back(std::move(b));
}

// Rates of the poses at the time of the event, which moves along.
PairTangent DualEvent::pairTangent(const ContactPart& part, std::size_t lane) const {
  PairTangent t;
  const auto& scene_bodies = lanes_.direction(lane).scene.bodies;
  const auto fill = [&](const Side& side, Eigen::Index at, Eigen::VectorXd& size) {
    const BodyDerivative& written = scene_bodies[static_cast<std::size_t>(side.body)];
    size = written.size;
    if (side.participant < 0) {
      t.pose.segment<3>(at) = written.position;
      t.pose.segment<3>(at + 3) = written.orientation;
      return;
    }
    const DualState& s = bodies_[static_cast<std::size_t>(side.participant)].before;
    t.pose.segment<3>(at) = ratesOf(s.x, lane);
    t.pose.segment<3>(at + 3) = 0.5 * unskew(Mat3(ratesOf(s.R, lane) * valuesOf(s.R).transpose()));
  };
  fill(part.a, 0, t.size_a);
  fill(part.b, 6, t.size_b);
  return t;
}

void DualEvent::addContact(const Contact& c, double weight) {
  const Motion& motion = lanes_.motion();
  const auto sideOf = [&](int body) {
    const Participant* p = event_.find(body);
    return Side{body, p ? static_cast<int>(p - event_.participants.data()) : -1};
  };
  const auto poseOf = [&](int body) {
    const BodyModel& model = (*motion.models)[static_cast<std::size_t>(body)];
    const Participant* p = event_.find(body);
    const State& s = p ? p->before : motion.world_lines[static_cast<std::size_t>(body)].arcs[0].startState();
    return Pose{s.x, model.shapeToWorld(s.q.toRotationMatrix())};
  };
  ContactPart part;
  part.a = sideOf(c.a), part.b = sideOf(c.b);
  part.weight = weight;
  part.material_a = materialIndexOf(*motion.scene, c.a);
  part.material_b = materialIndexOf(*motion.scene, c.b);
  const Pose A = poseOf(c.a), B = poseOf(c.b);
  const ContactJacobian J = motion.geometry->jacobian(c.a, c.b, c.features, A, B);
  std::vector<PairTangent> along;
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) along.push_back(pairTangent(part, lane));
  const std::vector<ContactJacobian> dJ = motion.geometry->jacobianRates(c.a, c.b, c.features, A, B, along);
  part.pose = J.pose.cast<Num>();
  part.size_a = J.size_a.cast<Num>();
  part.size_b = J.size_b.cast<Num>();
  Num7 at;
  at << Num(c.at.gap), constant(c.at.normal), constant(c.at.point);
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    setRates(part.pose, dJ[lane].pose, lane);
    setRates(part.size_a, dJ[lane].size_a, lane);
    setRates(part.size_b, dJ[lane].size_b, lane);
    Eigen::Matrix<double, 7, 1> d = J.pose * along[lane].pose;
    if (J.size_a.cols() > 0) d += J.size_a * along[lane].size_a;
    if (J.size_b.cols() > 0) d += J.size_b * along[lane].size_b;
    setRates(at, d, lane);
  }
  part.point = at.tail<3>();
  tiltNormal(c, at, part);
  parts_.push_back(std::move(part));
}

void DualEvent::tiltNormal(const Contact& c, const Num7& at, ContactPart& part) const {
  part.impulse_normal = at.segment<3>(1);
  part.tilted = c.tilt_a >= 0 || c.tilt_b >= 0;
  if (!part.tilted) return;
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
  part.tilt = tiltJacobian<Num>(at.segment<3>(1), tilt_a, tilt_b);
  const Eigen::Matrix<double, 3, 7> J = valuesOf(part.tilt);
  part.impulse_normal = constant(c.impulse_normal);
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    Eigen::Matrix<double, 7, 1> by;
    by << ratesOf(NVec(at.segment<3>(1)), lane), ratesOf(tilt_a, lane), ratesOf(tilt_b, lane);
    setRates(part.impulse_normal, Vec3(J * by), lane);
  }
}

PairNums DualEvent::pairOf(const Contact& c, const ContactPart& part) const {
  const Scene& scene = *lanes_.motion().scene;
  PairNums pair{c.pair.elasticity, c.pair.friction, c.pair.tangential_elasticity};
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    const auto rateOf = [&](int m) {
      return m < 0 ? MaterialDerivative{} : lanes_.direction(lane).scene.materials[static_cast<std::size_t>(m)];
    };
    const PairCoefficients d = combineTangent(materialOf(scene, scene.bodies[static_cast<std::size_t>(c.a)]),
                                              materialOf(scene, scene.bodies[static_cast<std::size_t>(c.b)]),
                                              rateOf(part.material_a), rateOf(part.material_b));
    pair.elasticity.rate[lane] = d.elasticity;
    pair.friction.rate[lane] = d.friction;
    pair.tangential_elasticity.rate[lane] = d.tangential_elasticity;
  }
  return pair;
}

void DualEvent::assemble() {
  wide_ = usesWide(event_, *lanes_.motion().models);
  for (std::size_t i = 0; i < bodies_.size(); ++i) problem_.driven = problem_.driven || isKinematic(i);
  const auto n = static_cast<Eigen::Index>(parts_.size());
  problem_.K = MatX::Zero(3 * n, 3 * n);
  problem_.u = VecX::Zero(3 * n);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const ContactPart& part = parts_[k];
    problem_.normal.push_back(part.impulse_normal);
    problem_.pair.push_back(pairOf(event_.contacts[k], part));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const MovingBody& b = bodies_[i];
      if (b.body != part.a.body && b.body != part.b.body) continue;
      const Arm arm{k, i, b.body == part.a.body ? 1.0 : -1.0, part.point - b.before.x};
      problem_.u.segment<3>(3 * static_cast<Eigen::Index>(k)) += arm.sign * (b.before.v + b.omega.cross(arm.r));
      arms_.push_back(arm);
    }
  }
  for (const Arm& k : arms_)
    for (const Arm& l : arms_) {
      if (k.participant != l.participant || isKinematic(k.participant)) continue;
      const MovingBody& b = bodies_[k.participant];
      const NMat rotation = skewOf<Num>(k.r) * b.A * skewOf<Num>(l.r);
      problem_.K.block<3, 3>(3 * static_cast<Eigen::Index>(k.contact), 3 * static_cast<Eigen::Index>(l.contact)) +=
          k.sign * l.sign * (lanes_.model(b.body).inverse_mass * NMat::Identity() - rotation);
    }
  if (wide_) {  // the impulses are found in throughLaw
  } else if (n > 1) {
    const Branch<Num> branch(problem_);
    P_ = branch.P_N + branch.kappa * branch.d;
  } else {
    const OneContact one{problem_.K, problem_.u, problem_.normal[0], problem_.pair[0]};
    const FrictionTerms<Num> friction(one);
    P_ = takesFriction(one, friction) ? friction.impulse() : FrictionlessTerms<Num>(one).impulse();
  }
  for (const ContactPart& part : parts_) {
    Eigen::Matrix<Num, 12, 1> rate = Eigen::Matrix<Num, 12, 1>::Zero();
    Eigen::Index at = 0;
    for (const Side& side : {part.a, part.b}) {
      if (side.participant >= 0) {
        const StateBar& F = bodies_[static_cast<std::size_t>(side.participant)].rate_before;
        rate.segment<3>(at) = F.x;
        rate.segment<3>(at + 3) = F.theta;
      }
      at += 6;
    }
    D_ += part.weight * part.pose.row(0).dot(rate);
  }
}

DualEvent::Problem DualEvent::lawPullback(const VecX& P_bar) const {
  const std::size_t n = parts_.size();
  Problem bar{MatX::Zero(P_bar.size(), P_bar.size()), VecX::Zero(P_bar.size()), std::vector<NVec>(n, NVec::Zero()),
              std::vector<PairNums>(n), false};
  if (n > 1) {
    jointPullback<Num>(problem_, P_bar, bar);
    return bar;
  }
  const OneContact one{problem_.K, problem_.u, problem_.normal[0], problem_.pair[0]};
  const NVec only = P_bar;
  const FrictionTerms<Num> friction(one);
  if (takesFriction(one, friction))
    friction.pullback(only, bar);
  else
    FrictionlessTerms<Num>(one).pullback(only, bar);
  return bar;
}

// WideImpact::pullback.
std::vector<StateBar> DualEvent::throughWideLaw(const std::vector<StateBar>& after_bar, std::vector<Num7>& contact_bar,
                                                std::vector<PairNums>& pair_bar,
                                                std::vector<ModelBar>& model_bar) const {
  using Pass = ImpactPass<WideNum>;
  Pass pass;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MovingBody& b = bodies_[i];
    const DualModel& m = lanes_.model(b.body);
    const M3<WideNum> R = widened(b.before.R), A = R * widened(m.A) * R.transpose();
    pass.bodies.push_back({isKinematic(i), isKinematic(i) ? WideNum(0) : widened(m.inverse_mass), A,
                           widened(b.before.v), widened(b.before.L)});
  }
  for (const Arm& arm : arms_)
    pass.arms.push_back({arm.contact, arm.participant, arm.sign,
                         V3<WideNum>(widened(parts_[arm.contact].point) - widened(bodies_[arm.participant].before.x))});
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    pass.problem.normal.push_back(widened(problem_.normal[k]));
    const PairNums& pair = problem_.pair[k];
    pass.problem.pair.push_back(
        {widened(pair.elasticity), widened(pair.friction), widened(pair.tangential_elasticity)});
  }
  pass.solve();
  std::vector<Pass::BodyBar> bodies_bar(bodies_.size());
  std::vector<Pass::ContactBar> contacts_bar(parts_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_bar[i].v = widened(after_bar[i].v), bodies_bar[i].L = widened(after_bar[i].L);
  pass.pullback(bodies_bar, contacts_bar);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    contact_bar[k].segment<3>(1) += narrowed(contacts_bar[k].normal);
    contact_bar[k].tail<3>() += narrowed(contacts_bar[k].point);
    pair_bar[k] = narrowed(contacts_bar[k].pair);
  }
  std::vector<StateBar> before_bar = after_bar;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Pass::BodyBar& bar = bodies_bar[i];
    before_bar[i].v = narrowed(bar.v);
    before_bar[i].L = narrowed(bar.L);
    before_bar[i].x += narrowed(bar.x);
    before_bar[i].theta += narrowed(pass.turnBar(i, bar));
    ModelBar& to = model_bar[static_cast<std::size_t>(bodies_[i].body)];
    to.addInertiaBar(narrowed(pass.inertiaBar(i, bar, widened(bodies_[i].before.R))));
    const WideNum inverse_mass = pass.bodies[i].inverse_mass;
    to.mass -= narrowed(bar.inverse_mass * inverse_mass * inverse_mass);
  }
  return before_bar;
}

// ImpactAssembly::pullback.
std::vector<StateBar> DualEvent::throughLaw(const std::vector<StateBar>& after_bar, std::vector<Num7>& contact_bar,
                                            std::vector<PairNums>& pair_bar, std::vector<ModelBar>& model_bar) const {
  if (wide_) return throughWideLaw(after_bar, contact_bar, pair_bar, model_bar);
  std::vector<StateBar> before_bar = after_bar;
  std::vector<Num> inverse_mass_bar(bodies_.size());
  std::vector<NVec> r_bar(arms_.size(), NVec::Zero()), omega_bar(bodies_.size(), NVec::Zero());
  std::vector<NMat> A_bar(bodies_.size(), NMat::Zero());
  VecX P_bar = VecX::Zero(P_.size());
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    if (isKinematic(arm.participant)) continue;
    const auto row = 3 * static_cast<Eigen::Index>(arm.contact);
    const NVec P_k = P_.segment<3>(row);
    const NVec &v_bar = after_bar[arm.participant].v, &L_bar = after_bar[arm.participant].L;
    P_bar.segment<3>(row) +=
        arm.sign * (lanes_.model(bodies_[arm.participant].body).inverse_mass * v_bar + L_bar.cross(arm.r));
    inverse_mass_bar[arm.participant] += arm.sign * P_k.dot(v_bar);
    r_bar[j] = arm.sign * P_k.cross(L_bar);
  }
  const Problem bar = lawPullback(P_bar);
  for (std::size_t j = 0; j < arms_.size(); ++j)
    for (std::size_t l = 0; l < arms_.size(); ++l) {
      const Arm &a = arms_[j], &b = arms_[l];
      if (a.participant != b.participant || isKinematic(a.participant)) continue;
      const std::size_t i = a.participant;
      const NMat Ra = skewOf<Num>(a.r), Rb = skewOf<Num>(b.r), &A = bodies_[i].A;
      const NMat K_bar =
          a.sign * b.sign *
          bar.K.block<3, 3>(3 * static_cast<Eigen::Index>(a.contact), 3 * static_cast<Eigen::Index>(b.contact));
      inverse_mass_bar[i] += K_bar.trace();
      A_bar[i] -= Ra * K_bar * Rb;                // <K_bar, -Ra dA Rb>, Ra^T = -Ra
      r_bar[j] += unskewOf<Num>(K_bar * Rb * A);  // <K_bar, -[dr]x A Rb>
      r_bar[l] += unskewOf<Num>(A * Ra * K_bar);  // <K_bar, -Ra A [dr]x>
    }
  for (std::size_t j = 0; j < arms_.size(); ++j) {
    const Arm& arm = arms_[j];
    const NVec u_bar = arm.sign * bar.u.segment<3>(3 * static_cast<Eigen::Index>(arm.contact));
    before_bar[arm.participant].v += u_bar;
    omega_bar[arm.participant] += arm.r.cross(u_bar);
    r_bar[j] += u_bar.cross(bodies_[arm.participant].omega);
    before_bar[arm.participant].x -= r_bar[j];
    contact_bar[arm.contact].tail<3>() += r_bar[j];
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    contact_bar[k].segment<3>(1) += bar.normal[k];
    pair_bar[k] = bar.pair[k];
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const MovingBody& b = bodies_[i];
    const DualModel& m = lanes_.model(b.body);
    const NMat& R = b.before.R;
    A_bar[i] += omega_bar[i] * b.before.L.transpose();
    before_bar[i].L += b.A * omega_bar[i];
    // dA = [theta]x A - A [theta]x - A R dJ R^T A, A symmetric
    before_bar[i].theta += unskewOf<Num>(A_bar[i] * b.A - b.A * A_bar[i]);
    ModelBar& to = model_bar[static_cast<std::size_t>(b.body)];
    to.addInertiaBar(-(R.transpose() * b.A * A_bar[i] * b.A * R));
    to.mass -= inverse_mass_bar[i] * m.inverse_mass * m.inverse_mass;
  }
  return before_bar;
}

void DualEvent::scatter(const ContactPart& part, const Num7& bar, std::vector<StateBar>& before_bar,
                        SceneBar& scene_bar) const {
  const Eigen::Matrix<Num, 12, 1> d = part.pose.transpose() * bar;
  Eigen::Index at = 0;
  for (const Side& side : {part.a, part.b}) {
    BodyBar& body = scene_bar.bodies[static_cast<std::size_t>(side.body)];
    NVec& x = side.participant < 0 ? body.position : before_bar[static_cast<std::size_t>(side.participant)].x;
    NVec& theta =
        side.participant < 0 ? body.orientation : before_bar[static_cast<std::size_t>(side.participant)].theta;
    x += d.segment<3>(at);
    theta += d.segment<3>(at + 3);
    at += 6;
  }
  if (part.size_a.cols() > 0)
    scene_bar.bodies[static_cast<std::size_t>(part.a.body)].size += part.size_a.transpose() * bar;
  if (part.size_b.cols() > 0)
    scene_bar.bodies[static_cast<std::size_t>(part.b.body)].size += part.size_b.transpose() * bar;
}

void DualEvent::materialPullback(const Contact& c, const ContactPart& part, const PairNums& bar,
                                 SceneBar& scene_bar) const {
  const Scene& scene = *lanes_.motion().scene;
  const Material& a = materialOf(scene, scene.bodies[static_cast<std::size_t>(c.a)]);
  const Material& b = materialOf(scene, scene.bodies[static_cast<std::size_t>(c.b)]);
  PairNums unused;
  const auto slot = [&](int m) -> PairNums& {
    return m < 0 ? unused : scene_bar.materials[static_cast<std::size_t>(m)];
  };
  const auto pull = [&](Combine rule, double Material::*value, double MaterialDerivative::*rate, Num PairNums::*field) {
    const auto numberOf = [&](const Material& material, int m) {
      Num n = material.*value;
      for (std::size_t lane = 0; m >= 0 && lane < lanes_.size(); ++lane)
        n.rate[lane] = lanes_.direction(lane).scene.materials[static_cast<std::size_t>(m)].*rate;
      return n;
    };
    const Slopes s = slopesOf(rule, numberOf(a, part.material_a), numberOf(b, part.material_b));
    slot(part.material_a).*field += s.by_a * (bar.*field);
    slot(part.material_b).*field += s.by_b * (bar.*field);
  };
  pull(std::min(a.combine_elasticity, b.combine_elasticity), &Material::elasticity, &MaterialDerivative::elasticity,
       &PairNums::elasticity);
  pull(std::min(a.combine_friction, b.combine_friction), &Material::friction, &MaterialDerivative::friction,
       &PairNums::friction);
  pull(Combine::average, &Material::tangential_elasticity, &MaterialDerivative::tangential_elasticity,
       &PairNums::tangential_elasticity);
}

std::vector<StateBar> DualEvent::pullback(const std::vector<StateBar>& after_bar, const std::vector<StateBar>& read_bar,
                                          const Num& time_bar, SceneBar& scene_bar,
                                          std::vector<ModelBar>& model_bar) const {
  std::vector<StateBar> before_bar(after_bar.size());
  const bool through = std::any_of(after_bar.begin(), after_bar.end(), [](const auto& s) { return !s.isZero(); });
  if (through) {
    std::vector<Num7> contact_bar(parts_.size(), Num7::Zero());
    std::vector<PairNums> pair_bar(parts_.size());
    before_bar = throughLaw(after_bar, contact_bar, pair_bar, model_bar);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ContactPart& part = parts_[k];
      const Contact& c = event_.contacts[k];
      if (part.tilted) {
        const Num7 by = part.tilt.transpose() * contact_bar[k].segment<3>(1);
        contact_bar[k].segment<3>(1) = by.head<3>();
        if (c.tilt_a >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_a)] += by.segment<2>(3);
        if (c.tilt_b >= 0) scene_bar.tilts[static_cast<std::size_t>(c.tilt_b)] += by.segment<2>(5);
      }
      scatter(part, contact_bar[k], before_bar, scene_bar);
      materialPullback(c, part, pair_bar[k], scene_bar);
    }
  }
  Num sigma = -time_bar;
  for (std::size_t i = 0; i < before_bar.size(); ++i) {
    before_bar[i] += read_bar[i];
    sigma += after_bar[i].dot(bodies_[i].rate_after) - before_bar[i].dot(bodies_[i].rate_before);
  }
  sigma /= D_;
  for (const ContactPart& part : parts_) {
    Num7 gap_bar = Num7::Zero();
    gap_bar[0] = sigma * part.weight;
    scatter(part, gap_bar, before_bar, scene_bar);
  }
  return before_bar;
}

}  // namespace carom::detail
