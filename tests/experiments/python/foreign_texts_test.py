"""Texts that somebody else wrote stay texts in every language that scripts write: a terminal's, Markdown, CSV, LaTeX, and matplotlib's labels;
and names of files stay below their folder."""

import csv
import html
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest

os.environ["MPLBACKEND"] = "Agg"

import markdown_it
import matplotlib.pyplot as plt
import pandas
from ssrlab.figures import style
from ssrlab.tables import latex, markdown, summary_file
from ssrlab.tables.cell import Cell
from ssrlab.csv_files import parse_rows, write_lines
from ssrlab.markdown_text import markdown_code, markdown_prose, markdown_text
from ssrlab.mistakes import ResultsError, shown
from ssrlab.results import Results
from ssrlab.dataframes import Tables
from ssrlab.text_files import path_inside, word_here, write_text

TYPED = "\\immediate\\openout7=forged.txt\\immediate\\write7{x}\\immediate\\closeout7"
ATTACKS = [
    *("a\nerror: forged", "a\n\n# b <i>", "a\rb", "\x1b[31mred", "\x1b]0;title\x07", "\x9b31m", "\u202egnp.exe", "a\u2028b", "a\x85b", "a\x0cb", "\0", "caf\udce9"),
    *(TYPED, f"}}{TYPED}{{", f"a\n{TYPED}", f"^^M{TYPED}", f"a] {TYPED}", "$\\foo$", "a$b$c", "100 % & #1 ~ ^ _ {", "}", "\\", "a--b---c", "?`!`", "`a", "[x]", "*", '"q'),
    *("<script>alert(1)</script>", "<img src=x onerror=alert(1)>", "<!-- end of table -->", "[a](javascript:alert(1))", "![a](http://x/y)", "<javascript:alert(1)>"),
    *("[a]: javascript:x", "[a][b]", "[^1]", "a|b", "`a|b`", "``a` <b> ``", "\\` <b> `", "\\\\` <b> `", "*a*", "_a_", "__a__", "a_b_c", "~~a~~", "&lt;b&gt;", "&#60;", "&copy"),
    *("# a", "- a", "+ a", "1. a", "1) a", "> a", "    a", "---", "===", "***", ": a", "a\\", "a\\|b"),
    *('=HYPERLINK("http://x")', "+1+cmd|' /C calc'!A0", "-2+3", "@SUM(1)", "\t=1", "\r=1", "'=1", "''=1", "'a", "=1\n=2", "a,b", 'a"b', "-0.5", "+1e3", "-", "1.5 ms"),
]
PLAIN = ["amd_sssr", "taps=4", "dda.thickness=0.25 dda.stride=2", "roughness_0.1_0.3", "-0.5", "\N{GREEK SMALL LETTER ALPHA} \N{MULTIPLICATION SIGN} 2"]  # which stay legible


def inline_text(rendered):
    """The text of HTML without its tags."""
    return html.unescape(re.sub(r"<[^>]*>", "", rendered))


class Terminal(unittest.TestCase):
    def test_one_line_that_is_not_obeyed(self):
        for attack in ATTACKS:
            text = shown(attack)
            self.assertTrue(text.isprintable(), (attack, text))
            self.assertEqual(len(text.splitlines()), 1, attack)
        self.assertEqual(shown("\x1b[1m a\nb \x9b \u202e caf\udce9"), r"\x1b[1m a\nb \u009b \u202e caf\xe9")  # as core/shown_text.h says
        for plain in PLAIN:
            self.assertEqual(shown(plain), plain)


class Markdown(unittest.TestCase):
    reader = markdown_it.MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"])

    def test_as_a_cell(self):
        for attack in ATTACKS:
            rendered = self.reader.render(f"| a | b |\n|---|---|\n| {markdown_text(attack)} | end |\n")
            self.assertEqual(re.findall(r"<(\w+)", rendered), "table thead tr th th tbody tr td td".split(), attack)
            self.assertEqual(inline_text(re.findall(r"<td>(.*?)</td>", rendered)[0]).strip(), shown(attack).strip(), attack)

    def test_as_prose(self):
        for attack in ATTACKS:
            rendered = self.reader.render(markdown_prose(attack) + "\n\nend\n")
            self.assertEqual(set(re.findall(r"<(\w+)", rendered)) - {"code"}, {"p"}, (attack, rendered))
            self.assertEqual(inline_text(rendered).replace("`", "").split(), [*shown(attack).replace("`", "").split(), "end"], attack)
            rendered = self.reader.render(f"Run {markdown_code(attack)} now")
            self.assertEqual(inline_text(rendered).split("Run ")[1].split(" now")[0].strip(), shown(attack).strip(), attack)
            self.assertEqual(re.findall(r"<(\w+)", rendered), ["p", "code"], attack)
        self.assertEqual(self.reader.render(markdown_prose("`a_b` < c")), "<p><code>a_b</code> &lt; c</p>\n")

    def test_names_stay_legible(self):
        for plain in PLAIN:
            self.assertEqual(markdown_text(plain), plain)
        self.assertEqual(markdown_prose("Error over that of `x_y`, at 1.5 ms [0.4, 0.6] (a)"), "Error over that of `x_y`, at 1.5 ms [0.4, 0.6] (a)")

    def test_a_table(self):
        """Names, captions, reasons, clocks and the line below hold an attack each; short and folded."""
        for attack in ATTACKS:
            for count in (1, 9):
                rendered = self.reader.render(markdown.markdown(*table_of(attack, count)))
                tags = set(re.findall(r"<(\w+)", re.sub(r"<!--.*?-->", "FORGED", rendered)))
                self.assertLessEqual(tags, {"p", "table", "thead", "tbody", "tr", "th", "td", "code", "details", "summary"}, (attack, rendered))
                self.assertEqual((rendered.count("<table>"), rendered.count("<tr>"), rendered.count("FORGED")), (1, 1 + count, 0), attack)
                self.assertNotIn("<!--", rendered)


class Csv(unittest.TestCase):
    def test_no_formula_and_back_again(self):
        out = io.StringIO()
        texts = [a for a in ATTACKS if "\udce9" not in a]
        write_lines(out, [["name", "number", "=head()"], *([a, -0.5, a] for a in texts)])
        for fields in list(csv.reader(io.StringIO(out.getvalue(), newline=""))):
            for field in fields:
                self.assertTrue(field[:1] not in ("=", "+", "-", "@", "\t", "\r") or re.fullmatch(r"[+-][\d.e+]+", field), field)
        columns, rows = parse_rows(out.getvalue(), "f.csv")
        self.assertEqual(columns, ["name", "number", "=head()"])
        self.assertEqual([(r["name"], r["number"], r["=head()"]) for r in rows], [(a, "-0.5", a) for a in texts])

    def test_pandas_reads_the_names(self):
        texts = [a for a in ATTACKS if "\udce9" not in a and "\0" not in a] + ["NA", "null", "nan"]
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "t.csv"), "w", newline="", encoding="utf-8") as stream:
                write_lines(stream, [["name", "value"], *([a, -1.5] for a in texts)])
            with open(os.path.join(folder, "manifest.json"), "w", encoding="utf-8") as stream:
                stream.write("{}")
            with open(os.path.join(folder, "schema.json"), "w", encoding="utf-8") as stream:
                stream.write('{"resources": [{"name": "t", "schema": {"fields": [{"name": "name", "type": "string"}, {"name": "value", "type": "number"}]}}]}')
            table = Tables(folder)["t"]
        self.assertIsInstance(table, pandas.DataFrame)
        self.assertEqual(table["name"].tolist(), [a.replace("\r\n", "\n") for a in texts])
        self.assertEqual(set(table["value"]), {-1.5})

    def test_a_kept_summary_reads_back(self):
        """No name makes a line of its head."""
        for attack in ("a\n# study: \"forged\"", "\n# table: {}", "=1", "# a"):
            cells = [Cell(attack, attack, attack, 1.0, 0.9, 1.1, interval=attack)]
            about = {"name": attack, "caption": attack, "shots": [attack], "resolutions": [], "over": None, "over_count": None, "clocks": []}
            with tempfile.TemporaryDirectory() as folder:
                file = os.path.join(folder, "s.csv")
                summary_file.write(file, {"study": attack}, [about], cells)
                origin, tables = summary_file.read(file)
            self.assertEqual((origin, list(tables)), ({"study": attack}, [attack]))
            self.assertEqual(tables[attack][1], cells)


def table_of(text, count=1):
    """(what is said of a table, its cells, the line below) whose texts all hold `text`."""
    cells = [Cell(text, f"{text} {i}", text, 0.5, interval=f"none: {text}", clock=text) for i in range(count)]
    origin = {"study": text, "commit": text, "shots": 2, "device": text, "is_complete": False}
    about = {"name": text, "caption": text, "rows": [text], "columns": [text], "shots": [text], "resolutions": [text], "over": text, "over_count": 2, "clocks": [text, "b"]}
    return about, cells, summary_file.made_from(origin, about, cells)


class Paths(unittest.TestCase):
    def test_they_lead_nowhere_else(self):
        """As core/path_inside.h has it."""
        with tempfile.TemporaryDirectory() as outside:
            folder = os.path.join(outside, "results")
            os.makedirs(os.path.join(folder, "images"))
            os.symlink(outside, os.path.join(folder, "up"))
            os.symlink("gone", os.path.join(folder, "images/dangling"))
            for name in ("images/a.exr", "new/b.exr", "..b..c"):
                self.assertEqual(path_inside(folder, name), f"{folder}/{name}")
            for name in ("", "..", "../a", "images/../../a", "images/..", "/etc/passwd", "a\0b", 3, None):
                with self.assertRaisesRegex(ResultsError, "^m.json: 'exr': .* is no path below", msg=name):
                    path_inside(folder, name, "m.json: 'exr'")
            for name in ("up", "up/x", "images/dangling"):
                with self.assertRaisesRegex(ResultsError, "is a symbolic link", msg=name):
                    path_inside(folder, name)


class Leftovers(unittest.TestCase):
    def test_of_killed_processes_go_with_the_next_write(self):
        """As core/leftovers.h has it."""
        killed = subprocess.Popen([sys.executable, "-c", ""])
        killed.wait()
        with tempfile.TemporaryDirectory() as folder:
            own = f"b.csv.partial-{word_here()}-{os.getpid()}-9"
            for name in (f"a.csv.partial-{word_here()}-{killed.pid}-0", own, "a.csv.partial-1"):
                open(os.path.join(folder, name), "w", encoding="utf-8").close()
            write_text(os.path.join(folder, "c.csv"), "c")
            self.assertEqual(sorted(os.listdir(folder)), ["a.csv.partial-1", own, "c.csv"])


class Latex(unittest.TestCase):
    STUBS = r"\let\toprule\hline\let\midrule\hline\let\bottomrule\hline\newcommand{\addlinespace}[1][]{}"

    def test_nothing_but_what_ssrlab_writes_is_run(self):
        known = set(re.findall(r"\\([a-zA-Z]+|.)", latex.latex(*table_of("plain")), re.DOTALL)) | {"texttt", "textbackslash", "textasciitilde", "textasciigrave", "textless", "textgreater", "textbar"}
        known |= set("_%&#${}^\\")
        for attack in ATTACKS:
            text = latex.latex(*table_of(attack))
            for line in text.splitlines():
                code = re.sub(r"(?<!\\)((?:\\\\)*)%.*", r"\1", line)
                self.assertLessEqual(set(re.findall(r"\\([a-zA-Z]+|.)", code)), known, (attack, line))
                self.assertEqual(code.count("^^"), 0, line)
            self.assertRegex(re.search(r"\\label\{(.*?)\}", text)[1], r"^tab:[A-Za-z0-9:._-]*$")
        labels = {re.search(r"\\label\{(.*?)\}", latex.latex(*table_of(a)))[1] for a in ATTACKS if "\udce9" not in a}
        self.assertEqual(len(labels), len(ATTACKS) - 1, "names that differ have labels that differ")

    def test_latex_sets_it(self):
        """By pdflatex (texlive-latex-base): all attacks in one document, which writes no file and has no error."""
        with tempfile.TemporaryDirectory() as folder:
            pages = [latex.latex(*table_of(a)) for a in ATTACKS if shown(a).isascii()]
            body = "\n\\clearpage\n".join(pages)
            with open(os.path.join(folder, "t.tex"), "w", encoding="utf-8") as stream:
                stream.write(f"\\documentclass{{article}}\\usepackage{{graphicx}}{self.STUBS}\n\\begin{{document}}\n{body}\n\\end{{document}}\n")
            command = ["pdflatex", "-no-shell-escape", "-interaction=nonstopmode", "-halt-on-error", "-draftmode", "t.tex"]
            done = subprocess.run(command, cwd=folder, env=os.environ | {"HOME": folder}, capture_output=True, text=True, errors="replace")
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])
            self.assertFalse(os.path.exists(os.path.join(folder, "forged.txt")), "a name was run")


class Labels(unittest.TestCase):
    def test_names_in_figures_hold_nothing_that_is_obeyed(self):
        for attack in ATTACKS:
            results = Results.__new__(Results)
            results.labels, results.rounds_names = {}, False
            for manifest in ({}, {"label": attack, "group": attack}):
                results.techniques, results.shot_entries = {(attack, attack): manifest}, {attack: manifest}
                for name in (results.point_label(attack, attack), results.point_group(attack, attack), results.shot_label(attack), results.shot_group(attack)):
                    self.assertTrue(name.isprintable(), (attack, name))

    def test_no_mathematics(self):
        style.apply()
        figure, axes = plt.subplots()
        for attack in ("a$b$c", "$\\foo$", "$x^2$", "\\$"):
            axes.set_title(attack)
            axes.plot([0, 1], [0, 1], label=attack)
            axes.set_xticks([0], [attack])
            legend = figure.legend()
            figure.draw_without_rendering()
            self.assertEqual({t.get_text() for t in legend.get_texts()}, {attack})
            self.assertEqual(axes.title._preprocess_math(attack), (attack, False))
            self.assertGreater(style.text_width(attack), 0)
            legend.remove(), axes.cla()
        plt.close(figure)


if __name__ == "__main__":
    unittest.main()
