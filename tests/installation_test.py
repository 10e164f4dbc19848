"""What `cmake --install` puts into a folder: a ssrlab that needs neither checkout nor build folder, and which is gone without rest afterwards.

usage: installation_test.py CMAKE BUILD_FOLDER

Its commands run where the checkout is an empty folder, if the system lets this process mount (unshare)."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CMAKE, BUILD = sys.argv[1], Path(sys.argv[2]).resolve()
STUDY = {
    "shots": [{"scene": "fence", "resolution": [32, 18]}],
    "techniques": [{"technique": "none"}, {"technique": "mcguire_dda"}],
    "reference": {"samples": 16},
    "timing": {"frames": 0},
    "tables": [{"name": "errors", "caption": "Errors", "of": "results", "where": {"metric": "mse", "target": "specular", "mask": "reflective"}, "rows": ["technique", "point"], "columns": "shot"}],
}


def files_below(folder):
    """Size and time of change by path."""
    return {file: (file.lstat().st_size, file.lstat().st_mtime_ns) for file in folder.rglob("*") if not file.is_dir()}


def command_with(word):
    """The command of quickstart.md that has this word, without sudo."""
    lines = (ROOT / "experiments/docs/quickstart.md").read_text(encoding="utf-8").splitlines()
    return next(line.strip().removeprefix("sudo ") for line in lines if line.startswith("    ") and word in line)


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory())).resolve()
        cls.prefix, cls.here, empty = cls.folder / "prefix", cls.folder / "elsewhere", cls.folder / "empty"
        for folder in (cls.here, empty):
            folder.mkdir()
        cls.install()
        mounts = " && ".join(shlex.join(["mount", "--bind", str(empty), str(hidden)]) for hidden in (BUILD, ROOT))
        cls.hiding = ["unshare", "--mount", *([] if os.geteuid() == 0 else ["--map-root-user"]), "sh", "-c", f'{mounts} && exec "$@"', "sh"]
        cls.is_hidden = shutil.which("unshare") and not cls.folder.is_relative_to(ROOT) and not subprocess.run([*cls.hiding, "true"], capture_output=True, check=False).returncode
        own = {name: value for name, value in os.environ.items() if not name.startswith(("SSRLAB_", "XDG_"))}
        cls.environment = own | {"HOME": str(cls.folder / "home"), "PATH": f"{cls.prefix}/bin:/usr/bin:/bin"}
        cls.installed = files_below(cls.prefix)

    @classmethod
    def install(cls):
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.prefix], capture_output=True, check=True)

    def run_here(self, *command):
        hiding = self.hiding if self.is_hidden else []
        done = subprocess.run([*hiding, *command], capture_output=True, text=True, check=False, cwd=self.here, env=self.environment)
        self.assertEqual(done.returncode, 0, f"{command}: {done.stdout}{done.stderr}")
        return done.stdout

    def test_commands_find_their_files(self):
        if not self.is_hidden:
            print("the checkout cannot be hidden: no mount by unshare", file=sys.stderr)
        else:
            self.assertEqual(self.run_here("ls", ROOT), "")
        self.assertIn("mcguire_dda: ", self.run_here("ssrlab", "list", "techniques"))
        self.assertIn("dda.stride", self.run_here("ssrlab", "describe", "mcguire_dda"))
        self.assertIn(f"{self.prefix}/share/ssrlab", self.run_here("ssrlab"))
        self.assertIn("quickstart", self.run_here("ssrlab", "list", "studies"))
        self.run_here("ssrlab", "advise", "--chip", "navi21", "--ms", "1")
        self.run_here("ssrlab", "inspect", "room:1")  # starts scenes/generate.py
        shutil.copy(ROOT / "tests/data/fuzz/glb/draco_sequential.glb", self.here)
        self.run_here("ssrlab", "inspect", "draco_sequential.glb")  # starts draco_decoder
        (self.here / "study.json").write_text(json.dumps(STUDY), encoding="utf-8")
        self.run_here("ssrlab", "run", "study.json")
        self.run_here("ssrlab", "shaders", "mcguire_dda", "--chip", "navi21")  # starts chip_compiler
        for command in ("report", "tables", "figures"):
            self.run_here("ssrlab", command, "results/study")
        for made in ("report.html", "tables/errors.md", "figures"):
            self.assertTrue((self.here / "results/study" / made).exists(), made)
        self.assertEqual(files_below(self.prefix), self.installed, "a command wrote into the installation")

    def test_is_the_program_of_the_build(self):
        """Else it would make the cells anew that the other one made."""
        built = subprocess.run([BUILD / "ssrlab", "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(self.run_here("ssrlab", "--version"), built)

    def test_links_of_documents_lead_somewhere(self):
        documents = list((self.prefix / "share/ssrlab").rglob("*.md"))
        self.assertGreater(len(documents), 50)
        for document in documents:
            for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", document.read_text(encoding="utf-8")):
                if not link.startswith(("http:", "https:", "mailto:")):
                    self.assertTrue((document.parent / link).exists(), f"{document}: {link}")

    def test_a_new_installation_has_no_shader_of_an_old_one(self):
        old = self.prefix / "share/ssrlab/variants/none/old.comp"
        old.touch()
        self.install()
        self.assertFalse(old.exists())

    def test_uninstalling_leaves_nothing(self):
        copy = self.folder / "copy"
        shutil.copytree(self.prefix, copy)
        subprocess.run(shlex.split(command_with("rm -r").replace("/usr/local", str(copy))), check=True)
        self.assertEqual([file for file in copy.rglob("*") if file not in (copy / "bin", copy / "lib", copy / "share")], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
