// Who made what: machines and versions of ssrlab, and which of them made each cell.

import {h} from "../elements/elements.js";
import {report} from "./data.js";
import {list} from "../values.js";

export const makers = list(report.manifest.provenance);

/// "<shot>: <technique> <point>" to {maker, cell}.
const cellsMade = new Map(makers.flatMap((maker, m) => list(maker.cells).map(cell => [cell.what, {maker: m, cell}])));
const madeBy = row => cellsMade.get(`${row.shot}: ${row.technique} ${row.point}`);

/// For tips: when, by which commit and on which device.
export function madeText(row) {
    const made = madeBy(row);
    if (!made) return "";
    const {ssrlab = {}, device = {}} = makers[made.maker];
    return `made ${made.cell.finished}, commit ${commitText(ssrlab)}, ${device.name ?? "device not recorded"}`;
}

const commitText = ssrlab =>
    String(ssrlab.commit ?? "not recorded").slice(0, 10) + (ssrlab.dirty ? " with changes" : "");

/// A link from a row to its maker.
export function madeCell(row) {
    const made = madeBy(row);
    if (!made) return "–";
    const link = h("a", {href: `#maker-${made.maker + 1}`, class: "hash"}, commitText(makers[made.maker].ssrlab ?? {}));
    link.title = madeText(row);
    return h("span", {}, link, " ", h("small", {}, made.cell.finished ?? ""));
}
