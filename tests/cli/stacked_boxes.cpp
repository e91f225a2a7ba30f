// SPDX-License-Identifier: MIT
#include "tests/cli/stacked_boxes.h"

#include <string>

namespace carom::test {

void addStackedBoxes(nlohmann::json& scene, double drop) {
  scene["materials"]["lead"] = {{"elasticity", 0}, {"friction", 1}};
  scene["bodies"].push_back({{"name", "belt"},
                             {"fixed", true},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {2, 2, 0.2}}}}}},
                             {"position", {40, 0, 0}},
                             {"surface_velocity", {0.5, 0, 0}}});
  const auto add = [&](const std::string& name, double thickness, double height) {
    scene["bodies"].push_back({{"name", name},
                               {"mass", 1},
                               {"material", "lead"},
                               {"shape", {{"box", {{"size", {0.2, 0.2, thickness}}}}}},
                               {"position", {40.6, 0, height}},
                               {"velocity", {0.5, 0, 0}}});
  };
  add("lower box", 0.2, 0.2);
  for (int i = 0; i < 7; ++i) add("plate " + std::to_string(i), 0.02, 0.31 + 0.02 * i);
  add("upper box", 0.2, 0.54 + drop);
}

}  // namespace carom::test
