// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "formats/gltf/frame.hpp"

namespace tinygltf {
class Model;
}

namespace carom::gltf {

/// Turn from the axes of our shape to those of the collider's node: half a turn for a plane that is mirrored over, and
/// for a cone that stands on its apex.
Quat axesOf(const ColliderShape& shape, const Mat3& stretch);

/// Shapes of colliders, scaled by the stretch of their nodes. Surfaces are made once for all who use them.
class ShapeMaker {
 public:
  ShapeMaker(const tinygltf::Model& model, const formats_detail::Json& document, ImportReport& report)
      : model_(model), document_(document), report_(report) {}

  /// In our axes (see axesOf). None for what is not supported or turned off by a scale of 0, which is reported. Throws
  /// InputError naming the node: scales that make a round shape another one, surfaces that are not possible.
  /// `solid`: the mass of the body is that of its volume, so that small holes of meshes are closed.
  std::optional<Shape> make(const PhysicsNode& node, const Mat3& stretch, bool solid = false);

  /// A mesh of the file as it is, with the digits that carom kept beside it where they agree with its floats.
  std::shared_ptr<const Surface> surfaceOf(const MeshShape& shape) { return surfaceOf(shape, Mat3::Identity(), false); }

 private:
  struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
  };
  using Key = std::tuple<int, int, bool, std::array<double, 9>, bool>;

  std::shared_ptr<const Surface> surfaceOf(const MeshShape& shape, const Mat3& baked, bool solid);
  Triangles trianglesOf(const MeshShape& shape, const Mat3& baked);
  void useExactVertices(int mesh, std::vector<Vec3>& vertices);
  void appendBelow(int node, const Eigen::Affine3d& transform, Triangles& out);

  const tinygltf::Model& model_;
  const formats_detail::Json& document_;
  ImportReport& report_;
  std::map<Key, std::shared_ptr<const Surface>> made_;
};

}  // namespace carom::gltf
