// SPDX-License-Identifier: MIT
#include "editing/control.h"

namespace carom {
namespace {

Control ofBody(const char* vary, std::string body) {
  Control control;
  control.vary = vary;
  control.body = std::move(body);
  return control;
}

Control ofMaterial(const char* vary, std::string material) {
  Control control;
  control.vary = vary;
  control.material = std::move(material);
  return control;
}

}  // namespace

Control position(std::string body) { return ofBody("position", std::move(body)); }
Control orientation(std::string body) { return ofBody("orientation", std::move(body)); }
Control velocity(std::string body) { return ofBody("velocity", std::move(body)); }
Control angularVelocity(std::string body) { return ofBody("angular_velocity", std::move(body)); }
Control surfaceVelocity(std::string body) { return ofBody("surface_velocity", std::move(body)); }
Control surfaceAngularVelocity(std::string body) { return ofBody("surface_angular_velocity", std::move(body)); }
Control elasticity(std::string material) { return ofMaterial("elasticity", std::move(material)); }
Control friction(std::string material) { return ofMaterial("friction", std::move(material)); }
Control tangentialElasticity(std::string material) { return ofMaterial("tangential_elasticity", std::move(material)); }
Control mass(std::string body) { return ofBody("mass", std::move(body)); }
Control inertia(std::string body) { return ofBody("inertia", std::move(body)); }
Control size(std::string body) { return ofBody("size", std::move(body)); }

Control tilt(std::string body, int impact) {
  Control control = ofBody("tilt", std::move(body));
  control.impact = impact;
  return control;
}

Control gravity() {
  Control control;
  control.vary = "gravity";
  return control;
}

}  // namespace carom
