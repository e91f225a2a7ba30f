// SPDX-License-Identifier: MIT
// Control of one impact: the tilt (alpha, beta) of the collision normal at the body's n-th impact. Tilts stay within
// the cone alpha^2 + beta^2 <= max^2 (see validity_rows.h).

#include "editing/problem/controls/control_families.hpp"

namespace carom::editing_detail {
namespace {

std::vector<std::string> tiltComponents(const Scene&, const ControlOwner&) { return {"alpha", "beta"}; }
Eigen::VectorXd getTilt(const Scene& scene, const ControlOwner& o) { return scene.tilts[o.tilt].value; }
void setTilt(const Eigen::VectorXd& values, const Scene&, const ControlOwner& o, Scene& scene) {
  scene.tilts[o.tilt].value = values;
}
Eigen::VectorXd gatherTilt(const SceneGradient& gradient, const ControlOwner& o, const Eigen::VectorXd&) {
  return gradient.tilts[o.tilt];
}
void scatterTilt(const Eigen::VectorXd& rates, const ControlOwner& o, const Eigen::VectorXd&, SceneTangent& tangent) {
  tangent.tilts[o.tilt] += rates;
}

Eigen::VectorXd scaleTilt(const Scene&, const ControlOwner&) { return Vec2::Ones(); }

}  // namespace

const ControlKind kTiltControl{
    .word = "tilt",
    .owner = OwnerKind::impact,
    .components = tiltComponents,
    .get = getTilt,
    .set = setTilt,
    .gather = gatherTilt,
    .scatter = scatterTilt,
    .scale = scaleTilt,
};

}  // namespace carom::editing_detail
