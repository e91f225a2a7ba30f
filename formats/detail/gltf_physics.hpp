#pragma once

#include "adjoint/motion.h"
#include "formats/document.h"

namespace tinygltf {
class Model;
class Value;
}  // namespace tinygltf

namespace carom {

/// The document-wide parts of KHR_physics_rigid_bodies, KHR_implicit_shapes and OMI_physics_gravity: one material for
/// each of the scene's and a last one for bodies that name none, one shape a body (same index as the body).
void addPhysics(tinygltf::Model& model, const Scene& scene);

/// Mass, inertia and start velocities of a moving body, in the axes of its node.
tinygltf::Value motionOf(const Body& body, const BodyModel& model);
/// Collision shape and material of a body.
tinygltf::Value colliderOf(const Scene& scene, int body);

/// Duration, controls and constraints, as writeDocument writes them for this scene. Throws InputError as that does.
tinygltf::Value editOf(const Document& document, const Scene& scene);

}  // namespace carom
