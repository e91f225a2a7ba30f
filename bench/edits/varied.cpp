// SPDX-License-Identifier: MIT
#include "bench/edits/varied.h"

#include <algorithm>
#include <cmath>

#include "editing/problem/controls/control_set.hpp"

namespace carom::bench {

using namespace editing_detail;

namespace {

bool isBall(const Body& body) { return std::holds_alternative<Sphere>(body.shape); }

std::vector<Control> menu(const Scene& scene, int impacts, Dice& dice) {
  std::vector<Control> menu;
  for (const Body& body : scene.bodies) {
    if (body.fixed) continue;
    if (body.name != "thrown") menu.push_back(velocity(body.name));
    for (Control& c : std::vector{angularVelocity(body.name), position(body.name), orientation(body.name),
                                  mass(body.name), tilt(body.name, dice.integer(1, std::min(3, impacts)))})
      menu.push_back(c);
    if (!isBall(body)) menu.push_back(inertia(body.name));
  }
  for (const Material& material : scene.materials) {
    menu.push_back(elasticity(material.name));
    if (material.friction > 0) menu.push_back(friction(material.name));
    menu.push_back(tangentialElasticity(material.name));
  }
  return menu;
}

bool hasThreeNumbers(const Control& c) {
  return c.vary == "velocity" || c.vary == "angular_velocity" || c.vary == "position" || c.vary == "orientation";
}

void keepSome(Control& control, Dice& dice) {
  std::vector<std::string> names = {"x", "y", "z"};
  dice.shuffle(names);
  names.resize(static_cast<std::size_t>(dice.integer(1, 2)));
  control.only(names);
}

int numbersOf(const Scene& scene, const std::vector<Control>& controls) { return ControlSet(scene, controls).size(); }

// Room of 0.15 to 1 natural scale on either side, each drawn by itself, within the physical bounds.
void bound(const Scene& scene, Control& control, Dice& dice) {
  const ControlSet set(scene, {control});
  for (const Variable& v : set.variables()) {
    const double down = dice.in(0.15, 1), up = dice.in(0.15, 1);
    const double low = v.logarithmic ? v.before * std::exp(-down * v.scale) : v.before - down * v.scale;
    const double high = v.logarithmic ? v.before * std::exp(up * v.scale) : v.before + up * v.scale;
    control.min.push_back(std::max(low, v.lower));
    control.max.push_back(std::min(high, v.upper));
  }
}

}  // namespace

std::vector<Control> drawControls(const Scene& scene, int impacts, Dice& dice) {
  const int wanted = static_cast<int>(std::lround(dice.logIn(kFewestNumbers, kMostNumbers)));
  std::vector<Control> controls = {velocity("thrown")};
  if (wanted > 4 && dice.chance(0.15)) keepSome(controls[0], dice);
  std::vector<Control> rest = menu(scene, impacts, dice);
  dice.shuffle(rest);
  for (const Control& c : rest) {
    if (numbersOf(scene, controls) >= wanted) break;
    controls.push_back(c);
    if (hasThreeNumbers(c) && dice.chance(0.25)) keepSome(controls.back(), dice);
    if (numbersOf(scene, controls) > kMostNumbers) controls.pop_back();
  }
  for (Control& c : controls) {
    if (c.vary != "tilt" && c.vary != "inertia" && dice.chance(0.3)) bound(scene, c, dice);
    if (dice.chance(0.25)) c.weighted(dice.oneOf(std::vector<double>{0.25, 0.5, 2, 4}));
  }
  return controls;
}

}  // namespace carom::bench
