"""The files of a search in its folder: tune.csv, presets.json, tuned.md, and the figure search.pdf, .svg and .png."""

import json
import math
import os

from ssrlab.figures import style
from ssrlab.figures.numbers import with_interval
from ssrlab.figures.placed_labels import place_labels
from ssrlab import statistics
from ssrlab.csv_files import write_lines
from ssrlab.markdown_text import markdown_code, markdown_text
from ssrlab.mistakes import counted, say
from ssrlab.results import Measured
from ssrlab.text_files import path_inside, whole_file, write_text

FASTER = 1.1  # a point that is this much faster than the baseline is worth a name though it errs more


def ratio_of(difference):
    """A difference of logarithms as a ratio with its 95 % interval."""
    half = difference.half_width()
    return Measured(*(math.exp(difference.mean + s * half) for s in (0, -1, 1)))


def times(budgets):
    return ", ".join(f"{b:g}x" for b in budgets)


class Outcome:
    def __init__(self, tuning, judged):
        self.tuning, self.race, self.studies = tuning, tuning.race, tuning.studies
        self.results, self.found = judged
        self.points = {**tuning.points, **{p.name: p for p in tuning.tried}}
        self.unit = "" if not self.studies.has_time else "ms" if self.studies.has_clock else f"us on {self.studies.cost}, estimated" if self.studies.is_estimated else self.studies.cost

    def write(self):
        self.write_csv()
        self.write_presets()
        self.write_page()
        if self.studies.has_time:
            self.draw()
        complete = sum(not p.stopped for p in self.tuning.tried)
        say(
            f"{counted(len(self.tuning.tried), 'point')} tried, {complete} of them in full: {counted(self.tuning.runs(), 'run')} in place of "
            f"{self.tuning.runs_of_a_point() * len(self.points)}; {os.path.join(self.tuning.out, 'tuned.md')}"
        )

    def log_time(self, point):
        return point.estimate[1] if point.estimate else self.race.log_time(point)

    def write_csv(self):
        axes = [axis.name for axis in self.tuning.space.axes]
        with whole_file(self.file("tune.csv")) as temporary, open(temporary, "w", newline="", encoding="utf-8") as stream:
            lines = [["point", "batch", "stopped", "shots", "runs", "ratio", "low", "high", "time", *axes]]
            for point in self.points.values():
                error = ratio_of(self.race.error(point)) if point.errors else Measured("", "", "")
                row = [point.name, point.batch, point.stopped, len(point.shots()), point.runs(), error.value, error.low, error.high]
                values = [point.values.get(name, "") if point.values else point.parameters.get(name, "") for name in axes]  # none of them: beside a program
                lines.append(row + ["" if point.refusal or not self.studies.has_time else math.exp(self.log_time(point))] + [json.dumps(v) if isinstance(v, bool) else v for v in values])
            write_lines(stream, lines)

    def file(self, name):
        return path_inside(self.tuning.out, name)

    def changes(self, point):
        """The parameters that differ from the technique's defaults."""
        return {k: v for k, v in point.parameters.items() if v != self.tuning.declared[k].get("default")}

    def unseen(self, name):
        """(ratio of errors to the baseline's over the judging scenes, their number, ratio of times or None); None where nothing was judged."""
        if self.results is None or name == self.tuning.baseline:
            return None
        logs = [(shot.get("asset") or shot["scene"], math.log(row.value)) for shot, rows in self.unseen_rows(name) for row in rows.values() if row]
        if not logs:
            return None
        value, low, high, count = statistics.geometric_mean_over_scenes(logs)
        scene_of = {shot["shot"]: shot.get("asset") or shot["scene"] for shot in self.results.manifest["shots"]}
        taken = self.studies.times_of(self.results, self.point_of(name)).items() if self.studies.has_time else []
        time = statistics.geometric_mean_over_scenes([(scene_of[shot], math.log(ratio)) for shot, (ratio, _) in taken])[:3] if taken else None
        return Measured(value, low, high), count, Measured(*time) if time else None

    def point_of(self, name):
        return next(v["point"] for v in self.results.manifest["techniques"] if v.get("label") == name)

    def unseen_rows(self, name):
        """(shot, {metric: ratio to the baseline with its interval, or None}) of each judging shot."""
        point = self.point_of(name)
        chosen = [
            r
            for r in self.results.effects
            if r["point"] == point and r["against"] == "baseline" and (r["target"], r["mask"]) == (self.studies.target, self.studies.mask)
        ]
        for shot in self.results.manifest["shots"]:
            rows = {r["metric"]: r for r in chosen if r["shot"] == shot["shot"]}
            yield shot, {m: self.results.measured(rows[m], ("ratio", "low", "high")) if m in rows else None for m in self.studies.metrics}

    def write_presets(self):
        """Writes presets.json, as tables of techniques read it (variants/registry.h). Left out are the config's own points, which have
        names, and points that are neither faster than the baseline nor significantly better, or worse on unseen scenes."""
        presets = []
        for name, budgets in self.found.items():
            point = self.points[name]
            searched, judged = ratio_of(self.race.error(point)), self.unseen(name)
            is_faster = self.race.log_time(point) < -math.log(FASTER)
            is_better = searched.high < 1 and (judged is None or judged[0].value < 1)
            if name in self.tuning.points or not (is_faster or is_better):
                continue
            word, scenes_of_search = self.time_word(), len(self.studies.shots)
            base = f"`{self.tuning.baseline}`"
            within = f" within {times(budgets)} the {word} of {base}" if self.studies.has_time else ""

            def said(error, time):
                return f"error and {word} are {error} and {time} times those of {base}" if time else f"the error is {error} times the error of {base}"

            time_of_search = f"{math.exp(self.race.log_time(point)):.2f}" if within else ""
            text = f"for low error{within}, found by `ssrlab tune`. On the {counted(scenes_of_search, 'scene')} of the search, {said(with_interval(searched), time_of_search)}"
            if judged:
                text += f". On {counted(judged[1], 'other scene')}, {said(with_interval(judged[0]), judged[2] and with_interval(judged[2]))}"
            name = f"best_{min(budgets):g}x" if self.studies.has_time else "best"
            preset = {"technique": self.tuning.searched, "name": name, "description": text}
            presets.append(preset | {"parameters": self.changes(point)})
        write_text(self.file("presets.json"), json.dumps({"presets": presets}, indent=2) + "\n")

    def about_time(self):
        if not self.studies.has_time:
            return "time: not measured, the program's own"
        baseline = markdown_code(self.tuning.baseline)
        open_range = f"; an estimate, of which no interval holds what its model leaves open: {statistics.MODEL_RANGE_TEXT}" if self.studies.is_estimated else ""
        return f"{self.time_word()}: likewise (that of {baseline}: {self.tuning.baseline_cost:.4g} {self.unit}; on the scenes of the search without an interval){open_range}"

    def time_cell(self, ratio):
        return f"{ratio:.3f}" if self.studies.has_time else "not measured"

    def time_word(self):
        return "time" if self.studies.has_clock else f"estimated time on {self.studies.cost}" if self.studies.is_estimated else self.studies.cost

    def write_page(self):
        tuning = self.tuning
        error = f"{' and '.join(self.studies.metrics)} ({self.studies.target}, {self.studies.mask})"
        lines = [
            f"# Tuned: {tuning.searched}",
            "",
            f"Error: {error}, as a multiple of that of {markdown_code(tuning.baseline)}, geometric mean over scenes; {self.about_time()}. In brackets 95 % intervals: of the scenes of the search by "
            "the seeds and the reference's noise, for these scenes as they are; of unseen ones by how they differ among each other, none below "
            "4 scenes.",
            "",
            f"{counted(len(tuning.tried), 'point')} {'was' if len(tuning.tried) == 1 else 'were'} tried, {sum(not p.stopped for p in tuning.tried)} of them in full, in {counted(tuning.runs(), 'run')} of one seed in one "
            f"shot ({tuning.runs_of_a_point() * len(self.points)} without stopping any). The least of many measured errors looks smaller than it is; "
            "that on unseen scenes does not.",
            "",
            "## Found",
            "",
            f"| within | point | error, searched | {self.time_word()} | error, unseen | {self.time_word()}, unseen |",
            "|---|---|---|---|---|---|",
        ]
        for budget in tuning.budgets:
            name = next((n for n, budgets in self.found.items() if budget in budgets), None)
            lines.append(f"| {budget:g}x | " + (" | ".join(map(markdown_text, self.cells(name))) if name else "no point is so fast | | | |") + " |")
        lines += ["", "## Beside", "", f"| point | error, searched | {self.time_word()} | error, unseen | {self.time_word()}, unseen |", "|---|---|---|---|---|"]
        lines += [f"| {' | '.join(map(markdown_text, self.cells(name)))} |" for name in tuning.names]
        lines += ["", "## The front", "", f"| {self.time_word()} | error | point | differs from {markdown_text(tuning.start)} in |", "|---|---|---|---|"]
        for point in self.race.front():
            differs = ", ".join(f"{k} = {json.dumps(v)}" for k, v in point.values.items() if tuning.space.start[k] != v)
            lines.append(f"| {self.time_cell(math.exp(self.race.log_time(point)))} | {with_interval(ratio_of(self.race.error(point)))} | {markdown_text(point.name)} | {markdown_text(differs)} |")
        lines += self.unseen_lines()
        write_text(self.file("tuned.md"), "\n".join(lines) + "\n")

    def cells(self, name):
        point, judged = self.points[name], self.unseen(name)
        cells = [name, with_interval(ratio_of(self.race.error(point))), self.time_cell(math.exp(self.race.log_time(point)))]
        if name == self.tuning.baseline:
            time = "1" if self.studies.has_time else self.time_cell(1)
            return [name, "1", time] + (["1", time] if self.results else ["", ""])
        return cells + ([with_interval(judged[0]), with_interval(judged[2]) if judged[2] else ""] if judged else ["", ""])

    def unseen_lines(self):
        if self.results is None:
            return ["", 'No scenes were named to judge on (`"judge"`).']
        names = [n for n in dict.fromkeys([*self.tuning.names, *self.found]) if n != self.tuning.baseline]
        lines = ["", "## Unseen scenes", "", f"| shot | metric | {' | '.join(map(markdown_text, names))} |", "|---|---|" + "---|" * len(names)]
        of_points = {name: dict((shot["shot"], rows) for shot, rows in self.unseen_rows(name)) for name in names}
        for shot in (s["shot"] for s in self.results.manifest["shots"]):
            for metric in self.studies.metrics:
                found = [of_points[name][shot][metric] for name in names]
                lines.append(f"| {markdown_text(self.results.shot_label(shot))} | {metric} | {' | '.join(with_interval(m) if m else '' for m in found)} |")
        return lines

    def draw(self):
        style.apply()
        figure, (axes,) = style.panels(1, height=6.5)
        place = lambda p: (math.exp(self.log_time(p)), math.exp((p.estimate or (self.race.error(p).mean,))[0]))  # noqa: E731
        stopped = [place(p) for p in self.tuning.tried if p.stopped]
        complete = [p for p in self.tuning.tried if not p.stopped]
        if stopped:
            axes.plot(*zip(*stopped), "x", color="#999999", markersize=3, label="stopped", zorder=2)
        for name, points, mark, color in (
            ("tried in full", [p for p in complete if p.name not in self.found], "o", style.COLORS[5]),
            ("named in the config", [self.points[n] for n in self.tuning.names], "s", style.COLORS[0]),
            ("found", [self.points[n] for n in self.found], "D", style.COLORS[1]),
        ):
            for index, point in enumerate(points):
                error = ratio_of(self.race.error(point))
                x, y = place(point)
                bars = [[max(y - error.low, 0)], [max(error.high - y, 0)]]
                axes.errorbar(x, y, yerr=bars, fmt=mark, color=color, label=name if index == 0 else None, zorder=3)
        slowest = max(place(p)[0] for p in self.points.values())
        front = [place(p) for p in self.race.front()]
        front.append((max(slowest, front[-1][0]), front[-1][1]))  # more time buys nothing
        axes.step(*zip(*front), where="post", color="#444444", label="front", zorder=1)
        axes.set_xlabel(f"{self.time_word()} / {self.time_word()} of {self.tuning.baseline}")
        axes.set_ylabel(f"error / error of {self.tuning.baseline}")
        style.log_axis(axes.xaxis), style.log_axis(axes.yaxis)
        style.draw_legend(figure, [axes])
        labels = {name: (name, style.COLORS[0]) for name in self.tuning.names}
        labels |= {name: (f"within {times(budgets)}", style.COLORS[1]) for name, budgets in self.found.items()}
        covered = [(x0, y0, x1, y0) for (x0, y0), (x1, _) in zip(front, front[1:])] + [(x1, y0, x1, y1) for (_, y0), (x1, y1) in zip(front, front[1:])]
        covered += [2 * place(p) for p in self.tuning.tried]
        place_labels(axes, [(*place(self.points[name]), text, style.darker(color)) for name, (text, color) in labels.items()], covered)
        style.save(figure, self.tuning.out, "search")
