"use strict";
// What the page is made of: the tables that report_data() of experiments/report/report_data.cpp packs, unpacked.

const report = readData();

function readData() {
    const raw = JSON.parse(document.getElementById("data").textContent);
    const t = raw.texts;
    const error = r => ({
        shot: t[r[0]],
        variant: t[r[1]],
        point: t[r[2]],
        target: t[r[3]],
        metric: t[r[4]],
        formula: t[r[5]],
        mask: t[r[6]],
        value: r[7],
        low: r[8],
        high: r[9],
        floor: r[10],
        deviation: r[11],
        seeds: r[12],
        corrected: r[13] === 1,
        pixels: r[14],
        nonFinite: r[15],
        negative: r[16],
        frame: t[r[17]],
        interval: t[r[18]],
        isRanked: r[19] === 1,  // its interval holds all that is random
        litNoise: r[20]
    });
    const split = r => ({
        shot: t[r[0]],
        frame: t[r[1]],
        variant: t[r[2]],
        point: t[r[3]],
        target: t[r[4]],
        mask: t[r[5]],
        seeds: r[6],
        mse: r[7],
        biasSquared: {value: r[8], low: r[9], high: r[10]},
        variance: {value: r[11], low: r[12], high: r[13]}
    });
    const hit = r => ({
        shot: t[r[0]],
        frame: t[r[1]],
        variant: t[r[2]],
        point: t[r[3]],
        stage: t[r[4]],
        mask: t[r[5]],
        quantity: t[r[6]],
        seeds: r[7],
        rays: r[8],
        value: r[9],
        low: r[10],
        high: r[11]
    });
    const effect = r => ({
        shot: t[r[0]],
        variant: t[r[1]],
        point: t[r[2]],
        against: t[r[3]],
        againstVariant: t[r[4]],
        againstPoint: t[r[5]],
        target: t[r[6]],
        metric: t[r[7]],
        formula: t[r[8]],
        mask: t[r[9]],
        seeds: r[10],
        value: r[11],
        low: r[12],
        high: r[13],
        holm: r[14],
        p: r[15],
        interval: t[r[16]],
        isPrimary: r[17] === 1
    });
    const timeEffect = r => ({
        shot: t[r[0]],
        variant: t[r[1]],
        point: t[r[2]],
        against: t[r[3]],
        againstVariant: t[r[4]],
        againstPoint: t[r[5]],
        stage: t[r[6]],
        rounds: r[7],
        value: r[8],
        low: r[9],
        high: r[10]
    });
    const time = r => ({
        shot: t[r[0]],
        variant: t[r[1]],
        point: t[r[2]],
        stage: t[r[3]],
        clock: t[r[4]],
        frames: r[5],
        value: r[6],
        low: r[7],
        high: r[8]
    });
    return {
        isStudy: raw.is_study,  // else the page shows `stability` alone
        stability: raw.stability,  // as experiments/stability/stability_report.h has it; null: none
        manifest: raw.manifest,
        metrics: raw.metrics,
        defaults: raw.defaults,  // variant to {parameter: value}, of those that this build knows
        warnings: raw.warnings,
        notes: raw.notes,
        images: raw.images,
        singleChanges: raw.single_changes,
        headline: raw.headline ?? null,
        answers: raw.answers ?? [],  // what each shot says, in sentences
        errors: raw.errors.map(error),  // those that speak for their shot
        frames: raw.frames.map(error),  // those of each frame, where the ones above are over all of them
        splits: raw.splits.map(split),
        hits: raw.hits.map(hit),
        effects: raw.effects.map(effect),
        timeEffects: raw.time_effects.map(timeEffect),
        times: raw.times.map(time)
    };
}
