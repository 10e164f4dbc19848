// The pictures: what is rendered now, what lies beside it, and a map of errors or of where rays ended.

import {at, swatch} from "../elements/elements.js";
import {categoryPixels, colorPixels, displayTable, falseColorPixels, putPixels} from "../images/colors.js";
import {scalarModes, scalarsOf, sharedMaximum} from "../images/differences.js";
import {decodeHalves, inflatedStream} from "../images/packed.js";
import {verdicts} from "../study/verdicts.js";
import {number} from "../values.js";

const decoded = new Map();  // by name: a promise of an image
const mostDecoded = 24;

/// A promise of what PageImages has under the name, with `halves` or `codes` as the report's viewer has them.
function loadedImage(description) {
    const {name} = description;
    if (!decoded.has(name)) {
        decoded.set(name, fetchedImage(description));
        if (decoded.size > mostDecoded) decoded.delete(decoded.keys().next().value);
    }
    return decoded.get(name);
}

async function fetchedImage(description) {
    const answer = await fetch("image/" + description.name);
    if (!answer.ok) {
        decoded.delete(description.name);
        throw new Error("This picture is outdated. A newer picture follows.");
    }
    const bytes = await inflatedStream(answer.body);
    const image = {...description, pixels: description.width * description.height, scalars: new Map()};
    return description.format === "palette" ? {...image, codes: bytes} :
                                              {...image, halves: decodeHalves(bytes, description)};
}

/// Modes of images/differences.js that a shot can be mapped by.
export const errorMaps = ["relative", "absolute", "signed"];

/// The images of the chosen shot, by label and target; those of a picture that has no numbers yet in the first.
export function shownImages(news, shot) {
    const measured = news.result?.shots.find(s => s.shot === shot)?.images ?? {};
    const isFirst = !news.result || news.result.shots[0]?.shot === shot;
    const {picture} = news;
    const isNewer = picture && isFirst && picture.state > (news.result?.state ?? 0);
    return isNewer ? {...picture.images, ...measured, now: picture.images.now} : measured;
}

let painting = 0;

/// Paints all three panes; what is asked for meanwhile is painted in place of it.
export async function paintPictures(news, look) {
    const turn = ++painting, images = shownImages(news, look.shot), {target} = look;
    const now = images.now?.[target], truth = images.truth?.[target], other = images[look.beside]?.[target];
    if (!now) return;
    const rays = news.why?.hits[look.map];
    const [own, beside, right, map] =
        await Promise.all([now, other, truth, rays].map(d => d ? loadedImage(d) : Promise.resolve(null)));
    if (turn !== painting) return;
    const table = displayTable(look.exposure, look.curve);
    putPixels(at("now"), colorPixels(own, table));
    at("now-caption").textContent = news.technique;
    if (beside) putPixels(at("other"), colorPixels(beside, table));
    at("other-caption").textContent = look.beside === "truth" ? "path-traced truth" : look.beside;
    if (map) {
        putPixels(at("errors"), categoryPixels(map.codes, map, map.palette));
        at("errors-caption").replaceChildren(
            "where rays ended: ", ...verdicts.flatMap(v => [swatch(v.color), `${v.name} `]));
    } else if (right && scalarModes[look.map]) {
        const {title, formula, isSigned} = scalarModes[look.map];
        const base = {...right, index: right.name}, maximum = sharedMaximum([[own, base]], look.map);
        putPixels(at("errors"), falseColorPixels(scalarsOf(own, base, look.map), own, maximum, isSigned));
        at("errors-caption").textContent = `${title} from the truth, up to ${number(maximum)}: ${formula}`;
    }
}
