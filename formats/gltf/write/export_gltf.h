// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom {

/// Interpolation of the motion, in glTF's words.
enum class GltfKeys {
  /// LINEAR keys at every frame, at every impact and between: works in every glTF reader, including Blender.
  linear,
  /// CUBICSPLINE translation, one key per impact, tangents = velocities: exact for flight under gravity, and small.
  /// Not for importers that drop the tangents, such as Blender's.
  cubic
};

/// Options of glTF export.
struct GltfOptions {
  GltfKeys keys = GltfKeys::linear;  ///< interpolation
  double frames_per_second = 24;  ///< whole frames have keys (linear); Blender's default is 24
  /// m; linear keys: largest error of translations between keys, and at most 0.5 % of the body's radius. With 1e-4
  /// under 9.81 m/s^2 and 24 frames there are 120 keys per second, which include the frames at 30 and 60 per second.
  double tolerance = 1e-4;
  bool camera = false;                   ///< add a camera that frames the whole motion, from the side and slightly above
  std::optional<double> light = {};      ///< lux: add a directional light (KHR_lights_punctual)
  std::optional<Seconds> ghosts = {};    ///< s: interval of translucent copies of moving bodies
  bool nails = false;                    ///< marks of the constraints: nailed positions and poses, regions
};

/// Scene and motion as glTF 2.0: a .glb file when `binary`, else a .gltf file, JSON with embedded buffers. Metres,
/// seconds; z up becomes y up, (x, y, z) -> (x, z, -y), for the axes of bodies, too, so that a z-up program that
/// converts back (Blender) has every body's axes as they are here. Rotations are sampled, within 1e-3 rad of the
/// motion between keys. Carries KHR_physics_rigid_bodies, KHR_implicit_shapes and OMI_physics_gravity (used, not
/// required), and the scene document with the edit (controls, constraints) in the scene's `extras`; importGltf reads
/// them back without loss. `extras` have `carom_playback` beside it: `frames_per_second`, `last_frame`. A moving
/// body's node is at the origin of its shape; scaled surfaces and parts have nodes below it. Camera, light, ghosts
/// and nails have no physics. Throws InputError for numbers out of range (naming the body or the option).
std::string gltfText(const Document& document, const Motion& motion, const GltfOptions& options, bool binary);

/// The last frame of a motion of this length; frame 0 is its start.
int lastFrame(double seconds, double frames_per_second);
/// Neither a bool nor a character is a time.
template <NoTime T>
int lastFrame(T seconds, double frames_per_second) = delete;

}  // namespace carom
