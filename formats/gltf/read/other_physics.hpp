// SPDX-License-Identifier: MIT
// Private to formats/*.cpp: physics that is not written in KHR_physics_rigid_bodies, written so.
#pragma once

#include "formats/gltf/import_report.h"
#include "formats/gltf/read/import_gltf.h"
#include "formats/json/json.hpp"

namespace tinygltf {
class Model;
}

namespace carom::gltf {

/// The document with OMI_physics_body and OMI_physics_shape or OMI_collider, as Godot writes them, turned into KHR_physics_rigid_bodies and
/// KHR_implicit_shapes: velocities from the axes of the world into the node's, heights of capsules without their caps, mass 1
/// where none is given. Nodes that have the latter extension keep it. Throws InputError with the JSON pointer.
formats_detail::Json withKhronosPhysics(formats_detail::Json document, const tinygltf::Model& model);

/// Whether a node has KHR_physics_rigid_bodies.
bool hasPhysics(const formats_detail::Json& document);

/// The document with a collider for each node with a mesh of the default scene, as `options` say: nodes move unless they, or one
/// above, are named in `options.fixed`. Throws InputError: physics in the file, a name that no node has.
formats_detail::Json withColliders(formats_detail::Json document, const tinygltf::Model& model, const ImportOptions& options);

}  // namespace carom::gltf
