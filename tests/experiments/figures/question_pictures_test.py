"""The pictures of the pages of answers show what the kept summaries hold today, are small, and are all shown."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from ssrlab.repository import QUESTIONS, ROOT

draw = [sys.executable, "-B", "-m", "ssrlab.question_pictures"]
MOST_BYTES = 60_000  # a page of 13 pictures loads in a second over a slow line


def check(is_true, what):
    if not is_true:
        sys.exit(f"question_pictures_test: {what}")


def noted(text, what):
    """Of the file's metadata: <dc:source>, the hash of all that it shows, or <dc:creator>."""
    return re.search(rf"<dc:{what}>(.*?)</dc:{what}>", text, re.DOTALL)[1]


def drawn_alike(picture):
    """Without the names of clip paths, which matplotlib makes by hashing their corners: where these differ in a float's last
    bit, as between processors with and without AVX-512, only the names differ."""
    names = {}
    return re.sub(r"\bp[0-9a-f]{10}\b", lambda name: names.setdefault(name[0], f"path {len(names)}"), picture)


def main():
    with tempfile.TemporaryDirectory() as folder:
        drawn = subprocess.run([*draw, "--out", folder], capture_output=True, text=True)
        check(drawn.returncode == 0 and not drawn.stderr, drawn.stderr)
        new = {file.name: file.read_text(encoding="utf-8") for file in Path(folder).glob("*.svg")}
    kept = {file.name: file.read_text(encoding="utf-8") for file in (QUESTIONS / "pictures").glob("*.svg")}
    check(kept.keys() == new.keys(), f"{sorted(kept)} are kept, {sorted(new)} are drawn")
    pages = "".join(file.read_text(encoding="utf-8") for file in [ROOT / "README.md", *QUESTIONS.glob("*.md")])
    again = "python3 experiments/python question_pictures draws it anew"
    for name, picture in kept.items():
        check(noted(picture, "source") == noted(new[name], "source"), f"{name} shows other numbers than the summaries hold; {again}")
        if noted(picture, "creator") == noted(new[name], "creator"):  # of the same version of matplotlib
            check(drawn_alike(picture) == drawn_alike(new[name]), f"{name} is drawn otherwise now; {again}")
        check(len(picture.encode()) <= MOST_BYTES, f"{name} has {len(picture.encode())} bytes")
        check(re.search(rf"\]\((experiments/studies/questions/)?pictures/{name}\)", pages), f"no page shows {name}")
    unknown = subprocess.run([*draw, "absent"], capture_output=True, text=True)
    check(unknown.returncode == 2 and "no picture 'absent'" in unknown.stderr, unknown.stderr)


main()
