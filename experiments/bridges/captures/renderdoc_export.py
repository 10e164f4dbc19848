#!/usr/bin/python3
"""Exports textures of a RenderDoc capture as a capture for ssrlab (README.md beside this file).

usage: renderdoc_export.py FILE.rdc --list
       renderdoc_export.py FILE.rdc MAPPING.json --out DIR [--frame N]

Needs RenderDoc's Python module (Debian: python3-renderdoc) and a device that can replay the capture.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import renderdoc as rd

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "python")]
from capture_files import CHANNELS, frame_folder, write_environment, write_frame  # noqa: E402
from ssrlab.json_files import read_json  # noqa: E402
from ssrlab.mistakes import ResultsError, exit_code, say  # noqa: E402
from renderdoc_layers import camera_value, decoded, from_the_top, layer_of  # noqa: E402
from ssrlab.text_files import path_inside  # noqa: E402

KINDS = {"Float": "float", "UNorm": "unorm", "UNormSRGB": "srgb", "SNorm": "snorm", "UInt": "uint", "Depth": "depth"}
LAYOUTS = {"R10G10B10A2": "r10g10b10a2", "R11G11B10": "r11g11b10", "D24S8": "d24s8", "D32S8": "d32s8"}


class Replay:
    """An open capture."""

    def __init__(self, file):
        rd.InitialiseReplay(rd.GlobalEnvironment(), [])
        self.file = rd.OpenCaptureFile()
        result = self.file.OpenFile(str(file), "", None)
        if result != rd.ResultCode.Succeeded:
            raise ResultsError(f"{file}: {result}")
        result, self.controller = self.file.OpenCapture(rd.ReplayOptions(), None)
        if result != rd.ResultCode.Succeeded:
            raise ResultsError(f"{file} cannot be replayed here: {result}")
        self.names = {r.resourceId: r.name for r in self.controller.GetResources()}
        self.textures = {t.resourceId: t for t in self.controller.GetTextures()}
        self.actions = []
        self._collect(self.controller.GetRootActions(), "")

    def close(self):
        self.controller.Shutdown()
        self.file.Shutdown()
        rd.ShutdownReplay()

    def _collect(self, actions, path):
        structured = self.controller.GetStructuredFile()
        for action in actions:
            name = f"{path}{action.GetName(structured)}"
            self.actions.append((action, name))
            self._collect(action.children, name + " / ")

    def outputs(self, action):
        """What an action writes: (output, texture); its number, or "depth"."""
        found = [(i, o) for i, o in enumerate(action.outputs) if o != rd.ResourceId.Null()]
        return found + ([("depth", action.depthOut)] if action.depthOut != rd.ResourceId.Null() else [])

    def action(self, event):
        """By its number, or the last whose name contains a text; without either the last of all."""
        found = [a for a, name in self.actions
                 if event is None or (a.eventId == event if isinstance(event, int) else event in name)]  # fmt: skip
        if not found:
            raise ResultsError(f"no event is called {event!r}; --list shows all")
        return found[-1]

    def texels(self, entry):
        action = self.action(entry.get("event"))
        if "output" in entry:
            outputs = dict(self.outputs(action))
            if entry["output"] not in outputs:
                raise ResultsError(f"event {action.eventId} has no output {entry['output']!r}, only {list(outputs)}")
            texture = outputs[entry["output"]]
        else:
            named = [i for i in self.textures if entry["texture"] in (self.names[i], str(int(i)))]
            if len(named) != 1:
                raise ResultsError(f"{len(named)} textures are called '{entry['texture']}'; --list shows all")
            texture = named[0]
        self.controller.SetFrameEvent(action.eventId, True)
        about = self.textures[texture]
        data = self.controller.GetTextureData(texture, rd.Subresource(entry.get("mip", 0), entry.get("slice", 0), 0))
        texels = decoded(data, (about.width, about.height), texture_format(about.format))
        return from_the_top(texels, self.controller.GetAPIProperties().pipelineType.name, self._origin_is_lower_left())

    def _origin_is_lower_left(self):
        """Of OpenGL's clip space at the event; of other programs nothing is said."""
        state = self.controller.GetGLPipelineState()
        return state is None or state.vertexProcessing.clipOriginLowerLeft

    def variable(self, entry):
        """A float variable of a shader's constant buffers ("camera.view" of a member), of shape (rows, columns)."""
        action = self.action(entry.get("event"))
        stage = rd.ShaderStage.__members__[entry.get("stage", "vertex").title()]
        self.controller.SetFrameEvent(action.eventId, True)
        state = self.controller.GetPipelineState()
        shader = state.GetShaderReflection(stage)
        if shader is None:
            raise ResultsError(f"event {action.eventId} has no {entry.get('stage', 'vertex')} shader")
        is_compute = stage == rd.ShaderStage.Compute
        pipeline = state.GetComputePipelineObject() if is_compute else state.GetGraphicsPipelineObject()
        found = {}
        for i, block in enumerate(shader.constantBlocks):
            buffer = state.GetConstantBuffer(stage, i, 0)
            for value in self.controller.GetCBufferVariableContents(
                pipeline, shader.resourceId, stage, state.GetShaderEntryPoint(stage), i, buffer.resourceId,
                buffer.byteOffset, buffer.byteSize):  # fmt: skip
                _collect_variables(value, "", found)
        if entry["variable"] not in found:
            raise ResultsError(f"event {action.eventId} has no variable '{entry['variable']}', only {sorted(found)}")
        return found[entry["variable"]]


def _collect_variables(value, path, found):
    for member in value.members:
        _collect_variables(member, f"{path}{value.name}.", found)
    if not value.members and value.rows:
        count = value.rows * value.columns
        found[path + value.name] = np.array(list(value.value.f32v)[:count], float).reshape(value.rows, value.columns)


def texture_format(texel):
    if texel.type == rd.ResourceFormatType.Regular:
        kind = texel.compType.name
        return ("bgra" if texel.BGRAOrder() else "regular", KINDS.get(kind, kind), texel.compByteWidth, texel.compCount)
    name = texel.type.name
    return (LAYOUTS.get(name, name), "", 0, 0)


def list_contents(replay):
    for action, name in replay.actions:
        outputs = replay.outputs(action)
        if outputs:
            text = ", ".join(f"{output}: {replay.names[texture]}" for output, texture in outputs)
            say(f"event {action.eventId:6} {name}   [{text}]")
    for texture, about in replay.textures.items():
        say(f"texture {replay.names[texture]!r} ({int(texture)}): {about.width}x{about.height} {about.format.Name()}")


LAYER = {"event?": (int, str), "output?": (int, str), "texture?": str, "mip?": int, "slice?": int, "channels?": str, "decode?": [(str, float)]}
MAPPING = {"camera": (str, dict), "layers": {"depth": LAYER, "*": LAYER}, "environment?": list}


def read_mapping(file):
    mapping = read_json(file, MAPPING)
    unknown = [key for key in mapping if key not in ("camera", "layers", "environment")]
    unknown += [f"layers.{name}" for name in mapping.get("layers", {}) if name not in CHANNELS]
    unknown += [f"layers.{name}.{key}" for name, entry in mapping.get("layers", {}).items() for key in entry
                if key not in ("event", "output", "texture", "mip", "slice", "channels", "decode")]  # fmt: skip
    if unknown:
        raise ResultsError(f"{file}: unknown keys {unknown}")
    if isinstance(mapping["camera"], str):
        mapping["camera"] = read_json(path_inside(str(Path(file).parent), mapping["camera"], f"{file}: 'camera'"))
    return mapping


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("capture", type=Path)
    parser.add_argument("mapping", type=Path, nargs="?")
    parser.add_argument("--list", action="store_true", help="events with their outputs, and textures")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--frame", type=int, help="writes into DIR/frame_<N>; default: into DIR")
    arguments = parser.parse_args()
    if not arguments.list and not (arguments.mapping and arguments.out):
        parser.error("name a mapping and --out, or ask for --list")
    replay = Replay(arguments.capture)
    try:
        if arguments.list:
            list_contents(replay)
            return
        mapping = read_mapping(arguments.mapping)
        camera = mapping["camera"]
        texels = {name: replay.texels(entry) for name, entry in mapping["layers"].items()}
        height, width = texels["depth"].shape[:2]
        camera = {"extent": [width, height], **camera}
        for name, entry in camera.items():
            if isinstance(entry, dict):
                camera[name] = camera_value(name, replay.variable(entry), entry)
        layers = {n: layer_of(n, t, mapping["layers"][n], camera) for n, t in texels.items()}
        folder = arguments.out
        if "environment" in mapping:
            write_environment(folder, np.asarray(mapping["environment"]))
        write_frame(folder if arguments.frame is None else frame_folder(folder, arguments.frame), layers, camera)
    finally:
        replay.close()


if __name__ == "__main__":
    sys.exit(exit_code(main, "the capture"))
