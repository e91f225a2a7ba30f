// SPDX-License-Identifier: MIT
#include "tests/cli/stacked_boxes.h"

namespace carom::test {

void addStackedBoxes(nlohmann::json& scene, double drop) {
  scene["materials"]["lead"] = {{"elasticity", 0}, {"friction", 1}};
  scene["bodies"].push_back({{"name", "plate"},
                             {"fixed", true},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {2, 2, 0.2}}}}}},
                             {"position", {40, 0, 0}}});
  for (const auto& [name, height] : {std::pair{"lower box", 0.2}, {"upper box", 0.4 + drop}})
    scene["bodies"].push_back({{"name", name},
                               {"mass", 1},
                               {"material", "lead"},
                               {"shape", {{"box", {{"size", {0.2, 0.2, 0.2}}}}}},
                               {"position", {40, 0, height}}});
}

}  // namespace carom::test
