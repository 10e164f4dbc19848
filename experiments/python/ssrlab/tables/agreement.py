"""How far metrics agree with one another, and with people's judgements: rows for tables, in the form of a study's files."""

import itertools

from ssrlab.csv_files import number, read_rows
from ssrlab.mistakes import ResultsError
from ssrlab.repository import QUESTIONS

# Pairs of images, without names and in an order drawn anew, of which somebody said which is nearer to the truth
# (experiments/python/ssrlab/judge.py).
PAIR = ("shot", "first", "first_point", "second", "second_point")
JUDGEMENTS = str(QUESTIONS / "judgements.csv")


def _by_shot(results, rows):
    """{shot: {metric: {(technique, point): shortfall}}} of the rows that have a value."""
    found = {}
    for row in rows:
        if row["value"]:
            found.setdefault(row["shot"], {}).setdefault(row["metric"], {})[(row["technique"], row["point"])] = results.shortfall(row["metric"], number(row, "value"))
    return found


def kendall_tau(first, second):
    """Kendall's rank correlation of two lists (tau a, of the pairs that neither ties); None where all are tied."""
    concordant = discordant = 0
    for i, j in itertools.combinations(range(len(first)), 2):
        product = (first[i] - first[j]) * (second[i] - second[j])
        concordant += product > 0
        discordant += product < 0
    pairs = concordant + discordant
    return (concordant - discordant) / pairs if pairs else None


def agreement_rows(results, rows):
    """For each shot and pair of metrics: Kendall's tau of their orders of the points."""
    for shot, metrics in _by_shot(results, rows).items():
        for metric, against in itertools.product(metrics, metrics):
            points = [p for p in metrics[metric] if p in metrics[against]]
            tau = kendall_tau([metrics[metric][p] for p in points], [metrics[against][p] for p in points])
            if len(points) > 2 and tau is not None:
                yield {"shot": shot, "metric": metric, "against": against, "value": repr(tau), "low": "", "high": ""}


def read_judgements(file=JUDGEMENTS):
    return read_rows(file)[1]


def _decided(judgements):
    """One judgement for each pair on which all judges agree."""
    pairs = {}
    for judged in judgements:
        pairs.setdefault(tuple(judged[c] for c in PAIR), []).append(judged)
    return [of_pair[0] for of_pair in pairs.values() if len({j["nearer"] for j in of_pair}) == 1 and of_pair[0]["nearer"] in PAIR]


def eye_rows(results, rows, judgements):
    """For each metric and decided pair: 1 if the metric orders the two points like the judgement, else 0."""
    found = _by_shot(results, rows)
    for number, judged in enumerate(_decided(judgements)):
        if judged["shot"] not in found:
            raise ResultsError(f"{JUDGEMENTS} judges {judged['shot']}, of which these results have no rows")
        for metric, values in found[judged["shot"]].items():
            first, second = (values.get((judged[n], judged[n + "_point"])) for n in ("first", "second"))
            if first is None or second is None:
                raise ResultsError(f"{JUDGEMENTS}: pair {number + 1} of {judged['shot']} is not among these results")
            yield {
                "shot": judged["shot"],
                "pair": str(number),
                "metric": metric,
                "what": "pairs ordered alike",
                "value": repr(float((first < second) == (judged["nearer"] == "first"))),
                "low": "",
                "high": "",
            }
