// How long GPUs that are not there would take (estimates.csv): stacked bars of stages, by the part that bounds each.

const estimateChoice = {};

/// ChipTimePart of experiments/gpu_costs/chips/chip_time.h: `bound` by its name, `column` of what it takes alone.
const estimateParts = [
    ["vector", "vector", "vector instructions", 0], ["scalar", "scalar", "scalar instructions", 5],
    ["shared_memory", "sharedMemory", "shared memory", 3], ["textures", "textures", "textures and buffers", 4],
    ["targets", "targets", "colour targets", 7], ["memory", "memory", "memory", 1], ["latency", "latency", "latency", 6]
].map(([bound, column, name, look]) => ({bound, column, name, fill: stageFill(look)}));
const partOf = e => estimateParts.find(part => part.bound === e.bound);

function showEstimates() {
    if (!report.estimates.length) return leaveOut("estimates");
    const chips = unique(report.estimates.map(e => e.chip)), shots = unique(report.estimates.map(e => e.shot));
    Object.assign(estimateChoice, {chip: chips[0], shot: shots[0]});
    const body = h("div"), update = () => body.replaceChildren(...estimatesPart());
    const chooser = (label, key, options) => select(label, options, options[0][0], value => {
        estimateChoice[key] = value;
        update();
    });
    const choosers = [
        chooser("Chip", "chip", chips.map(chip => [chip, chipText(chip)])),
        shots.length > 1 ? chooser("Shot", "shot", shots.map(shot => [shot, shotLabel(shot)])) : null
    ];
    pointListeners.push(update);
    update();
    at("estimates").append(h("div", {class: "controls"}, choosers), body);
}

function chipText(chip) {
    const product = report.estimates.find(e => e.chip === chip && e.product)?.product;
    return product ? `${chip} (${product})` : chip;
}

function estimatesPart() {
    const {chip, shot} = estimateChoice;
    const own = filteredRows(report.estimates.filter(e => e.chip === chip && e.shot === shot));
    const estimated = own.filter(e => !e.refusal), stages = estimated.filter(e => e.stage !== "total" && e.value > 0);
    const isStated = e => own.some(o => o.stage !== "total" && o.refusal && isSamePoint(o, e));  // by its stages
    const refused = own.filter(e => e.refusal && (e.stage !== "total" || !isStated(e)));
    const place = e => e.stage === "total" ? pointLabel(e) : `${e.stage} of ${pointLabel(e)}`;
    return [
        refusalsNote(refused, own.length, place, "All points"),
        estimated.length ? h("p", {class: "note"}, howSure()) : "",
        stages.length ? h("div", {class: "bars"}, estimateBars(own, stages),
                          h("div", {}, boundLegend(stages), estimateSentences(own, stages))) :
                        "",
        estimated.length ? estimateTable(estimated) : ""
    ];
}

const howSure = () => `Intervals are of sampling alone: ${report.modelRange.text}.`;

/// Between what the model leaves the time.
const modelRangeOf = e => `[${number(e.low * report.modelRange.low, 3)}, ${number(e.high * report.modelRange.high, 3)}]`;

const totalEstimate = (own, point) => own.find(e => e.stage === "total" && isSamePoint(e, point) && !e.refusal);
const microseconds = value => `${number(value, 3)} µs`;

function estimateBars(own, stages) {
    const {chip, shot} = estimateChoice;
    const rows = unique(stages.map(pointLabel)).map(label => {
        const ofPoint = stages.filter(e => pointLabel(e) === label), total = totalEstimate(own, ofPoint[0]);
        const parts = ofPoint.map(
            e => ({
                value: e.value,
                fill: partOf(e).fill,
                text: stageName(e.stage),
                data: {stage: e.stage, bound: e.bound},
                tip: `${label}\n${e.stage}: estimated ${microseconds(e.value)} ${interval(e, 3)}\nbound by ${
                    partOf(e).name}${total ? `\n${percent(e.value / total.value)} of the total` : ""}`
            }));
        return {label: total ? label : `${label} (in part)`, parts, total};
    });
    return stackedBars({
        title: `Estimated times of stages on ${chip}, ${shot}`,
        rows,
        xLabel: `microseconds on ${chip} (estimate); the line is the 95 % interval of the total`
    });
}

function boundLegend(stages) {
    const bounds = estimateParts.filter(part => stages.some(e => e.bound === part.bound));
    return h(
        "p", {class: "stage-names"}, "Bound by: ",
        bounds.map(part => h("span", {class: "stage"}, textureSwatch(part.fill), part.name)));
}

function estimateSentences(own, stages) {
    const points = unique(stages.map(pointKey)).map(key => stages.find(e => pointKey(e) === key));
    const text = total => total ?
        `${microseconds(total.value)} by estimate (95\u00a0% interval of sampling from ${number(total.low, 3)} to ${
            number(total.high, 3)}; with what the model leaves open ${modelRangeOf(total)}), most of it bound by ${
            partOf(total).name}.` :
        "no total, since a stage has no estimate.";
    const items = points.map(p => h("li", {}, h("b", {}, pointLabel(p)), ": ", text(totalEstimate(own, p))));
    const sentences = h("ul", {class: "sentences"}, items);
    return items.length > longList ? folded("Totals in words", sentences) : sentences;
}

function estimateTable(estimated) {
    const time = value => cell(value, number(value, 3)), share = value => cell(value, percent(value));
    const isBound = e => e.stage !== "total" && e.value > 0;
    const part = (e, {bound, column}) =>
        cell(e[column], h(isBound(e) && e.bound === bound ? "b" : "span", {}, number(e[column], 3)));
    const stage = e => e.stage === "total" ?
        h("b", {}, "total") :
        h("span", {}, isBound(e) ? textureSwatch(partOf(e).fill) : null, stageName(e.stage));
    const lines = estimated.map(
        e => [pointLabel(e), stage(e), time(e.value), interval(e, 3), modelRangeOf(e), ...estimateParts.map(p => part(e, p)),
              time(e.caches), share(e.activeLanes), share(e.unmatched)]);
    const numbers = [
        "estimate", "95 % interval", "model range", ...estimateParts.map(p => p.name), "caches", "lanes that run", "runs at most"
    ];
    const columns = [
        {name: "Point"}, {name: "Stage"},
        ...numbers.map(name => ({name: name[0].toUpperCase() + name.slice(1), number: true}))
    ];
    const note =
        h("p", {class: "note"},
          `Estimates for ${chipText(estimateChoice.chip)} in microseconds, and what each part of the chip would take for them alone.`,
          ` Intervals are of sampling; the model range is what they leave open: ${report.modelRange.text}.`,
          " Bold is the part that bounds the stage.",
          " Caches are no part of the estimate: they are what it would be if every byte came through the L2 cache.",
          " Lanes that run are the share of the waves' lanes that do, weighted by vector instructions.",
          " Runs at most are the share of the estimate in code of which it is only known how often it ran at most.");
    return folded("All parts of the estimates as numbers", note, scroller(table(columns, lines, {groupBy: 0})));
}
