// SPDX-License-Identifier: MIT
#include "formats/export/export_blender.h"

#include <string_view>

#include "formats/base/base64.hpp"
#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

namespace {

constexpr const char* kHead = R"(# A motion for Blender, written by carom: blender --python <this file>
# It goes into a scene of its own; nothing that is there is changed. The file itself follows at the end.
import base64
import math
import os
import tempfile

import bpy
import numpy

)";

// The importer makes frames of seconds by the whole rate alone, without the base that rates like 29.97 have beside it.
constexpr const char* kBody = R"(

def retime(things, factor):
    actions = {thing.animation_data.action for thing in things if thing.animation_data}
    for curve in (curve for action in actions if action for curve in action.fcurves):
        for key in curve.keyframe_points:
            key.co.x *= factor
        curve.update()


def show():
    if not hasattr(numpy, 'bool'):  # Blender 3.4's importer uses this name, which numpy 1.24 (Debian 12) has not
        numpy.bool = bool
    scene = bpy.data.scenes.new('carom')
    if bpy.data.worlds:
        scene.world = bpy.data.worlds[0]
    bpy.context.window.scene = scene
    scene.render.fps = math.ceil(FRAMES_PER_SECOND)
    handle, path = tempfile.mkstemp(suffix='.glb')
    try:
        with os.fdopen(handle, 'wb') as file:
            file.write(base64.b64decode(GLB))
        bpy.ops.import_scene.gltf(filepath=path)
    finally:
        os.remove(path)
    scene.render.fps_base = scene.render.fps / FRAMES_PER_SECOND
    if scene.render.fps != FRAMES_PER_SECOND:
        retime(scene.objects, FRAMES_PER_SECOND / scene.render.fps)
    scene.frame_start = 0
    scene.frame_end = LAST_FRAME
    scene.frame_set(0)
    cameras = [thing for thing in scene.objects if thing.type == 'CAMERA']
    if cameras:
        scene.camera = cameras[0]


)";

std::string inLines(const std::string& text) {
  constexpr std::size_t kWidth = 116;
  std::string out;
  for (std::size_t i = 0; i < text.size(); i += kWidth) out += text.substr(i, kWidth) + '\n';
  return out;
}

}  // namespace

std::string blenderText(const Document& document, const Motion& motion, const GltfOptions& options) {
  const std::string encoded = base64(gltfText(document, motion, options, true));
  std::string script = kHead;
  script += "FRAMES_PER_SECOND = " + numberText(options.frames_per_second) + "\n";
  script += "LAST_FRAME = " + std::to_string(lastFrame(motion.end, options.frames_per_second)) + "\n";
  script += kBody;
  script += "GLB = '''\n" + inLines(encoded) + "'''\n\nshow()\n";
  return script;
}

}  // namespace carom
