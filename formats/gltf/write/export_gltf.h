// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom {

/// How the motion is keyed, in glTF's words.
enum class GltfKeys {
  /// LINEAR keys at every frame, at every impact and between: right wherever glTF is read, in Blender too.
  linear,
  /// CUBICSPLINE translation, one key an impact, tangents = velocities: exact for flight under gravity, and small. Not
  /// for importers that drop the tangents, as Blender's does.
  cubic
};

/// How a motion is written as glTF.
struct GltfOptions {
  GltfKeys keys = GltfKeys::linear;  ///< how it is keyed
  double frames_per_second = 24;  ///< whole frames have keys of their own (linear); Blender has 24 unless told
  /// m; linear keys: how far translations may be off between keys, and at most 0.5 % of the body's radius. With 1e-4
  /// under 9.81 m/s^2 and 24 frames there are 120 keys a second, which hold the whole frames of 30 and 60 as well.
  double tolerance = 1e-4;
  bool camera = false;                   ///< one that sees the whole motion, from the side and a little above
  std::optional<double> light = {};      ///< lx: a sun (KHR_lights_punctual); 2000 is a bright hall or a dull day
  std::optional<double> ghosts = {};     ///< s: translucent copies of moving bodies, this far apart in time
  bool nails = false;                    ///< marks of the constraints: nailed places and poses, regions
};

/// Scene and motion as glTF 2.0: a .glb file when `binary`, else a .gltf file, JSON with embedded buffers. Metres,
/// seconds; z up becomes y up, (x, y, z) -> (x, z, -y), for the axes of bodies too, so that a program with z up that
/// turns them back (Blender) has every body's axes as they are here. Rotations are sampled, and within 1e-3 rad of the
/// motion between keys. Carries KHR_physics_rigid_bodies, KHR_implicit_shapes and OMI_physics_gravity (used, not
/// required), and the scene document with the edit (controls, constraints) in the scene's `extras`; importGltf reads
/// them back without loss. `extras` have `carom_playback` beside it: `frames_per_second`, `last_frame`. A moving body's
/// node is at the origin of its shape; scaled surfaces and parts have nodes below it. Camera, light, ghosts and nails
/// have no physics. Throws InputError when a number does not fit (naming the body or the option).
std::string gltfText(const Document& document, const Motion& motion, const GltfOptions& options, bool binary);

/// The last frame that a motion of this length needs, the first being 0 at its start.
int lastFrame(double seconds, double frames_per_second);

}  // namespace carom
