// SPDX-License-Identifier: MIT
#include "tests/cli/tipping_box.h"

#include <cmath>

namespace carom::test {

void addTippingBox(nlohmann::json& scene, double drop) {
  scene["materials"]["lead"] = {{"elasticity", 0}, {"friction", 1}};
  scene["bodies"].push_back({{"name", "plate"},
                             {"fixed", true},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {2, 2, 0.2}}}}}},
                             {"position", {40, 0, 0}}});
  const double tilt = 0.5, lowest = 0.1 * (std::sin(tilt) + std::cos(tilt));
  scene["bodies"].push_back({{"name", "box"},
                             {"mass", 1},
                             {"material", "lead"},
                             {"shape", {{"box", {{"size", {0.2, 0.2, 0.2}}}}}},
                             {"position", {40, 0, 0.1 + lowest + drop}},
                             {"orientation", {std::cos(tilt / 2), 0, std::sin(tilt / 2), 0}}});
}

}  // namespace carom::test
