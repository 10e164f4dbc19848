// What the page is made of: the tables that report_data() of experiments/report/report_data.cpp packs, unpacked; and how
// shots and points are named.

import {breakable, h} from "../elements/elements.js";
import {list, unique} from "../values.js";

export const report = readData();

function readData() {
    const raw = JSON.parse(document.getElementById("data").textContent);
    const camelCase = name => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
    /// Rows as objects with the columns of the CSV files (experiments/docs/reference/result_columns.md), in camel case.
    const rows = ({columns, texts, rows}) => {
        const isText = columns.map(name => texts.includes(name)), names = columns.map(camelCase);
        return rows.map(r => Object.fromEntries(names.map((name, i) => [name, isText[i] ? raw.texts[r[i]] : r[i]])));
    };
    const error = e => ({...e, deviation: e.seedDeviation, isRanked: e.ranked});
    const split = s => ({
        ...s,
        biasSquared: {value: s.biasSquared, low: s.biasSquaredLow, high: s.biasSquaredHigh},
        variance: {value: s.variance, low: s.varianceLow, high: s.varianceHigh}
    });
    /// With the interval that agrees with the verdict.
    const effect = e =>
        ({...e, value: e.ratio, low: e.lowHolm, high: e.highHolm, holm: e.pHolm, isPrimary: e.family === "primary"});
    const timeEffect = e =>
        ({...e, value: e.ratio, low: e.lowHolm ?? e.low, high: e.highHolm ?? e.high, holm: e.pHolm});
    const time = t => ({...t, value: t.medianMs, low: t.lowMs, high: t.highMs});
    const stability = raw.stability && {
        ...raw.stability,
        cases: rows(raw.stability.cases),
        rows: rows(raw.stability.rows),
        stages: rows(raw.stability.stages)
    };
    return {
        isStudy: raw.is_study,  // else the page shows `stability` alone
        stability,              // null: none
        diff: raw.diff ?? null,  // of the page that `ssrlab diff --page` writes: experiments/report/diff_page.cpp
        manifest: raw.manifest,
        metrics: raw.metrics,
        defaults: raw.defaults,          // technique to {parameter: value}, of those that this build knows
        headline: raw.headline ?? null,  // of studies, as their answers: experiments/results/answers/answers.h
        answers: raw.answers ?? [],
        inTheseScenes: raw.in_these_scenes ?? "",
        inScenesLikeThese: raw.in_scenes_like_these ?? "",
        warnings: raw.warnings,
        notes: raw.notes,
        images: raw.images,
        singleChanges: (raw.manifest.techniques ?? [])
                           .filter(v => v.single_change)
                           .map(v => ({technique: v.technique, point: v.point, ...v.single_change})),
        errors: rows(raw.errors).map(error),  // those that represent their shot
        frames: rows(raw.frames).map(error),  // those of each frame, where the ones above are over all of them
        splits: rows(raw.splits).map(split),
        hits: rows(raw.hits),
        costs: rows(raw.costs),  // a row for each stage, with a column for each quantity
        countSpread: raw.count_spread,  // of the seeds of a point, %
        compiled: rows(raw.compiled),
        estimates: rows(raw.estimates).map(e => ({...e, value: e.microseconds})),
        modelRange: raw.model_range,  // {low, high, text}: what the intervals of estimates leave open
        effects: rows(raw.effects).map(effect),
        timeEffects: rows(raw.time_effects).map(timeEffect),
        times: rows(raw.times).map(time)
    };
}

export const manifestShots = () => list(report.manifest.shots);

/// How the study names points and shots, where it does.
const pointLabels =
    new Map(list(report.manifest.techniques).filter(v => v.label).map(v => [`${v.technique}|${v.point}`, v.label]));

const shotLabels = new Map(list(report.manifest.shots).filter(s => s.label).map(s => [s.shot, s.label]));
export const ownLabel = row => pointLabels.get(`${row.technique}|${row.point}`);

export const pointLabel = row =>
    ownLabel(row) ?? row.technique + (row.point && row.point !== "default" ? " · " + row.point : "");

export const shotLabel = shot => shotLabels.get(shot) ?? shot;
export const shotName = shot => h("span", {class: "shot-name"}, breakable(shotLabel(shot)));
export const pointKey = row => row.technique + "|" + row.point;
export const isSamePoint = (a, b) => a.shot === b.shot && pointKey(a) === pointKey(b);

/// Names of shots as short as they still differ: their scenes, or without the parts that all of them share.
export const shortShot = (() => {
    const shots = unique((report.errors.length ? report.errors : manifestShots()).map(r => r.shot)),
          parts = shot => shot.split(".");
    const areScenesUnique = unique(shots.map(s => parts(s)[0])).length === shots.length;
    const isShared = (part, i) => i > 0 && shots.every(s => parts(s)[i] === part);
    const short = new Map(shots.map(
        s => [s, areScenesUnique ? parts(s)[0] : parts(s).filter((part, i) => !isShared(part, i)).join(".")]));
    return shot => shotLabels.get(shot) ?? short.get(shot) ?? shot;
})();

export const shotExposure = shot => {
    const exposure = manifestShots().find(s => s.shot === shot)?.exposure_ev;
    return Number.isFinite(exposure) ? exposure : 0;
};

export const oldShot = shot => `${shot} (old)`, newShot = shot => `${shot} (new)`;
export const otherRun = shot => shot.endsWith(" (old)") ? newShot(shot.slice(0, -6)) : oldShot(shot.slice(0, -6));
