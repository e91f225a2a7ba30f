// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/base/document.h"
#include "formats/base/format_error.h"
#include "formats/gltf/import_report.h"

namespace carom {

/// Content of a file, and what was changed or ignored.
struct Imported {
  Document document;    ///< the scene, and the edit if carom wrote the file
  ImportReport report;  ///< what differs
};

/// How a file is imported whose meshes are drawn, but have no physics.
struct ImportOptions {
  /// The collider of each node with a mesh.
  enum class As {
    nothing,  ///< the physics of the file
    hull,     ///< convex hull
    mesh,     ///< its triangles; closed, unless it is fixed
    box,      ///< bounding box in the axes of the node
    sphere    ///< ball about the middle of that box that holds it
  };
  As as = As::nothing;                 ///< of files without physics
  std::optional<double> density = {};  ///< kg/m^3, of moving bodies; default: 1000. Only with `as`
  std::vector<std::string> fixed = {};  ///< names of nodes that, with all below them, are fixed bodies. Only with `as`
};

/// Reads the default scene of a .gltf or .glb file with KHR_physics_rigid_bodies and KHR_implicit_shapes (drafts; the
/// older form `collider.shape` with KHR_collision_shapes too), or with OMI_physics_body and OMI_physics_shape as Godot writes
/// them, and OMI_physics_gravity, y up turned to z up. With `options` also one without physics.
///
/// A node with `motion` is a moving body of all colliders at it and below it, down to nodes with motions of their
/// own; every other collider is a fixed body. Scale goes into the shapes. Missing mass and inertia are derived from
/// the shape (1000 kg/m^3 without a mass). Unsupported content is in the report.
///
/// A file written by carom also contains the scene document. Bodies whose nodes still have the same numbers are read
/// from there, with the edit, without loss. Bodies changed by another program are read from the extensions.
///
/// Throws FormatError with the JSON pointer or the node: not glTF, no physics, invalid values.
Imported importGltf(const std::string& path, const ImportOptions& options = {});

/// The same for the bytes of a file; buffers in other files are searched in `folder`. Throws InputError.
Imported parseGltfScene(std::string_view bytes, const std::string& folder, const ImportOptions& options = {});

}  // namespace carom
