// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "bench/charts/engines/engine.h"

namespace carom::charts {

const std::vector<EngineKind>& engines() {
  static const std::vector<EngineKind> found = {
      odeStep(),
      odeQuickStep(),
#ifdef CAROM_CHARTS_BULLET
      bullet(),
#endif
#ifdef CAROM_CHARTS_MUJOCO
      mujoco(),
#endif
  };
  return found;
}

std::vector<EngineKind> mapEngines() {
  std::vector<EngineKind> kinds = engines();
  std::erase_if(kinds, [](const EngineKind& kind) { return kind.name == "ODE quick"; });
  return kinds;
}

const std::vector<std::string>& missingEngines() {
  static const std::vector<std::string> missing = {
#ifndef CAROM_CHARTS_BULLET
      "Bullet",
#endif
#ifndef CAROM_CHARTS_MUJOCO
      "MuJoCo",
#endif
  };
  return missing;
}

PairCoefficients commonPair(const Scene& scene) {
  const Material& first = materialOf(scene, scene.bodies.at(0));
  for (const Body& body : scene.bodies) {
    const Material& m = materialOf(scene, body);
    if (m.elasticity != first.elasticity || m.friction != first.friction)
      throw std::invalid_argument("'" + body.name + "' has another material than '" + scene.bodies[0].name +
                                  "', expected one material for all bodies");
  }
  return combine(first, first);
}

}  // namespace carom::charts
