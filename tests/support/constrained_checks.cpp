// SPDX-License-Identifier: MIT
#include "tests/support/constrained_checks.h"

#include <algorithm>
#include <cmath>

#include "adjoint/constrained/constrained_path.hpp"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

using adjoint_detail::ConstrainedPath;
using adjoint_detail::ConstrainedStep;

class Look {
 public:
  Look(const Motion& motion, int body, ConstrainedFindings& found) : motion_(motion), body_(body), found_(found) {}

  void at(const State& state) {
    const double energy = energyPerMass(motion_, body_, state);
    // of what flies far down the rounding is that of its kinetic energy
    const double growth = (energy - least_) / std::max(1.0, std::abs(energy));
    if (!(growth <= found_.worst_growth)) found_.worst_growth = growth;
    least_ = std::min(least_, energy);
  }

  void gapsOf(const ConstrainedPath& path, const State& state) {
    const auto& scene = path.scene();
    const Pose own{state.x, scene.model->shapeToWorld(state.q.toRotationMatrix())};
    for (std::size_t k = 0; k < path.contacts().size(); ++k) {
      const double gap = std::abs(scene.contact(path.contacts()[k], k, own, {}, path.start()).at.gap);
      if (!(gap <= found_.worst_gap)) found_.worst_gap = gap;
    }
  }

 private:
  const Motion& motion_;
  int body_;
  ConstrainedFindings& found_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double energyPerMass(const Motion& motion, int body, const State& state) {
  const BodyModel& model = (*motion.models)[static_cast<std::size_t>(body)];
  return kineticEnergy(model, state) * model.inverse_mass - model.gravity_factor * motion.scene->gravity.dot(state.x);
}

ConstrainedFindings lookAtConstrainedPaths(const Motion& motion, int samples) {
  ConstrainedFindings found;
  for (std::size_t b = 0; b < motion.world_lines.size(); ++b) {
    if (!(*motion.models)[b].moving) continue;
    const std::vector<Arc>& arcs = motion.world_lines[b].arcs;
    Look look(motion, static_cast<int>(b), found);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const double from = arcs[a].start(), until = a + 1 < arcs.size() ? arcs[a + 1].start() : motion.end;
      const auto* path = arcs[a].trajectory().constrained();
      if (!path) {
        for (int i = 0; i <= samples; ++i) look.at(arcs[a].stateAt(std::min(until, from + (until - from) * i / samples)));
        continue;
      }
      ++found.paths;
      for (const ConstrainedStep& step : path->allSteps()) {
        if (!(step.start < until)) break;
        ++found.steps;
        const double length = std::min(step.length, until - step.start);
        for (int i = 0; i <= samples; ++i) {
          const State state = arcs[a].stateAt(std::min(until, step.start + length * i / samples));
          look.at(state);
          look.gapsOf(*path, state);
        }
      }
    }
  }
  return found;
}

}  // namespace carom::test
