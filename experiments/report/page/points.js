// The points that a study compares: which are shown, and the number, colour and shape that each keeps on the page.

/// What the page shows first: the error that a study compares by, and what an eye sees; manifests of other versions
/// may lack it.
const headline = Object.fromEntries(
    Object.entries({metric: "mse", mask: "reflective", target: "specular", perceptual_metric: "flip", margin: 0.05})
        .map(([key, usual]) => [key, report.headline?.[key] || usual]));

const pointKey = row => row.variant + "|" + row.point;
const singleChangeKeys = new Set(report.singleChanges.map(pointKey));
const isSingleChange = row => singleChangeKeys.has(pointKey(row));
const isSamePoint = (a, b) => a.shot === b.shot && pointKey(a) === pointKey(b);

/// Of a capture without truth, which has no errors, those that it ran.
const allPoints = [...new Map((report.errors.length ? report.errors : list(report.manifest.variants))
                                  .map(r => [pointKey(r), {variant: r.variant, point: r.point}]))
                       .values()];
const comparedPoints = allPoints.filter(p => !isSingleChange(p));
const places = new Map(allPoints.map((p, i) => [pointKey(p), i]));
const variants = unique(allPoints.map(p => p.variant));
const mostNamed = 30;  // more names than that cover each other
/// The point's name at a mark, no longer than it takes to differ from the others.
const markName = (() => {
    const count = variant => comparedPoints.filter(p => p.variant === variant).length;
    const techniques = variants.filter(v => v !== "none");
    return row => ownLabel(row) ??
        (count(row.variant) === 1    ? row.variant :
             techniques.length === 1 ? row.point :
                                       pointLabel(row));
})();

/// What the reader chose to see. `hidden`: keys of points that legends switched off.
const shownPoints = {
    filter: "",
    sort: "study",
    isGrouped: false,
    relativeTo: "best",  // or none: what cells of the matrix are divided by
    colourBy: comparedPoints.length <= mostNamed ? "point" : "variant",
    // A grid has holes without them; a list of changes to a baseline is shown by its effects.
    hasSingleChanges: comparedPoints.some(p => (p.point.match(/=/g) ?? []).length > 1),
    hidden: new Set()
};

const parametersByPoint = new Map(list(report.manifest.variants).map(v => [pointKey(v), v.parameters ?? {}]));
const parametersOf = row => parametersByPoint.get(pointKey(row)) ?? {};

const groupsByPoint = new Map(list(report.manifest.variants).map(v => [pointKey(v), v.group ?? ""]));
const groupOf = row => groupsByPoint.get(pointKey(row)) ?? "";
const pointGroups = unique(allPoints.map(groupOf));

/// Names of parameters in which points of one variant differ.
const sweptParameters = (() => {
    const swept = new Map();
    for (const variant of variants) {
        const all = allPoints.filter(p => p.variant === variant).map(parametersOf);
        const names = unique(all.flatMap(Object.keys));
        swept.set(variant, names.filter(name => unique(all.map(p => JSON.stringify(p[name]))).length > 1));
    }
    return swept;
})();

const mostParameters = 8;  // in a tip
/// For tips: the parameters that differ among the points of the variant; a swept point's name has them already.
function parameterLines(row) {
    if (row.point.includes("=")) return [];
    const names = sweptParameters.get(row.variant) ?? [], parameters = parametersOf(row);
    const shown = names.slice(0, mostParameters), rest = names.length - shown.length;
    return [
        ...shown.map(name => `${name} = ${JSON.stringify(parameters[name])}`),
        ...(rest ? [`and ${rest} more parameters, see Parameters`] : [])
    ];
}
/// What the point is, for tips: its name, and those parameters.
const pointText = row => [pointLabel(row), ...parameterLines(row)].join("\n");

const mayShow = row => shownPoints.hasSingleChanges || !isSingleChange(row);
/// By what is read, and by what results are keyed by.
const matchesFilter = row => {
    const names = `${pointLabel(row)} ${row.variant} ${row.point} ${groupOf(row)}`.toLowerCase();
    return shownPoints.filter.toLowerCase().split(/\s+/).every(word => names.includes(word));
};
/// Rows of the points that the reader has not filtered out.
const filteredRows = rows => rows.filter(r => mayShow(r) && matchesFilter(r));
/// Those of them that no legend switched off: what charts draw.
const chartedRows = rows => filteredRows(rows).filter(r => !shownPoints.hidden.has(pointKey(r)));

const symbolNames = ["circle", "square", "triangle", "diamond", "star", "cross", "wye", "hexagon"];

/// Eight colours and eight shapes: shape and colour shift against each other, so that 64 pairs differ.
const seriesStyle = index =>
    ({color: `var(--s${index % 8})`, symbol: symbolNames[(index + Math.floor(index / 8)) % 8]});

/// The distinct values of a swept parameter, numbers in ascending order.
const valuesOf = name => unique(allPoints.map(p => parametersOf(p)[name]).filter(v => v !== undefined))
                             .sort((a, b) => typeof a === "number" ? a - b : String(a).localeCompare(String(b)));

/// From the first value to the last one: cividis, which looks alike with and without defects of colour vision.
function parameterStyle(name, value) {
    const values = valuesOf(name), place = values.indexOf(value);
    if (place < 0) return {color: "var(--faint)", symbol: "wye"};
    const share = values.length > 1 ? place / (values.length - 1) : 0;
    const scale = Plot.scale({color: {type: "linear", domain: [0, 1], scheme: "cividis"}});
    return {color: scale.apply(0.05 + 0.9 * share), symbol: symbolNames[place % 8], hasOutline: true};
}

function styleOf(row) {
    const by = shownPoints.colourBy;
    if (by === "point") return seriesStyle(places.get(pointKey(row)));
    if (by === "variant") return seriesStyle(variants.indexOf(row.variant));
    if (by === "group") return seriesStyle(pointGroups.indexOf(groupOf(row)));
    return parameterStyle(by, parametersOf(row)[by]);
}

/// [{label, keys, style}]: what colours and shapes stand for, of the points of `rows`.
function legendGroups(rows) {
    const points = [...new Map(rows.map(r => [pointKey(r), r])).values()], by = shownPoints.colourBy;
    const name = p => by === "point" ? pointLabel(p) :
        by === "variant"             ? p.variant :
        by === "group"               ? groupOf(p) || "no group" :
        by in parametersOf(p)        ? `${by} = ${JSON.stringify(parametersOf(p)[by])}` :
                                       `without ${by}`;
    const ordered = ["point", "variant", "group"].includes(by) ?
        points :
        [...points].sort((a, b) => compareCells(parametersOf(a)[by] ?? null, parametersOf(b)[by] ?? null, true));
    const groups = new Map();
    for (const p of ordered) {
        if (!groups.has(name(p))) groups.set(name(p), {label: name(p), keys: [], style: styleOf(p)});
        groups.get(name(p)).keys.push(pointKey(p));
    }
    return [...groups.values()];
}

/// What draws anew when filter, legend or colours change.
const pointListeners = [];
const pointsChanged = () => pointListeners.forEach(f => f());

/// A button per series: it shows and hides the series in all charts.
function pointLegend(rows) {
    const groups = legendGroups(filteredRows(rows)), {hidden} = shownPoints;
    const entries = groups.map(({label, keys, style}) => ({
                                   label,
                                   style,
                                   isShown: keys.some(k => !hidden.has(k)),
                                   toggle: () => {
                                       const isShown = keys.some(k => !hidden.has(k));
                                       keys.forEach(k => isShown ? hidden.add(k) : hidden.delete(k));
                                       pointsChanged();
                                   }
                               }));
    const all = hide => () => {
        groups.flatMap(g => g.keys).forEach(k => hide ? hidden.add(k) : hidden.delete(k));
        pointsChanged();
    };
    return legend(entries, groups.length > 4 ? [["all", all(false)], ["none", all(true)]] : []);
}

const headlineMetric = rows => {
    const keys = unique(rows.map(metricKey));
    return preferred(keys, keys.find(m => m.startsWith(headline.metric + "|")));
};
/// The metric that is read beside it: physical and perceptual errors order techniques differently. Undefined if `rows`
/// have none.
const otherMetric = (key, rows) => {
    const {metric, perceptual_metric: perceptual} = headline, keys = unique(rows.map(metricKey));
    const others = key.startsWith(metric + "|") ? [perceptual, "mse", "relmse"] : [metric];
    return others.map(other => keys.find(k => k !== key && k.startsWith(other + "|"))).find(Boolean);
};
const metricName = key => {
    const [metric, formula] = key.split("|");
    return metric === formula || !formula ? metric : `${metric} (${formula})`;
};
/// A box for each of the `keys` (target, metric, mask) of `choice`, with the values that `rows` have; it begins with the
/// headline's.
const choiceBoxes = (choice, keys, rows, changed) => keys.map(key => {
    const isMetric = key === "metric", values = unique(rows.map(isMetric ? metricKey : r => r[key]));
    choice[key] = isMetric ? headlineMetric(rows) : preferred(values, headline[key]);
    const label = key[0].toUpperCase() + key.slice(1);
    return select(label, isMetric ? values.map(m => [m, metricName(m)]) : values, choice[key], value => {
        choice[key] = value;
        changed();
    });
});
/// Which frames a row of errors is of; empty for a shot of one frame.
function framesText(row) {
    const frames = list(manifestShots().find(s => s.shot === row.shot)?.frames);
    if (frames.length < 2) return "";
    return row.frame === "" ? "mean over frames" : `frame ${row.frame} alone`;
}
const unitText = metric => {
    const unit = report.metrics[metric]?.unit;
    return unit && unit !== "1" ? ` (${unit.replace("^2", "²")})` : "";
};

/// Names of shots as short as they still differ: their scenes, or without the parts that all of them share.
const shortShot = (() => {
    const shots = unique((report.errors.length ? report.errors : manifestShots()).map(r => r.shot)),
          parts = shot => shot.split(".");
    const areScenesUnique = unique(shots.map(s => parts(s)[0])).length === shots.length;
    const isShared = (part, i) => i > 0 && shots.every(s => parts(s)[i] === part);
    const short = new Map(shots.map(
        s => [s, areScenesUnique ? parts(s)[0] : parts(s).filter((part, i) => !isShared(part, i)).join(".")]));
    return shot => shotLabels.get(shot) ?? short.get(shot) ?? shot;
})();

/// A folded part per shot, those of the first row open; `draw(shot)` gives its content when it is opened, and anew when
/// the shown points change.
function shotParts(shots, draw) {
    const columns = Math.max(1, Math.floor(innerWidth / 1200));  // as the style sheet's .shots
    const parts = shots.map((shot, i) => {
        const body = h("div"),
              part =
                  h("details", {open: i < columns, "data-shot": shot, class: "shot"}, h("summary", {}, shotLabel(shot)),
                    body);
        let isDrawn = false;
        const update = () => {
            if (part.open && !isDrawn) body.replaceChildren(...draw(shot));
            isDrawn = part.open;
        };
        part.addEventListener("toggle", update);
        part.drawNow = update;  // printing does not wait for events
        pointListeners.push(() => {
            isDrawn = false;
            update();
        });
        update();
        return part;
    });
    return h("div", {class: "shots"}, parts);
}

/// Takes a section that a study has nothing for off the page, and the link to it.
function leaveOut(id) {
    at(id).remove();
    document.querySelector(`nav a[href="#${id}"]`)?.remove();
}
