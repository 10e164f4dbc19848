"""Names become paths in one way: no source joins a folder with a name that it does not spell out but by path_inside() (core/path_inside.h,
experiments/python/ssrlab/text_files.py), so that no file of a stranger leads out of its folder.

A join is `folder / name` in C++ and in Python, os.path.join(folder, name), or a text made of a folder, "/" and a name, where the name is no
literal. ALLOWED lists those whose names are not a stranger's; one that is no longer there is a mistake, too."""

import ast
import functools
import re
import unittest

from markdown_test import FILES, ROOT

PROGRAM = "the program spells it out, or makes it"
REQUEST = "a config, or the command line, is what the user asks for, and may name any folder"
LISTED = "of the user's own folder, which was listed"
CHECKED = "of a scene.json that experiments/bridges/engines/shared/scene_folder.js has let through"
SCENE = "scenes have a rule of their own: file_below() (core/reading_limits.h)"

ALLOWED = {
    ("core/path_inside.cpp", "path /= part"): "the one way",
    ("variants/registry.cpp", "base / text"): REQUEST,
    ("variants/passes/technique_files.cpp", "fs::path(SSRLAB_SOURCE_DIR) / folder"): PROGRAM,
    ("core/reading_limits.cpp", "folder / name"): SCENE,
    ("core/scene/gltf/gltf_uri.cpp", "folder / name"): SCENE,
    ("core/scene/load_scene.cpp", "folder / name"): SCENE,
    ("core/scene/scene_family.cpp", "beside / scene"): PROGRAM,
    ("core/scene/scene_family.cpp", "folder / scene"): PROGRAM,
    ("core/scene/scene_family.cpp", 'folder / (scene.string() + ".partial-" + std::to_string(getpid()))'): PROGRAM,
    ("core/scene/scene_file.cpp", "folder / name"): SCENE,
    ("experiments/cli/list_command.cpp", "folder / name"): SCENE,
    ("experiments/cli/scene_for_command.cpp", "options.out / view"): "printed",
    ("experiments/cli/gbuffer_command.cpp", "out / name"): PROGRAM,
    ("experiments/cli/config_of_study.cpp", 'std::filesystem::path("results") / config.stem()'): REQUEST,
    ("experiments/study/config/extends.cpp", 'file.parent_path() / object.text("extends")'): REQUEST,
    ("experiments/study/config/extends.cpp", "from / path"): REQUEST,
    ("experiments/study/config/shots/read_shots.cpp", 'folder / shot.get<std::string>("gbuffer")'): REQUEST,
    ("experiments/study/config/shots/read_shots.cpp", 'folder / shot.get<std::string>("reference")'): REQUEST,
    ("experiments/study/config/points/read_techniques.cpp", 'folder / object.get<std::string>("external")'): REQUEST,
    ("experiments/study/measuring/times/clock_proofs.cpp", 'folder / ("clock-" + hash.hex() + ".json")'): PROGRAM,
    ("experiments/bridges/inspect/describe_frames.cpp", 'view.folder / ("f" + std::to_string(*view.frames.begin()) + ".s0.exr")'): PROGRAM,
    ("experiments/study/plan/estimate.cpp", 'folder_ / ("cache" + std::to_string(size))'): PROGRAM,
    ("experiments/study/plan/estimate.cpp", 'fs::temp_directory_path() / ("ssrlab-plan-" + std::to_string(getpid()))'): PROGRAM,
    ("experiments/bridges/scene_for/raw_files.cpp", "folder_ / name"): PROGRAM,
    ("experiments/study/folder_owner.cpp", 'file.parent_path() / (".study.json-" + std::to_string(getpid()))'): PROGRAM,
    ("experiments/results/cells/host_info.cpp", "fs::path(SSRLAB_SOURCE_DIR) / folder"): PROGRAM,
    ("experiments/results/cells/source_code.cpp", "root / folder"): PROGRAM,
    ("groundtruth/reference/reference_cache.cpp", 'folder / (key + ".exr")'): PROGRAM,
    ("groundtruth/reference/reference_cache.cpp", 'folder / (key + ".lock")'): PROGRAM,
    ("groundtruth/reference/reference_cache.cpp", 'folder / (key + ".partial.exr")'): PROGRAM,
    ("experiments/cli/watch_command.cpp", 'std::filesystem::path("results/watch") / folder.filename()'): REQUEST,
    ("experiments/live/watch/kept_versions.cpp", "out_ / watch_folder::kept_numbers"): PROGRAM,
    ("experiments/live/watch/kept_versions.cpp", "out_ / watch_folder::now"): PROGRAM,
    ("experiments/live/watch/kept_versions.cpp", "out_ / watch_folder::technique"): PROGRAM,
    ("experiments/live/watch/kept_versions.cpp", "out_ / watch_folder::versions"): PROGRAM,
    ("experiments/live/watch/watch_session.cpp", "folder / file"): LISTED,
    ("experiments/live/watch/watched_files.cpp", "folder / file"): LISTED,
    ("experiments/live/watch/watched_files.cpp", "fs::path(SSRLAB_SOURCE_DIR) / root"): PROGRAM,
    ("experiments/live/watch/watched_files.cpp", "made / file"): LISTED,
    ("experiments/bridges/captures/blender_export.py", "arguments.out / f'frame_{frame:04}'"): PROGRAM,
    ("experiments/bridges/captures/renderdoc_export.py", "folder / f'frame_{arguments.frame:04}'"): PROGRAM,
    ("experiments/bridges/engines/blender_eevee/render.py", "folder / background['image']"): CHECKED,
    ("experiments/bridges/engines/blender_eevee/render.py", "folder / frame['light']"): CHECKED,
    ("experiments/bridges/engines/blender_eevee/render.py", "out / f'{name}.f32'"): CHECKED,
    ("experiments/bridges/engines/render_study.py", "os.path.join(os.path.dirname(file), v['external'])"): REQUEST,
    ("experiments/python/ssrlab/findings_pictures.py", "folder / f'{name}.svg'"): PROGRAM,
    ("experiments/python/ssrlab/judge.py", "os.path.join(arguments.out, f'pair_{number}.png')"): PROGRAM,
    ("experiments/python/ssrlab/tables/documents.py", "os.path.join(folder, name)"): LISTED,
    ("experiments/python/ssrlab/tables/documents.py", "os.path.join(summaries, name)"): LISTED,
    ("experiments/python/ssrlab/text_files.py", "os.path.join(path, part)"): "the one way",
    ("experiments/python/ssrlab/tune/program.py", "os.path.join(folder, words[0])"): REQUEST,
    ("experiments/python/ssrlab/tune/studies.py", "os.path.join(folder, shot[k])"): REQUEST,
    ("scenes/generate.py", "arguments.out / name"): REQUEST,
    ("scenes/generate.py", "arguments.out / name.replace(':', '_')"): PROGRAM,
    ("scenes/generate.py", "folder / name"): PROGRAM,
    ("scenes/generator/families/shell.py", "wanted / len(outer) / (head - sill)"): "a number of windows",
    ("scenes/pictures.py", "out / f'{family}s.png'"): PROGRAM,
    ("scenes/pictures.py", "out / f'{scene}.png'"): LISTED,
}

PARENTHESES = r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
PART = rf"(?:::)?\w+(?:::\w+)*(?:<[\w:]+>)?(?:{PARENTHESES}|\[[^\]]*\])?"
OPERAND = rf"(?:{PART}(?:\.|->))*{PART}"
LEFT, RIGHT = re.compile(rf"(?:{OPERAND})$"), re.compile(rf"{PARENTHESES}|{OPERAND}")
LAST_NAME = re.compile(rf"(\w+)(?:<[\w:]+>)?(?:{PARENTHESES}|\[[^\]]*\])?$")
DECLARED = re.compile(r"\b(?:fs|std::filesystem)::path(?:\s+|\s*&\s*)(?:const\s+)?([a-z]\w*)")


@functools.cache
def declared_paths(file):
    return DECLARED.findall(source(file))


@functools.cache
def source(file):
    return (ROOT / file).read_text(encoding="utf-8")


def without(text, pattern):
    """Blanks in its place, so that all else stays where it is."""
    return re.sub(pattern, lambda m: m[0][0] + " " * (len(m[0]) - 2) + m[0][-1], text)


def cpp_paths(text):
    """The names that are declared as paths in a source and in the headers that it includes."""
    included = (declared_paths(name) for name in re.findall(r'#include "([^"]+)"', text) if name in FILES)
    return set(DECLARED.findall(text)).union(*included) | {"path", "parent_path", "temp_directory_path"}


def cpp_joins(text):
    paths = cpp_paths(text)
    code = without(without(text, r'"(?:[^"\\\n]|\\.)*"'), r"//[^\n]*")
    for sign in re.finditer(r"\s/=?\s", code):
        left, right = LEFT.search(code, max(sign.start() - 200, 0), sign.start()), RIGHT.match(code, sign.end())
        if left and right and not right[0].isdigit() and LAST_NAME.search(left[0])[1] in paths:
            yield text[left.start() : right.end()]
    yield from re.findall(r'[\w.>\-]+\.(?:c_str|string)\(\) \+ "/', text)


def is_literal(node):
    """A text, or a name in capitals, which a source gives a text."""
    return isinstance(node, ast.Constant) or ast.unparse(node).split(".")[-1].isupper() or ast.unparse(node) == "os.pardir"


def python_joins(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "os.path.join" and not all(map(is_literal, node.args[1:])):
            yield node
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div) and not is_literal(node.right) and re.search(r"(?i)folder|path|dir|out|root|parent", ast.unparse(node.left)):
            yield node
        if isinstance(node, ast.Call) and re.fullmatch(r"open|Path|os\.\w+|shutil\.\w+", ast.unparse(node.func)):
            yield from (a for a in node.args if isinstance(a, (ast.JoinedStr, ast.BinOp)) and re.search(r"\}/[^{]*\{|/['\"] \+", ast.unparse(a)))


def joins():
    """(file, join), each once."""
    found = set()
    for file in sorted(FILES):
        if file.startswith("tests/") or "/vendor/" in file:
            continue
        if file.endswith((".cpp", ".h")):
            found |= {(file, re.sub(r"\s+", " ", join)) for join in cpp_joins(source(file))}
        if file.endswith(".py"):
            found |= {(file, ast.unparse(join)) for join in python_joins(source(file))}
    return found


class PathJoins(unittest.TestCase):
    def test_no_name_of_a_file_is_joined_but_by_path_inside(self):
        found = joins()
        self.assertEqual(sorted(found - set(ALLOWED)), [])
        self.assertEqual(sorted(set(ALLOWED) - found), [], "these are no longer there")

    def test_joins_are_found(self):
        for text in ("read(results / file);", "x = settings.out / image.at(kind);", "p /= name;", "a.parent_path() / (n + \".x\")", "a.string() + \"/\" + n"):
            self.assertEqual(len(list(cpp_joins("fs::path results; fs::path out; fs::path p; " + text))), 1, text)
        for text in ('results / "file.csv"', "count / size", "half / 2", "// results / file"):
            self.assertEqual(list(cpp_joins("fs::path results; " + text)), [], text)
        for text in ("os.path.join(a, name)", "folder / name", 'open(f"{a}/{b}.md")', 'os.remove(a + "/" + b)', 'os.path.join(a, x["name"] + ".md")'):
            self.assertEqual(len(list(python_joins(text))), 1, text)
        for text in ('os.path.join(a, "b.csv")', "error / base", 'print(f"{a}/{b}")', 'folder / "b"', "os.path.join(a, NAME)"):
            self.assertEqual(list(python_joins(text)), [], text)


if __name__ == "__main__":
    unittest.main()
