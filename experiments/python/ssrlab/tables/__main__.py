"""Tables of a study's results, as its config asks for them ("tables", experiments/docs/figures.md): Markdown, LaTeX and CSV.

usage: python3 experiments/python tables RESULTS [--out DIR] [--keep]
       python3 experiments/python tables --fill | --check ESTIMATORS

With --keep also the summary that is committed (experiments/studies/summaries), and the documents that show its tables; --fill makes
the tables of all documents anew, --check says which differ, and which summaries today's estimators did not make."""

import os
import sys

from ssrlab.tables.command_line import parse_arguments

ARGUMENTS = parse_arguments() if __name__ == "__main__" else None  # before the imports below, which take half a second

from ssrlab.mistakes import ResultsError, counted, exit_code, shown
from ssrlab.results import Results
from ssrlab.text_files import path_inside, write_text
from ssrlab.tables import documents, formats, latex, summary_file
from ssrlab.tables.cells import Table, cells_of
from ssrlab.tables.markdown import markdown


def default_folder(results):
    return path_inside(results, "tables")


def remove_others(out, names):
    """Removes tables that the config does not ask for; no other files."""
    for file in os.listdir(out):
        name, kind = os.path.splitext(file)
        if kind in (".md", ".tex", ".csv") and name not in names:
            os.remove(path_inside(out, file))


def make(folder, out, summary_folder):
    """Writes a study's tables; returns their number. `summary_folder`: where the summary is kept; None: nowhere."""
    results = Results(folder)
    config = results.manifest["config"] or {}
    entries = config.get("tables", [])
    if not entries:
        raise ResultsError(f"{folder}: its study asks for no tables; add \"tables\" to its config (experiments/docs/figures.md)")
    why_not = summary_file.why_not_kept(results.manifest) if summary_folder else None
    if why_not:
        raise ResultsError(f"{folder} cannot be kept: {why_not}")
    origin = summary_file.origin(results.manifest)
    tables, every = [], []
    manifest = os.path.join(folder, "manifest.json")
    stems = [path_inside(out, entry["name"], f"{manifest}: config: tables: 'name'") for entry in entries]
    if summary_folder:
        summary = path_inside(summary_folder, results.manifest["study"]["name"] + ".csv", f"{manifest}: study: 'name'")
    for entry, stem in zip(entries, stems):
        table, cells = cells_of(results, Table(entry))
        made_from = summary_file.made_from(origin, table, cells)
        write_text(stem + ".md", markdown(table, cells, made_from))
        write_text(stem + ".tex", latex.latex(table, cells, made_from))
        write_text(stem + ".csv", formats.comma_separated(table, cells))
        tables.append(table)
        every += cells
    if out == default_folder(folder):
        remove_others(out, {table["name"] for table in tables})
    if summary_folder:
        summary_file.write(summary, origin, tables, every)
    return len(entries)


def main():
    arguments = ARGUMENTS or parse_arguments()
    summaries = os.path.join(arguments.root, "experiments/studies/summaries")
    if arguments.check is not None:
        found = documents.mistakes(arguments.root, summaries, arguments.check)
        for sentence in found:
            print(f"error: {shown(sentence)}", file=sys.stderr)
        return 2 if found else 0
    if arguments.results:
        out = arguments.out or default_folder(arguments.results)
        count = make(arguments.results, out, summaries if arguments.keep else None)
        print(f"{counted(count, 'table')} in {out}")
    if arguments.fill or arguments.keep:
        changed = documents.rewrite(arguments.root, summaries)
        print(f"{counted(len(changed), 'document')} changed" + "".join(f"\n{file}" for file in changed))


if __name__ == "__main__":
    sys.exit(exit_code(main, "the tables"))
