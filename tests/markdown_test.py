"""Links between the Markdown files, to their headings, and the paths that they name, lead somewhere; pictures are of today."""
import hashlib
import os
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def all_files():
    """Of the repository: without what .gitignore names, and git's own."""
    for folder, folders, names in os.walk(ROOT):
        is_root = folder == str(ROOT)
        ignored = r"\.git|__pycache__" + (r"|build(-.*)?|results" if is_root else "")
        folders[:] = [name for name in folders if not re.fullmatch(ignored, name)]
        yield from (os.path.relpath(os.path.join(folder, name), ROOT) for name in names)


FILES = set(all_files())
FOLDERS = {str(parent) for file in FILES for parent in Path(file).parents}
NAME = r"(?:README|[a-z0-9_]+)\.(?:cpp|h|py|js|md|sh|csv|json|glsl|comp|frag|cmake)"
DOCUMENTS = sorted(file for file in FILES if file.endswith(".md"))


def without_code(text, keeps_inline=False):
    """The text without its blocks of code, and without code in lines of prose."""
    text = re.sub(r"(?ms)^```.*?^```", "", text)
    text = re.sub(r"(?m)(?<=\n\n)(?: {4}.*\n|\n)+", "\n", text)
    return text if keeps_inline else re.sub(r"`[^`\n]+`", "code", text)


def anchors(document):
    """Those of `<a id="name"></a>`, and the names that its headings have on the repository's host: small letters, '-' for
    spaces, -1 after the second."""
    text = without_code((ROOT / document).read_text(encoding="utf-8"), True)
    found = re.findall(r'<a id="([\w-]+)"></a>', text)
    for title in re.findall(r"(?m)^#{1,6} (.+)$", text):
        name = re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")
        same = sum(re.fullmatch(re.escape(name) + r"(-\d+)?", other) is not None for other in found)
        found.append(f"{name}-{same}" if same else name)
    return found


class Markdown(unittest.TestCase):
    def test_links_and_their_anchors_lead_somewhere(self):
        count = 0
        for document in DOCUMENTS:
            text = without_code((ROOT / document).read_text(encoding="utf-8"))
            for link in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'<img src="([^"]+)"', text):
                if re.match(r"https?:|mailto:", link):
                    continue
                count += 1
                path, _, anchor = link.partition("#")
                target = os.path.normpath(os.path.join(os.path.dirname(document), path)) if path else document
                self.assertTrue(target in FILES or target in FOLDERS, f"{document}: {link}")
                if anchor:
                    self.assertIn(anchor, anchors(target), f"{document}: {link}")
        self.assertGreater(count, 50)

    def test_no_line_begins_with_a_number(self):
        """Markdown takes a line that begins with a comment for HTML, and shows its code and links as they are written."""
        for document in DOCUMENTS:
            for line in (ROOT / document).read_text(encoding="utf-8").splitlines():
                self.assertIsNone(re.match(r"\s*([-*>]|\d+\.)?\s*<!--=", line), f"{document}: {line}")

    def test_scripts_of_findings_are_listed_and_can_be_run(self):
        """They need packages from the network: whoever writes one runs it."""
        scripts = sorted(file.removeprefix("findings/") for file in FILES if re.fullmatch(r"findings/\w+\.sh", file))
        listed = re.findall(r"(?m)^\| `(\w+\.sh)` \|", (ROOT / "findings/README.md").read_text(encoding="utf-8"))
        self.assertEqual(sorted(listed), scripts)
        for script in scripts:
            self.assertTrue(os.access(ROOT / "findings" / script, os.X_OK), script)

    def test_paths_that_they_name_exist(self):
        """From the root, or from the document's own folder: `core/files.h`, `configs/best.json`."""
        count = 0
        for document in DOCUMENTS:
            text = (ROOT / document).read_text(encoding="utf-8")
            for path in re.findall(rf"(?<![\w./*-])((?:[\w-]+/)+{NAME})\b", text):
                first = path.split("/")[0]
                near = os.path.normpath(os.path.join(os.path.dirname(document), path))
                if first not in FOLDERS and os.path.dirname(near) not in FOLDERS:
                    continue  # of a results folder, or another project's
                count += 1
                self.assertTrue({path, near} & FILES, f"{document}: {path}")
        self.assertGreater(count, 100)

    def test_pictures_were_drawn_from_what_is_committed(self):
        """Else draw them anew: python3 experiments/python readme_pictures."""
        made_from = {
            "readme/report.png": "configs/quickstart.json",
            "readme/comparison.png": "configs/readme.json",
            "readme/simple_ssr.png": "configs/technique_pictures.json",
            "readme/four_mode_ssr.png": "configs/technique_pictures.json",
            "readme/tracers.png": "configs/technique_pictures.json",
            "questions/pictures/flight_helmet.png": "questions/pictures/third_party.crops.json",
            "questions/pictures/room_10103.png": "questions/pictures/composed.crops.json",
            "questions/pictures/room_10105.png": "questions/pictures/composed.crops.json",
            "questions/pictures/room_30102.png": "questions/pictures/rooms_at_gpu_time.crops.json",
            "questions/pictures/metal_corner.png": "questions/pictures/engines.crops.json",
            "questions/pictures/roughness_gradient.png": "questions/pictures/visibility.crops.json",
            "questions/pictures/thin_pole.png": "questions/pictures/visibility.crops.json",
            "questions/pictures/toy_car.png": "questions/pictures/visibility_stills.crops.json",
            "questions/pictures/rails.png": "questions/pictures/visibility_stills.crops.json",
        }
        for name, source in made_from.items():
            picture = (ROOT / "experiments/studies" / name).read_bytes()
            digest = hashlib.sha256((ROOT / "experiments/studies" / source).read_bytes()).hexdigest()
            self.assertTrue(b"tEXtSource\0" + digest.encode() in picture, f"{name} is not of this {source}")


if __name__ == "__main__":
    unittest.main()
