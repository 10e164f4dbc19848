// The pictures: what is rendered now, what lies beside it, and a map of errors or of where rays ended.

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
        throw new Error("This picture is gone: a newer one is on its way.");
    }
    const stream = answer.body.pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const image = {...description, pixels: description.width * description.height, scalars: new Map()};
    return description.format === "palette" ? {...image, codes: bytes} :
                                              {...image, halves: decodeHalves(bytes, description)};
}

/// What can be mapped of a shot: errors by the report's modes, and where the rays of each pass ended.
const errorMaps = {
    relative: "relative error",
    absolute: "absolute difference",
    signed: "signed difference",
};
const verdictNames =
    "where rays ended: right green, wrong place orange, false hit red-purple, avoidable miss yellow, unavoidable miss blue, empty grey";

function paintPixels(id, pixels) {
    const canvas = at(id);
    if (canvas.width !== pixels.width || canvas.height !== pixels.height)
        Object.assign(canvas, {width: pixels.width, height: pixels.height});
    canvas.getContext("2d").putImageData(pixels, 0, 0);
}

/// The images of the chosen shot, by label and target; those of a picture that has no numbers yet in the first.
function shownImages(news, shot) {
    const measured = news.result?.shots.find(s => s.shot === shot)?.images ?? {};
    const isFirst = !news.result || news.result.shots[0]?.shot === shot;
    const {picture} = news;
    const isNewer = picture && isFirst && picture.state > (news.result?.state ?? 0);
    return isNewer ? {...picture.images, ...measured, now: picture.images.now} : measured;
}

let painting = 0;

/// Paints all three panes; what is asked for meanwhile is painted in place of it.
async function paintPictures(news, look) {
    const turn = ++painting, images = shownImages(news, look.shot), {target} = look;
    const now = images.now?.[target], truth = images.truth?.[target], other = images[look.beside]?.[target];
    if (!now) return;
    const rays = news.why?.hits[look.map];
    const [own, beside, right, map] =
        await Promise.all([now, other, truth, rays].map(d => d ? loadedImage(d) : Promise.resolve(null)));
    if (turn !== painting) return;
    const table = displayTable(look.exposure, look.curve);
    paintPixels("now", colorPixels(own, table));
    at("now-caption").textContent = news.technique;
    if (beside) paintPixels("other", colorPixels(beside, table));
    at("other-caption").textContent = look.beside === "truth" ? "path-traced truth" : look.beside;
    if (map) {
        paintPixels("errors", categoryPixels(map.codes, map, map.palette));
        at("errors-caption").textContent = verdictNames;
    } else if (right && scalarModes[look.map]) {
        const {title, formula, isSigned} = scalarModes[look.map];
        const base = {...right, index: right.name}, maximum = sharedMaximum([[own, base]], look.map);
        paintPixels("errors", falseColorPixels(scalarsOf(own, base, look.map), own, maximum, isSigned));
        at("errors-caption").textContent = `${title} from the truth, up to ${fourDigits(maximum)}: ${formula}`;
    }
}
