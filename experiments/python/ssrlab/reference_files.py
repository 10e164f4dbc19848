"""The page of the layers of image files, from what ssrlab declares (reference_pages.py)."""

from ssrlab.reference_markdown import code, contents, page, prose, table

TITLES = {
    "gbuffer.exr": "A G-buffer that ssrlab reads as a [capture](../../bridges/captures/README.md), and that `ssrlab gbuffer` writes.",
    "camera.json": "The camera beside `gbuffer.exr`.",
    "reference.exr": "The truth that `ssrlab reference` writes.",
    "Images of a results folder": "Images that `ssrlab run` writes.",
}


def layer_table(layers, *more):
    return table(["layer", "channels", *more, "meaning"], [
        [code(one["name"]), " ".join(one["channels"]), *(one[key] for key in more), prose(one["meaning"])] for one in layers])


def image_files(declared):
    capture, reference = declared["capture_files"], declared["image_layers"]
    gbuffer = [one | {"if absent": prose(one["if_absent"]) or "Required."} for one in capture["layers"]]
    lines = [
        "The layers of the OpenEXR files that ssrlab reads and writes. A channel's name is `LAYER.CHANNEL`, for example `normal.X`. The first row is the top.",
        "Radiance is linear, with the primaries of Rec. 709. [How to read the files in Python](../results_folder.md#how-do-i-read-the-images-in-python).", "",
        *contents(TITLES.items()),
        "## gbuffer.exr", "", TITLES["gbuffer.exr"], "",
        "World space is right-handed with +Y up, in metres. `type` is what ssrlab writes. ssrlab also reads half floats, and `R G B` as names of `X Y Z`.",
        "Other layers are listed and ignored.", "",
        *layer_table(gbuffer, "type", "if absent"),
        "Where there is no surface, ssrlab writes 0 into all layers but `depth`, `lit` and `motion`, and roughness 1.", "",
        "## camera.json", "", TITLES["camera.json"] + " A matrix multiplies column vectors: the fourth column of `view_from_world` is the translation.", "",
        *table(["key", "values", "default", "meaning"],
               [[code(key["name"]), key["values"], key["default"] or "required", prose(key["meaning"])] for key in capture["camera"]]),
        "## reference.exr", "", TITLES["reference.exr"] + " All layers are float, but `sample_count`, `lobe_samples` and `material_id` are uint.", "",
        "The following layers have noise. The file also has `NAME.a` and `NAME.b`, each from one half of the samples, and `NAME.variance`, the variance of `NAME`.", "",
        *layer_table(reference["estimates"]),
        "The other layers:", "", *layer_table(reference["others"]),
        "With `--ladder`, the file has two more layers with noise, for which the same holds:", "", *layer_table(reference["rungs"]),
        "And these:", "", *layer_table(reference["of_rungs"]),
        "## Images of a results folder", "",
        "The channels of these files are `R`, `G` and `B`, without a layer: half floats, or float for errors. `images` in `manifest.json` lists each file with",
        "`shot`, `technique`, `point`, `frame`, `seed`, `kind` and `target`.", "",
        *table(["kind", "R G B", "contents"], [[code(one["name"]), one["channels"], prose(one["meaning"])] for one in reference["results"]])]
    return page("Layers of image files", *lines)
