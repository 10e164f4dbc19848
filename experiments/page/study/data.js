// What the page is made of: the tables that report_data() of experiments/report/report_data.cpp packs, unpacked; and how
// shots and points are named.

import {breakable, h} from "../elements/elements.js";
import {grouped, list, unique} from "../values.js";

export const report = readData();

function readData() {
    const raw = JSON.parse(document.getElementById("data").textContent);
    const camelCase = name => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
    /// Rows with the columns of the CSV files (experiments/docs/reference/result_columns.md), in camel case, and what
    /// `more` adds: functions of a row's place, made of those of the columns. A row reads its columns when it is asked:
    /// copies of hundreds of thousands take a browser seconds.
    const rows = ({count, columns, texts}, more = () => ({})) => {
        const text = values => Array.isArray(values) ? values.map(i => raw.texts[i]) : raw.texts[values];
        const own = Object.fromEntries(Object.entries(columns).map(([name, values]) => {
            const list = texts.includes(name) ? text(values) : values;
            return [camelCase(name), Array.isArray(list) ? i => list[i] : () => list];
        }));
        class Row {
            constructor(place) { this.place = place; }
            toJSON() { return Object.fromEntries(Object.keys(own).map(name => [name, this[name]])); }
        }
        for (const [name, valueAt] of Object.entries({...own, ...more(own)}))
            Object.defineProperty(Row.prototype, name, {get() { return valueAt(this.place); }});
        return Array.from({length: count}, (_, place) => new Row(place));
    };
    const error = own => ({deviation: own.seedDeviation, isRanked: own.ranked});
    const split = own => ({
        biasSquared: i => ({value: own.biasSquared(i), low: own.biasSquaredLow(i), high: own.biasSquaredHigh(i)}),
        variance: i => ({value: own.variance(i), low: own.varianceLow(i), high: own.varianceHigh(i)})
    });
    /// With the interval that agrees with the verdict.
    const effect = own => ({
        value: own.ratio,
        low: own.lowHolm,
        high: own.highHolm,
        holm: own.pHolm,
        isPrimary: i => own.family(i) === "primary"
    });
    const timeEffect = own => ({
        value: own.ratio,
        low: i => own.lowHolm(i) ?? own.low(i),
        high: i => own.highHolm(i) ?? own.high(i),
        holm: own.pHolm
    });
    const time = own => ({value: own.medianMs, low: own.lowMs, high: own.highMs});
    const {images, notes} = JSON.parse(document.getElementById("image-list").textContent);
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
        verdict: raw.verdict ?? null,  // {headline, sentences} of `ssrlab judge`
        inTheseScenes: raw.in_these_scenes ?? "",
        inScenesLikeThese: raw.in_scenes_like_these ?? "",
        warnings: raw.warnings,
        notes,
        images: images.map((image, index) => ({...image, index})),
        singleChanges: (raw.manifest.techniques ?? [])
                           .filter(v => v.single_change)
                           .map(v => ({technique: v.technique, point: v.point, ...v.single_change})),
        errors: rows(raw.errors, error),  // those that represent their shot
        frames: rows(raw.frames, error),  // those of each frame, where the ones above are over all of them
        splits: rows(raw.splits, split),
        hits: rows(raw.hits),
        costs: rows(raw.costs),  // a row for each stage, with a column for each quantity
        countSpread: raw.count_spread,  // of the seeds of a point, %
        compiled: rows(raw.compiled),
        estimates: rows(raw.estimates, own => ({value: own.microseconds})),
        modelRange: raw.model_range,  // {low, high, text}: what the intervals of estimates leave open
        effects: rows(raw.effects, effect),
        timeEffects: rows(raw.time_effects, timeEffect),
        times: rows(raw.times, time)
    };
}

export const manifestShots = () => list(report.manifest.shots);

/// A row with other values in some columns, or more of them.
export const changedRow = (row, values) => Object.create(row, Object.getOwnPropertyDescriptors(values));

const shotsOf = new WeakMap();  // of lists that were asked for

/// The rows by shot, in the order in which shots first come. A list is gone through once: it must not change.
export function byShot(rows) {
    if (!shotsOf.has(rows)) shotsOf.set(rows, grouped(rows, r => r.shot));
    return shotsOf.get(rows);
}
export const ofShot = (rows, shot) => byShot(rows).get(shot) ?? [];
export const manifestShot = shot => ofShot(manifestShots(), shot)[0];

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
    const shared = parts(shots[0] ?? "").map((part, i) => i > 0 && shots.every(s => parts(s)[i] === part));
    const short =
        new Map(shots.map(s => [s, areScenesUnique ? parts(s)[0] : parts(s).filter((_, i) => !shared[i]).join(".")]));
    return shot => shotLabels.get(shot) ?? short.get(shot) ?? shot;
})();

export const shotExposure = shot => {
    const exposure = manifestShot(shot)?.exposure_ev;
    return Number.isFinite(exposure) ? exposure : 0;
};

export const oldShot = shot => `${shot} (old)`, newShot = shot => `${shot} (new)`;
export const otherRun = shot => shot.endsWith(" (old)") ? newShot(shot.slice(0, -6)) : oldShot(shot.slice(0, -6));
