// SPDX-License-Identifier: MIT
#include "cli/units.h"

#include <utility>

namespace carom::cli {

std::string unitOf(const std::string& name) {
  constexpr std::pair<const char*, const char*> kUnits[] = {
      {"position", "m"},     {"point", "m"},     {"velocity", "m/s"},    {"angular_velocity", "rad/s"},
      {"orientation", "rad"}, {"time", "s"},      {"mass", "kg"},         {"inertia", "kg m^2"},
      {"size", "m"},         {"gravity", "m/s^2"}, {"avoid", "m"},        {"inside", "m"},
      {"speed", "m/s"},      {"kinetic_energy", "J"}, {"impulse", "N s"}, {"height", "m"},
      {"contact", "m"},      {"surface_velocity", "m/s"}, {"surface_angular_velocity", "rad/s"}};
  const std::string number = name.substr(0, name.find(' '));  // "size.0.scale"
  if (number.ends_with(".scale")) return "";
  const std::string word = number.substr(0, number.find('.'));
  for (const auto& [known, unit] : kUnits)
    if (word == known) return unit;
  return "";
}

}  // namespace carom::cli
