"""The command line of `ssrlab figures`, without what draws them: that takes a second to import."""

import os

from ssrlab import memory
from ssrlab.command_lines import CommandLine


def command_line():
    parser = CommandLine(prog="ssrlab figures", description="Draws figures for papers (PDF, SVG, PNG) from a results folder, and animations of shots in motion (GIF).")
    parser.add_argument("results", help="Results folder that `ssrlab run` filled")
    parser.add_argument("--out", metavar="DIR", help="Output folder; default: figures in the results folder")
    parser.add_argument("--choice", metavar="figures.json", help="File that says which figures are drawn and how they look; the report's viewer writes one with crops. Default: each figure that the results allow, except convergence")
    parser.add_argument("--target", metavar="NAME", help="Target of the error; default: specular")
    parser.add_argument("--metric", metavar="NAME", help="Metric of the error; default: that of the study's primary error, else the first")
    parser.add_argument("--mask", metavar="NAME", help="Mask of the error; default: reflective")
    parser.add_argument("--max-memory", metavar="SIZE", type=memory.size_in_bytes, help=f"Memory that reading an image may take, for example 8GB; default: {memory.VARIABLE}, else half of this machine's memory")
    return parser


def parse_arguments():
    arguments = command_line().parse_args()
    if arguments.max_memory is not None:
        os.environ[memory.VARIABLE] = str(arguments.max_memory)
    return arguments
