// What the study answers for each shot, and which shot and point the reader looks at.

import {pointLabel, report} from "./data.js";

export const answerChoice = {
    shot: null,
    point: null,   // {technique, point}; null: the best of the shot
    request: null  // the last drawing of pictures, so that a slow one does not replace a later one
};

export const answerOf = shot => report.answers.find(a => a.shot === shot);

/// Label of what the answer calls the baseline; undefined where it has none.
export const baselineLabel = shot => {
    const baseline = answerOf(shot)?.baseline;
    return baseline ? pointLabel(baseline) : undefined;
};

export const chosenPoint = () => answerChoice.point ?? answerOf(answerChoice.shot)?.best;
