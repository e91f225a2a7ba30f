// SPDX-License-Identifier: MIT
#include "formats/gltf/frame.hpp"

namespace carom::gltf {

Frame inside(const Frame& outer, const PhysicsNode& node) {
  Frame frame;
  frame.translation = outer.translation + turned(outer.rotation, outer.stretch * node.translation);
  frame.rotation = product(outer.rotation, node.rotation);
  const Mat3 R = matrixOf(node.rotation);
  // outer.rotation S R = (outer.rotation R) (R^T S R)
  const bool even = outer.stretch == Mat3(outer.stretch(0, 0) * Mat3::Identity());
  const Mat3 stretch = even ? outer.stretch : Mat3(R.transpose() * outer.stretch * R);
  frame.stretch = stretch * node.scale.asDiagonal();
  return frame;
}

}  // namespace carom::gltf
