"""What `ssrlab` says to mistakes of every kind, in terminals and without one: a sentence that says what to do, an exit code that is
documented, no traceback and no bare text of an exception.

usage: sharp_edges_test.py SSRLAB
"""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import sys
import tempfile
import termios
import unittest
from pathlib import Path

SSRLAB = Path(sys.argv[1]).resolve()
BARE = re.compile(r"Traceback|terminate called|what\(\)|std::|basic_string|CLI::|json\.exception|Exception|Error:|a fault of ssrlab|core dumped")
WAY_OUT = re.compile(
    r"did you mean '[^']+'\?|known are: |names are: |there are none|it has [^ ]+, |the table has |"  # names to choose from
    r"`(ssrlab|experiments/)[^`]+`|as in: ssrlab|as in '|see `|experiments/\S+\.md says|"  # a command to run
    r"\bmust |[;:,] (choose|check|write|add|give|name|remove|install) ")  # what to change
BARE_TERMINAL = {"TERM": "xterm-256color"}
EXITS = {"diff": {0, 1, 2, 3}}
SCRIPTS = ("figures", "tables")
FRAME = ["--size", "8", "8"]
STUDY = {"shots": [{"scene": "sky_only", "resolution": [16, 16]}], "techniques": [{"technique": "none"}], "reference": {"samples": 16}, "seeds": 1, "timing": {"frames": 0}}


class Ran:
    def __init__(self, words, code, out, err):
        self.words, self.code, self.out, self.err = words, code, out, err

    def __str__(self):
        return f"ssrlab {' '.join(self.words)}: exit code {self.code}\n{self.out[-300:]}{self.err}"


class SharpEdges(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.environment = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR", "SSRLAB_VALIDATE")} | {"SSRLAB_CACHE": str(cls.folder / "cache")} | BARE_TERMINAL
        (cls.folder / "file").write_text("no folder")
        (cls.folder / "study.json").write_text(json.dumps(STUDY))
        assert cls.run_words("run", "study.json", "--out", "results", "--no-report").code == 0
        cls.commands = [c["name"] for c in json.loads(cls.run_words("describe", "--json").out)["commands"]]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def run_words(cls, *words, **environment):
        ran = subprocess.run([SSRLAB, *words], cwd=cls.folder, env=cls.environment | environment, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=600)
        return Ran(words, ran.returncode, ran.stdout, ran.stderr)

    def check(self, ran, codes=None):
        said = str(ran)
        self.assertIn(ran.code, codes or EXITS.get(ran.words[0] if ran.words else "", {0, 2, 3}), said)
        self.assertNotRegex(ran.err, BARE, said)
        self.assertNotIn("\x1b", ran.out + ran.err, said)
        if ran.code in (2, 3):
            errors = [line for line in ran.err.splitlines() if line.startswith("error: ")]
            self.assertEqual(len(errors), 1, said)
            self.assertRegex(errors[0], WAY_OUT, said)
            self.assertLess(len(errors[0]), 900, said)

    def refused(self, *words, says="", codes=(2,), **environment):
        ran = self.run_words(*words, **environment)
        self.check(ran, codes)
        self.assertIn(says, ran.err, str(ran))

    def test_help_is_found(self):
        page = self.run_words("--help")
        self.assertEqual(self.run_words().out, page.out)
        self.assertEqual(self.run_words("help").out, page.out)
        self.assertEqual(self.run_words("help", "help").out, page.out)
        for command in self.commands:
            self.assertRegex(page.out, rf"(?m)^  {command} ", command)
        self.assertEqual(self.run_words("help", "run").out, self.run_words("run", "--help").out)
        self.assertEqual(page.out.count("for example: ssrlab "), 6)
        self.refused("help", "runn", says="did you mean 'run'?")

    def test_commands_without_arguments(self):
        for command in self.commands:
            if command not in ("stability", "describe"):  # which do much without any
                self.check(self.run_words(command))

    def parsed(self, words):
        """What `ssrlab` says to each list of words, by one process that does nothing else: a process for each takes ten seconds."""
        asked = "".join(json.dumps(line) + "\n" for line in words)
        ran = subprocess.run([SSRLAB, "--check-lines"], cwd=self.folder, env=self.environment, input=asked, capture_output=True, text=True)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        return ran.stdout.splitlines()

    def test_one_argument_too_many(self):
        lines = [[command, *["a.json"] * 5] for command in self.commands if command not in ("rays", "merge", *SCRIPTS)]  # which take many
        for line, said in zip(lines, self.parsed(lines)):
            self.assertRegex(said, rf"is one argument too many; `ssrlab {line[0]}` takes |is not known; known are: ", line)
        for command in ("diff", *SCRIPTS):
            self.refused(command, *["a.json"] * 5)

    def test_misspelt_options(self):
        lines = [[command, "--max-memroy=1GB"] for command in self.commands if command not in SCRIPTS]
        for line, said in zip(lines, self.parsed(lines)):
            self.assertRegex(said, rf"`ssrlab {line[0]}` has no option '--max-memroy'; (did you mean '--max-memory'|known are: --help)", line)
        self.refused("run", "study.json", "--ot", "o", says="did you mean '--out'?")
        self.refused("run", "study.json", "--output", "o", says="did you mean '--out'?")
        self.refused("tables", "o", "--kep", says="did you mean '--keep'?")
        self.refused("figures", "o", "--chioce", "c.json", says="did you mean '--choice'?")
        self.refused("--versoin", says="did you mean '--version'?")
        self.refused("run", "study.json", "--out", says="'--out' needs a value: --out DIR")
        self.refused("plan", "study.json", "--json", "a", "--json", "b", says="'--json' was given more than once")
        self.refused("gbuffer", "fence", "--size", "480", says="'--size' needs 2 values: --size")
        self.refused("help", "run", "plan", says="`ssrlab help` takes one command")

    def test_misspelt_names(self):
        for words, says in {
            ("runn",): "did you mean 'run'?",
            ("list", "scene"): "did you mean 'scenes'?",
            ("run", "quickstrat"): "did you mean 'quickstart'?",
            ("plan", "qzzzzz"): "`ssrlab list studies` lists all",
            ("needs", "fenc"): "did you mean 'fence'?",
            ("needs", "zzzzzz"): "`ssrlab list scenes` lists all",
            ("gbuffer", "fence", "--camera", "mian", *FRAME): "did you mean 'main'?",
            ("gbuffer", "fence", "--animation", "wave", *FRAME): "",
            ("gbuffer", "fence", "--depth-format", "d23", *FRAME): "did you mean 'd24'?",
            ("gbuffer", "fence", "--planes", "scen", *FRAME): "did you mean 'scene'?",
            ("describe", "mcguire"): "did you mean 'mcguire_dda'?",
            ("export-shaders", "mcguire_dad", "--out", "e"): "did you mean 'mcguire_dda'?",
            ("export-shaders", "mcguire_dda", "--out", "e", "--preset", "cuorse"): "did you mean 'coarse'?",
            ("export-shaders", "mcguire_dda", "--out", "e", "--set", "thicknes=1"): "did you mean 'dda.thickness'?",
            ("export-shaders", "mcguire_dda", "--out", "e", "--set", "zzz=1"): "`ssrlab describe TECHNIQUE` lists all",
            ("export-shaders", "mcguire_dda", "--out", "e", "--set", "zzz"): "must be NAME=VALUE",
            ("compare", "a.exr", "b.exr", "--metric", "flop"): "did you mean 'flip'?",
            ("compare", "a.exr", "b.exr", "--tone-map", "acess"): "did you mean 'aces'?",
            ("advise", "--chip", "navi22"): "it has ",
            ("advise", "--surface", "mirors"): "did you mean 'mirrors'?",
            ("stability", "--cases", "mirorred"): "did you mean 'mirrored'?",
            ("stability", "--techniques", "mcguire_dad"): "did you mean 'mcguire_dda'?",
            ("scene-for", "thre", "fence", "--out", "s"): "did you mean 'three'?",
            ("new", "mine", "--from", "mcguire_dad"): "did you mean 'mcguire_dda'?",
            ("run", "study.json", "--cells", "rendrs"): "did you mean 'renders'?",
            ("rays", "room:x"): "as in 'room:17'",
            ("record", "fence", "--technique", "diligent_srs", "--out", "p.html"): "did you mean 'diligent_ssr'?",
        }.items():
            self.refused(*words, says=says)

    def test_files_that_are_not_there(self):
        for command in ("run", "plan", "merge", "tune"):
            self.refused(command, "nowhere.json")
        for command in ("report", "figures", "tables", "tradeoff", "judge", "capture", "inspect", "watch"):
            self.refused(command, "nowhere", *(["--scene", "fence"] if command == "watch" else []))
        self.refused("diff", "nowhere", "nowhere")
        self.refused("compare", "nowhere.exr", "nowhere.exr")
        self.refused("merge", "study.json", "nowhere")
        self.refused("stability", "--table", "nowhere.json")
        self.refused("advise", "--table", "nowhere.csv")

    def test_mistakes_in_configs_have_their_place(self):
        for change, says in {
            '{"shots": [{"scene": "fenc", "resolution": [8, 8]}]}': "did you mean 'fence'?",
            '{"shots": [{"scene": ["fence", "zzzzzz"], "resolution": [8, 8]}]}': "`ssrlab list scenes` lists all",
            '{"shots": [{"scene": "room:x", "resolution": [8, 8]}]}': "as in 'room:17'",
            '{"shots": [{"scene": "fence", "camera": "mian", "resolution": [8, 8]}]}': "did you mean 'main'?",
            '{"techniques": [{"technique": "mcguire_dad"}]}': "did you mean 'mcguire_dda'?",
            '{"techniques": [{"technique": "mcguire_dda", "preset": "cuorse"}]}': "did you mean 'coarse'?",
            '{"techniques": [{"technique": "mcguire_dda", "parameters": {"zzz": 1}}]}': "`ssrlab describe TECHNIQUE` lists all",
            '{"techniques": [{"technique": "mcguire_dda", "sweep": {"dda.strid": [1, 2]}}]}': "did you mean 'dda.stride'?",
            '{"metrics": ["flop"]}': "did you mean 'flip'?",
            '{"masks": ["reflectiv"]}': "did you mean 'reflective'?",
            '{"refrence": {}}': "did you mean 'reference'?",
            '{"tables": [{"name": "a", "caption": "c", "rows": ["techniqe"], "columns": "shot", "of": "results"}]}': "did you mean 'technique'?",
        }.items():
            (self.folder / "wrong.json").write_text(json.dumps(STUDY | json.loads(change), indent=1))
            ran = self.run_words("plan", "wrong.json")
            self.check(ran, (2,))
            self.assertIn(says, ran.err, str(ran))
            self.assertRegex(ran.err, r"error: wrong\.json:\d+:\d+: ", str(ran))

    def test_an_included_study_is_found_beside_its_results(self):
        (self.folder / "quickstart").mkdir()
        self.check(self.run_words("plan", "quickstart"), (0,))
        self.refused("plan", "paper_figures", says="`ssrlab list studies` lists all")  # a choice of figures, no study

    def test_output_that_is_lost_is_a_fault(self):
        for words in (["list", "metrics"], ["needs", "fence", "--size", "8", "8"]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                ran = subprocess.run([SSRLAB, *words], cwd=self.folder, env=self.environment, stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(ran.returncode, 3, words)
            self.assertIn("the output cannot be written", ran.stderr)

    def test_results_lack_names(self):
        self.refused("tradeoff", "results", "--metric", "flop", says="specular flip all")
        self.refused("figures", "results", "--metric", "flop")

    def test_folders_that_cannot_be_made(self):
        for words in (
            ("run", "study.json", "--out", "file/below"),
            ("plan", "study.json", "--json", "/proc/below/plan.json"),
            ("gbuffer", "sky_only", *FRAME, "--out", "/proc/below"),
            ("reference", "sky_only", *FRAME, "--samples", "16", "--out", "file/below/r.exr"),
            ("export-shaders", "mcguire_dda", "--out", "file/below"),
            ("new", "file/below"),
            ("advise", "--json", "/proc/below/points.json"),
        ):
            self.refused(*words, codes=(2, 3))
        self.assertFalse(Path("/proc/below").exists())

    def terminal(self, columns, *words, typed="", **environment):
        """What a terminal of so many columns shows, on which somebody typed ahead."""
        ours, its = pty.openpty()
        os.write(ours, typed.encode())
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        with subprocess.Popen([SSRLAB, *words], cwd=self.folder, env=self.environment | environment, stdin=its, stdout=its, stderr=its) as process:
            os.close(its)
            said = b""
            while True:
                try:
                    part = os.read(ours, 65536)
                except OSError:  # EIO: nobody has the other end any more
                    break
                if not part:
                    break
                said += part
            os.close(ours)
            process.wait()
        return said.decode().replace("\r\n", "\n")

    def test_a_study_of_hours_is_confirmed_where_somebody_sees_the_question(self):
        study = {
            # Hours on any machine: 8e12 samples.
            "shots": [{"scene": "corridor", "camera": "dolly", "resolution": [1920, 1080], "frames": {"from": 0, "to": 1000}, "measure_from": 0}],
            "reference": {"samples": 4096},
            "techniques": [{"technique": "none"}],
            "timing": {"frames": 0},
        }
        (self.folder / "long.json").write_text(json.dumps(study), encoding="utf-8")
        said = self.terminal(200, "run", "long.json", typed="n\n")
        self.assertRegex(said, r"This study takes \d+ h", said)
        self.assertIn("Start it? [y/N]", said)
        self.assertIn("the study was not started", said)
        self.assertFalse((self.folder / "results" / "long" / "cells").exists())

    def test_terminals_of_few_columns(self):
        for words in (["--help"], ["run", "--help"], ["figures", "--help"], ["list", "scenes"], ["list", "metrics"], ["describe", "mcguire_dda"]):
            for columns in (40, 60) if words == ["--help"] else (40,):
                said = self.terminal(columns, *words)
                plain = re.sub("\x1b\\[[0-9;]*m", "", said)
                for line in plain.split("\n"):
                    self.assertTrue(len(line) <= columns or len(line.split()) <= 2, (words, columns, line))
                self.assertNotIn("\x1b", plain)
                if words != ["figures", "--help"]:  # argparse breaks within words
                    self.assertEqual(plain.split(), self.run_words(*words).out.split(), (words, columns))

    def test_colours_only_where_they_are_wanted(self):
        self.assertIn("\x1b[1m", self.terminal(80, "--help"))
        self.assertIn("\x1b[1;31merror:\x1b[0m", self.terminal(80, "runn"))
        self.assertIn("\x1b[1;31merror:\x1b[0m", self.terminal(80, "figures"))
        for words in (["--help"], ["runn"], ["figures"]):
            self.assertNotIn("\x1b", self.terminal(80, *words, NO_COLOR="1"))
            self.assertNotIn("\x1b", self.terminal(80, *words, TERM="dumb"))

    def test_progress_fits(self):
        said = self.terminal(24, "reference", "fence", "--size", "64", "36", "--seconds", "2", "--out", "drawn.exr")  # long enough for lines
        drawn = re.findall(r"(?:^|\r)(\[[^\r\n]+)", said)
        self.assertGreater(len(drawn), 0)
        for line in drawn:
            self.assertLess(len(line), 24)
        self.assertTrue(any(len(line) == 23 for line in drawn), "no line was cut")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
