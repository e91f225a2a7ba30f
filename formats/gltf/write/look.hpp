// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/drawing/palette.hpp"
#include "formats/gltf/write/buffer.hpp"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace carom::formats_detail {

/// Appends an item to one of the model's lists and returns its index.
template <class Item>
int append(std::vector<Item>& items, Item item) {
  items.push_back(std::move(item));
  return static_cast<int>(items.size()) - 1;
}

/// Sets the pose of a node, given in our axes.
void setPose(tinygltf::Node& node, const Vec3& x, const Quat& q);

/// How a surface looks; `alpha` is how much of it hides what is behind, from 0 to 1.
struct Tint {
  Colour colour;
  double alpha = 1;
  double roughness = 0.45;
  bool both_sides = false;
};

/// What bodies look like: adds meshes with materials to a model. Planes are squares of the given half width.
class GltfLook {
 public:
  GltfLook(tinygltf::Model& model, GltfBuffer& buffer, const Scene& scene, double plane_half_width)
      : model_(model), buffer_(buffer), scene_(scene), plane_half_width_(plane_half_width) {}

  /// Mesh of a body in its own colour; of a translucent copy where alpha < 1. Each is made once.
  int body(int index, double alpha = 1);
  /// Mesh of any shape, made anew.
  int shape(const Shape& shape, const std::string& name, const Tint& tint);

 private:
  int addMaterial(const std::string& name, const Tint& tint);

  tinygltf::Model& model_;
  GltfBuffer& buffer_;
  const Scene& scene_;
  double plane_half_width_;
  std::map<std::pair<int, double>, int> bodies_;
};

}  // namespace carom::formats_detail
