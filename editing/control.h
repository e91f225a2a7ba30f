// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/distribution.h"

namespace carom {

/// Scene parameters that an edit may change. `vary` is the word of the scene document: position, orientation,
/// velocity, angular_velocity, surface_velocity, surface_angular_velocity, elasticity, friction, tangential_elasticity, mass,
/// inertia, size, tilt, gravity.
struct Control {
  std::string vary;                     ///< kind of parameter
  std::string body;                     ///< for kinds that belong to a body
  std::string material;                 ///< for kinds that belong to a material
  int impact = 1;                       ///< tilt: at the body's n-th impact
  std::vector<std::string> components;  ///< names of the components that vary ("x", "radius"); empty means all
  std::vector<double> min;              ///< lower bounds, SI; empty: physical bounds only; one for all components; or one each
  std::vector<double> max; ///< upper bounds, likewise
  double weight = 1;                    ///< w in the cost (w change / natural scale)^2
  std::string notes = {};               ///< for readers; kept in documents
  /// How likely its values are; read by `explore` alone.
  std::optional<Distribution> distribution = {};

  /// Bounds every component, SI.
  Control& within(double lo, double hi) { return min = {lo}, max = {hi}, *this; }
  /// Lower bound of every component, SI.
  Control& atLeast(double lo) { return min = {lo}, *this; }
  /// Upper bound of every component, SI.
  Control& atMost(double hi) { return max = {hi}, *this; }
  /// Varies only these components.
  Control& only(std::vector<std::string> names) { return components = std::move(names), *this; }
  /// Sets the weight: above 1 a change costs more, below 1 less.
  Control& weighted(double w) { return weight = w, *this; }
};

Control position(std::string body);                  ///< initial position of a body, m
Control orientation(std::string body);               ///< its initial orientation
Control velocity(std::string body);                  ///< its initial velocity, m/s
Control angularVelocity(std::string body);           ///< its initial angular velocity, rad/s
Control surfaceVelocity(std::string body);           ///< surface velocity of a fixed or kinematic body, m/s, its axes
Control surfaceAngularVelocity(std::string body);    ///< its surface angular velocity, rad/s, its axes
Control elasticity(std::string material);            ///< coefficient of restitution of a material
Control friction(std::string material);              ///< Coulomb coefficient of a material
Control tangentialElasticity(std::string material);  ///< coefficient of tangential restitution of a material
Control mass(std::string body);                      ///< mass of a body, kg
Control inertia(std::string body);                   ///< its principal moments of inertia, kg m^2
Control size(std::string body);                      ///< the dimensions of its shape, m
Control tilt(std::string body, int impact);          ///< tilt of the contact normal at its n-th impact
Control gravity();                                   ///< gravity, m/s^2

}  // namespace carom
