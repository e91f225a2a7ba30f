// SPDX-License-Identifier: MIT
#include "adjoint/derivative/adjoint.h"

#include <functional>
#include <map>

#include "adjoint/base/arguments.hpp"
#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/derivative/seed.hpp"

namespace carom {
namespace {

// Adjoints that wait at an event, by participant.
struct Pending {
  std::vector<StateDerivative> after, before;
  double time = 0;
};

class ReversePass {
 public:
  explicit ReversePass(DerivativeTape& tape)
      : tape_(tape),
        motion_(tape.motion()),
        scene_bar_(*motion_.scene),
        start_bar_(motion_.world_lines.size()),
        model_bar_(motion_.world_lines.size()) {}

  SceneGradient run(std::span<const StateSeed> seeds, Reliability* reliability) {
    for (const StateSeed& seed : seeds) plant(seed);
    while (!pending_.empty()) {
      const auto latest = pending_.begin();
      const int event = latest->first;
      const Pending bars = std::move(latest->second);
      pending_.erase(latest);
      if (reliability) {
        reliability->pass(motion_, event);
        reliability->passFriction(motion_, event, tape_.event(event).frictionFromZero());
      }
      throughEvent(event, bars);
    }
    toSceneAsWritten();
    return std::move(scene_bar_);
  }

 private:
  void plant(const StateSeed& seed) {
    const auto b = static_cast<std::size_t>(seed.body);
    const ReadPlace place = readPlace(motion_, seed.body, seed.at);
    const StateDerivative bar = seedPullback((*motion_.models)[b], place.state, seed, model_bar_[b]);
    if (seed.at.event >= 0) {
      Pending& at = pendingAt(seed.at.event);
      at.time += seed.time;
      if (motion_.events[static_cast<std::size_t>(seed.at.event)].find(seed.body)) {
        at.before[participantOf(seed.at.event, seed.body)] += bar;
        return;
      }
      // a body that has no part in the event moves on while the event comes later
      at.time += bar.dot(motion_.world_lines[b].arcs[static_cast<std::size_t>(place.arc)].rate(place.state));
    }
    throughFlight(seed.body, place.arc, place.time, tape_.arcUntil(seed.body, place.arc, place.time), bar);
  }

  // From time t on arc k back to the start of the arc, which is an event or the start of the motion.
  void throughFlight(int body, int k, double t, const RotationSensitivity& S, const StateDerivative& bar) {
    const auto b = static_cast<std::size_t>(body);
    const WorldLine& line = motion_.world_lines[b];
    const StateDerivative start =
        flightPullback(line.arcs[static_cast<std::size_t>(k)], t, S, bar, scene_bar_.gravity, model_bar_[b]);
    if (k == 0) {
      start_bar_[b] += start;
    } else {
      const int event = line.events[static_cast<std::size_t>(k) - 1];
      pendingAt(event).after[participantOf(event, body)] += start;
    }
  }

  void throughEvent(int index, const Pending& bars) {
    const Event& event = motion_.events[static_cast<std::size_t>(index)];
    const std::vector<StateDerivative> before =
        tape_.event(index).pullback(bars.after, bars.before, bars.time, scene_bar_, model_bar_);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Participant& p = event.participants[i];
      if (before[i].isZero()) continue;
      throughFlight(p.body, p.arc, event.time, tape_.arc(p.body, p.arc), before[i]);
    }
  }

  void toSceneAsWritten() {
    for (std::size_t b = 0; b < start_bar_.size(); ++b) {
      const Body& body = motion_.scene->bodies[b];
      const BodyModel& model = (*motion_.models)[b];
      if (!start_bar_[b].isZero()) startPullback(body, model, start_bar_[b], scene_bar_.bodies[b], model_bar_[b]);
      if (!model_bar_[b].isZero()) modelPullback(body, model, model_bar_[b], scene_bar_.bodies[b]);
    }
  }

  std::size_t participantOf(int event, int body) const {
    const Event& e = motion_.events[static_cast<std::size_t>(event)];
    return static_cast<std::size_t>(e.find(body) - e.participants.data());
  }

  Pending& pendingAt(int event) {
    Pending& p = pending_[event];
    const std::size_t n = motion_.events[static_cast<std::size_t>(event)].participants.size();
    p.after.resize(n);
    p.before.resize(n);
    return p;
  }

  DerivativeTape& tape_;
  const Motion& motion_;
  SceneGradient scene_bar_;
  std::vector<StateDerivative> start_bar_;
  std::vector<BodyModelDerivative> model_bar_;
  std::map<int, Pending, std::greater<>> pending_;  // latest event first
};

}  // namespace

SceneGradient adjoint(DerivativeTape& tape, std::span<const StateSeed> seeds, Reliability* reliability) {
  for (const StateSeed& seed : seeds) checkSeed("adjoint", tape.motion(), seed);
  return ReversePass(tape).run(seeds, reliability);
}

SceneGradient adjoint(const Motion& motion, std::span<const StateSeed> seeds, Reliability* reliability) {
  DerivativeTape tape(motion);
  return adjoint(tape, seeds, reliability);
}

}  // namespace carom
