"""Where files of strangers are read, and where commands write folders, names become paths in one way: no source there joins a folder with
a name that it does not spell out but by path_inside() (core/path_inside.h, experiments/python/ssrlab/text_files.py), so that no file or link
in there leads out of its folder.

A join is `folder / name` in C++ and in Python, os.path.join(folder, name), or a text made of a folder, "/" and a name, where the name is no
literal. Scenes have a rule of their own, file_below(), which tests of scenes hold."""

import ast
import functools
import re
import unittest

from markdown_test import FILES, ROOT

# Of results folders, captures, G-buffers, and what commands write. Configs and command lines are not among these: they are what the user
# asks for.
READERS = (
    "core/gbuffer/",
    "core/gpu/",
    "experiments/bridges/captures/",
    "experiments/bridges/scene_for/",
    "experiments/bridges/shader_export/",
    "experiments/cli/gbuffer_command.cpp",
    "experiments/live/",
    "experiments/python/ssrlab/dataframes.py",
    "experiments/python/ssrlab/figures/",
    "experiments/python/ssrlab/results.py",
    "experiments/python/ssrlab/tables/__main__.py",
    "experiments/report/",
    "experiments/results/",
    "experiments/study/measuring/frames/",
    "experiments/study/shots/",
)
OWN_SOURCES = ("own_files(", "built_files(", "root")  # the folders above ssrlab's own files

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
        is_own = left and left[0].rstrip(")").endswith(OWN_SOURCES)
        if left and right and not is_own and not right[0].isdigit() and LAST_NAME.search(left[0])[1] in paths:
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


class PathJoins(unittest.TestCase):
    def test_readers_join_no_name_but_by_path_inside(self):
        for reader in READERS:
            files = [file for file in sorted(FILES) if file.startswith(reader) and file.endswith((".cpp", ".h", ".py"))]
            self.assertTrue(any("path_inside(" in source(file) for file in files), f"{reader} reads no names")
            for file in files:
                found = map(ast.unparse, python_joins(source(file))) if file.endswith(".py") else cpp_joins(source(file))
                self.assertEqual(list(found), [], file)

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
