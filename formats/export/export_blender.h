// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/gltf/write/export_gltf.h"

namespace carom {

/// A Python script for Blender (`blender --python motion.py`, or its text editor) with the whole .glb file in it. It
/// creates a scene with the frame rate of the options, frames from 0 to the last one, and the file's camera as the
/// active one, which an imported file cannot set. Throws InputError as gltfText does.
std::string blenderText(const Document& document, const Motion& motion, const GltfOptions& options = {});

}  // namespace carom
