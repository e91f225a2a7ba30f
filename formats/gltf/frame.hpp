// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include "formats/gltf/axes.hpp"
#include "formats/gltf/nodes.hpp"

namespace carom::gltf {

using namespace formats_detail;

/// What a chain of nodes does to a point: p_outer = translation + rotation * (stretch p). The stretch is a multiple of
/// the identity or diagonal wherever the chain allows it.
///
/// Composition is exact where it can be: a rotation by 0, and one and its opposite leave numbers as they are, bit by bit.
/// So poses that went out come back.
struct Frame {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();
  Mat3 stretch = Mat3::Identity();
};

Frame inside(const Frame& outer, const PhysicsNode& node);

}  // namespace carom::gltf
