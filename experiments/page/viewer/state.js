// What the viewer shows: which images of which methods, and how.

import {scalarModes} from "../images/differences.js";
import {byShot, ofShot, pointKey, pointLabel, report, shotLabel} from "../study/data.js";
import {isLadderRung} from "../study/ladder.js";
import {unique} from "../values.js";
import {loadedImages} from "./page_images.js";

export const truthKey = "reference";
export const sameKey = "same point";  // of viewer.shot, as what images of the shot beside it are compared with

export const viewer = {
    shot: null,
    beside: null,  // a shot whose images can be shown with those of `shot`
    frame: null,
    target: null,
    mode: "color",
    layout: "side",
    hasErrorRow: false,
    exposure: 0,
    curve: "none",
    scale: 0,
    methods: [],        // of shot and frame, the truth first, each followed by that of the shot beside it
    chosen: null,       // keys of methods, in the order in which they are shown; kept from shot to shot
    shown: [],          // {method, image} of those whose image is there
    baseKey: truthKey,  // of what differences are taken against
    active: 0,
    previous: 1,
    splitAt: 0.5,
    panes: [],
    pinned: null,
    pointed: null,
    drag: null,
    request: 0,     // counts choices, so that a slow one does not replace a later one
    choices: null,  // what the controls of shot, target and images were made for
    isPlaying: false,
    address: null,  // that shows the same again; null before anything is shown
    keeping: 0      // the timer that puts it into the address bar
};

export const firstShown = 6;
export const isError = mode => scalarModes[mode]?.isError ?? false;
export const truthMethod = () => viewer.methods.find(m => m.key === truthKey);

/// What is shown of a method; rungs of the truth ladder are compared with what arrives.
export const resultIndex = method =>
    method?.results[method.key === truthKey || !isLadderRung(viewer.target) ? viewer.target : "incident"];

/// Of what the target `image` shows: visible differences are of no other.
export const jodMap = method => viewer.target === "image" ? loadedImages.get(method.jod) : undefined;
export const resultOf = method => loadedImages.get(resultIndex(method));
export const truth = () => resultOf(truthMethod());

/// Of the images that are shown those of `viewer.shot` itself.
export const shownOfShot = () => viewer.shown.filter(s => s.method.shot === viewer.shot);

/// What a method's differences are taken against; where that is the truth, that of its own shot.
export const baseMethod = method => viewer.methods.find(
    viewer.baseKey === truthKey     ? m => m.own === truthKey && m.shot === method.shot :
        viewer.baseKey === sameKey ? m => m.own === method.own && m.shot === viewer.shot :
                                     m => m.key === viewer.baseKey);

export const baseOf = method => resultOf(baseMethod(method)) ?? truth();

/// Whether there is such a difference to look at.
export const hasBase = ({method, image}) => baseOf(method) !== undefined && image !== baseOf(method);
export const frameOf = image => image.frame ?? 0;

/// All images of a shot's frame by method: {shot, own: its key in the shot, key: its key in the viewer, label, technique,
/// point, results: {target: index}, confidence: index, jod: index, verdicts: [{stage, index}],
/// roughness: index}.
export function methodsOf(shot, frame) {
    const methods = new Map();
    for (const image of ofShot(report.images, shot)) {
        if (frameOf(image) !== frame) continue;
        const {index} = image;
        const isTruth = image.technique === truthKey;
        const key = isTruth ? truthKey : pointKey(image);
        if (!methods.has(key))
            methods.set(key, {
                shot,
                own: key,
                key,
                label: isTruth ? "truth" : pointLabel(image),
                technique: image.technique,
                point: image.point,
                results: {},
                verdicts: []
            });
        const method = methods.get(key);
        if (image.kind === "hits")
            method.verdicts.push({stage: image.target, index});
        else if (image.kind === "confidence")
            method.confidence = index;
        else if (image.kind === "surface")
            method.roughness = index;
        else if (image.kind === "jod")
            method.jod = index;
        else
            method.results[image.target] = index;
    }
    return [...methods.values()].sort((a, b) => (b.key === truthKey) - (a.key === truthKey));
}

const firstImage = shot => ofShot(report.images, shot)[0];

/// The shots whose images fit beside those of `shot`.
export const shotsBeside = shot => [...byShot(report.images).keys()].filter(other => {
    const [a, b] = [firstImage(shot), firstImage(other)];
    return other !== shot && a.width === b.width && a.height === b.height;
});

/// What of a shot's name another has not.
export const ownWords = (shot, other) => {
    const words = name => name.split(/[. ()]+/);
    return words(shot).filter(word => !words(other).includes(word)).join(" ") || shotLabel(shot);
};

export const besideKey = own => `${viewer.beside}|${own}`;

/// methodsOf() the shot, and of the one beside it the same frame, or its last.
export function allMethods(frame) {
    const {shot, beside} = viewer;
    if (!beside) return methodsOf(shot, frame);
    const named = (method, ofShot, other) => ({...method, label: `${method.label}, ${ownWords(ofShot, other)}`});
    const own = methodsOf(shot, frame).map(m => named(m, shot, beside)), frames = framesOf(beside);
    const others = methodsOf(beside, frames.includes(frame) ? frame : frames.at(-1))
                       .map(m => named({...m, key: besideKey(m.own)}, beside, shot));
    const alone = others.filter(m => !own.some(o => o.own === m.own));
    return [...own.flatMap(m => [m, ...others.filter(o => o.own === m.own)]), ...alone];
}

export const framesOf = shot => unique(ofShot(report.images, shot).map(frameOf)).sort((a, b) => a - b);
export const targetsOf = methods => unique(methods.flatMap(m => Object.keys(m.results)));
