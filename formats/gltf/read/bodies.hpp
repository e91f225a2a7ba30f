// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <functional>

#include "formats/gltf/read/shapes.hpp"

namespace carom::gltf {

/// The body that a node is known to be, with everything below it; null for what has to be made from its physics.
using Known = std::function<const Body*(const PhysicsNode& node, const Frame& world)>;

/// The bodies of a file in the order of its nodes, with names of their own. What cannot be taken over is reported.
/// Throws InputError naming the node for what is not possible.
std::vector<Body> makeBodies(const PhysicsFile& file, ShapeMaker& shapes, const Known& known, ImportReport& report);

/// Mass, centre of mass, inertia and velocities of a moving body whose shape and pose are set already. `shape_to_node`
/// turns its axes into the node's, `world` is the frame of the node. What equals the values that derive from the shape
/// (kSame) is left to be derived.
void setMotion(Body& body, const PhysicsNode& node, const Quat& shape_to_node, const Frame& world,
               ImportReport& report);

}  // namespace carom::gltf
