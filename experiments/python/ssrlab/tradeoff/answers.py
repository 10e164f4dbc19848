"""answers.md: what the rows say, as sentences and tables."""

from ssrlab.tradeoff.rows import RUNGS
from ssrlab.markdown_text import markdown_code, markdown_text
from ssrlab.results import BEHIND, EQUIVALENT

MOST_LISTED = 4


def number(value):
    """Three significant digits."""
    if value is None:
        return ""
    if value == 0:
        return "0"
    text = f"{value:.3g}"
    return text if "e" not in text or abs(value) < 1e-3 else f"{value:.0f}"


def measured(value, low, high):
    if value is None:
        return ""
    ends = f" [{number(low)}, {number(high) if high is not None else '...'}]" if low is not None else ""
    return number(value) + ends


def bound(value, high):
    """Of what is known from above alone: by its interval's upper end, where there is one."""
    return f"at most {number(high)}" if high is not None else f"about {number(value)}"


def listed(names):
    names = list(names)
    shown = names[:MOST_LISTED] + ([f"{len(names) - MOST_LISTED} more"] if len(names) > MOST_LISTED else [])
    return shown[0] if len(shown) == 1 else ", ".join(shown[:-1]) + " and " + shown[-1] if shown else ""


def table(head, rows):
    """`head`: in Markdown; `rows`: of texts as they are."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(markdown_text(c) for c in row) + " |" for row in rows] + [""]


def where(machine):
    """The beginning of a sentence; frozen points need no times, and so no machine."""
    return markdown_text(machine[0].upper() + machine[1:] if machine.startswith("not timed") else f"On {machine}")


class Answers:
    def __init__(self, analysis):
        self.analysis, self.study = analysis, analysis.study
        self.unit = markdown_text(self.study.unit)
        self.shot_labels = {s.name: s.label for s in self.study.shots}
        self.base_label = self.study.label_of(self.study.baseline)
        self.base = markdown_text(self.base_label)

    def text(self):
        parts = [self._head(), self._at_costs(), self._whole(), self._shots(), self._floors(), self._stages()]
        return "\n".join(line for part in parts for line in part).rstrip() + "\n"

    def _head(self):
        study, manifest = self.study, self.study.results.manifest
        title = manifest.get("title") or manifest.get("study", {}).get("name", "")
        lines = [f"# {markdown_text(title)}: error against {'time' if self.study.is_timed else self.unit}", ""]
        if commits := study.commits:
            lines += [f"{markdown_code('ssrlab run ' + manifest['study']['config'])}, commit {markdown_text(commits)}; then `ssrlab tradeoff`.", ""]
        lines.append(
            f"Error: {markdown_text(study.metric)} of {markdown_code(study.target)} over {markdown_code(study.mask)} pixels, {len(study.shots)} shots of "
            f"{len({s.scene for s in study.shots})} scenes; multiples are of the error of {self.base}. In brackets 95 % intervals."
        )
        machines = self.analysis.machines()
        if not machines:
            lines.append("Nothing was timed: errors alone are compared." if self.study.is_timed else f"Nothing has {self.unit}.")
        elif all(row["cost"] is None for row in study.front):
            lines.append("Nothing was timed here: at a time stands what was chosen for it on the scenes of another study.")
        elif self.study.is_timed:
            lines.append(
                f"Times are medians of the sum of a technique's own stages. Taken on {'; '.join(map(markdown_text, machines))}."
                + (" **Times of different machines or sizes are never compared below.**" if len(machines) > 1 else "")
            )
            lines += self._doubts()
        elif study.costs == "estimated":
            lines.append(
                f"{markdown_code(study.unit)}: microseconds that the chip would take for a technique's own stages. **No GPU ran anything**: what is assumed stands in "
                "experiments/gpu_costs/chips/README.md, and no interval holds whether that is so. Those of costs hold the sampling of invocations, and code of which it is not known whether it ran. "
                f"**What the model leaves open is wider**: {study.asked['model_range']}. Two costs closer than {study.asked['model_decides_from']:g} times are not decided, and a point surely fits what it would fit at the range's end."
            )
        else:
            lines.append(f"{markdown_code(self.study.unit)}: counted over a technique's own stages with the first seed. Counts of a point's seeds spread by up to {100 * study.asked['counts_spread']:.2g} %, so that points closer than twice that are not decided; times may order techniques otherwise.")
        lines += [
            f"**{markdown_text(study.label_of(tuple(r['point'])))} has no estimate** in {listed(markdown_text(self.shot_labels[s]) for s in r['shots'])} and is left out there: "
            f"{markdown_text(r['why'])}."
            for r in study.asked["refused"]
        ]
        without = [s.label for s in study.shots if s.divisor is None]
        if without:
            lines.append(
                f"Multiples leave out {', '.join(map(markdown_text, without))}: the error of {self.base} is not known, or too small to divide by."
            )
        if not manifest.get("is_complete", True):
            lines.append("**The study is not complete: shots are missing.**")
        return [*lines, ""]

    def _doubts(self):
        shots = [s for s in self.study.shots if self.analysis.curves[s.name]]
        lines = []
        floor = max((s.floor for s in shots), default=0)
        if floor > 0:
            lines.append(f"Two copies of one point may differ by {100 * floor:.0f} % in a shot: times within that are not distinguishable.")
        if not self.study.has_noise_of_times:
            lines.append("**No point was timed twice**: of their noise only the scatter of frames is known.")
        unproven = [s.label for s in shots if not s.is_clock_proven]
        if unproven:
            lines.append(f"**The timer was not validated in {len(unproven)} of {len(shots)} shots** (manifest.json, `clock`).")
        busy = [p.disturbed_share for s in shots for p in s.judged()]
        if busy and max(busy) > 0:
            lines.append(f"Other work disturbed {100 * sum(busy) / len(busy):.0f} % of the timed frames.")
        return lines

    def _at_costs(self):
        lines = []
        for machine in self.analysis.machines():
            lines += [f"## Which technique at which {'time' if self.study.is_timed else 'cost'}", "", f"{where(machine)}, over scenes. {self._who_stands()}".rstrip(), ""]
            lines += table((self.unit, "least error", f"error / {self.base}", "undecided beside it"), [self._short(machine, c) for c in self.analysis.costs])
            for cost in self.analysis.costs:
                lines += self._at_cost(machine, cost)
        return lines

    def _who_stands(self):
        chosen_on = {c["chosen_on"] for c in self.study.chosen.values() if c["point"]}
        if chosen_on == {"frozen"}:
            return "Each technique stands at the point that was chosen for it on the scenes of another study (`frozen`)."
        return "Some points were chosen on the scenes of another study (`frozen`), others here." if "frozen" in chosen_on else ""

    def _rows_at(self, machine, cost, group=""):
        return [r for r in self.study.across if (r.get("machine"), r.get("cost"), r["group"]) == (machine, cost, group)]

    def _groups_at(self, machine, cost):
        """Each technique in each group of shots, where the study has several."""
        groups = list(dict.fromkeys(r["group"] for r in self.study.across if r["group"]))
        if not groups:
            return []
        of_group = {g: self._rows_at(machine, cost, g) for g in groups}
        head = ("technique", *(f"{g} ({max((r['scenes'] for r in of_group[g]), default=0)})" for g in groups))
        cells = []
        for variant in dict.fromkeys(r["variant"] for r in self._rows_at(machine, cost)):
            own = [next((r for r in of_group[g] if r["variant"] == variant), None) for g in groups]
            cells.append((variant, *(r and f"{self._place(r)}{measured(r['ratio'], r['low'], r['high'])}; {number(r['median'])}" or "" for r in own)))
        return ["", f"In each group (scenes): error / {self.base}, geometric mean with its interval, then the median. Not behind: best, undecided beside the least, or within the margin of it.", "", *table(head, cells)]

    @staticmethod
    def _place(row):
        return "not behind: " if row["standing"] and row["standing"] != BEHIND else ""

    def _short(self, machine, cost):
        rows = self._rows_at(machine, cost)
        first = next((r for r in rows if r["rank"] == 1), None)
        if first is None or first["label"] == self.base_label:
            return number(cost), "none that fits in all scenes", "", ""
        near = [r["label"] for r in rows if r["rank"] and r is not first and r["standing"] != BEHIND]
        return number(cost), first["label"], measured(first["ratio"], first["low"], first["high"]), ", ".join(near)

    def _at_cost(self, machine, cost):
        rows = self._rows_at(machine, cost)
        lines = [f"### {number(cost)} {self.unit}", ""]
        if not rows:
            return [*lines, "No point fits in any scene.", ""]
        of_scenes = rows[0]["of_scenes"]
        first = next((r for r in rows if r["rank"] == 1), None)
        lines.append(self._first_sentence(first, rows, of_scenes))
        partly = [r for r in rows if r["scenes"] < of_scenes]
        if partly:
            lines.append(
                "Not ranked, since they do not fit everywhere: "
                + "; ".join(f"{markdown_text(r['label'])} ({r['scenes']} of {of_scenes} scenes, there {measured(r['ratio'], r['low'], r['high'])} of {self.base}'s error)" for r in partly)
                + "."
            )
        absent = {v for c in self.analysis.curves.values() for v in c} - {r["variant"] for r in rows}
        if absent:
            lines.append(f"In no scene fit {markdown_text(listed(sorted(absent)))}.")
        fits = ["" if r["scenes_that_fit"] is None else f"{r['scenes_that_fit']} of {of_scenes}" for r in rows]
        return [*lines, "", *self._ranking("technique", rows, "surely fits in scenes", fits), *self._groups_at(machine, cost)]

    def _ranking(self, what, rows, last, of_last):
        """Rows of across.csv as a table; `last`: the head of its last column, `of_last`: what stands there."""
        cells = [
            (
                r["label"],
                r["rank"] and f"{r['rank']} ({r['rank_low']} to {r['rank_high']})" or "",
                measured(r["ratio"], r["low"], r["high"]),
                measured(r["median"], r["median_low"], r["median_high"]),
                measured(r["against_best"], r["against_best_low"], r["against_best_high"]),
                number(r["p_holm"]),
                "" if r["chance_first"] is None else f"{r['chance_first']:.2f}",
                "" if r["chance_near"] is None else f"{r['chance_near']:.2f}",
                measured(r["scenes_needed"], r["scenes_needed_low"], r["scenes_needed_high"]),
                r["wins"],
                r["shared"],
                own,
            )
            for r, own in zip(rows, of_last)
        ]
        head = (what, "rank (without any one scene)", f"error / {self.base}", "median of it", "error / first's", "p (adjusted)", "probability to be first", "within 10 %", "scenes that 10 % need", "shots won", "shots shared", last)
        return table(head, cells)

    def _first_sentence(self, first, rows, of_scenes):
        if first is None or (first["ratio"] == 1 and first["label"] == self.base_label):
            return f"No technique fits in all {of_scenes} scenes" + (f" with less error than {self.base}." if first else ".")
        others = [r for r in rows if r["rank"] and r is not first]
        beaten = [r for r in others if r["standing"] == BEHIND]
        near = [r for r in others if r["standing"] == EQUIVALENT]
        open_ones = [r for r in others if r not in beaten and r not in near]
        text = f"**{markdown_text(first['label'])}** has the least error, {measured(first['ratio'], first['low'], first['high'])} of that of {self.base} (geometric mean, {first['scenes']} scenes)"
        if not others:
            return text + "; nothing else fits in all of them."
        text += ". "
        if first["low"] is None:
            return text + f"Of other scenes {first['scenes']} scenes say nothing."
        if first["standing"] == "best":
            return text + "In scenes like these the rest is behind for certain (adjusted for all comparisons, 0.05)."
        text += f"In scenes like these the least on average is {self._chances(rows, 'chance_first')} (probability); within 10 % of the least {self._chances(rows, 'chance_near')}."
        if near:
            text += f" Within the margin of the first for certain: {markdown_text(listed(r['label'] for r in near))}."
        if open_ones:
            text += f" Undecided beside the first: {markdown_text(listed(r['label'] for r in open_ones))}."
        if beaten:
            text += f" Behind for certain: {markdown_text(listed(r['label'] for r in beaten))}."
        return text

    @staticmethod
    def _chances(rows, name):
        likely = sorted((r for r in rows if r[name] is not None), key=lambda r: -r[name])
        named = [r for i, r in enumerate(likely) if i == 0 or (i < 3 and r[name] >= 0.02)]
        return listed(f"{markdown_text(r['label'])} with {r[name]:.2f}" for r in named)

    def _whole(self):
        rows = [r for r in self.study.across if r.get("cost") is None and not r["group"]]
        if not rows:
            return []
        lines = ["## Least error at any cost", "", self._first_sentence(next((r for r in rows if r["rank"] == 1), None), rows, rows[0]["of_scenes"]), ""]
        return lines + self._ranking("point", rows, "scenes", [r["scenes"] for r in rows])

    def _shots(self):
        lines = []
        if self.analysis.machines():
            lines = ["## Each shot", "", "A technique is its variant: all of its points make its front. Curves between two of them are interpolated (logarithmic): nothing was run there.", ""]
        for shot in self.study.shots:
            if not self.analysis.curves[shot.name]:
                continue
            lines += [f"### {markdown_text(shot.label)}", "", self._front_sentence(shot), ""]
            lines += self._costs_table(shot) + self._errors_table(shot)
        return lines

    def _front_sentence(self, shot):
        rows = sorted((r for r in self.study.front if r["shot"] == shot.name and r["cost"] is not None), key=lambda r: r["cost"])
        at = lambda r: f"{markdown_text(r['label'])} ({measured(r['cost'], r['cost_low'], r['cost_high'])} {self.unit}, {measured(r['error'], r['error_low'], r['error_high'])})"  # noqa: E731
        sure = [r for r in rows if r["verdict"] == "front"]
        maybe = [r for r in rows if r["verdict"] == "undecided"]
        beaten = [r for r in rows if r["verdict"] == "dominated"]
        text = f"Certainly on the front: {', '.join(at(r) for r in sure)}. " if sure else "No point is certainly on the front. "
        if maybe:
            text += f"Undecided: {', '.join(markdown_text(r['label']) for r in maybe)}. "
        return text + f"{len(beaten)} points are dominated." if beaten else text.strip()

    def _costs_table(self, shot):
        rows = [r for r in self.analysis.error_at_cost if r["shot"] == shot.name]
        by = {(r["variant"], r["cost"]): r for r in rows}
        costs = self.analysis.costs
        cells = []
        for variant, curve in self._curves(shot):
            ends = f"{number(curve.start)} to {number(curve.end)}"
            cells.append((variant, ends, *(self._error_text(by[variant, c]) for c in costs)))
        return table(("technique", f"measured at ({self.unit})", *(f"error at {number(c)} {self.unit}" for c in costs)), cells)

    def _curves(self, shot):
        """Those of more than the baseline alone."""
        curves = self.analysis.curves[shot.name].items()
        return [(v, c) for v, c in curves if [p.key for p in c.points] != [self.study.baseline]]

    def _error_text(self, row):
        if row.get("error") is None:
            return f"below {number(row['start'])} no point was measured" + (" (may fit)" if row["fits"] == "maybe" else "")
        if row["status"] == "past end":
            text = f"{bound(row['error'], row['high'])}, reached at {number(row['end'])}"
        else:
            text = measured(row["error"], row["low"], row["high"])
        return text + ("" if row["fits"] == "surely" else " (may not fit)")

    def _errors_table(self, shot):
        rows = [r for r in self.analysis.cost_to_error if r["shot"] == shot.name]
        if not rows:
            return []
        by = {(r["variant"], r["factor"]): r for r in rows}
        factors = self.analysis.factors
        cells = [
            (v, *(self._cost_text(by[v, f]) for f in factors)) for v, _ in self._curves(shot)
        ]
        of = {f: next(r["error"] for r in rows if r["factor"] == f) for f in factors}
        return table(("technique", *(f"{self.unit} to {number(f)} of {self.base}'s error ({number(of[f])})" for f in factors)), cells)

    def _cost_text(self, row):
        if row["status"] == "not reached":
            return f"{'not' if row['share_that_reach'] < 0.025 else 'perhaps not'} reached by {number(row['end'])}"
        if row["status"] == "before start":
            return f"{bound(row['cost'], row['high'])}, its cheapest"
        return measured(row["cost"], row["low"], row["high"]) if row["low"] is not None else bound(row["cost"], row["high"])

    def _floors(self):
        if not self.analysis.fits and not self.analysis.limits:
            return []
        lines = [f"## What more {'time' if self.study.is_timed else self.unit} cannot improve", ""]
        return lines + self._limits() + self._fits()

    def _limits(self):
        rows = [r for r in self.analysis.limits if r["rung"] == RUNGS[0]]
        if not rows:
            return []
        clear = [r for r in rows if r.get("over_rung_high") is not None]
        above = [r for r in clear if r["over_rung_low"] > 1]
        lines = [
            f"`{RUNGS[0]}` is the lower bound for any single-frame technique: all that the image shows is found, and elsewhere the environment is seen. Only what earlier frames showed, or luck, goes below it. "
            + (f"The least error of all points is significantly above it in {len(above)} of the {len(clear)} shots in which it is significantly above 0: there better techniques are possible." if clear else ""),
            "",
        ]
        cells = [
            (self.shot_labels[r["shot"]], r["label"], number(r["cost"]), measured(r["error"], r["error_low"], r["error_high"]), measured(r["rung_error"], r["rung_low"], r["rung_high"]), measured(r.get("over_rung"), r.get("over_rung_low"), r.get("over_rung_high")))
            for r in rows
        ]
        return lines + table(("shot", "least error", self.unit, "its error", f"`{RUNGS[0]}`", f"error / `{RUNGS[0]}`"), cells)

    def _fits(self):
        rows = self.analysis.fits
        if not rows:
            return []
        lines = ["error = floor + a cost^-b along each axis of quality: the floor is a lower bound along that axis alone, at any cost.", ""]
        axes = {}
        for r in rows:
            axes.setdefault(f"{r['variant']} {r['fixed']}".strip() + f" along {r['parameter']}", []).append(r)
        for axis, of_axis in axes.items():
            floors = [r for r in of_axis if r["floor_low"]]
            above = [r for r in floors if (r.get("floor_over_rung_low") or 0) > 1]
            lines.append(
                f"- {markdown_text(axis)}: a floor is significantly above 0 in {len(floors)} of {len(of_axis)} shots" + (f", and above {markdown_code(above[0]['rung'])} in {len(above)}" if above else "") + "."
            )
        lines.append("")
        cells = []
        for axis, of_axis in axes.items():
            for r in of_axis:
                ends = f"{number(r.get('cost_from'))} to {number(r.get('cost_to'))}"
                over = measured(r.get("floor_over_rung"), r.get("floor_over_rung_low"), r.get("floor_over_rung_high"))
                fitted = (measured(r["floor"], r["floor_low"], r["floor_high"]), over, measured(r["b"], r["b_low"], r["b_high"]), number(r["misfit"]))
                cells.append((axis, self.shot_labels[r["shot"]], r["points"], ends, *fitted, r["status"]))
        return lines + table(("axis", "shot", "points", self.unit, "floor", "floor / rung", "b", "misfit", "status"), cells)

    def _stages(self):
        rows = self.study.stages
        if not rows:
            return []
        lines = ["## What each change gains and costs", ""]
        lines.append(
            "Points that differ in one parameter. A stage that is switched off may *save cost* and add error. The last column is the cost of each percent of error."
        )
        lines.append("")
        for machine in dict.fromkeys(r["machine"] for r in rows):
            own = [r for r in rows if r["machine"] == machine]
            pooled = [r for r in own if not r["shot"] and r["error_low"] is not None]
            changes = {self._change_key(r) for r in pooled}
            single = [r for r in own if r["shot"] and self._change_key(r) not in changes]
            lines += [f"On {markdown_text(machine)}{', over scenes: geometric mean of the ratios of errors, mean of the costs' if pooled else ''}:", ""]
            lines += self._stage_table("scenes", pooled)
            if single:
                lines += ["In each shot, since three scenes or fewer are too few for an interval:", ""] + self._stage_table("shot", single)
        return lines

    @staticmethod
    def _change_key(row):
        return row["variant"], row["point"], row["against_variant"], row["against_point"]

    def _stage_table(self, first, rows):
        cells = [
            (
                f"{self.study.label_of((r['against_variant'], r['against_point']))}: {r['change']}",
                self.shot_labels[r["shot"]] if first == "shot" else r["scenes"],
                measured(*(None if v is None else 100 * (v - 1) for v in (r["error_ratio"], r["error_low"], r["error_high"]))),
                measured(r["cost"], r["cost_low"], r["cost_high"]),
                r["verdict"],
                measured(r["cost_per_percent"], r["cost_per_percent_low"], r["cost_per_percent_high"]),
            )
            for r in sorted(rows, key=self._change_key)
        ]
        head = ("change", first, "% more error", f"{self.unit} more", "verdict", f"{self.unit} per % of error")
        return table(head, cells) if cells else []
