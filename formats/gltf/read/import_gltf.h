// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/base/document.h"
#include "formats/base/format_error.h"

namespace carom {

/// What an import could not take over as it was: one sentence each, with the name of the node or material.
struct ImportReport {
  std::vector<std::string> warnings;
  std::vector<std::string> joints, triggers;  ///< names of the nodes that have one; neither is simulated
};

struct Imported {
  Document document;
  ImportReport report;
};

/// Reads the default scene of a .gltf or .glb file with KHR_physics_rigid_bodies and KHR_implicit_shapes (drafts; the
/// older form `collider.shape` with KHR_collision_shapes too) and OMI_physics_gravity, y up turned to z up.
///
/// A node with `motion` is a moving body of all colliders at it and below it, down to nodes with motions of their own;
/// every other collider is a fixed body. Scale goes into the shapes. Mass and inertia that the file leaves out are
/// derived from the shape (1000 kg/m^3 without a mass). What is not supported is in the report.
///
/// A file that carom wrote holds its scene document too. Bodies whose nodes still say the same number by number are
/// taken from there, with the edit; they come back exactly. Bodies that another program has changed are read from the
/// extensions.
///
/// Throws FormatError with the JSON pointer or the node: no glTF, no physics in it, values that are not possible.
Imported importGltf(const std::string& path);

/// The same for the bytes of a file; buffers in other files are searched in `folder`. Throws InputError.
Imported parseGltfScene(std::string_view bytes, const std::string& folder);

/// Saves a document as saveDocument does. Surfaces of hulls and meshes that have no file are written beside it, as
/// <name>-meshes/<body>.obj with all their digits, one for each surface; hulls of few points are written in the
/// document itself. Returns the mesh files, relative to the document. Throws FormatError.
std::vector<std::string> saveWithMeshes(const std::string& path, const Document& document);

}  // namespace carom
