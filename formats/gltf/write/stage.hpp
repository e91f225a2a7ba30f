// SPDX-License-Identifier: MIT
// Private to formats/*.cpp. What a picture needs besides bodies: nodes without physics. Each function adds nodes to the
// model and returns the indices of those that belong to the scene itself.
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"
#include "formats/gltf/write/look.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

/// A perspective camera, 16 to 9, that sees all of the extent: from the side of its longer horizontal edge, a little
/// turned and raised.
int addCamera(tinygltf::Model& model, const Extent& extent);
/// A directional light of so many lux, from above and from the left of that camera.
int addSun(tinygltf::Model& model, const Extent& extent, double lux);

/// Translucent copies of every moving body at multiples of the interval, below one node. Throws InputError for more than
/// kMaxGhosts.
inline constexpr double kMaxGhosts = 20000;
std::vector<int> addGhosts(tinygltf::Model& model, GltfLook& look, const Motion& motion, double interval);

/// Marks of constraints, below one node: balls at nailed places, bodies in nailed poses, regions as translucent solids.
std::vector<int> addNails(tinygltf::Model& model, GltfLook& look, const Document& document, const Motion& motion);

}  // namespace carom::formats_detail
