"""Run by blender_check.py within Blender: a scene of ours as a .blend, with the cameras of a capture.

usage: blender -b --factory-startup -P blender_scene.py -- GLB CAPTURE OUT.blend

The radiance of its world is (direction + 1) / 2, of Blender's x, y and z as red, green and blue.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

np.bool = bool  # Debian's glTF importer of Blender 3.4 uses the name, which its numpy has no more
glb, capture, out = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 30  # of our scenes: the importer turns times into frames with it
bpy.ops.import_scene.gltf(filepath=glb)
scene.world = bpy.data.worlds.new("world")
scene.world.use_nodes = True
tree = scene.world.node_tree
half = tree.nodes.new("ShaderNodeVectorMath")
half.operation = "MULTIPLY_ADD"
half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], half.inputs[0])
tree.links.new(half.outputs[0], tree.nodes["Background"].inputs["Color"])

data = bpy.data.cameras.new("camera")
scene.camera = bpy.data.objects.new("camera", data)
scene.collection.objects.link(scene.camera)
blender_from_ours = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
for file in sorted(Path(capture).glob("frame_*/camera.json")):
    camera = json.loads(file.read_text())
    for frame, key in ((camera["frame"] - 1, "previous_view_from_world"), (camera["frame"], "view_from_world")):
        scene.camera.matrix_world = Matrix((blender_from_ours @ np.linalg.inv(camera[key])).tolist())
        scene.camera.keyframe_insert("location", frame=frame)
        scene.camera.keyframe_insert("rotation_euler", frame=frame)
    data.sensor_fit = "HORIZONTAL"
    data.lens = data.sensor_width / 2 * camera["clip_from_view"][0][0]
    data.clip_start, data.clip_end = camera["near"], camera["far"]
bpy.ops.wm.save_as_mainfile(filepath=out)
