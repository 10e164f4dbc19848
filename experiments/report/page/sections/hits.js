// Where rays ended, against what they truly meet: hits.csv.

const hitChoice = {};
const errorStage = "error";  // rows of that stage share out the squared error, not the rays

// Okabe and Ito's colours, as in the maps of the verdicts; `short` is written into bars that have room.
const verdicts = [
    {key: "right", name: "right", color: "#009e73", short: "right"},
    {key: "unavoidable_miss", name: "rightly missed: not on the screen", color: "#0072b2", short: "off screen"},
    {key: "empty", name: "rightly missed: nothing there", color: "#808080", short: "nothing"},
    {key: "avoidable_miss", name: "missed", color: "#f0e442", short: "missed"},
    {key: "wrong_place", name: "wrong place", color: "#e69f00", short: "wrong place"},
    {key: "false_hit", name: "false hit", color: "#cc79a7", short: "false hit"}
];
/// What a ray did that missed what the screen shows, by the outcome that its tracer gave (variants/tracers/outcome.h).
const missTexts = {
    off_screen: "left the screen",
    behind_camera: "reached the camera",
    unfinished: "ran out of steps",
    background: "ended on the background",
    too_thick: "went too far behind a surface",
    from_behind: "met the back of a surface",
    own_surface: "met what they started from",
    hidden: "met what is hidden",
    hit: "hit with too little confidence"
};
const colorSwatch = color => h("span", {class: "swatch", style: `background:${color}`});
const verdictLegend = some => legend(some.map(v => ({label: v.name, swatch: colorSwatch(v.color)})));

function showHits() {
    const rays = report.hits.filter(r => r.stage !== errorStage);
    showErrorShares();
    if (!rays.length) return leaveOut("hits");
    const boxes = choiceBoxes(hitChoice, ["mask"], rays, pointsChanged);
    const parts = shotParts(unique(rays.map(r => r.shot)), hitPart);
    at("hits").append(h("div", {class: "controls"}, boxes), verdictLegend(verdicts), parts);
}

/// Rows of one point, frame and pass, by quantity.
function hitGroups(shot) {
    const groups = new Map();
    for (const r of filteredRows(report.hits)) {
        if (r.shot !== shot || r.mask !== hitChoice.mask || r.stage === errorStage) continue;
        const key = [r.variant, r.point, r.stage, r.frame].join("|");
        if (!groups.has(key)) groups.set(key, {first: r, by: new Map()});
        groups.get(key).by.set(r.quantity, r);
    }
    return [...groups.values()];
}

const percentInterval = r => r.low === null ? "" : ` [${(100 * r.low).toFixed(1)}, ${(100 * r.high).toFixed(1)}]`;

const passName = (first, hasFrames) => first.stage.split("/").pop() + (hasFrames ? `, frame ${first.frame}` : "");

function hitPart(shot) {
    const groups = hitGroups(shot), hasFrames = unique(groups.map(g => g.first.frame)).length > 1;
    if (!groups.length) return [];
    const rows = groups.map(
        ({first, by}) => ({
            label: `${pointLabel(first)}: ${passName(first, hasFrames)}`,
            parts: verdicts.filter(v => by.has(v.key)).map(v => {
                const r = by.get(v.key);
                return {
                    value: r.value,
                    fill: v.color,
                    text: v.short,
                    tip: `${pointLabel(first)}\n${v.name}: ${percent(r.value)} of its rays${percentInterval(r)}`
                };
            })
        }));
    const columns = [
        {name: "Point"}, {name: "Rays of"}, {name: "Correct", number: true}, {name: "Error of distance", number: true},
        {name: "Depth fetches", number: true}, {name: "Rays", number: true}, {name: "Avoidable misses reported as"}
    ];
    const lines = groups.map(({first, by}) => {
        const correct = by.get("correct"), distance = by.get("distance_error"), fetches = by.get("fetches");
        const misses = [...by.values()].filter(r => r.quantity.startsWith("miss: ")).sort((a, b) => b.value - a.value);
        return [
            pointLabel(first), passName(first, hasFrames),
            cell(correct.value, percent(correct.value), h("small", {}, percentInterval(correct))),
            cell(distance?.value, distance ? number(distance.value, 2) : ""),
            cell(fetches.value, number(fetches.value, 3)), cell(first.rays, number(first.rays, 6)),
            misses.slice(0, 3).map(r => `${r.quantity.slice(6).replace("_", " ")} ${percent(r.value)}`).join(", ")
        ];
    });
    return [h(
        "div", {class: "bars"},
        stackedBars({title: `Where rays ended, ${shot}`, rows, xLabel: "share of the rays", isShare: true}),
        h("details", {open: lines.length <= longTable},
          h("summary", {}, "The same as numbers, with fetches and reasons"), scroller(table(columns, lines))))];
}

/// Opens and scrolls to the rays of a shot.
function showRaysOf(shot) {
    const part = [...at("hits").querySelectorAll("details.shot")].find(p => p.dataset.shot === shot);
    if (!part) return;
    part.open = true;
    part.drawNow();
    part.scrollIntoView();
}
