// SPDX-License-Identifier: MIT
#include "adjoint/derivative/adjoint.h"

#include "adjoint/base/arguments.hpp"
#include "adjoint/derivative/arc_pass.hpp"
#include "adjoint/derivative/derivative_arguments.hpp"
#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/derivative/single_impact.hpp"
#include "adjoint/derivative/waiting_bars.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

class ReversePass {
 public:
  ReversePass(DerivativeTape& tape, Reliability* reliability)
      : tape_(tape), motion_(tape.motion()), reliability_(reliability), bars_(motion_) {}

  SceneGradient run(std::span<const StateSeed> seeds) {
    for (const StateSeed& seed : seeds) plant(seed);
    bars_.eachEvent([&](int event, const Bars::AtEvent& at) {
      if (reliability_) {
        reliability_->pass(motion_, event);
        const FromZero friction = tape_.event(event).frictionFromZero();
        reliability_->passFriction(motion_, event, friction.margin, friction.shared);
      }
      throughEvent(event, at);
    });
    toSceneAsWritten();
    return std::move(bars_.scene);
  }

 private:
  using Bars = WaitingBars<double>;

  void plant(const StateSeed& seed) {
    const auto b = static_cast<std::size_t>(seed.body);
    const ReadPlace place = readPlace(motion_, seed.body, seed.at);
    const StateDerivative bar = seedPullback((*motion_.models)[b], place.state, seed, bars_.model[b]);
    bars_.scene.gravity += seed.gravity;
    if (seed.size.size() > 0) bars_.scene.bodies[b].size += seed.size;
    const auto rate = [&] {
      return motion_.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rateAt(place.time, place.state);
    };
    if (seed.at.event >= 0 && bars_.readAtEvent(seed.at, seed.body, bar, seed.time, rate)) return;
    throughArc(seed.body, place.arc, place.time, bar,
               [&]() -> ArcSensitivity { return tape_.arcUntil(seed.body, place.arc, place.time); });
  }

  // From time t on arc k back to the start of the arc, which is an event or the start of the motion. Where nothing
  // depends on how the body has turned in flight, its sensitivity is not asked for.
  template <class Sensitivity>
  void throughArc(int body, int k, double t, const StateDerivative& bar, const Sensitivity& sensitivity) {
    const auto b = static_cast<std::size_t>(body);
    const Arc& arc = motion_.world_lines[b].arcs[static_cast<std::size_t>(k)];
    if (reliability_) reliability_->passArc(motion_, body, k);
    static const ArcSensitivity kUnturned;
    const bool turns = !arc.isFlight() || !isZero(bar.theta);
    const auto arrive = [&](int of, int start_of, const StateDerivative& start) { bars_.arriveAt(of, start_of, start); };
    if (turns) arcPullback(motion_, body, k, t, sensitivity(), bar, arrive, bars_.scene, bars_.model);
    else arcPullback(motion_, body, k, t, kUnturned, bar, arrive, bars_.scene, bars_.model);
  }

  void throughEvent(int index, const Bars::AtEvent& at) {
    const Event& event = motion_.events[static_cast<std::size_t>(index)];
    const auto onward = [&](const auto& before) {
      for (std::size_t i = 0; i < event.participants.size(); ++i) {
        const Participant& p = event.participants[i];
        if (before[i].isZero()) continue;
        throughArc(p.body, p.arc, event.time, before[i],
                   [&]() -> const ArcSensitivity& { return tape_.until(p, event.time); });
      }
    };
    if (const SingleImpact* single = tape_.singleImpact(index)) {
      onward(single->pullback(at.after, at.before, at.time, bars_.scene, bars_.model));
    } else {
      onward(tape_.event(index).pullback(at.after, at.before, at.time, bars_.scene, bars_.model));
    }
  }

  void toSceneAsWritten() {
    for (std::size_t b = 0; b < bars_.start.size(); ++b) {
      const Body& body = motion_.scene->bodies[b];
      const BodyModel& model = (*motion_.models)[b];
      BodyDerivative& written = bars_.scene.bodies[b];
      if (!bars_.start[b].isZero()) startPullback(body, model, bars_.start[b], written, bars_.model[b]);
      if (!bars_.model[b].isZero()) modelPullback(body, model, bars_.model[b], written);
    }
  }

  DerivativeTape& tape_;
  const Motion& motion_;
  Reliability* reliability_;
  Bars bars_;
};

}  // namespace

SceneGradient adjoint(DerivativeTape& tape, std::span<const StateSeed> seeds, Reliability* reliability) {
  for (const StateSeed& seed : seeds) checkSeed("adjoint", tape.motion(), seed);
  return ReversePass(tape, reliability).run(seeds);
}

SceneGradient adjoint(const Motion& motion, std::span<const StateSeed> seeds, Reliability* reliability) {
  DerivativeTape tape(motion);
  return adjoint(tape, seeds, reliability);
}

}  // namespace carom
