// What GPUs' compilers make of the passes (compiled.csv): registers, waves and cycles, without a GPU.

const compiledChoice = {};

// Why a SIMD holds no more waves: Occupancy of experiments/gpu_costs/chips/occupancy.h.
const limitColors = {
    "nothing": "#009e73",
    "registers": "#e69f00",
    "scalar registers": "#f0e442",
    "shared memory": "#cc79a7"
};

function showCompiled() {
    if (!report.compiled.length) return leaveOut("compiled");
    const chips = unique(report.compiled.map(r => r.chip)), shots = shotsByCode();
    Object.assign(compiledChoice, {chip: chips[0], shot: shots[0][0]});
    const body = h("div"), update = () => body.replaceChildren(...compiledPart());
    const chooser = (label, key, options) => select(label, options, options[0][0], value => {
        compiledChoice[key] = value;
        update();
    });
    const names = shots.map(
        ([shot, ...alike]) => [shot, shotLabel(shot) + (alike.length ? ` and ${alike.length} alike` : "")]);
    const choosers = [
        chooser("Chip", "chip", chips.map(chip => [chip, chip])),
        shots.length > 1 ? chooser("Shot", "shot", names) : null
    ];
    pointListeners.push(update);
    update();
    at("compiled").append(h("div", {class: "controls"}, choosers), body);
}

/// Lists of shots whose passes are the same: most shots of a study need the same ones.
function shotsByCode() {
    const groups = new Map();
    for (const shot of unique(report.compiled.map(r => r.shot))) {
        const key = JSON.stringify(report.compiled.filter(r => r.shot === shot).map(r => ({...r, shot: null})));
        groups.set(key, [...groups.get(key) ?? [], shot]);
    }
    return [...groups.values()];
}

const compiledPass = r => r.stage + (r.pipeline > 0 ? ` #${r.pipeline + 1}` : "");

function compiledPart() {
    const {chip, shot} = compiledChoice;
    const own = filteredRows(report.compiled.filter(r => r.chip === chip && r.shot === shot && r.shader !== "vertex"));
    const compiled = own.filter(r => !r.refusal), refused = own.filter(r => r.refusal);
    const first = new Map();  // by hash
    for (const r of compiled)
        if (r.hash && !first.has(r.hash)) first.set(r.hash, r);
    const columns = [
        {name: "Point"}, {name: "Pass"}, {name: "Registers", number: true}, {name: "Spilled", number: true},
        {name: "Waves", number: true}, {name: "Limited by"}, {name: "Shared memory, bytes", number: true},
        {name: "Instructions", number: true}, {name: "Latency", number: true}, {name: "Cycles", number: true},
        {name: "Machine code"}
    ];
    const count = value => cell(value, number(value, 6));
    const lines = compiled.map(
        r => [pointLabel(r), compiledPass(r), count(r.vgprs), count(r.spilledVgprs), wavesCell(r),
              r.limit || "not known", count(r.ldsBytes), count(r.instructions), count(r.latency),
              count(r.inverseThroughput), codeText(r, first.get(r.hash))]);
    const caption = `${chip}, by ${unique(compiled.map(r => r.driver)).join(", ")}`;
    return [
        refusalsNote(refused, own.length, r => `${compiledPass(r)} of ${pointLabel(r)}`, "All passes"),
        lines.length ? scroller(table(columns, lines, {groupBy: 0, caption})) : ""
    ];
}

/// With a bar of the share that the waves are of those that fit.
function wavesCell(r) {
    if (r.waves === null) return cell(null, "–");
    const color = limitColors[r.limit] ?? "var(--faint)";
    const bar = h("span", {style: `width:${100 * r.waves / r.mostWaves}%;background:${color}`});
    return cell(r.waves, `${r.waves} of ${r.mostWaves}`, h("span", {class: "share"}, bar));
}

/// `first`: the first pass of the table that has this machine code.
function codeText(r, first) {
    if (!r.hash) return "not known";
    if (first === r) return h("code", {}, r.hash);
    const isOtherPass = compiledPass(first) !== compiledPass(r);
    return `same machine code as ${isOtherPass ? `${compiledPass(first)} of ` : ""}${pointLabel(first)}`;
}

/// A sentence for each reason why some of `count` rows have no numbers; `place` names a row, `all` all of them.
function refusalsNote(refused, count, place, all) {
    const sentences = unique(refused.map(r => r.refusal)).map(reason => {
        const places = refused.filter(r => r.refusal === reason).map(place);
        const where = places.length === count ? all : places.join(", ");
        return h("li", {class: "warning"}, `${where}: ${reason}.`);
    });
    return sentences.length ? h("ul", {class: "refusals", "aria-label": "What has no numbers, and why"}, sentences) : "";
}
