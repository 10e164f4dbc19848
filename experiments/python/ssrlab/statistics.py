"""Statistics of numbers that scripts choose, as ssrlab itself computes them: asked of the program, so that each is written once
(experiments/cli/statistics_command.cpp). One process answers all questions of a script, some 20 microseconds each."""

import functools
import json
import math
import os
import subprocess

from ssrlab.mistakes import Fault

HERE = os.path.dirname(os.path.abspath(__file__))
BUILT = os.path.join(HERE, "../../../build/release/ssrlab")


def program():
    """That which started the script, else the one that was built beside it."""
    found = os.environ.get("SSRLAB_PROGRAM") or BUILT
    if not os.path.exists(found):
        raise Fault(f"{os.path.normpath(found)} is missing: build ssrlab, or name the program in SSRLAB_PROGRAM")
    return found


@functools.cache
def _answering():
    return subprocess.Popen([program(), "statistics"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def _ask(question, values, **options):
    process = _answering()
    try:
        process.stdin.write(json.dumps({"ask": question, "values": values} | options) + "\n")
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
    except (OSError, ValueError) as e:
        raise Fault(f"{program()} statistics ended, or is another program than this script's; build ssrlab anew") from e
    if isinstance(answer, dict):
        raise ValueError(f"{question}: {answer['error']}")
    return answer


def mean_over_scenes(values):
    """(mean, low, high, scenes) of (asset, value) pairs, one for each shot; no ends below four scenes."""
    return tuple(_ask("mean_over_scenes", [[asset, float(v)] for asset, v in values]))


def geometric_mean_over_scenes(logarithms):
    """(ratio, low, high, scenes) of (asset, ln ratio) pairs."""
    *ends, scenes = mean_over_scenes(logarithms)
    return (*(None if v is None else math.exp(v) for v in ends), scenes)


def bootstrap_over_scenes(values, seed=1):
    """(low, high) of the mean, each None where there is none."""
    return tuple(_ask("bootstrap_over_scenes", [float(v) for v in values], seed=seed))


def mean(values):
    """(mean, low, high) by Student's t, of two values or more."""
    return tuple(_ask("mean", [float(v) for v in values]))


def p_holm(effects, degrees):
    """p-values of "the mean is 0" of (mean, half width of its 95 % interval by Student's t of so many degrees of freedom) pairs, adjusted
    together (Holm)."""
    return _ask("p_holm", [[float(mean), float(half)] for mean, half in effects], degrees=degrees)


@functools.cache
def model_range():
    """(low, high, sentence): by so many times a stage's measured time was its estimate (experiments/gpu_costs/chips/model_range.h)."""
    return tuple(_ask("model_range", []))


@functools.cache
def counts_spread():
    """By how much the counts of a point's seeds spread at most (experiments/results/tables/counts_spread.h), relative."""
    return _ask("counts_spread", [])[0]


def median(values):
    """(median, low, high) of values in order of time."""
    return tuple(_ask("median", [float(v) for v in values]))


def sign_factor(values):
    """By how much more than those of independent values the signs of these, in order of time, scatter about their median."""
    return _ask("sign_factor", [float(v) for v in values])[0]
