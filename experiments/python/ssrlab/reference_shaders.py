"""The page of what shaders of techniques read and call, from what ssrlab declares and from the shared GLSL (reference_pages.py)."""

import re

from ssrlab.mistakes import ResultsError
from ssrlab.reference_markdown import code, contents, page, prose, table
from ssrlab.repository import ROOT

SHARED = {  # include, as a shader writes it, and what the file is for
    "core/shaders/view.glsl": "Positions on the screen, in view space and in world space.",
    "common/mirror_ray.glsl": "Position, normals and mirror ray of a pixel.",
    "common/image_space.glsl": "Texture coordinates under jitter, and comparisons for both directions of depth.",
    "tracers/trace.glsl": 'What `#include "tracer"` takes and gives. This include also declares `TraceEnd trace(TraceRay ray)`, the chosen march.',
    "tracers/outcome.h": "How rays end.",
    "common/motion.glsl": "Motion of a pixel.",
    "core/shared/brdf.h": "The BRDF of glTF 2.0. Directions are in a local frame, with the normal along +z; `o` points to the viewer, `i` to the light.",
    "common/ggx_lobe.h": "Samples of the specular lobe without its tail, and their density, in the same local frame.",
    "common/visible_normal_disk.glsl": "Another mapping of random numbers to visible normals.",
    "common/halton.h": "Random numbers and Halton points from whole numbers.",
    "core/shaders/gbuffer/environment.glsl": 'Radiance of the environment. The pass needs `"environment": true` in technique.json.',
    "core/shaders/gbuffer/dielectric_f0.glsl": "Reflectance of dielectrics.",
    "core/shaders/gbuffer/split_sum.glsl": "Albedo of the specular lobe. The pass needs `split_sum` in `reads`.",
    "common/screen_probe/lookup.glsl": "What the screen says about directions that the image does not show. The passes of `variants/common/screen_probe` make its images.",
    "common/luminance.glsl": "Luminance.",
    "common/ycocg.glsl": "Luma and colour differences.",
    "common/half.glsl": "Numbers for images of 16 bits.",
}
# Of core/shared/brdf.h, whose text is part of the key of every cached reference: a comment there would make all references stale.
WITHOUT_COMMENT = {"ggx_alpha": "GGX width of a perceptual roughness: its square, but at least `min_ggx_alpha`"}
FUNCTION = re.compile(r"(?m)^(?:SHARED )?(\w+) (\w+)\(([^;{)]*)\)\s*\{")
CONSTANT = re.compile(r"(?m)^const \w+ ([^;]+);(?: *//+<? ?(.*))?$")


def source_of(include):
    return ROOT / include if include.startswith("core/") else ROOT / "variants" / include


def comment_before(text, at):
    """The comment of the lines right above, as one line."""
    lines = []
    for line in reversed(text[:at].splitlines()):
        if not line.startswith("//"):
            break
        lines.insert(0, line.lstrip("/ "))
    return " ".join(lines)


def first_sentence(text):
    return re.split(r"(?<=[\w)\]])\. (?=[A-Z])", text)[0]


def file_lines(include, about):
    text = source_of(include).read_text(encoding="utf-8")
    functions = []
    for found in FUNCTION.finditer(text):
        meaning = first_sentence(comment_before(text, found.start())) or WITHOUT_COMMENT.get(found[2])
        if not meaning:
            raise ResultsError(f"{source_of(include)}: the function {found[2]}() has no comment right above")
        functions.append([code(f"{found[1]} {found[2]}({' '.join(found[3].split())})"), prose(meaning)])
    constants = [[code(found[1]), prose(found[2] or first_sentence(comment_before(text, found.start())))] for found in CONSTANT.finditer(text)]
    images = [name for names in re.findall(r"(?m)^uniform \w+ ([\w, ]+);", text) for name in names.split(", ")]
    structs = re.findall(r"(?ms)^struct \w+ \{.*?^\};", text)
    lines = [f"## {include}", "", about, ""]
    lines += [f"The file declares {', '.join(map(code, images))}. Your shader must not declare the same names.", ""] if images else []
    lines += ["```glsl", *"\n\n".join(structs).splitlines(), "```", ""] if structs else []
    return lines + table(["constant", "meaning"], constants) + table(["function", "meaning"], functions)


def shaders(declared):
    images = declared["shader_images"]
    camera = re.search(r"(?ms)^struct CameraData \{.*?^\};", (ROOT / "core/shared/camera.h").read_text(encoding="utf-8"))[0]
    titles = {"The G-buffer": "Images that every pass can read.", "Images for `reads`": "Images that a pass must list.",
              "The block camera": "Matrices, sizes and numbers of the frame."} | SHARED
    lines = [
        "The images that a shader of a technique can read, the block `camera`, and the functions that techniques share.",
        "[Write a technique](../write_a_technique.md#how-do-i-write-a-shader) has a whole shader that uses them.", "",
        *contents(titles.items()),
        "## The G-buffer", "",
        "A shader declares an image under its name, for example `uniform sampler2D depth;`, and `material_id` as `usampler2D`. All images have the size",
        "of the screen, and row 0 is the top. Radiance is linear, with the primaries of Rec. 709. `packed` is the format with the study key",
        '`"gbuffer_formats": "packed"`. In [captures](../../bridges/captures/README.md), the engine wrote the values where there is no surface.', "",
        *table(["image", "format", "packed", "channels", "where there is no surface"],
               [[code(i["name"]), i["format"], i["packed"] if i["packed"] != i["format"] else "the same", prose(i["meaning"]), prose(i["background"])]
                for i in images["gbuffer"]]),
        "## Images for `reads`", "",
        *table(["image", "format", "contents"], [[code(i["name"]), i["format"], prose(i["meaning"])] for i in images["provided"]]),
        "## The block camera", "",
        "Every shader has `camera`, for example `camera.extent.xy`. World space is right-handed with +Y up, in metres. View space looks along -z,",
        "with y up.", "",
        "```glsl", *camera.splitlines(), "```", "",
        "Every shader also has the constants `scene_is_still`, `scene_has_environment` and `scene_has_matte`. They are false, true and true, unless the pass",
        "sets them by its [key `scene_constants`](../../../variants/README.md#passes).", "",
        *(line for item in SHARED.items() for line in file_lines(*item))]
    return page("What shaders read and call", *lines)
