// Who made what: machines and versions of ssrlab, the clock, and which of them made each cell.

import {at, factList, h, scroller} from "../elements/elements.js";
import {foldedLater} from "../elements/later.js";
import {table} from "../elements/tables.js";
import {known} from "./facts.js";
import {report} from "../study/data.js";
import {makers} from "../study/makers.js";
import {list, number, percent, unique} from "../values.js";

/// "2 % to 5 %", over the shots.
const floorRange = floors =>
    known(floors.length || null, unique([Math.min(...floors), Math.max(...floors)].map(v => percent(v))).join(" to "));

export function showProvenance() {
    const {clock} = report.manifest, proofs = list(clock?.proofs);
    const times = [
        ["Clock", known(unique(proofs.map(p => p.method)).join(", "))],
        ["Clock proof", proofs.length ? proofs.map(clockProof).join(" | ") : "not recorded"],
        ["A/A floor of times", floorRange(Object.values(clock?.aa_floors ?? {}))],
        [
            "Empty submit",
            known(proofs[0]?.empty_submit_ms, proofs.map(p => number(p.empty_submit_ms, 3)).join(", ") + " ms")
        ],
        ["Foreign load, at most", foreignLoad(list(clock?.load))],
        ["Times taken on", known(unique(list(clock?.load).map(l => l.host?.name).filter(Boolean)).join(", "))],
    ];
    const columns = ["Cell", "Started", "Finished", "Hash"];
    const cellRow = c =>
        [c.what, known(c.started), known(c.finished), h("span", {class: "hash"}, String(c.cell ?? "").slice(0, 12))];
    const part = (maker, i) => {
        const cells = list(maker.cells), facts = factList(makerFacts(maker, makers.length > 1 ? i + 1 : 0));
        const made = () => foldedLater(
            `${cells.length} cells made by it`, () => [scroller(table(columns, cells.map(c => () => cellRow(c))))]);
        return [h("div", {id: `maker-${i + 1}`}, facts), cells.length ? made() : ""];
    };
    at("provenance").append(...(makers.length ? makers : [{}]).flatMap(part), factList(times));
    // A link into a folded part opens it.
    addEventListener(
        "hashchange",
        () => document.querySelector(location.hash || "#none")?.closest("details")?.setAttribute("open", ""));
}

/// What made some of the cells, where and when; `place` counts them from 1 where there are several.
function makerFacts(maker, place) {
    const {device = {}, host = {}, ssrlab = {}} = maker;
    const joined = parts => parts.filter(Boolean).join(", ");
    return [
        ...(place ? [[`Made by ${place}`, `${list(maker.cells).length} cells`]] : []),
        ["Device", known(device.name, [device.name, device.type && `(${device.type})`].filter(Boolean).join(" "))],
        ["Driver", known(device.driver, joined([device.driver, device.api && `Vulkan ${device.api}`]))],
        [
            "Host", known(host.cpu, joined([
                              host.name, host.cpu, host.cores && `${host.cores} cores`,
                              host.memory_gib && `${number(host.memory_gib)} GiB`
                          ]))
        ],
        ["Kernel", known(host.kernel)],
        ["ssrlab", known(ssrlab.version, joined([ssrlab.version, ssrlab.build, ssrlab.compiler]))],
        [
            "Commit",
            h("span", {class: "hash"},
              known(ssrlab.commit, String(ssrlab.commit).slice(0, 12)) + (ssrlab.dirty ? " with changes" : ""))
        ],
        ["Run", `${known(maker.started)} to ${known(maker.finished)}`],
    ];
}

const verdictTexts = {
    passed: "passed",
    failed: "FAILED",
    not_judged: "NOT JUDGED, the machine was busy"
};

const clockProof = proof =>
    list(proof.checks)
        .map(
            p => `${p.stage_kind}: ${verdictTexts[p.verdict] ?? "not recorded"} (${
                list(p.ratio).map(r => number(r, 3)).join(" : ")} for ${list(p.expected).join(" : ")})`)
        .join("; ");

function foreignLoad(loads) {
    const largest = loads.map(l => l.largest_foreign_load).filter(x => typeof x === "number");
    return largest.length ? percent(Math.max(...largest)) + " of the machine's CPU time" : "not recorded";
}
