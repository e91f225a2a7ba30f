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
  std::string vary;                     ///< kind of number
  std::string body;                     ///< where the kind belongs to a body
  std::string material;                 ///< where it belongs to a material
  int impact = 1;                       ///< tilt: at the body's n-th impact
  std::vector<std::string> components;  ///< names of the components that vary ("x", "radius"); empty means all
  std::vector<double> min;              ///< SI; empty: only the physical bounds; one for every component; or one each
  std::vector<double> max;              ///< the same
  double weight = 1;                    ///< of the change, on top of the natural scale
  std::string notes = {};               ///< for people; kept in documents

  /// Keeps every component between two numbers, SI.
  Control& within(double lo, double hi) { return min = {lo}, max = {hi}, *this; }
  /// Keeps every component from falling below, SI.
  Control& atLeast(double lo) { return min = {lo}, *this; }
  /// Keeps every component from rising above, SI.
  Control& atMost(double hi) { return max = {hi}, *this; }
  /// Lets these components vary and no others.
  Control& only(std::vector<std::string> names) { return components = std::move(names), *this; }
  /// Makes a change dearer (above 1) or cheaper (below 1) than others.
  Control& weighted(double w) { return weight = w, *this; }
};

Control position(std::string body);                  ///< where a body starts, m
Control orientation(std::string body);               ///< how it is turned at the start
Control velocity(std::string body);                  ///< its velocity at the start, m/s
Control angularVelocity(std::string body);           ///< its angular velocity at the start, rad/s
Control elasticity(std::string material);            ///< coefficient of restitution of a material
Control friction(std::string material);              ///< Coulomb coefficient of a material
Control tangentialElasticity(std::string material);  ///< tangential restitution of a material
Control mass(std::string body);                      ///< mass of a body, kg
Control inertia(std::string body);                   ///< its principal moments of inertia, kg m^2
Control size(std::string body);                      ///< the dimensions of its shape, m
Control tilt(std::string body, int impact);          ///< tilt of the surface that it strikes at its n-th impact
Control gravity();                                   ///< gravity, m/s^2

}  // namespace carom
