"""The command line of `ssrlab tables`, without what makes them: that takes half a second to import."""

import argparse

from ssrlab.command_lines import CommandLine
from ssrlab.repository import ROOT


def command_line():
    parser = CommandLine(prog="ssrlab tables", description="Makes the tables of a study (Markdown, LaTeX, CSV) from a results folder.")
    parser.add_argument("results", nargs="?", help="Results folder that `ssrlab run` filled")
    parser.add_argument("--out", metavar="DIR", help="Output folder; default: tables in the results folder")
    parser.add_argument("--keep", action="store_true", help="Also keep the numbers in experiments/studies/summaries, and write them into documents")
    parser.add_argument("--fill", action="store_true", help="Write the kept numbers into all tables and sentences of documents")
    parser.add_argument("--check", metavar="ESTIMATORS", type=int, help="Fail if a document differs from the kept numbers, or if the estimators have another version than those of the kept numbers. `ssrlab tables --check` adds the version")
    parser.add_argument("--root", default=str(ROOT), help=argparse.SUPPRESS)  # tests use a tree of their own
    return parser


def parse_arguments():
    parser = command_line()
    arguments = parser.parse_args()
    if sum([arguments.results is not None, arguments.fill, arguments.check is not None]) != 1:
        parser.error("name one results folder, or --fill, or --check")
    return arguments
