#pragma once

#include <string>

#include "adjoint/motion.h"
#include "formats/document.h"

namespace carom {

/// How the motion is keyed.
enum class GltfProfile {
  web,     ///< CUBICSPLINE translation, one key an impact, tangents = velocities: exact for flight under gravity
  blender  ///< LINEAR keys at every frame and every impact, for importers that drop the tangents
};

struct GltfOptions {
  GltfProfile profile = GltfProfile::web;
  double frames_per_second = 24;  ///< blender profile only
};

/// Writes scene and motion as glTF 2.0: binary for ".glb", otherwise JSON with embedded buffers. Metres, seconds; one
/// root node turns z-up into glTF's y-up. Rotations are sampled, slerp between keys is within 1e-3 rad of the motion.
/// Carries KHR_physics_rigid_bodies, KHR_implicit_shapes and OMI_physics_gravity (used, not required), and the scene
/// document with the edit (controls, constraints) in the scene's `extras`; importGltf reads them back without loss.
/// A moving body's node is at the origin of its shape; round shapes, planes, scales and parts have nodes below it.
/// Throws InputError when a number does not fit (naming the body) or the file cannot be written (naming the path).
void exportGltf(const std::string& path, const Document& document, const Motion& motion,
                const GltfOptions& options = {});

inline void exportGltf(const std::string& path, const Document& document, const Motion& motion, GltfProfile profile) {
  exportGltf(path, document, motion, GltfOptions{profile, 24});
}

}  // namespace carom
