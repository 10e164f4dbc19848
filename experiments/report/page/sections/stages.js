// Stage times and counted costs: stacked bars per shot and the numbers.

/// Eight colours, each plain and in three textures, of start.js's page-wide <defs>.
const textures = ["plain", "stripes", "dots", "checks"];
const stageFill = index => `url(#${textures[Math.floor(index / 8) % textures.length]}-${index % 8})`;

function textureDefinitions() {
    const size = {width: 8, height: 8, patternUnits: "userSpaceOnUse"},
          over = {fill: "none", stroke: "var(--card)", "stroke-width": 2.2};
    const drawn = {plain: [], stripes: ["M-2 6L6 -2M2 10L10 2"], dots: ["M2 2h.01M6 6h.01"], checks: ["M0 4H8M4 0V8"]};
    const patterns = textures.flatMap(
        texture => Array.from(
            {length: 8},
            (_, i) => svg(
                "pattern", {id: `${texture}-${i}`, ...size}, svg("rect", {width: 8, height: 8, fill: `var(--s${i})`}),
                drawn[texture].map(d => svg("path", {
                                       d,
                                       ...over,
                                       "stroke-linecap": texture === "dots" ? "round" : "butt",
                                       "stroke-width": texture === "dots" ? 3.4 : 2.2
                                   })))));
    return svg("svg", {width: 0, height: 0, "aria-hidden": "true", class: "definitions"}, svg("defs", {}, patterns));
}

const textureSwatch = fill => svg(
    "svg", {viewBox: "0 0 14 14", "aria-hidden": "true", class: "icon"}, svg("rect", {width: 14, height: 14, fill}));

const stageChoice = {
    bars: "times"
};

function showStages() {
    const shots = unique([...report.times, ...report.costs].map(t => t.shot));
    if (!shots.length) return leaveOut("stages");
    const ofTimes = report.times.length ? [["times", "times"], ["shares", "shares of each point's total"]] : [],
          ofCosts = report.costs.length ? Object.entries(costKinds).map(([kind, {name}]) => [kind, name]) : [];
    if (!ofTimes.length) stageChoice.bars = "fetches";
    const note = h("p", {class: "note"});
    const bars = select("Bars show", [...ofTimes, ...ofCosts], stageChoice.bars, value => {
        stageChoice.bars = value;
        note.textContent = stagesText();
        pointsChanged();
    });
    if (ofCosts.length) {
        const title = ofTimes.length ? "Stage times and counted costs" : "Counted costs of stages";
        document.querySelector("#stages h2").textContent = title;
        document.querySelector("nav a[href='#stages']").textContent = title;
        note.textContent = stagesText();
        at("stage-shots").append(note);
    }
    at("stage-shots").append(h("div", {class: "controls"}, bars), shotParts(shots, stagesOf));
}

/// What the switch shows, where there are counts.
function stagesText() {
    if (stageChoice.bars in costKinds)
        return `${howCounted} A count is no time: it holds no caches, no compression, no lanes that wait for others.`;
    return "Median times over the measured frames, of the machine that took them. The switch puts what stages do, counted, in their place.";
}

function stagesOf(shot) {
    const times = report.times.filter(t => t.shot === shot);
    const own = filteredRows(times.filter(t => t.variant !== "")), shared = times.filter(t => t.variant === "");
    const stages = unique(own.filter(t => t.stage !== "total").map(t => t.stage));
    const points = unique(own.map(pointLabel));
    const columns = [
        {name: "Variant"}, {name: "Stage"}, {name: "Median ms", number: true}, {name: "95 % interval", number: true},
        {name: "Frames", number: true}, {name: "Clock"}
    ];
    const sorted = [...own].sort((a, b) => points.indexOf(pointLabel(a)) - points.indexOf(pointLabel(b)));
    const swatch = t => t.stage === "total" || t.variant === "" ? null : textureSwatch(lookOf(stageName(t.stage)));
    const row = t =>
        [t.variant === "" ? "–" : pointLabel(t),
         t.stage === "total" ? h("b", {}, "total") : h("span", {}, swatch(t), t.stage), cell(t.value, number(t.value)),
         interval(t), String(t.frames), t.clock.replaceAll("_", " ")];
    const barRows = stageChoice.bars in costKinds ? costRows(shot, stageChoice.bars) : own;
    if (!times.length) return [stageBars(barRows), costTable(shot)];
    return [
        stages.length ? stageBars(barRows) :
                        h("p", {class: "note"}, "No variant of this shot has a stage: all were skipped."),
        savedNote(shot), floorNote(shot), formNote(own), costTable(shot),
        h("details", {open: own.length <= longTable}, h("summary", {}, "All stages as numbers"),
          table(columns, sorted.map(row), {groupBy: 0})),
        ...(shared.length ?
                [h("h3", {}, "Shared by all variants: G-buffer and lit colour"), table(columns, shared.map(row))] :
                [])
    ];
}

const lastPart = stage => stage.split("/").pop();
/// What two stages of one technique end in.
const stageRows = [...report.times, ...report.costs.map(c => ({...c, value: 0}))];  // looks go by times
const ambiguousParts = new Set(unique(stageRows.filter(t => t.stage !== "total").map(t => `${t.variant}|${t.stage}`))
                                   .map(key => [key.split("|")[0], lastPart(key.split("|")[1])].join("|"))
                                   .filter((key, i, all) => all.indexOf(key) !== i)
                                   .map(key => key.split("|")[1]));
/// A stage's name, without its folder where the rest says it.
const stageName = stage => (ambiguousParts.has(lastPart(stage)) ? stage : lastPart(stage)).replaceAll("_", " ");

/// By name of a stage: the index of its look, the same in all techniques. No other name has it as long as there are
/// looks, and none ever has that shares a technique with it as long as a technique has no more stages than there are
/// looks. The plain ones go to those that take longest.
function stageLooks(times) {
    const own = times.filter(t => t.stage !== "total" && t.variant !== ""), longest = new Map(), together = new Map();
    for (const t of own) longest.set(stageName(t.stage), Math.max(longest.get(stageName(t.stage)) ?? 0, t.value));
    for (const variant of unique(own.map(t => t.variant))) {
        const names = unique(own.filter(t => t.variant === variant).map(t => stageName(t.stage)));
        for (const name of names) together.set(name, [...together.get(name) ?? [], ...names]);
    }
    const looks = new Map(), all = Array.from({length: 8 * textures.length}, (_, i) => i);
    for (const name of [...longest.keys()].sort((a, b) => longest.get(b) - longest.get(a))) {
        const near = new Set(together.get(name).map(other => looks.get(other))), taken = new Set(looks.values());
        looks.set(name, all.find(i => !taken.has(i)) ?? all.find(i => !near.has(i)) ?? looks.size % all.length);
    }
    return looks;
}

const ownLooks = stageLooks(stageRows);
const lookOf = name => stageFill(ownLooks.get(name));

function stageBars(own) {
    const areShares = stageChoice.bars === "shares", cost = costKinds[stageChoice.bars];
    const valueText = t => cost ? `${countText(t.value * 1e6)} ${cost.name}` : `${number(t.value)} ms ${interval(t)}`;
    const rows = unique(own.map(pointLabel))
                     .map(label => {
                         const ofPoint = own.filter(t => pointLabel(t) === label),
                               total = ofPoint.find(t => t.stage === "total");
                         const stages = ofPoint.filter(t => t.stage !== "total"),
                               sum = stages.reduce((all, t) => all + t.value, 0);
                         const parts = stages.map(
                             t => ({
                                 value: areShares ? t.value / sum : t.value,
                                 fill: lookOf(stageName(t.stage)),
                                 text: stageName(t.stage),
                                 data: {stage: t.stage, value: t.value},
                                 tip: `${label}\n${t.stage}: ${valueText(t)}${
                                     total?.value > 0 ? `\n${percent(t.value / total.value)} of the total` : ""}`
                             }));
                         return {label, parts, total: areShares || cost ? null : total};
                     })
                     .filter(row => row.parts.length);
    const names = unique(rows.flatMap(row => row.parts.map(p => p.text)));
    const key = h(
        "p", {class: "stage-names"}, names.map(name => h("span", {class: "stage"}, textureSwatch(lookOf(name)), name)));
    const chart = stackedBars({
        title: `Stage ${cost ? "costs" : "times"}, ${own[0].shot}`,
        rows,
        isShare: areShares,
        xLabel: areShares ? "share of the point's time (medians)" :
            cost          ? `${cost.axis}, in the last frame` :
                            "median time (ms); the line is the 95 % interval of the total"
    });
    return h("div", {class: "bars"}, chart, h("div", {}, key));
}

/// What each point saves by leaving out what the scene has no use for: medians and intervals over the frames.
function savedNote(shot) {
    const savings = list(report.manifest.clock?.savings).filter(s => s.shot === shot);
    if (!savings.length) return "";
    const leftOut = list(manifestShots().find(s => s.shot === shot)?.left_out).length;
    const share = s => cell(s.share, `${percent(s.share)} `, h("small", {}, `[${percent(s.low)}, ${percent(s.high)}]`));
    return folded(
        `Work that can be skipped: time saved by ${leftOut} parts`,
        table(
            [
                {name: "Point"}, {name: "Share of its total that is saved", number: true},
                {name: "Total without saving (ms)", number: true}
            ],
            savings.map(s => [pointLabel(s), share(s), number(s.complete_ms, 3)])),
        h("p", {class: "note"}, "Which parts, and why: ", h("a", {href: "#needs"}, "What the scenes need"), "."));
}

const longList = 6;  // of paragraphs; longer ones are folded
/// What was timed: a point's name does not say which form of a stage ran. Single changes equal their baseline in all
/// but what their name says.
function formNote(times) {
    const isTimed = v => times.some(t => pointKey(t) === pointKey(v));
    const lines = list(report.manifest.variants)
                      .filter(v => isTimed(v) && !isSingleChange(v))
                      .map(v => [pointLabel(v), formText(v)])
                      .filter(([, text]) => text);
    if (!lines.length) return "";
    const items = lines.map(([label, text]) => h("li", {}, h("b", {}, label), ": " + text));
    const note = h("div", {class: "note forms"}, "What was timed:", h("ul", {}, items));
    return lines.length > longList ? folded("What was timed", note) : note;
}

/// The forms a point chose, and what else it changes of its variant's defaults.
function formText({variant, parameters}) {
    const entries = Object.entries(parameters ?? {}), defaults = report.defaults[variant];
    const show = some => some.map(([name, value]) => `${name} = ${JSON.stringify(value)}`).join(", ");
    const isForm = ([, value]) => typeof value === "string", forms = show(entries.filter(isForm));
    if (!defaults || !entries.length) return forms;
    const changed = entries.filter(([name, value]) => name in defaults && defaults[name] !== value);
    const others = show(changed.filter(e => !isForm(e)));
    return [forms, others ? `not at its default: ${others}` : "all else at its default"].filter(Boolean).join("; ");
}

/// How far two interleaved copies of the same point were apart: smaller differences are none.
function floorNote(shot) {
    const pairs = list(report.manifest.clock?.aa_pairs).filter(p => p.shot === shot);
    if (!pairs.length) return "";
    const one =
        p => [`${percent(p.floor)} (${pointLabel(p)}, ${number(p.first_ms, 3)} ms)`, ...badges(mistakesOfTime(p))];
    const floors = pairs.map(p => p.floor), most = pairs.find(p => p.floor === Math.max(...floors));
    const text = [
        `Two interleaved copies of the same point differed by ${
            pairs.length > 1 ? `${percent(Math.min(...floors))} to ` : ""}`,
        ...one(most),
        `. A/A floor of this shot: ${
            percent(aaFloor(shot))}; smaller differences between times say nothing.`
    ];
    const rest = () => folded("The copies of each point", h("ul", {}, pairs.map(p => h("li", {}, one(p)))));
    return h("div", {class: "note"}, text, pairs.length > 1 ? rest() : "");
}
