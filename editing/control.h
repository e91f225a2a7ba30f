// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"

namespace carom {

/// What an edit may change. `vary` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, elasticity, friction, tangential_elasticity, mass, inertia, size, tilt, gravity.
struct Control {
  std::string vary;
  std::string body;                     ///< where the kind belongs to a body
  std::string material;                 ///< where it belongs to a material
  int impact = 1;                       ///< tilt: at the body's n-th impact
  std::vector<std::string> components;  ///< names of the components that vary ("x", "radius"); empty means all
  std::vector<double> min, max;         ///< empty: only the physical bounds; one number: every component; or one each
  double weight = 1;                    ///< of the change, on top of the natural scale
  std::string notes = {};               ///< for people; kept in documents

  Control& within(double lo, double hi) { return min = {lo}, max = {hi}, *this; }
  Control& atLeast(double lo) { return min = {lo}, *this; }
  Control& atMost(double hi) { return max = {hi}, *this; }
  Control& only(std::vector<std::string> names) { return components = std::move(names), *this; }
  Control& weighted(double w) { return weight = w, *this; }
};

Control position(std::string body);
Control orientation(std::string body);
Control velocity(std::string body);
Control angularVelocity(std::string body);
Control elasticity(std::string material);
Control friction(std::string material);
Control tangentialElasticity(std::string material);
Control mass(std::string body);
Control inertia(std::string body);
Control size(std::string body);
Control tilt(std::string body, int impact);
Control gravity();

}  // namespace carom
