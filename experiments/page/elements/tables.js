// Tables, sorted by what the reader clicks.

import {h, scrollWatcher} from "./elements.js";
import {copyText, saveFile} from "./files.js";
import {drawLater} from "./later.js";
import {interval, number, percent} from "../values.js";

const mostRows = 100;  // that are made at once

/// Columns are names, or {name, number: true} as numbers() makes them: those are right-aligned. Rows are arrays of
/// cells, or functions that make one; a cell is a text, an element, or a cell(). `sortable`: a button in each head sorts;
/// `groupBy`: the column by which rows are set apart; `last`: a row that stays the last. Of many rows the further ones
/// are made when the reader comes near them.
export function table(columns, rows, {sortable, groupBy, caption, last} = {}) {
    rows = rows.map(row => typeof row === "function" ? once(row) : () => row);
    const body = h("tbody"), names = columns.map(c => c.name ?? c), classes = columns.map(c => c.number ? "number" : null);
    const sortBy = i => {
        const up = heads[i].getAttribute("aria-sort") !== "ascending";
        heads.forEach(head => head.removeAttribute("aria-sort"));
        heads[i].setAttribute("aria-sort", up ? "ascending" : "descending");
        show([...rows].sort((a, b) => compareCells(sortKey(a()[i]), sortKey(b()[i]), up)));
    };
    const button = (name, i) => h("button", {click: () => sortBy(i), title: "Sort by " + name}, name);
    const heads = names.map((name, i) => h("th", {class: classes[i], scope: "col"}, sortable ? button(name, i) : name));
    const data = (cell, c) => {
        const value = cell?.sort === undefined ? null : String(cell.sort);
        return h("td", {class: classes[c], "data-value": value}, cell?.content ?? cell);
    };
    const isFirst = (ordered, i) => groupBy !== undefined && i > 0 &&
        sortKey(ordered[i]()[groupBy]) !== sortKey(ordered[i - 1]()[groupBy]);
    const lineOf = (ordered, i) => h("tr", {class: isFirst(ordered, i) ? "group" : null}, ordered[i]().map(data));
    const lines = (ordered, from, to) => ordered.slice(from, to).map((_, i) => lineOf(ordered, from + i));
    /// In place of the rows from `from` on.
    const rest = (ordered, from) => {
        const count = ordered.length - from, place = h("tr", {}, h("td", {colspan: columns.length}, `${count} more rows`));
        const drawTo = to => place.replaceWith(...lines(ordered, from, to), ...(to < ordered.length ? [rest(ordered, to)] : []));
        place.drawWhole = () => drawTo(ordered.length);
        return drawLater(place, () => drawTo(from + mostRows));
    };
    const show = ordered => body.replaceChildren(
        ...lines(ordered, 0, mostRows), ...(ordered.length > mostRows ? [rest(ordered, mostRows)] : []),
        ...(last ? [h("tr", {}, last.map(data))] : []));
    show(rows);
    const whole = h("table", {}, caption ? h("caption", {}, caption) : null, h("thead", {}, h("tr", {}, heads)), body);
    scrollWatcher.observe(whole);  // on narrow screens tables scroll by themselves
    return whole;
}

/// What `make` makes, once.
function once(make) {
    let made;
    return () => made ??= make();
}

export const numbers = (...names) => names.map(name => ({name, number: true}));

/// A table() in the place of one that stands in the page; empty without rows.
export const fillTable = (place, columns, rows) =>
    place.replaceChildren(...(rows.length ? table(columns, rows).children : []));
const sortKey = cell => cell && cell.sort !== undefined ? cell.sort : cell instanceof Node ? cell.textContent : cell;

/// Missing numbers come last in both directions.
export function compareCells(a, b, up) {
    if (a === null || b === null) return (a === null) - (b === null);
    const order = typeof a === "number" && typeof b === "number" ?
        a - b :
        String(a).localeCompare(String(b), "en", {numeric: true});
    return up ? order : -order;
}

/// A cell that is sorted by `sort`, null where its value is missing.
export const cell = (sort, ...content) => ({sort: sort ?? null, content: h("span", {}, ...content)});
export const numberCell = (value, digits) => cell(value, number(value, digits));
export const countCell = count => cell(count, String(count));
export const shareCell = share => cell(share, percent(share));

/// The value of a row of numbers, with its interval.
export const valueCell = (row, digits) =>
    cell(row.value, number(row.value, digits), " ", h("small", {}, interval(row, digits)));

/// A text of a table as spreadsheets take it: what begins like a formula and is more than a number, a percentage or an interval stands behind
/// an apostrophe, as in ssrlab's own files (experiments/results/files/csv.h).
const inCells = text => /^'*[=+\-@]/.test(text) && !/^[+-][\d.,e\s%[\]+-]*$/.test(text) ? `'${text}` : text;

/// With the rows that are still to be made.
function wholeTable(whole) {
    whole.querySelector("tr.later")?.drawWhole();
    return whole;
}

/// Buttons that copy a table as it is shown, for a spreadsheet, and save it under the name that `name` gives.
export function tableButtons(whole, name, said = null) {
    const text = c => inCells(c.textContent.replace(/\s+/g, " ").trim());
    const quoted = c => /[",]/.test(text(c)) ? `"${text(c).replaceAll("\"", "\"\"")}"` : text(c);
    const lines = (of, separator) => [...wholeTable(whole).rows].map(row => [...row.cells].map(of).join(separator) + "\n").join("");
    const copy = async event => {
        await copyText(lines(text, "\t"));
        (said ?? event.target).textContent = "Copied.";
    };
    const save = () => saveFile(new Blob([lines(quoted, ",")], {type: "text/csv"}), name());
    return [h("button", {click: copy}, "Copy table"), h("button", {click: save}, "Save table")];
}

export function tableActions(whole, name) {
    const said = h("output");
    return h("div", {class: "controls"}, tableButtons(whole, () => name, said), said);
}
