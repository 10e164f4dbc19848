// The page of `ssrlab diff --page`: what changed from one run to another, in pictures and numbers. Images of both runs are
// those of two shots, "<shot> (old)" and "<shot> (new)", which the viewer shows beside each other.

const oldShot = shot => `${shot} (old)`, newShot = shot => `${shot} (new)`;
const otherRun = shot => shot.endsWith(" (old)") ? newShot(shot.slice(0, -6)) : oldShot(shot.slice(0, -6));
const isOfChange = number => number.verdict === "changed";

function showDiff() {
    const {diff} = report;
    document.querySelectorAll("nav, main > section:not(#viewer)").forEach(part => part.remove());
    at("subtitle").textContent = `old: ${diff.before}, new: ${diff.after}`;
    at("viewer").before(h(
        "section", {id: "diff"}, h("p", {id: "diff-lead"}, diffLead(diff)), scroller(verdictTable(diff.counts)),
        diff.points.length ? h("h2", {}, "Points that differ") : null,
        diff.points.length ? h("p", {class: "note"}, diffNote(diff)) : null, diff.points.map(diffBlock),
        aloneParts(diff)));
    if (!report.images.length) {
        at("viewer").remove();
        return undefined;
    }
    const first = diff.points.find(p => diffImages(p).every(Boolean));
    return Promise.resolve(showViewer()).then(() => addressedView() || !first ? undefined : openDiff(first));
}

function diffLead(diff) {
    const of = (changed, compared, what) => `${changed} of ${compared} ${what} changed significantly`;
    const pictures = diff.points.filter(p => p.images === "differ").length;
    return [
        of(diff.changed, diff.compared, "errors"),
        diff.compared_times ? of(diff.changed_times, diff.compared_times, "times") : null,
        `images of ${pictures} points differ`
    ].filter(Boolean).join("; ") + ".";
}

const diffNote = diff => [
    "The largest changes first. Pictures are of the shot's last frame, the first seed and the target " +
        `${diff.target}; a click opens both in the viewer below.`,
    diff.without_room ? `The last ${diff.without_room} have no pictures here: a page has room for 30 MB.` : null,
    diff.moved.length ?
        `Times of ${diff.moved.map(m => m[0]).join(", ")} are of different machines and are not compared.` :
        null
].filter(Boolean).join(" ");

function verdictTable(counts) {
    const verdicts = counts[0]?.verdicts.map(v => v.verdict) ?? [];
    return table(
        [{name: "Technique"}, {name: "Numbers", number: true}, ...verdicts.map(name => ({name, number: true}))],
        counts.map(c => [c.technique, cell(c.numbers, String(c.numbers)), ...c.verdicts.map(v => cell(v.count, String(v.count)))]),
        {sortable: true});
}

/// The point's image in both runs; undefined where the page has none.
const diffImages = ({shot, variant, point}) => [oldShot(shot), newShot(shot)].map(of => {
    const index = report.images.findIndex(i => i.shot === of && i.variant === variant && i.point === point);
    return index < 0 ? undefined : {...report.images[index], index};
});

function diffBlock(point) {
    const changed = point.numbers.filter(isOfChange), others = point.numbers.filter(n => !isOfChange(n));
    const pictures = h("div", {class: "diff-pictures"});
    const block = h(
        "section", {class: "diff-point"}, h("h3", {}, `${pointLabel(point)}, ${point.shot}`),
        h("p", {class: "note"}, pointSummary(point, changed)), pictures,
        changed.length ? scroller(numberTable(changed)) : null,
        others.length ? folded(`${others.length} other numbers that are not equal`, scroller(numberTable(others))) : null);
    if (diffImages(point).every(Boolean))
        new IntersectionObserver((entries, observer) => {
            if (!entries.some(e => e.isIntersecting)) return;
            observer.disconnect();
            drawDiffPictures(pictures, point);
        }, {rootMargin: "50%"}).observe(block);
    return block;
}

const pointSummary = (point, changed) => [
    `${changed.length} numbers changed, ${point.equal} are equal`,
    {equal: "images are equal", differ: "images differ", none: "a run has no images of it"}[point.images]
].join("; ") + ".";

function numberTable(numbers) {
    const columns = ["Metric", "Target", "Pixels", "Frame", "Old", "New", "New / old", "p (Holm)", "Verdict", "By"].map(
        (name, i) => ({name, number: i >= 4 && i < 8}));
    const rows = numbers.map(n => [
        n.metric, n.target, n.mask, n.frame, cell(n.before, number(n.before)), cell(n.after, number(n.after)),
        n.before && n.after !== null ? cell(n.after / n.before, number(n.after / n.before)) : "–",
        cell(n.p_holm, number(n.p_holm, 2)), n.verdict, n.how
    ]);
    return table(columns, rows, {sortable: true});
}

async function drawDiffPictures(box, point) {
    const images = diffImages(point), label = `${pointLabel(point)}, ${point.shot}`;
    const canvases = [await answerCanvas(images[0], `${label}, old`), await answerCanvas(images[1], `${label}, new`)];
    if (!canvases.every(Boolean)) return box.replaceChildren(h("p", {class: "note"}, whyNoImages));
    const [before, after] = images.map(i => loadedImages.get(i.index)), hasSize = before.pixels === after.pixels;
    const names = ["Old", "New", "Difference"];
    if (hasSize) {
        const values = scalarsOf(after, before, "absolute"), maximum = sharedMaximum([[after, before]], "absolute");
        const isEqual = values.every(v => v === 0);
        const canvas = h("canvas", {role: "img", "aria-label": `${label}, difference`});
        canvases.push(putPixels(canvas, falseColorPixels(values, after, maximum)));
        names[2] += isEqual ? ": none" : `, 0 to ${number(maximum, 3)} (${scalarModes.absolute.formula})`;
    }
    box.replaceChildren(...canvases.map((canvas, i) => {
        clickable(canvas, () => openDiff(point, true));
        canvas.tabIndex = 0;
        canvas.title = "Open in the viewer";
        return h("figure", {}, h("figcaption", {}, names[i]), canvas);
    }));
}

/// Shows the point of both runs and their truth; differences are those from the old run.
async function openDiff(point, isAsked = false) {
    const key = pointKey(point), beside = newShot(point.shot);
    Object.assign(viewer, {shot: null, beside, baseKey: sameKey, layout: "side", chosen: [truthKey, key, `${beside}|${key}`]});
    if (isAsked) at("viewer").scrollIntoView();
    await chooseShot(oldShot(point.shot));
}

function aloneParts(diff) {
    const columns = [{name: "Shot"}, {name: "Point"}];
    return [["the old run", diff.only_before], ["the new run", diff.only_after]].filter(([, points]) => points.length).map(
        ([where, points]) => folded(
            `${points.length} points of shots in ${where} alone, which are not compared`,
            scroller(table(columns, points.map(([shot, variant, point]) => [shot, pointLabel({variant, point})])))));
}
