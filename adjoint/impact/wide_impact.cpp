// SPDX-License-Identifier: MIT
#include "adjoint/impact/wide_impact.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/impact/impact_pass.hpp"

namespace carom {
namespace {

using detail::Wide;
using WideVec = detail::V3<Wide>;
using WideMat = detail::M3<Wide>;
using WidePass = detail::ImpactPass<Wide>;
// along one direction
using WideRate = detail::Dual<1, Wide>;
using WideTangentPass = detail::ImpactPass<WideRate>;

constexpr double kDoublesSpan = 1e3;

WideVec widened(const Vec3& v) { return v.cast<Wide>(); }
WideMat widened(const Mat3& m) { return m.cast<Wide>(); }
Vec3 narrowed(const WideVec& v) { return {v[0].high, v[1].high, v[2].high}; }
Mat3 narrowed(const WideMat& m) {
  return m.unaryExpr([](const Wide& x) { return x.high; });
}

struct WideBody {
  WideMat R, A;
  WideBody(const Participant& p, const BodyModel& model)
      : R(widened(p.before.q.toRotationMatrix())),
        A(R * widened(model.inverse_inertia).asDiagonal() * R.transpose()) {}
};

WidePass passOf(const Event& event, const std::vector<BodyModel>& models) {
  WidePass pass;
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    const Wide inverse_mass = model.kinematic ? 0 : model.inverse_mass;
    pass.bodies.push_back({model.kinematic, inverse_mass, WideBody(p, model).A, widened(p.before.v), widened(p.before.L)});
  }
  for (std::size_t k = 0; k < event.contacts.size(); ++k) {
    const Contact& c = event.contacts[k];
    pass.problem.normal.push_back(widened(c.impulse_normal));
    pass.problem.pair.push_back({c.pair.elasticity, c.pair.friction, c.pair.tangential_elasticity});
    for (std::size_t i = 0; i < event.participants.size(); ++i) {
      const Participant& p = event.participants[i];
      if (p.body != c.a && p.body != c.b) continue;
      pass.arms.push_back({k, i, p.body == c.a ? 1.0 : -1.0, WideVec(widened(c.at.point) - widened(p.before.x))});
    }
  }
  return pass;
}

}  // namespace

bool needsWide(const Event& event, const std::vector<BodyModel>& models) {
  const bool single = event.contacts.size() == 1;
  if (single && lawOf(event.contacts[0].pair) == Law::frictionless) return false;
  double least = kInfinity, most = 0, lightest = 0;
  for (const Participant& p : event.participants) {
    const BodyModel& model = models[static_cast<std::size_t>(p.body)];
    if (model.kinematic) continue;
    if (!std::isfinite(model.inverse_mass)) return false;  // no number of digits helps
    double reach = 0;
    for (const Contact& c : event.contacts)
      if (c.a == p.body || c.b == p.body) reach = std::max(reach, (c.at.point - p.before.x).squaredNorm());
    least = std::min({least, model.inverse_mass, reach * model.inverse_inertia.minCoeff()});
    most = std::max({most, model.inverse_mass, reach * model.inverse_inertia.maxCoeff()});
    lightest = std::max(lightest, model.inverse_mass);
  }
  // one contact has at least the mobility of the lighter body in every direction
  return most > kDoublesSpan * (single ? lightest : least);
}

std::vector<State> WideImpact::solve(Event& event) const {
  WidePass pass = passOf(event_, models_);
  pass.solve();
  event.mode = pass.mode;
  event.margins.stick_slip = pass.margin;
  for (std::size_t k = 0; k < event.contacts.size(); ++k)
    event.contacts[k].impulse = narrowed(WideVec(pass.P.segment<3>(3 * static_cast<Eigen::Index>(k))));
  const std::vector<WidePass::Body> after = pass.after();
  std::vector<State> states;
  for (std::size_t i = 0; i < after.size(); ++i) {
    State& s = states.emplace_back(event_.participants[i].before);
    s.v = narrowed(after[i].v);
    s.L = narrowed(after[i].L);
  }
  return states;
}

std::vector<StateDerivative> WideImpact::tangent(const std::vector<StateDerivative>& dbefore,
                                                 const std::vector<Vec7>& dcontact,
                                                 const std::vector<PairCoefficients>& dpair,
                                                 const std::vector<BodyModelDerivative>& dmodel) const {
  const WidePass now = passOf(event_, models_);
  WideTangentPass pass;
  const auto along = [](const auto& value, const auto& rate) {
    auto both = value.template cast<WideRate>().eval();
    setRates(both, rate, 0);
    return both;
  };
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    const WidePass::Body& b = now.bodies[i];
    const WideMat R = WideBody(event_.participants[i], models_[static_cast<std::size_t>(event_.participants[i].body)]).R;
    const WideMat T = detail::skewOf<Wide>(widened(dbefore[i].theta)), AR = b.A * R;
    const WideMat dA = T * b.A - b.A * T - AR * widened(dmodel[i].inertiaTensor()) * AR.transpose();
    WideTangentPass::Body& to = pass.bodies.emplace_back();
    to.kinematic = b.kinematic;
    to.inverse_mass = b.inverse_mass;
    to.inverse_mass.rate[0] = -Wide(dmodel[i].mass) * b.inverse_mass * b.inverse_mass;
    to.A = along(b.A, dA);
    to.v = along(b.v, widened(dbefore[i].v));
    to.L = along(b.L, widened(dbefore[i].L));
  }
  for (const WidePass::Arm& arm : now.arms)
    pass.arms.push_back({arm.contact, arm.body, arm.sign,
                         along(arm.r, WideVec(widened(Vec3(dcontact[arm.contact].tail<3>())) -
                                              widened(dbefore[arm.body].x)))});
  for (std::size_t k = 0; k < dcontact.size(); ++k) {
    pass.problem.normal.push_back(along(now.problem.normal[k], widened(Vec3(dcontact[k].segment<3>(1)))));
    const WidePass::Pair& pair = now.problem.pair[k];
    WideTangentPass::Pair& to = pass.problem.pair.emplace_back(
        WideTangentPass::Pair{pair.elasticity, pair.friction, pair.tangential_elasticity});
    to.elasticity.rate[0] = dpair[k].elasticity;
    to.friction.rate[0] = dpair[k].friction;
    to.tangential_elasticity.rate[0] = dpair[k].tangential_elasticity;
  }
  pass.solve();
  std::vector<StateDerivative> dafter = dbefore;
  const std::vector<WideTangentPass::Body> after = pass.after();
  for (std::size_t i = 0; i < after.size(); ++i) {
    dafter[i].v = narrowed(WideVec(ratesOf(after[i].v, 0)));
    dafter[i].L = narrowed(WideVec(ratesOf(after[i].L, 0)));
  }
  return dafter;
}

std::vector<StateDerivative> WideImpact::pullback(const std::vector<StateDerivative>& after_bar,
                                                  std::vector<Vec7>& contact_bar,
                                                  std::vector<PairCoefficients>& pair_bar,
                                                  std::vector<BodyModelDerivative>& model_bar) const {
  WidePass pass = passOf(event_, models_);
  pass.solve();
  std::vector<WidePass::BodyBar> bodies(after_bar.size());
  std::vector<WidePass::ContactBar> contacts(contact_bar.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].v = widened(after_bar[i].v), bodies[i].L = widened(after_bar[i].L);
  pass.pullback(bodies, contacts);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    contact_bar[k].segment<3>(1) += narrowed(contacts[k].normal);
    contact_bar[k].tail<3>() += narrowed(contacts[k].point);
    pair_bar[k].elasticity += contacts[k].pair.elasticity.high;
    pair_bar[k].friction += contacts[k].pair.friction.high;
    pair_bar[k].tangential_elasticity += contacts[k].pair.tangential_elasticity.high;
  }
  std::vector<StateDerivative> before_bar = after_bar;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const WidePass::BodyBar& bar = bodies[i];
    const Participant& p = event_.participants[i];
    before_bar[i].v = narrowed(bar.v);
    before_bar[i].L = narrowed(bar.L);
    before_bar[i].x += narrowed(bar.x);
    before_bar[i].theta += narrowed(pass.turnBar(i, bar));
    const WideMat R = WideBody(p, models_[static_cast<std::size_t>(p.body)]).R;
    model_bar[i].addInertiaBar(narrowed(pass.inertiaBar(i, bar, R)));
    const Wide inverse_mass = pass.bodies[i].inverse_mass;
    model_bar[i].mass += (-bar.inverse_mass * inverse_mass * inverse_mass).high;
  }
  return before_bar;
}

}  // namespace carom
