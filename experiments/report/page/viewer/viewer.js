// The viewer: which images are shown, and how.

const truthKey = "reference";
const sameKey = "same point";  // of viewer.shot, as what images of the shot beside it are compared with
const viewer = {
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

const firstShown = 6;
const isError = mode => scalarModes[mode]?.isError ?? false;
const truthMethod = () => viewer.methods.find(m => m.key === truthKey);
/// What is shown of a method; rungs of the truth ladder are compared with what arrives.
const resultIndex = method =>
    method?.results[method.key === truthKey || !isLadderRung(viewer.target) ? viewer.target : "incident"];
const resultOf = method => loadedImages.get(resultIndex(method));
const truth = () => resultOf(truthMethod());
/// Of the images that are shown those of `viewer.shot` itself.
const shownOfShot = () => viewer.shown.filter(s => s.method.shot === viewer.shot);
/// What a method's differences are taken against; where that is the truth, that of its own shot.
const baseMethod = method => viewer.methods.find(
    viewer.baseKey === truthKey     ? m => m.own === truthKey && m.shot === method.shot :
        viewer.baseKey === sameKey ? m => m.own === method.own && m.shot === viewer.shot :
                                     m => m.key === viewer.baseKey);
const baseOf = method => resultOf(baseMethod(method)) ?? truth();
/// Whether there is such a difference to look at.
const hasBase = ({method, image}) => baseOf(method) !== undefined && image !== baseOf(method);
const frameOf = image => image.frame ?? 0;

/// All images of a shot's frame by method: {shot, own: its key in the shot, key: its key in the viewer, label, variant,
/// point, results: {target: index}, confidence: index, verdicts: [{stage, index}], roughness: index}.
function methodsOf(shot, frame) {
    const methods = new Map();
    report.images.forEach((image, index) => {
        if (image.shot !== shot || frameOf(image) !== frame) return;
        const isTruth = image.variant === truthKey;
        const key = isTruth ? truthKey : pointKey(image);
        if (!methods.has(key))
            methods.set(key, {
                shot,
                own: key,
                key,
                label: isTruth ? "truth" : pointLabel(image),
                variant: image.variant,
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
        else
            method.results[image.target] = index;
    });
    return [...methods.values()].sort((a, b) => (b.key === truthKey) - (a.key === truthKey));
}

const firstImage = shot => report.images.find(i => i.shot === shot);
/// The shots whose images fit beside those of `shot`.
const shotsBeside = shot => unique(report.images.map(i => i.shot)).filter(other => {
    const [a, b] = [firstImage(shot), firstImage(other)];
    return other !== shot && a.width === b.width && a.height === b.height;
});
/// What of a shot's name another has not.
const ownWords = (shot, other) => {
    const words = name => name.split(/[. ()]+/);
    return words(shot).filter(word => !words(other).includes(word)).join(" ") || shotLabel(shot);
};
const besideKey = own => `${viewer.beside}|${own}`;

/// methodsOf() the shot, and of the one beside it the same frame, or its last.
function allMethods(frame) {
    const {shot, beside} = viewer;
    if (!beside) return methodsOf(shot, frame);
    const named = (method, ofShot, other) => ({...method, label: `${method.label}, ${ownWords(ofShot, other)}`});
    const own = methodsOf(shot, frame).map(m => named(m, shot, beside)), frames = framesOf(beside);
    const others = methodsOf(beside, frames.includes(frame) ? frame : frames.at(-1))
                       .map(m => named({...m, key: besideKey(m.own)}, beside, shot));
    const alone = others.filter(m => !own.some(o => o.own === m.own));
    return [...own.flatMap(m => [m, ...others.filter(o => o.own === m.own)]), ...alone];
}

/// What can stay beside `shot`; of two runs the other one of it.
function keepBeside(shot) {
    const before = viewer.beside, wanted = report.diff ? otherRun(shot) : before;
    viewer.beside = shotsBeside(shot).includes(wanted) ? wanted : null;
    if (!before || !viewer.beside) return;
    viewer.chosen = viewer.chosen?.map(key => key.startsWith(before + "|") ? besideKey(key.slice(before.length + 1)) : key);
}

/// Shows the same points of another shot beside those that are shown; null: of none.
function chooseBeside(shot) {
    const chosen = viewer.chosen.filter(key => !viewer.beside || !key.startsWith(besideKey("")));
    if (!shot && viewer.baseKey === sameKey) viewer.baseKey = truthKey;
    viewer.beside = shot;
    viewer.chosen = shot ? chosen.flatMap(own => [own, besideKey(own)]) : chosen;
    return chooseFrame(viewer.frame);
}

const framesOf = shot => unique(report.images.filter(i => i.shot === shot).map(frameOf)).sort((a, b) => a - b);
const targetsOf = methods => unique(methods.flatMap(m => Object.keys(m.results)));

function showViewer() {
    if (!report.images.length) {
        at("viewer").append(h("p", {class: "note"}, "This study has no images."));
        return;
    }
    if (!hasInflate) {
        at("viewer").append(h("p", {class: "note"}, whyNoImages));
        return;
    }
    at("viewer").append(
        ...report.notes.map(text => h("p", {class: "warning", role: "note"}, text)),
        h("p", {class: "warning", id: "viewer-problem", role: "alert", hidden: true}),
        h("div", {class: "controls", id: "viewer-choice"}),
        h("div", {class: "controls", id: "viewer-time", hidden: true}),
        h("div", {class: "controls", id: "viewer-look"}), h("div", {id: "viewer-images"}),
        h("div", {class: "controls", id: "viewer-pair", hidden: true}),
        h("p", {class: "sr-only", id: "viewer-status", role: "status"}), h("div", {class: "panes", id: "panes"}),
        h("div", {id: "viewer-crop", hidden: true}),  // below the images, which stay where the pointer is
        h("div", {id: "viewer-legend"}), h("div", {class: "scroll", id: "readout", "aria-live": "off"}), keyHelp());
    const addressed = addressedView();
    if (addressed) restoreChoice(addressed);
    showLook();
    addEventListener("keydown", viewerKey);
    new ResizeObserver(drawAll).observe(at("panes"));
    const first = report.images.find(i => i.shot === answerChoice.shot) ?? report.images[0];
    const start = () => viewer.shot === null ? chooseShot(first.shot) : undefined;
    addEventListener("hashchange", () => addressedView() && location.reload());
    if (addressed) return chooseShot(addressed.get("shot")).then(() => restoreView(addressed));
    if (!report.images.some(i => i.file)) return start();
    // Images beside the page are loaded when the viewer is about to be seen.
    new IntersectionObserver((entries, observer) => {
        if (!entries.some(e => e.isIntersecting)) return;
        observer.disconnect();
        start();
    }, {rootMargin: "50%"}).observe(at("viewer"));
}

/// For the other sections: scrolls to the viewer and shows truth and points (as pointLabel() names them) side by side.
/// Points without images in this shot are left out. Resolves when they are there; false: nothing of them can be shown.
async function openViewer({shot, points = [], target}) {
    if (!framesOf(shot).length || !at("viewer-choice")) return false;
    const own = methodsOf(shot, framesOf(shot).at(-1));
    const wanted =
        own.filter(m => points.includes(m.label)).sort((a, b) => points.indexOf(a.label) - points.indexOf(b.label));
    viewer.chosen = [truthKey, ...wanted.map(m => m.key)];
    viewer.beside = null;
    viewer.layout = "side";
    viewer.target = target ?? viewer.target;
    at("viewer").scrollIntoView();
    await chooseShot(shot);
    viewer.panes[0]?.canvas.focus({preventScroll: true});
    return true;
}

const shotExposure = shot => {
    const exposure = manifestShots().find(s => s.shot === shot)?.exposure_ev;
    return Number.isFinite(exposure) ? exposure : 0;
};

function chooseShot(shot) {
    if (shot !== viewer.shot) {
        keepBeside(shot);
        Object.assign(viewer, {shot, pinned: null, pointed: null, frame: framesOf(shot).at(-1)});
        Object.assign(view, {x: 0.5, y: 0.5, zoom: 1});
        setScale(0);
        setExposure(shotExposure(shot));
        clearCropBox();
    }
    showTime();
    return chooseFrame(viewer.frame);
}

function chooseFrame(frame) {
    viewer.frame = frame;
    viewer.methods = allMethods(frame);
    const targets = targetsOf(viewer.methods);
    viewer.target = preferred(targets, viewer.target ?? "image");
    const compared = viewer.methods.filter(m => m.shot === viewer.shot && (m.key === truthKey || !isSingleChange(m)));
    if (!viewer.methods.some(m => viewer.chosen?.includes(m.key))) viewer.chosen = firstKeys(compared);
    const choices = JSON.stringify([viewer.shot, viewer.beside, viewer.target, targets, viewer.methods.map(m => m.key)]);
    if (viewer.choices !== choices) showChoiceOfImages(targets);  // else the reader keeps filter and focus
    viewer.choices = choices;
    return showImages();
}

/// The truth and those of the least error, in the study's order.
function firstKeys(methods) {
    const errors =
        new Map(headlineRows(viewer.shot, headline.metric).map(r => [pointKey(r), badness(r.metric, r.value)]));
    const place = m => m.key === truthKey ? -Infinity : errors.get(m.key) ?? Infinity;
    const first = [...methods].sort((a, b) => compareCells(place(a), place(b), true)).slice(0, firstShown);
    return methods.filter(m => first.includes(m)).map(m => m.key);
}

/// What is to be there before the current choice can be painted.
function neededImages() {
    const chosen = viewer.methods.filter(m => viewer.chosen.includes(m.key));
    const methods = [...chosen, ...chosen.map(baseMethod), truthMethod()].filter(Boolean);
    const needed = methods.map(resultIndex);
    if (viewer.mode === "confidence") needed.push(...methods.map(m => m.confidence));
    if (viewer.mode === "rays" || viewer.mode === "cause")
        needed.push(...methods.flatMap(m => m.verdicts.map(v => v.index)));
    if (viewer.mode === "cause") needed.push(...ladderIndices());
    return unique(needed.filter(i => i !== undefined));
}

/// Loads what is chosen, and shows it.
async function showImages() {
    const request = ++viewer.request;
    const missing = neededImages().some(i => !loadedImages.has(i)), isFlip = viewer.mode === "flip";
    at("panes").setAttribute("aria-busy", missing || isFlip);
    await loadImages(neededImages());
    if (request !== viewer.request) return;  // another choice was made meanwhile
    setShown();
    if (isFlip)
        for (const {method, image} of viewer.shown.filter(hasBase)) {
            scalarsOf(image, baseOf(method), "flip");  // takes seconds for two megapixels
            await new Promise(resolve => setTimeout(resolve));
            if (request !== viewer.request) return;
        }
    at("panes").setAttribute("aria-busy", "false");
    layOut();
    if (viewer.pinned) loadForInspector();
}

function setShown() {
    const before = [viewer.active, viewer.previous].map(i => viewer.shown[i]?.method.key);
    viewer.shown = viewer.chosen.map(key => viewer.methods.find(m => m.key === key))
                       .filter(m => m && resultOf(m))
                       .map(method => ({method, image: resultOf(method)}));
    const place = (key, other) => {
        const found = viewer.shown.findIndex(s => s.method.key === key);
        return found < 0 ? Math.min(other, Math.max(viewer.shown.length - 1, 0)) : found;
    };
    viewer.active = place(before[0], 0);
    viewer.previous = place(before[1], 1);
    if (viewer.previous === viewer.active && viewer.shown.length > 1) viewer.previous = viewer.active ? 0 : 1;
}

/// `keys` are shown from now on, the truth first, then in the study's order.
function setChosen(keys) {
    const isWanted = new Set(keys);
    viewer.chosen = viewer.methods.filter(m => isWanted.has(m.key)).map(m => m.key);
    showChosenImages();
    return showImages();
}

function showImageProblem(text) {
    at("viewer-problem").textContent = text;
    at("viewer-problem").hidden = false;
}

function setLayout(layout) {
    viewer.layout = layout;
    layOut();
    viewer.panes[0]?.canvas.focus({preventScroll: true});
}

/// At most; few images share two rows, so that they are large.
const paneColumns = count => count <= 3 ? Math.max(count, 1) : count <= 10 ? Math.ceil(count / 2) : 6;

/// Makes the panes that the layout asks for: one per image, with that of its error below it if asked for.
function layOut() {
    const {layout, shown} = viewer;
    for (const name of ["side", "flip", "split"]) at("layout-" + name).setAttribute("aria-pressed", layout === name);
    at("panes").classList.toggle("single", layout !== "side");
    at("panes").style.setProperty("--columns", paneColumns(shown.length));
    if (shown.length) at("panes").style.setProperty("--aspect", shown[0].image.width / shown[0].image.height);
    showChosenImages();
    showPair();
    showCrops();
    const wantedOf = item => {
        const hasError = viewer.hasErrorRow && hasBase(item);
        return [{item, mode: viewer.mode}, ...(hasError ? [{item, mode: "absolute"}] : [])];
    };
    const current = shown[viewer.active];
    const columns = layout === "side" ? shown.map(wantedOf) :
        !current                      ? [] :
        layout === "flip"             ? [wantedOf(current)] :
                                        [[{item: current, mode: viewer.mode, other: shown[viewer.previous]}]];
    const wanted = columns.flat();
    const focused = viewer.panes.findIndex(p => p.canvas === document.activeElement);
    while (viewer.panes.length < wanted.length) viewer.panes.push(newPane());
    viewer.panes.length = wanted.length;
    viewer.panes.forEach((pane, i) => Object.assign(pane, {wanted: wanted[i]}));
    at("panes").replaceChildren(...columns.map(
        column => h("div", {}, viewer.panes.filter(p => column.includes(p.wanted)).map(p => p.element))));
    if (focused >= 0) (viewer.panes[focused] ?? viewer.panes[0])?.canvas.focus({preventScroll: true});
    paint();
}

/// What a mode shows of an image: {pixels, note}; `maximum` of a mode is its false-colour scale.
function pictureOf({method, image}, mode, table, maximumOf) {
    const inColor = note => ({pixels: colorPixels(image, table), note});
    if (mode === "nearest")
        return method.key === truthKey ? {pixels: nearestMap().pixels, note: "nearest method"} : inColor("");
    if (mode === "cause") return method.shot === viewer.shot && causePicture(method, image) || inColor("");
    if (mode === "rays") return verdictPicture(method) ?? inColor(method.key === truthKey ? "" : "no verdicts");
    if (mode === "confidence") {
        const own = loadedImages.get(method.confidence);
        if (!own) return inColor(method.key === truthKey ? "" : "no confidence");
        return {
            pixels: falseColorPixels(Float32Array.from(own.codes, (_, i) => pixelByte(own, i)), own, 1),
            note: "confidence"
        };
    }
    if (mode === "color" || isError(mode) && !hasBase({method, image})) return inColor("");
    const {title, isSigned} = scalarModes[mode], values = scalarsOf(image, baseOf(method), mode);
    return {pixels: falseColorPixels(values, image, maximumOf(mode), isSigned), note: title};
}

/// Fills the panes' pictures anew: colours depend on mode, exposure, curve and scale.
function paint() {
    lossMaps.clear();
    const table = displayTable(viewer.exposure, viewer.curve), maxima = {};
    const maximumOf = mode => maxima[mode] ??= 2 ** viewer.scale *
        sharedMaximum(
            viewer.shown.filter(s => !isError(mode) || hasBase(s)).map(s => [s.image, baseOf(s.method)]), mode);
    for (const pane of viewer.panes) {
        const {item, mode, other} = pane.wanted;
        const picture = pictureOf(item, mode, table, maximumOf);
        const second = other ? pictureOf(other, mode, table, maximumOf) : null;
        const place = viewer.shown.indexOf(item);
        const caption = [
            place < 9 ? h("kbd", {}, String(place + 1)) : "", item.method.label,
            second ? " | " + other.method.label : "",
            picture.note || second?.note ? h("small", {}, " " + (picture.note || second.note)) : ""
        ];
        setPane(pane, item.image, picture.pixels, second?.pixels, caption, viewer.target);
    }
    showLegend(maximumOf);
    drawAll();
}

function drawAll() {
    for (const pane of viewer.panes)
        if (pane.image) drawPane(pane, {pinned: viewer.pinned, splitAt: viewer.splitAt, box: crops.box});
    showReadout();
    keepAddress();
}
