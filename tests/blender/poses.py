# SPDX-License-Identifier: MIT
# Where a file's objects are in Blender, as File > Import > glTF shows them:
#   blender --background --factory-startup --python poses.py -- FILE ANSWER STEPS LAST
# imports FILE (.glb, .gltf; a .py is run as `blender --python` runs it), plays it in steps of 1 / STEPS of a frame and
# to frame LAST and writes to ANSWER, as JSON: frames a second, frame range, camera, objects with parent and type, and
# {"poses": {"<object>": [[x, y, z, qw, qx, qy, qz], ...]}}, world poses from frame 0 on.
import json
import runpy
import sys

import bpy
import numpy

if not hasattr(numpy, 'bool'):  # Debian 12's importer asks its numpy 1.24 for a name that is gone since
    numpy.bool = bool
file, answer, steps = sys.argv[sys.argv.index('--') + 1:][:3]
last = int(sys.argv[sys.argv.index('--') + 4])
before = set(bpy.data.objects)
if file.endswith('.py'):
    runpy.run_path(file)
else:
    bpy.ops.import_scene.gltf(filepath=file)
scene = bpy.context.scene
things = [thing for thing in bpy.data.objects if thing not in before]
poses = {thing.name: [] for thing in things}
for k in range(last * int(steps) + 1):
    scene.frame_set(k // int(steps), subframe=k % int(steps) / int(steps))
    for thing in things:
        x, q, _ = thing.matrix_world.decompose()
        poses[thing.name].append([*x, *q])
with open(answer, 'w') as out:
    json.dump({
        'fps': scene.render.fps / scene.render.fps_base,
        'range': [scene.frame_start, scene.frame_end],
        'camera': scene.camera.name if scene.camera in things else None,
        'playback': scene['carom_playback'].to_dict() if 'carom_playback' in scene else None,
        'objects': {thing.name: [thing.type, thing.parent.name if thing.parent else None] for thing in things},
        'poses': poses,
    }, out)
