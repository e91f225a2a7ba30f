// SPDX-License-Identifier: MIT
#include "tests/cli/stacked_boxes.h"

#include <utility>

namespace carom::test {

void addStackedBoxes(nlohmann::json& scene, double drop) {
  scene["materials"]["lead"] = {{"elasticity", 0}, {"friction", 1}};
  scene["bodies"].push_back({{"name", "belt"},
                             {"fixed", true},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {2, 2, 0.2}}}}}},
                             {"position", {40, 0, 0}},
                             {"surface_velocity", {0.5, 0, 0}}});
  for (const auto& [name, height] : {std::pair{"lower box", 0.2}, {"upper box", 0.4 + drop}})
    scene["bodies"].push_back({{"name", name},
                               {"mass", 1},
                               {"material", "lead"},
                               {"shape", {{"box", {{"size", {0.2, 0.2, 0.2}}}}}},
                               {"position", {40.6, 0, height}},
                               {"velocity", {0.5, 0, 0}}});
}

}  // namespace carom::test
