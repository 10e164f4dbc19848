// Rungs of the truth ladder: where targets, and their own errors, which bound what one frame shows.

import {manifestShot, manifestShots, ofShot} from "./data.js";
import {better, metricKey} from "./errors.js";
import {choice} from "./points.js";
import {list, unique} from "../values.js";

export const isLadderRung = target => target === "camera_radiance" || target === "on_screen";

/// Errors of the rungs in one shot, of its last frame.
export const ladderOf = (shot, {target, metricKey: key, mask}) =>
    list(manifestShot(shot)?.truth_ladder)
        .filter(r => r.target === target && metricKey(r) === key && r.mask === mask);

/// Errors of the rungs against the chosen target, under the chosen mask, as rows like those of techniques; of the last
/// frame alone.
export function ladderRows(key) {
    return manifestShots().flatMap(
        shot => ladderOf(shot.shot, {target: choice.target, metricKey: key, mask: choice.mask})
                    .map(r => ({
                             ...r,
                             shot: shot.shot,
                             frame: String(shot.frame),
                             isRanked: false,
                             technique: "truth ladder",
                             point: r.rung + (list(shot.frames).length > 1 ? ", last frame" : ""),
                             floor: null,
                             corrected: better(r.metric) === "lower",
                             seeds: null,
                             deviation: null,
                             nonFinite: 0
                         })));
}

/// The rows of each shot, and then its rungs.
export const besideTheirShots = (rows, ladder) =>
    unique(rows.map(r => r.shot)).flatMap(shot => [rows, ladder].flatMap(part => ofShot(part, shot)));
