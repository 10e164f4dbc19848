// All shots at a glance: the chosen error of every point, and the one that is read beside it. A short table is its own
// overview.

const longTable = 20;  // rows

function showOverview() {
    const rows = chosenRows().filter(r => r.value !== null);
    at("overview").hidden = rows.length <= longTable;
    if (at("overview").hidden) return;
    const others = otherRows().filter(r => r.value !== null);
    at("overview").replaceChildren(pointLegend(), ...[rows, others].filter(own => own.length).map(own => {
        return h("div", {class: "scroll strips"}, overviewTable(own));
    }));
}

function overviewTable(rows) {
    const name = rows[0].metric, isLog = better(name) === "lower";
    const reference = {near_zero: 0, near_one: 1}[better(name)] ?? null;
    const shown = chartedRows(rows);
    const scale = stripScale(shown.flatMap(r => [r.value, r.low ?? r.value, r.high ?? r.value]), isLog, reference);
    const best = clearlyBestRows(rows);
    const ladder = ladderRows(metricKey(rows[0])), rungs = unique(ladder.map(r => r.rung));
    const lines = unique(shown.map(r => r.shot)).map(shot => {
        const own = shown.filter(r => r.shot === shot);
        const marks = own.map((r, lane) => ({
                                  series: chartedIndex(r),
                                  row: r,
                                  isHollow: isOneSeed(r),
                                  lane,
                                  tip: `${pointLabel(r)}\n${name} ${number(r.value)} ${interval(r)}`
                              }));
        return [
            shot, strip(scale, marks),
            ...charted.map((_, i) => overviewCell(own.find(r => chartedIndex(r) === i), best)),
            ...rungs.map(rung => overviewCell(ladder.find(r => r.shot === shot && r.rung === rung), best))
        ];
    });
    const label = `${name}${unitText(name)} of ${choice.target}, ${choice.mask} pixels${isLog ? ", logarithmic" : ""}`;
    lines.push(["", stripAxis(scale, label), ...charted.map(() => ""), ...rungs.map(() => "")]);
    const columns = [
        {name: "Shot"}, {name: `${name}, 95 % intervals`}, ...charted.map(name => ({name, number: true})),
        ...rungs.map(name => ({name: `truth ladder · ${name}`, number: true}))
    ];
    return table(columns, lines);
}

const overviewCell = (row, best) => row ?
    [h(best.has(row) ? "b" : "span", {}, number(row.value, 3)), isOneSeed(row) ? h("small", {}, " 1 seed") : null] :
    "–";
