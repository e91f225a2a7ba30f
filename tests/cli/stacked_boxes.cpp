// SPDX-License-Identifier: MIT
#include "tests/cli/stacked_boxes.h"

#include <tuple>

namespace carom::test {

void addStackedBoxes(nlohmann::json& scene, double drop) {
  scene["materials"]["lead"] = {{"elasticity", 0}, {"friction", 1}};
  scene["bodies"].push_back({{"name", "plate"},
                             {"fixed", true},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {2, 2, 0.2}}}}}},
                             {"position", {40, 0, 0}}});
  for (const auto& [name, along, height] : {std::tuple{"lower box", 40.0, 0.2}, {"upper box", 40.11, 0.4 + drop}})
    scene["bodies"].push_back({{"name", name},
                               {"mass", 1},
                               {"material", "lead"},
                               {"shape", {{"box", {{"size", {0.2, 0.2, 0.2}}}}}},
                               {"position", {along, 0, height}}});
}

}  // namespace carom::test
