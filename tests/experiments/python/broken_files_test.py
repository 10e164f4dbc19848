"""Every script that reads files of somebody else refuses broken ones in a sentence, with exit code 2 or 3, or does no harm by them.

usage: broken_files_test.py [STRIDE]    every STRIDE-th mutation of each file; default: as many as take two seconds
"""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
EXPERIMENTS = os.path.join(HERE, "../../../experiments")
sys.path[:0] = [os.path.join(HERE, "../figures"), os.path.join(EXPERIMENTS, "study/measuring/costs")]
os.environ["MPLBACKEND"] = "Agg"

import broken_files
import cost_agreement
import ssrlab
import ssrlab.figures.__main__ as figures
import ssrlab.tables.__main__ as tables
import tables_study
from ssrlab import judge
from ssrlab.figures import stability as stability_figure
from ssrlab.tune import studies
from ssrlab.mistakes import exit_code

STRIDE = int(sys.argv.pop()) if len(sys.argv) > 1 else 31

class BrokenFiles(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="ssrlab_broken_")
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name
        self.tried = self.refused = 0

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as stream:
            stream.write(text if isinstance(text, str) else json.dumps(text))

    @staticmethod
    def run_script(work, arguments=()):
        """(exit code, what it said)"""
        said, before = io.StringIO(), sys.argv
        sys.argv = ["script", *arguments]
        try:
            with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
                code = exit_code(work, "the files")
        except SystemExit as end:
            code = end.code
        finally:
            sys.argv = before
        return code, said.getvalue()

    def break_files(self, names, work, *arguments):
        code, said = self.run_script(work, arguments)
        self.assertEqual((code, said), (0, ""), "what is whole")
        for name in names:
            with open(self.path(name), "rb") as stream:
                whole = stream.read()
            mutations = broken_files.of_json(whole) if name.endswith(".json") else broken_files.of_csv(whole)
            for index, (what, broken) in enumerate(mutations):
                if index % STRIDE:
                    continue
                with open(self.path(name), "wb") as stream:
                    stream.write(broken)
                code, said = self.run_script(work, arguments)
                self.tried, self.refused = self.tried + 1, self.refused + (code != 0)
                self.assertIn(code, (0, 2, 3), (name, what, said))
                self.assertNotIn("a fault of ssrlab", said, (name, what))
                self.assertEqual(said.count("\n"), said.startswith("error: "), (name, what, said))
            os.remove(self.path(name)), os.mkfifo(self.path(name))
            code, said = self.run_script(work, arguments)
            self.assertIn(code, (2, 3), (name, "a pipe", said))
            os.remove(self.path(name))
            with open(self.path(name), "wb") as stream:
                stream.write(whole)
        self.assertGreater(self.refused, 0)

    def test_folders_that_nobody_may_read(self):
        """The reason is said, not that a file is missing. Root may read all, and so becomes another user."""
        tables_study.write_results(self.folder)
        is_root = os.geteuid() == 0
        os.chmod(self.folder, 0o700 if is_root else 0)
        if is_root:
            os.seteuid(65534)
        try:
            said = [self.run_script(work, [self.folder]) for work in (tables.main, figures.main, lambda: ssrlab.read(self.folder) and None)]
        finally:
            if is_root:
                os.seteuid(0)
            os.chmod(self.folder, 0o700)
        self.assertEqual(said, [(2, f"error: cannot read {self.path('manifest.json')}: Permission denied\n")] * 3)

    def test_tables(self):
        tables_study.write_results(self.folder)
        self.break_files(("manifest.json", "summary.csv", "effects.csv", "splits.csv", "time_summary.csv"), tables.main, self.folder)

    def test_kept_summaries(self):
        tables_study.write_results(self.path("r"))
        self.write("t/README.md", '<!-- table made_up changes {"rows": ["taps = 4"]} -->\n<!-- end of table -->\n<!-- table made_up levels -->\n<!-- end of table -->\n')
        self.assertEqual(self.run_script(tables.main, [self.path("r"), "--keep", "--root", self.path("t")]), (0, ""))
        self.break_files(["t/experiments/studies/summaries/made_up.csv"], tables.main, "--check", "7", "--root", self.path("t"))

    def test_figures(self):
        """All that is read before the first is drawn."""
        tables_study.write_results(self.folder)
        choice = {"figures": [{"kind": "error_time", "width": 9.5, "points": ["sssr*"], "labels": {"sssr": "s"}}], "crops": [{"shot": "floor", "box": [0, 0, 4, 4], "points": [{"technique": "sssr", "point": "default"}]}]}
        self.write("figures.json", choice | {"font": "serif", "formats": ["svg"], "shots": ["floor"], "colors": {"sssr": "#102030"}})
        make, figures.make = figures.make, lambda *_: 0
        self.addCleanup(setattr, figures, "make", make)
        self.break_files(("figures.json", "manifest.json", "summary.csv", "time_summary.csv"), figures.main, self.folder, "--choice", self.path("figures.json"), "--mask", "all")

    def test_a_search_that_goes_on(self):
        self.write("minutes.json", {"search/start": 1.5})
        search = object.__new__(studies.Studies)
        search.minutes_file, search.minutes = self.path("minutes.json"), {}
        self.break_files(["minutes.json"], lambda: search._keep_minutes("search/start", 2.0))

    def test_smaller_scripts(self):
        self.write("times.csv", "shot,technique,point,stage,milliseconds\n" + "".join(f"s,v,p{i},{stage},{i + 1}\n" for i in range(3) for stage in ("total", "a")))
        self.write("costs.csv", "shot,technique,point,stage,quantity,value\n" + "".join(f"s,v,p{i},{stage},fetches,{i + 1}\n" for i in range(3) for stage in ("total", "a")))
        self.write("estimates.csv", "shot,technique,point,stage,chip,microseconds\n" + "".join(f"s,v,p{i},{stage},navi21,{i + 1}\n" for i in range(3) for stage in ("total", "a")))
        self.break_files(("times.csv", "costs.csv", "estimates.csv"), cost_agreement.main, self.folder)
        self.write("key.csv", "pair,shot,first,first_point,second,second_point\n1,s,a,b,c,d\n")
        self.write("answers.csv", "pair,nearer\n1,left\n")
        known, judge.JUDGEMENTS = judge.JUDGEMENTS, self.path("judgements.csv")
        self.addCleanup(setattr, judge, "JUDGEMENTS", known)
        self.break_files(("key.csv", "answers.csv"), judge.main, "enter", self.folder, self.path("answers.csv"), "--judge", "me")
        self.write("stability.csv", "group,case,technique,point,verdict\ng,c,v,default,ok\n")
        draw, stability_figure.draw = stability_figure.draw, lambda rows, _: [(r["group"], r["case"], r["technique"], r["point"], r["verdict"]) for r in rows] and None
        self.addCleanup(setattr, stability_figure, "draw", draw)
        self.break_files(["stability.csv"], stability_figure.main, self.path("stability.csv"), "--out=" + self.path("f.svg"))

    def test_pandas(self):
        tables_study.write_results(self.folder)
        fields = [{"name": name, "type": kind} for name, kind in (("shot", "string"), ("seeds", "integer"), ("value", "number"), ("represents_shot", "boolean"))]
        self.write("schema.json", {"resources": [{"name": "summary", "schema": {"fields": fields}}]})
        self.break_files(("schema.json", "summary.csv"), lambda: ssrlab.read(self.folder)["summary"] is None)


if __name__ == "__main__":
    unittest.main()
