"""Writes experiments/docs/reference from what ssrlab declares (`ssrlab describe --json`), from scenes/ and from experiments/studies.

usage: python3 experiments/python reference_pages [--check] [PROGRAM]    --check: fail where a page is not what the program declares"""

import argparse
import importlib
import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

from ssrlab.command_lines import CommandLine
from ssrlab.json_files import read_json
from ssrlab.markdown_text import markdown_prose
from ssrlab.mistakes import ResultsError, exit_code
from ssrlab.reference_files import image_files
from ssrlab.reference_markdown import NOTE, OUT, code, contents, linked, page, prose, table
from ssrlab.reference_shaders import shaders
from ssrlab.repository import CONFIGS, ROOT, STUDIES

UP = "../../.."  # to the root, from a page
VALUE = re.compile(r"(.*?)(?::(?:DIR|FILE|\{(.*)\}|\w+ in \[(.+) - (.+)\]))?")  # a name or type, and what the program checks
TYPES = {"UINT": "a whole number", "INT": "a whole number", "FLOAT": "a number", "TEXT": "a text"}
DEFAULT = re.compile(r"(?:; d|\. D)efault: (.*?)(?=\. [A-Z]|$)")  # in a meaning


def option_row(option):
    name, choices, least, most = VALUE.fullmatch(option["value"]).groups()
    value = ", ".join(code(choice) for choice in choices.split(",")) if choices else TYPES.get(name) or (name and code(name.removesuffix("...")))
    value += (f" in [{least}, {most}]" if least else "") + (", one or more" if option["several"] else "")
    said, initial = DEFAULT.search(option["meaning"]), option["default"].strip("[]").replace(",", " ")
    worded = said and (code(said[1]) if re.fullmatch(r"[\d. ]+", said[1]) else markdown_prose(said[1]))
    default = "required" if option["required"] else code(initial) if initial else worded or ""
    meaning = option["meaning"].replace(said[0], "") if said else option["meaning"]
    return [code(option["name"]), value, default, prose(meaning) + "".join(f" Not together with {code(other)}." for other in option["excludes"])]


def script_options(command):
    """Arguments and options of a command that is a module of experiments/python."""
    actions = importlib.import_module(f"ssrlab.{command}.command_line").command_line()._actions
    return [{"name": (one.option_strings or [one.dest])[-1], "value": "" if one.nargs == 0 else one.metavar or one.dest.upper(), "required": one.required,
             "several": False, "default": "", "excludes": [], "meaning": one.help} for one in actions if one.help != argparse.SUPPRESS and one.dest != "help"]


def commands(declared):
    options = {c["name"]: script_options(c["name"]) if c["has_script"] else c["options"] for c in declared["commands"]}
    shared = [one for one in options["run"] if sum(one in all_of for all_of in options.values()) > 6]
    head, many = ["argument or option", "value", "default", "meaning"], "Options of many commands"
    lines = [
        "Every command of `ssrlab` with its arguments and options. `ssrlab COMMAND --help` prints them, too. Exit codes are 0 (done), 1 (a check that",
        "the command makes has failed), 2 (an error in the request), 3 (a fault of the machine) and 130 (stopped by Ctrl-C).", "",
        *contents([(c["name"], prose(c["meaning"])) for c in declared["commands"]] + [(many, "What many commands share.")]), f"## {many}", "", *table(head, map(option_row, shared))]
    for command in declared["commands"]:
        example = f"For example: {code(command['example'])}."
        own, known = ([one for one in options[command["name"]] if (one in shared) == is_shared] for is_shared in (False, True))
        lines += [f"## {command['name']}", "", prose(command["meaning"]), "", example, "", *table(head, map(option_row, own))]
        lines += [f"[{many}](#options-of-many-commands): {', '.join(code(one['name']) for one in known)}.", ""] if known else []
    return page("Commands", *lines)


KEYS = {
    "study": ("A study", "Keys of the whole config."),
    "scene": ("A shot of a scene", "Keys of an entry of `shots` that shows a scene. Arrays of values make a shot of every combination."),
    "capture": ("A shot of a capture", "Keys of an entry of `shots` that shows a [capture](../../bridges/captures/README.md)."),
    "shot": ("Every shot", "Further keys of all entries of `shots`."),
    "technique": ("A technique", "Keys of an entry of `techniques`. [Techniques](techniques/README.md) lists presets and parameters."),
    "external": ("Images of another program", "Keys of an entry of `techniques` for images that [another program](../judge.md) rendered."),
    "table": ("A table", "Keys of an entry of `tables`, for `ssrlab tables`. [Figures and tables](../figures.md) shows examples."),
    "frozen": ("Frozen points", "Keys of an entry of `frozen`, which `ssrlab tradeoff` writes into `frozen.json`."),
    "tune": ("A search", "Keys of `tune`, for `ssrlab tune`. [Find the best parameters](../tune.md) shows examples."),
}


def study_keys(declared):
    lines = [
        "All keys of a study's config, with values, defaults and meanings. A config is a JSON file; `//` comments are allowed, and unknown keys are",
        "errors. `timing.frames` is the key `frames` in the object `timing`.", "",
        "An editor completes and checks configs with this schema:", "", "    build/release/ssrlab describe --schema > study.schema.json", "", *contents(KEYS.values())]
    for kind, (title, about) in KEYS.items():
        lines += [f"## {title}", "", about, ""]
        lines += table(["key", "values", "default", "meaning"],
                       [[code(r["key"]), r["values"], r["default"], r["meaning"] + "." * (r["meaning"][-1] != ".")] for r in declared["keys"][kind]])
    return page("Keys of a config", *lines)


def result_columns(declared):
    lines = [
        "The tables that a run writes into its [results folder](../results_folder.md), with every column. Empty cells are missing values.",
        "`schema.json` in the folder holds the same as a Data Package.", "", *contents((file["path"], prose(file["description"])) for file in declared["columns"])]
    for file in declared["columns"]:
        lines += [f"## {file['path']}", "", prose(file["description"]), ""]
        lines += table(["column", "type", "unit", "meaning"],
                       [[code(f["name"]), f["type"], f.get("unit", ""), prose(f["description"])] for f in file["schema"]["fields"]])
        lines += table(["quantity", "meaning"], [[code(v["name"]), prose(v["meaning"])] for f in file["schema"]["fields"] for v in f.get("values", [])])
    return page("Columns of the results", *lines)


def entry_lines(entry):
    return [f"{prose(entry['title'])} {prose(entry['description'])}", "", f"Source: {markdown_prose(entry['source']).removesuffix('.')}.", ""]


def parameters(entries, prefix=""):
    return table(["parameter", "default", "range", "unit", "meaning", "source"], [
        [code(prefix + p["name"]), code(p["default"]), markdown_prose(p["range"]), p["unit"], prose(p["meaning"]), markdown_prose(p["source"])] for p in entries])


PARTS = {  # what a technique may be composed of: title, word, the parameter that chooses, what the page has
    "tracers": ("Marches (tracers)", "march", "tracer", "The marches that find what a ray meets on the screen, with their parameters."),
    "denoisers": ("Denoisers", "denoiser", "denoiser", "The denoisers that turn the rays of `composed_ssr` into an image, with their parameters."),
}


def parts(kind, declared):
    title, word, parameter, about = PARTS[kind]
    lines = [about, f"A technique chooses one by its parameter `{parameter}`. [A comparison]({UP}/variants/{kind}/README.md) says how they differ.", "",
             *contents((entry["name"], prose(entry["title"])) for entry in declared[kind])]
    for entry in declared[kind]:
        lines += [f"## {entry['name']}", "", *entry_lines(entry)]
        lines += [] if entry.get("fits_webgl2", True) else [f"This {word} does not fit WebGL 2.", ""]
        lines += [f"This {word} needs the densities of rays, which mirror rays lack.", ""] if entry.get("needs_density") else []
        lines += parameters(entry["parameters"], entry["name"] + "." if kind == "denoisers" else "")
    return page(title, *lines)


def listed(value):
    return value if isinstance(value, list) else [value]


def condition(when, named):
    """A `when` of technique.json in words. `named`: the file's conditions."""
    def test(name, value):
        if name in named:
            return ("" if value else "not ") + f"({condition(named[name], named)})"
        limits = value.items() if isinstance(value, dict) else [("", value)]
        return " and ".join(f"{code(name)} is {word.replace('_', ' ')} {code(limit)}".replace("  ", " ") for word, limit in limits)

    return "; or ".join(" and ".join(test(*item) for item in one.items()) for one in listed(when))


def names(entries, kind="image"):
    """Images or buffers that a pass names, each once."""
    return ", ".join(dict.fromkeys(code(entry if isinstance(entry, str) else entry[kind]) for entry in listed(entries)))


def pass_row(one, named):
    runs = condition(one["when"], named) if "when" in one else "always"
    if "clear" in one:
        return ["clear", runs, "", names(one["clear"]), ""]
    marches = [f"march of {names(one['tracers'])}"] if "tracers" in one else []
    drawn = [use for kind in ("depth", "stencil") for use in listed(one.get(kind, [])) if use.get("write")]
    return [code(one.get("stage") or Path(one["shader"]).stem), runs, ", ".join(filter(None, [names(one.get("reads", [])), *marches])),
            names(listed(one.get("writes", [])) + drawn), names(one.get("buffers", []), "buffer")]


def part_lines(entry, kind, declared):
    """That a technique has the parameters of marches or denoisers, and those that have other defaults in it."""
    plain = {("" if kind == "tracers" else part["name"] + ".") + p["name"]: p["default"] for part in declared[kind] for p in part["parameters"]}
    shared = [p for p in entry["parameters"] if p["name"] in plain]
    other = [[code(p["name"]), code(p["default"])] for p in shared if p["default"] != plain[p["name"]]]
    said = f"The technique also has all parameters of [{kind}](../{kind}.md)" + (", some with other defaults:" if other else ".")
    return [said, "", *table(["parameter", "default"], other)] if shared else []


def technique(entry, declared):
    file = read_json(ROOT / f"variants/{entry['name']}/technique.json", has_comments=True)
    readme, named = f"variants/{entry['name']}/README.md", {c["name"]: c["when"] for c in file.get("conditions", [])}
    lines = entry_lines(entry) + ([f"[More about this technique]({UP}/../{readme})", ""] if (ROOT / readme).exists() else [])
    lines += [f"The passes keep within the limits of {entry['limits']}.", ""] if entry["limits"] else []
    lines += ["## Presets", "", *table(["preset", "meaning"], [[code(p["name"]), prose(p["meaning"])] for p in entry["presets"]])] if entry["presets"] else []
    for preset in (p for p in entry["presets"] if p["parameters"]):
        values = ", ".join(f"{name}={json.dumps(value)}" for name, value in preset["parameters"].items())
        lines += [f"Parameters of {code(preset['name'])}:", "", *textwrap.wrap(values, 140, initial_indent="    ", subsequent_indent="    ", break_on_hyphens=False), ""]
    lines += ["## Passes", "", "The passes of a frame in order, with the images that they read and write. A pass also reads the "
              "[G-buffer](../../glossary.md#g-buffer).", "", *table(["pass", "runs if", "reads", "writes", "buffers"], [pass_row(one, named) for one in file["passes"]])]
    lines += ["The passes of the chosen [denoiser](../denoisers.md) follow.", ""] if "denoiser" in file else []
    own = [p for p in entry["parameters"] if not p["part"]]
    lines += ["## Parameters", "", *(parameters(own) or ["This technique has no parameters.", ""])]
    return page(entry["name"], *lines, *(line for kind in PARTS for line in part_lines(entry, kind, declared)))


def metrics(declared):
    described = declared["metrics"]["described"]
    kinds = {"Of one image": declared["metrics"]["images"], "Of a sequence": declared["metrics"]["sequences"]}
    kinds["Of several seeds"] = [name for name in described if name not in sum(kinds.values(), [])]
    lines = [
        "The metrics that compare a technique's image with the truth. x is a value of the technique, r a value of the reference, and d = x - r, each",
        "for one channel of one pixel; t is the frame. [How the numbers are made](../numbers.md) explains noise and intervals.", ""]
    for title, listed in kinds.items():
        lines += [f"## {title}", "", *table(["metric", "formula", "unit", "better", "meaning"], [
            [code(n), code(m["formula"]), "" if m["unit"] == "1" else m["unit"], m["better"].replace("near_zero", "near 0").replace("near_one", "near 1"),
             prose(m["doc"])] for n, m in ((n, described[n]) for n in listed)])]
    return page("Metrics", *lines)


def scenes(declared):
    def row(folder):
        scene, name = read_json(folder / "scene.json", has_comments=True), folder.name
        picture = f"![{name}]({UP}/scenes/pictures/{name}.png)" if (ROOT / f"scenes/pictures/{name}.png").exists() else ""
        about = (folder / "about.txt").read_text(encoding="utf-8").strip()
        return "/" in scene.get("gltf", ""), [code(name), about, ", ".join(code(camera["name"]) for camera in scene["cameras"]), picture]

    rows = [row(file.parent) for file in sorted(ROOT.glob("scenes/*/scene.json"))]
    lines = ["The scenes of ssrlab: what each tests, its cameras, and the path tracer's picture of its first camera, which is the default.",
             f"[Scenes]({UP}/scenes/README.md) says where they come from, and how to add your own.", ""]
    for title, is_third_party in (("Procedural scenes", False), ("Third-party scenes", True)):
        lines += [f"## {title}", "", *table(["scene", "what it tests", "cameras", "first camera"], [cells for third, cells in rows if third == is_third_party])]
    lines += ["## Rooms and streets", ""]
    for name, about in ((family["name"], family["about"]) for family in declared["scene_families"]):
        lines += [f"`{name}:0` to `{name}:999999`: {prose(about)} The cameras are `main` and `path`.", "", f"![{name}s]({UP}/scenes/sheets/{name}s.png)", ""]
    return page("Scenes", *lines)


def studies(_declared):
    groups = read_json(STUDIES / "studies.json")
    configs = {file.stem for file in CONFIGS.glob("*.json") if file.stem != "paper_figures"}  # which is a figures.json
    if wrong := sorted(configs ^ {name for group in groups.values() for name in group}):
        raise ResultsError(f"{STUDIES / 'studies.json'}: '{wrong[0]}' has no question there, or no config")
    lines = ["The included studies, each with the question that it asks and its time on two CPU cores. `ssrlab plan` estimates the time on your machine.", "",
             "    build/release/ssrlab run experiments/studies/configs/quickstart.json --out results/quickstart", "",
             "`ssrlab run quickstart` finds an included study by its name, from any folder.", "",
             "Studies whose names begin with `tune_` are searches for `ssrlab tune`.", ""]
    for title, group in groups.items():
        lines += [f"## {title}", "", *table(["study", "question", "time"], [
            [f"[{name}]({UP}/experiments/studies/configs/{name}.json)", study["question"], study.get("time", "")] for name, study in group.items()])]
    return page("Studies", *lines)


def index(texts):
    """Of each page its title, and what its first sentence says."""
    heads = {name: text.removeprefix(NOTE).strip().split("\n\n")[:2] for name, text in texts.items()}
    rows = [[f"[{title.removeprefix('# ')}]({name})", about.replace("\n", " ").split(". ")[0].rstrip(".") + "."]
            for name, (title, about) in heads.items()]
    return page("Reference", "What the program declares, page by page. `python3 experiments/python reference_pages` writes these pages.", "", *table(["page", "contents"], rows))


def written(program):
    """All pages, by name."""
    declared = json.loads(subprocess.check_output([program, "describe", "--json"], text=True))
    pages = {"commands.md": commands, "study_keys.md": study_keys, "result_columns.md": result_columns, "metrics.md": metrics, "scenes.md": scenes,
             "studies.md": studies, "shaders.md": shaders, "image_files.md": image_files}
    texts = {name: write(declared) for name, write in pages.items()} | {f"{kind}.md": parts(kind, declared) for kind in PARTS}
    texts["techniques/README.md"] = page("Techniques", "Every technique of ssrlab. Each page lists passes, presets and parameters.", "", *table(
        ["technique", "what it is"], [[f"[{e['name']}]({e['name']}.md)", prose(e["title"])] for e in declared["techniques"]]))
    texts |= {"README.md": index(texts)} | {f"techniques/{entry['name']}.md": technique(entry, declared) for entry in declared["techniques"]}
    return {name: linked(text, name) for name, text in texts.items()}


def command_line():
    parser = CommandLine(prog="python3 experiments/python reference_pages", description="The pages of experiments/docs/reference, from what the program declares.")
    parser.add_argument("program", nargs="?", default=ROOT / "build/release/ssrlab", help="default: build/release/ssrlab")
    parser.add_argument("--check", action="store_true", help="write nothing; fail where a page is not what the program declares")
    return parser


def main():
    parser = command_line()
    arguments = parser.parse_args()
    texts, kept = written(arguments.program), {str(file.relative_to(OUT)): file for file in OUT.rglob("*.md")}
    stale = [name for name in {**texts, **kept} if name not in kept or texts.get(name) != kept[name].read_text(encoding="utf-8")]
    if arguments.check and stale:
        raise ResultsError(f"{OUT / stale[0]} is not what the program declares: run `python3 experiments/python reference_pages`")
    for name in stale:
        (OUT / name).parent.mkdir(parents=True, exist_ok=True)
        (OUT / name).write_text(texts[name], encoding="utf-8") if name in texts else kept[name].unlink()


if __name__ == "__main__":
    sys.exit(exit_code(main, "the pages of the reference"))
