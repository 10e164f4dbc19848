// Where rays ended, against what they truly meet: hits.csv.

const hitChoice = {
    shot: null,
    mask: null
};

// Okabe and Ito's colours, as in the maps of the verdicts.
const verdicts = [
    ["right", "right", "#009e73"], ["unavoidable_miss", "rightly missed: not on the screen", "#0072b2"],
    ["empty", "rightly missed: nothing there", "#808080"], ["avoidable_miss", "missed", "#f0e442"],
    ["wrong_place", "wrong place", "#e69f00"], ["false_hit", "false hit", "#cc79a7"]
];

function showHits() {
    if (!report.hits.length) {
        leaveOut("hits");
        return;
    }
    const shots = unique(report.hits.map(r => r.shot)), masks = unique(report.hits.map(r => r.mask));
    hitChoice.shot = shots[0];
    hitChoice.mask = preferred(masks, "reflective");
    const changed = key => value => {
        hitChoice[key] = value;
        drawHits();
    };
    at("hits").append(
        h("div", {class: "controls"}, select("Shot", shots, hitChoice.shot, changed("shot")),
          select("Mask", masks, hitChoice.mask, changed("mask"))),
        h("div", {class: "legend"},
          ...verdicts.map(([, name, color]) => h("span", {}, h("span", {class: "swatch", style: `background:${color}`}), name))),
        h("div", {class: "scroll strips", id: "hit-table"}));
    drawHits();
}

/// Rows of one point, frame and pass, by quantity.
function hitGroups() {
    const groups = new Map();
    for (const r of report.hits) {
        if (r.shot !== hitChoice.shot || r.mask !== hitChoice.mask) continue;
        const key = [r.variant, r.point, r.stage, r.frame].join("|");
        if (!groups.has(key)) groups.set(key, {first: r, by: new Map()});
        groups.get(key).by.set(r.quantity, r);
    }
    return [...groups.values()];
}

const percentInterval = r => r.low === null ? "" : ` [${(100 * r.low).toFixed(1)}, ${(100 * r.high).toFixed(1)}]`;

function sharesBar(by) {
    const parts = verdicts.filter(([key]) => by.has(key)).map(([key, name, color]) => {
        const r = by.get(key), part = h("span", {style: `width:${100 * r.value}%;background:${color}`});
        return withTip(part, `${name}: ${percent(r.value)}${percentInterval(r)}`);
    });
    const text = verdicts.filter(([key]) => by.has(key)).map(([key, name]) => `${name} ${percent(by.get(key).value)}`);
    return h("div", {class: "shares", role: "img", "aria-label": text.join(", ")}, ...parts);
}

function drawHits() {
    const columns = [
        {name: "Point"}, {name: "Rays of"}, {name: "Where they ended"}, {name: "Correct", number: true},
        {name: "Error of distance", number: true}, {name: "Depth fetches", number: true}, {name: "Rays", number: true},
        {name: "Avoidable misses were told as"}
    ];
    const frames = unique(report.hits.filter(r => r.shot === hitChoice.shot).map(r => r.frame));
    const lines = hitGroups().map(({first, by}) => {
        const correct = by.get("correct"), distance = by.get("distance_error"), fetches = by.get("fetches");
        const told = [...by.values()].filter(r => r.quantity.startsWith("miss: ")).sort((a, b) => b.value - a.value);
        return [
            pointLabel(first), first.stage.split("/").pop() + (frames.length > 1 ? `, frame ${first.frame}` : ""),
            sharesBar(by), cell(correct.value, percent(correct.value), h("small", {}, percentInterval(correct))),
            cell(distance?.value, distance ? number(distance.value, 2) : ""), cell(fetches.value, number(fetches.value, 3)),
            cell(first.rays, number(first.rays, 6)),
            told.slice(0, 3).map(r => `${r.quantity.slice(6).replace("_", " ")} ${percent(r.value)}`).join(", ")
        ];
    });
    at("hit-table").replaceChildren(table(columns, lines));
}
