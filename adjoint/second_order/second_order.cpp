// SPDX-License-Identifier: MIT
#include "adjoint/second_order/second_order.h"

#include <algorithm>
#include <map>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"
#include "adjoint/contact/contact_path.hpp"
#include "adjoint/derivative/derivative_arguments.hpp"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/derivative/seed_pass.hpp"
#include "adjoint/derivative/waiting_bars.hpp"
#include "adjoint/flight/flight_pass.hpp"
#include "adjoint/flight/flight_symmetric.hpp"
#include "adjoint/motion/inertia_change.hpp"
#include "adjoint/second_order/dual_event.hpp"
#include "adjoint/second_order/dual_path.hpp"
#include "adjoint/second_order/dual_rotation.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

// A seed with the rates of its weights.
struct DualSeed {
  NVec position, orientation, velocity, angular_velocity, center_of_mass, gravity;
  NMat inertia;
  Eigen::Matrix<Num, Eigen::Dynamic, 1> size;
  Num time, mass;
};

// Responses of arcs, shared by all directions; by body, arc, time, directions of the response and products.
using Responses = std::map<std::tuple<int, int, double, int, bool>, BodyResponse>;

bool hasRates(const Num& n) {
  return std::any_of(n.rate.begin(), n.rate.end(), [](double r) { return r != 0; });
}
bool hasRates(const NVec& v) { return hasRates(v[0]) || hasRates(v[1]) || hasRates(v[2]); }
bool hasRates(const StateBar& s) { return hasRates(s.x) || hasRates(s.theta) || hasRates(s.v) || hasRates(s.L); }
bool hasRates(const DualSeed& s) {
  return hasRates(s.position) || hasRates(s.orientation) || hasRates(s.velocity) || hasRates(s.angular_velocity) ||
         hasRates(s.center_of_mass) || hasRates(s.gravity) || hasRates(s.time) || hasRates(s.mass) ||
         std::any_of(s.size.begin(), s.size.end(), [](const Num& n) { return hasRates(n); }) ||
         hasRates(NVec(s.inertia.col(0))) || hasRates(NVec(s.inertia.col(1))) || hasRates(NVec(s.inertia.col(2)));
}

// The reverse pass of adjoint.cpp in dual numbers. It leaves out what the directions do not influence and has no
// rates, as its sums have none either; a `whole` pass leaves out nothing, and the values of its sums are right too.
class DualPass {
 public:
  DualPass(const Lanes& lanes, bool whole, Responses& responses, const std::vector<bool>& inertia_varies)
      : lanes_(lanes),
        whole_(whole),
        motion_(lanes.motion()),
        responses_(responses),
        inertia_varies_(inertia_varies),
        bars_(motion_) {
    for (std::size_t b = 0; b < motion_.world_lines.size(); ++b) plans_.push_back(planOf(b));
  }

  // Adds the rates of the seed's time derivative to `time_rate`, where its time is given.
  void plant(const StateSeed& seed, const DualSeed& weights, const Num& time, const ReadPlace& place,
             std::array<double, kLanes>& time_rate) {
    const bool event_influenced = seed.at.event >= 0 && lanes_.influence().event(seed.at.event);
    if (!influenced(seed.body, place.arc) && !event_influenced && !hasRates(time) && !hasRates(weights)) return;
    const auto b = static_cast<std::size_t>(seed.body);
    const DualState state =
        startsArc(motion_, seed.body, seed.at)
            ? lanes_.startOf(seed.body, place.arc)
            : lanes_.stateAt(seed.body, place.arc, time, place.state, plainSensitivity(seed.body, place.arc, place.time));
    bars_.scene.gravity += weights.gravity;
    if (weights.size.size() > 0) bars_.scene.bodies[b].size += weights.size;
    const StateBar bar = seedPullbackOf(lanes_.model(seed.body), state.R, state.L, weights, bars_.model[b]);
    const auto rate = [&] { return lanes_.rate(seed.body, place.arc, time, state); };
    if (seed.at.event < 0) time_rate = bar.dot(rate()).rate;
    if (seed.at.event >= 0 && bars_.readAtEvent(seed.at, seed.body, bar, weights.time, rate)) return;
    throughFlight(seed.body, place.arc, time, state, bar);
  }

  SceneBar run() {
    bars_.eachEvent([&](int event, const Bars::AtEvent& at) { throughEvent(event, at); });
    for (std::size_t b = 0; b < bars_.start.size(); ++b) {
      const Body& body = motion_.scene->bodies[b];
      const DualModel& model = lanes_.model(static_cast<int>(b));
      const std::vector<const BodyDerivative*> of_body = lanes_.ofBody(b);
      BodyBar& written = bars_.scene.bodies[b];
      if (!bars_.start[b].isZero()) startPullback(body, model, of_body, bars_.start[b], written, bars_.model[b]);
      modelPullback(body, model, of_body, bars_.model[b], written);
    }
    return std::move(bars_.scene);
  }

 private:
  using Bars = WaitingBars<Num>;

  // A compound may keep its symmetry to first order and not to second; then all moments and products are carried.
  BodyPlan planOf(std::size_t b) const {
    BodyPlan out = motion_.plan.bodies[b];
    const Body& body = motion_.scene->bodies[b];
    const bool derived = body.inertia.source == Inertia::Source::derived && !body.immovable();
    if (out.derivative_tier == Tier::none || !derived || !kindOf(body.shape).of_parts) return out;
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      const Eigen::VectorXd& size = lanes_.direction(lane).scene.bodies[b].size;
      if (size.isZero(0)) continue;
      const InertiaChange change =
          inertiaChange(kindOf(body.shape).propertiesRate(body.shape, size).rates, (*motion_.models)[b]);
      if (!change.keeps_symmetry) out.derivative_tier = Tier::triaxial;
      if (!change.keeps_axes) out.derivative_products = true;
    }
    return out;
  }

  DualSensitivity dualSensitivity(int body, int k, const Num& t, const DualState& start, const DualState& end) {
    const auto b = static_cast<std::size_t>(body);
    const Arc& arc = motion_.world_lines[b].arcs[static_cast<std::size_t>(k)];
    const BodyPlan& plan = plans_[b];
    const DualModel& model = lanes_.model(body);
    const Stretch stretch{model, start, end.R, t - lanes_.startTime(body, k)};
    if (plan.derivative_tier == Tier::none) return {};
    if (plan.derivative_tier == Tier::spherical) return sphericalSensitivity(stretch);
    if (plan.derivative_tier == Tier::symmetric)
      return symmetricSensitivity(stretch, symmetryAxis(arc.model().inertia));
    ResponseWanted wanted{3, inertia_varies_[b], inertia_varies_[b] && plan.derivative_products};
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      const Mat3 dJ = ratesOf(model.J, lane);
      if (!dJ.isZero(0)) wanted.lanes = std::max(wanted.lanes, plan.derivative_products && !dJ.isDiagonal(0) ? 9 : 6);
    }
    const auto [at, made] = responses_.try_emplace({body, k, t.value, wanted.lanes, wanted.products});
    if (made) at->second = bodyResponse(arc, t.value - arc.start(), wanted);
    return generalSensitivity(stretch, at->second);
  }

  const ArcSensitivity& plainSensitivity(int body, int k, double t) {
    const WorldLine& line = motion_.world_lines[static_cast<std::size_t>(body)];
    const auto kk = static_cast<std::size_t>(k);
    const bool whole = kk < line.events.size() && motion_.events[static_cast<std::size_t>(line.events[kk])].time == t;
    if (whole) return lanes_.tape().arc(body, k);
    return until_ = lanes_.tape().arcUntil(body, k, t);
  }

  void throughFlight(int body, int k, const Num& t, const DualState& end, const StateBar& bar) {
    if (!influenced(body, k) && !hasRates(t) && !hasRates(bar)) return;
    const auto b = static_cast<std::size_t>(body);
    StateBar d = bar;
    const Arc& arc = motion_.world_lines[b].arcs[static_cast<std::size_t>(k)];
    if (arc.closedForm()) {
      d = pathPullback(lanes_, body, k, t, bar, bars_.scene, bars_.model[b]);
    } else if (const DualModel& model = lanes_.model(body); model.moving) {
      DualSensitivity S;
      if (!isZero(bar.theta)) S = dualSensitivity(body, k, t, lanes_.startOf(body, k), end);
      d = flightPullbackOf(model.gravity_factor, t - lanes_.startTime(body, k), S, bar, bars_.scene.gravity,
                           bars_.model[b]);
    }
    bars_.arriveAt(body, k, d);
  }

  void throughEvent(int index, const Bars::AtEvent& at) {
    const Event& event = motion_.events[static_cast<std::size_t>(index)];
    const DualEvent dual = dualEvent(lanes_, index);
    const std::vector<StateBar> before = dual.pass.pullback(at.after, at.before, at.time, bars_.scene, bars_.model);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Participant& p = event.participants[i];
      if (!before[i].isZero()) throughFlight(p.body, p.arc, lanes_.eventTime(index), dual.before[i], before[i]);
    }
  }

  bool influenced(int body, int k) const { return whole_ || lanes_.influence().arc(body, k); }

  const Lanes& lanes_;
  bool whole_;
  const Motion& motion_;
  Responses& responses_;
  const std::vector<bool>& inertia_varies_;
  std::vector<BodyPlan> plans_;
  Bars bars_;
  ArcSensitivity until_;
};

// Adds what the reading changes by when its time moves by dt.
void addFlow(const Motion& motion, int body, const Instant& at, double dt, BodyStateRate& rate) {
  const auto b = static_cast<std::size_t>(body);
  const ReadPlace place = readPlace(motion, body, at);
  const BodyModel& model = (*motion.models)[b];
  const StateDerivative F = motion.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(place.time, place.state);
  rate.position += dt * originTangent(model, place.state, F, {});
  rate.orientation += dt * F.theta;
  rate.velocity += dt * F.v;
  rate.angular_velocity += dt * angularVelocityTangent(model, place.state, F, {});
  rate.center_of_mass += dt * F.x;
  rate.time += dt;
}

// Weights of the seeds along the lanes.
std::vector<DualSeed> dualSeeds(std::span<const StateSeed> seeds, const SeedRates& seed_rates, const Lanes& lanes) {
  std::vector<DualSeed> out;
  for (const StateSeed& s : seeds)
    out.push_back({constant(s.position), constant(s.orientation), constant(s.velocity), constant(s.angular_velocity),
                   constant(s.center_of_mass), constant(s.gravity), constant(s.inertia), s.size.cast<Num>(), s.time,
                   s.mass});
  if (!seed_rates) return out;
  const Motion& motion = lanes.motion();
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    std::vector<BodyStateRate> rates;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double dtime = lanes.timeRate(lane, i);
      rates.push_back(lanes.tangent(lane).at(seeds[i].body, seeds[i].at));
      if (seeds[i].at.event < 0 && dtime != 0) addFlow(motion, seeds[i].body, seeds[i].at, dtime, rates.back());
    }
    const std::vector<StateSeed> weights = seed_rates(rates);
    checkCount("secondOrder", "seeds of rates", weights.size(), seeds.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      setRates(out[i].position, weights[i].position, lane);
      setRates(out[i].orientation, weights[i].orientation, lane);
      setRates(out[i].velocity, weights[i].velocity, lane);
      setRates(out[i].angular_velocity, weights[i].angular_velocity, lane);
      setRates(out[i].center_of_mass, weights[i].center_of_mass, lane);
      setRates(out[i].gravity, weights[i].gravity, lane);
      setRates(out[i].inertia, weights[i].inertia, lane);
      if (weights[i].size.size() > 0 && out[i].size.size() == 0)
        out[i].size = Eigen::VectorXd::Zero(weights[i].size.size()).cast<Num>();
      for (Eigen::Index d = 0; d < weights[i].size.size(); ++d) out[i].size[d].rate[lane] = weights[i].size[d];
      out[i].time.rate[lane] = weights[i].time;
      out[i].mass.rate[lane] = weights[i].mass;
    }
  }
  return out;
}

}  // namespace

bool hasSecondOrder(const Motion& motion) {
  // What a spin makes of a block that slides is known to first order (11.28).
  const auto isFirstOrder = [](const Arc& arc) {
    if (arc.isFlight()) return false;
    const ContactPath* path = arc.closedForm();
    return !path || (path->form == PathForm::glide_block && path->inputs.friction > 0);
  };
  return std::ranges::none_of(motion.events, [](const Event& event) { return event.cause == TransitionCause::tips; }) &&
         std::ranges::none_of(motion.world_lines, [&](const WorldLine& line) { return std::ranges::any_of(line.arcs, isFirstOrder); });
}

SecondOrder secondOrder(DerivativeTape& tape, std::span<const StateSeed> seeds, const SeedRates& seed_rates,
                        std::span<const ReadingDirection> directions, RatesWanted wanted) {
  SecondOrder out;
  Responses responses;
  const Motion& motion = tape.motion();
  for (const StateSeed& seed : seeds) checkSeed("secondOrder", motion, seed);
  if (!hasSecondOrder(motion))
    throw NotComputable("second derivatives are not implemented for a motion in which a body tips, slides without rotating, or moves on corners, edges or faces");
  for (const ReadingDirection& d : directions) {
    checkDirection("secondOrder", *motion.scene, d.scene);
    if (d.time.size() > 0)
      checkCount("secondOrder", "rates of times", static_cast<std::size_t>(d.time.size()), seeds.size());
    checkEntries("secondOrder", "the rate of a time of", d.time);
  }
  std::vector<bool> inertia_varies(motion.world_lines.size(), wanted == RatesWanted::all);
  for (const ReadingDirection& d : directions) {
    for (std::size_t b = 0; b < inertia_varies.size(); ++b) {
      const BodyDerivative& of = d.scene.bodies[b];
      if (of.mass != 0 || of.density != 0 || !of.inertia.isZero(0) || !of.size.isZero(0)) inertia_varies[b] = true;
    }
  }
  for (std::size_t first = 0; first < directions.size(); first += kLanes) {
    const Lanes lanes(tape, directions.subspan(first, std::min(kLanes, directions.size() - first)));
    const std::vector<DualSeed> weights = dualSeeds(seeds, seed_rates, lanes);
    DualPass pass(lanes, first == 0, responses, inertia_varies);  // the first gives the gradient too
    std::vector<Eigen::VectorXd> time_rates(lanes.size(),
                                            Eigen::VectorXd::Zero(static_cast<Eigen::Index>(seeds.size())));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const ReadPlace place = readPlace(motion, seeds[i].body, seeds[i].at);
      Num time = seeds[i].at.event >= 0 ? lanes.eventTime(seeds[i].at.event) : Num(place.time);
      for (std::size_t lane = 0; lane < lanes.size() && seeds[i].at.event < 0; ++lane)
        time.rate[lane] = lanes.timeRate(lane, i);
      std::array<double, kLanes> time_rate{};
      pass.plant(seeds[i], weights[i], time, place, time_rate);
      for (std::size_t lane = 0; lane < lanes.size(); ++lane)
        time_rates[lane][static_cast<Eigen::Index>(i)] = time_rate[lane];
    }
    const SceneBar bar = pass.run();
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      out.gradient_rates.push_back(ratesOf(bar, *motion.scene, lane));
      out.time_rates.push_back(std::move(time_rates[lane]));
    }
    if (first == 0) out.gradient = valuesOf(bar, *motion.scene);
  }
  return out;
}

}  // namespace carom
