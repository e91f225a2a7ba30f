// SPDX-License-Identifier: MIT
// Control of one impact: the tilt (alpha, beta) of the collision normal at the body's n-th impact. Tilts stay within
// the cone alpha^2 + beta^2 <= max^2 (see validity_rows.hpp).

#include "editing/problem/controls/control_families.hpp"

namespace carom::editing_detail {
namespace {

std::vector<std::string> tiltComponents(const Scene&, const ControlOwner&) { return {"alpha", "beta"}; }
constexpr auto kTilt = [](auto& scene, const ControlOwner& o) -> auto& { return scene.tilts[o.tilt].value; };
constexpr auto kTiltRates = [](auto& scene, const ControlOwner& o) -> auto& { return scene.tilts[o.tilt]; };
using Tilts = FieldNumbers<kTilt, kTiltRates>;

Eigen::VectorXd scaleTilt(const Scene&, const ControlOwner&) { return Vec2::Ones(); }

}  // namespace

const ControlKind kTiltControl{
    .word = "tilt",
    .owner = OwnerKind::impact,
    .components = tiltComponents,
    .get = Tilts::get,
    .set = Tilts::set,
    .gather = Tilts::gather,
    .scatter = Tilts::scatter,
    .scale = scaleTilt,
};

}  // namespace carom::editing_detail
