// What all sections share: elements, numbers as text, tables, tips.

/// An element: `h("td", {class: "number"}, "12")`. Attributes that are functions become listeners, null ones are left
/// out.
function h(tag, attributes = {}, ...children) { return fill(document.createElement(tag), attributes, children); }

function svg(tag, attributes = {}, ...children) {
    return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function fill(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function")
            element.addEventListener(name, value);
        else if (value !== null && value !== undefined && value !== false)
            element.setAttribute(name, value === true ? "" : value);
    }
    element.append(...children.flat().filter(c => c !== null && c !== undefined));
    return element;
}

const at = id => document.getElementById(id);
const unique = list => [...new Set(list)];
const manifestShots = () => list(report.manifest.shots);
const list = value => Array.isArray(value) ? value : [];
/// How the study names points and shots, where it does.
const pointLabels =
    new Map(list(report.manifest.variants).filter(v => v.label).map(v => [`${v.variant}|${v.point}`, v.label]));
const shotLabels = new Map(list(report.manifest.shots).filter(s => s.label).map(s => [s.shot, s.label]));
const ownLabel = row => pointLabels.get(`${row.variant}|${row.point}`);
const pointLabel = row =>
    ownLabel(row) ?? row.variant + (row.point && row.point !== "default" ? " · " + row.point : "");
const shotLabel = shot => shotLabels.get(shot) ?? shot;

/// Four significant digits; exponents only where the plain form is long.
function number(x, digits = 4) {
    if (x === null || x === undefined) return "–";
    if (!Number.isFinite(x)) return String(x);
    if (x === 0) return "0";
    const size = Math.abs(x);
    if (size >= 1e5 || size < 1e-3) {
        const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
        return `${Number(mantissa)}e${Number(exponent)}`;
    }
    return String(Number(x.toPrecision(digits)));
}

/// Why a value has no interval, as experiments/results/verdicts/interval.h has it; empty where the reason is unknown.
const whyNoInterval = row => row.value !== null && row.interval?.startsWith("none: ") ?
    `${row.interval.slice("none: ".length)}: no interval` :
    "";
const interval = (row, digits = 4) => row.low === null || row.low === undefined ?
    whyNoInterval(row) :
    `[${number(row.low, digits)}, ${number(row.high, digits)}]`;

/// A single seed of a point that depends on it: another one might give anything.
const isOneSeed = row => row.interval === "none: 1 seed";

function select(label, options, value, changed) {
    const box = h("select", {change: event => changed(event.target.value)}, options.map(o => {
        const [key, text] = Array.isArray(o) ? o : [o, o];
        return h("option", {value: key, selected: key === value}, text);
    }));
    return h("label", {}, label, box);
}

/// Rows are arrays of cells; a cell is a text, an element, or {sort, content}. Columns with `number` are right-aligned;
/// a sortable table has a button in each head.
function table(columns, rows, options = {}) {
    const body = h("tbody");
    const heads = columns.map(
        (column, i) =>
            h("th", {class: column.number ? "number" : null, scope: "col"},
              options.sortable ? h("button", {click: () => sortBy(i), title: "Sort by " + column.name}, column.name) :
                                 column.name));
    const show =
        ordered =>
            body.replaceChildren(
                ...ordered.map(
                    (row, i) =>
                        h("tr", {
                            class: options.groupBy !== undefined && i > 0 &&
                                    sortKey(row[options.groupBy]) !== sortKey(ordered[i - 1][options.groupBy]) ?
                                "group" :
                                null
                        },
                          row.map(
                              (cell, c) =>
                                  h(
                                      "td", {
                                          class: columns[c].number ? "number" : null,
                                          "data-value": cell && cell.sort !== undefined ? String(cell.sort) : null
                                      },
                                      cell && cell.content !== undefined ? cell.content : cell)))));
    function sortBy(i) {
        const up = heads[i].getAttribute("aria-sort") !== "ascending";
        heads.forEach(head => head.removeAttribute("aria-sort"));
        heads[i].setAttribute("aria-sort", up ? "ascending" : "descending");
        show([...rows].sort((a, b) => compareCells(sortKey(a[i]), sortKey(b[i]), up)));
    }
    show(rows);
    const whole =
        h("table", {}, options.caption ? h("caption", {}, options.caption) : null, h("thead", {}, h("tr", {}, heads)),
          body);
    scrollWatcher.observe(whole);  // on narrow screens tables scroll by themselves
    return whole;
}

const sortKey = cell => cell && cell.sort !== undefined ? cell.sort : cell instanceof Node ? cell.textContent : cell;

/// Missing numbers come last in both directions.
function compareCells(a, b, up) {
    if (a === null || b === null) return (a === null) - (b === null);
    const order = typeof a === "number" && typeof b === "number" ?
        a - b :
        String(a).localeCompare(String(b), "en", {numeric: true});
    return up ? order : -order;
}

/// Makes `element` a button to pointer, keys and screen readers.
function clickable(element, act) {
    element.setAttribute("role", "button");
    element.classList.add("clickable");
    element.addEventListener("click", act);
    element.addEventListener("keydown", event => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        act(event);
    });
}

/// Whether `act` may be done here: what browsers may refuse (clipboard, address, full screen) throws.
async function attempt(act) {
    try {
        await act();
        return true;
    } catch {
        return false;
    }
}

function saveFile(blob, name) {
    const href = URL.createObjectURL(blob);
    h("a", {href, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
}

async function copyText(text) {
    if (await attempt(() => navigator.clipboard.writeText(text))) return;
    const area = h("textarea", {readonly: true});  // where a page that is a file has no clipboard of its own
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
}

/// A text of a table as spreadsheets take it: what begins like a formula and is more than a number, a percentage or an interval stands behind
/// an apostrophe, as in ssrlab's own files (experiments/results/tables/csv.h).
const inCells = text => /^'*[=+\-@]/.test(text) && !/^[+-][\d.,e\s%[\]+-]*$/.test(text) ? `'${text}` : text;

/// Buttons that copy a table as it is shown, for a spreadsheet, and save it under the name that `name` gives.
function tableButtons(whole, name, said = null) {
    const text = c => inCells(c.textContent.replace(/\s+/g, " ").trim());
    const quoted = c => /[",]/.test(text(c)) ? `"${text(c).replaceAll("\"", "\"\"")}"` : text(c);
    const lines = (of, separator) => [...whole.rows].map(row => [...row.cells].map(of).join(separator) + "\n").join("");
    const copy = async event => {
        await copyText(lines(text, "\t"));
        (said ?? event.target).textContent = "Copied.";
    };
    const save = () => saveFile(new Blob([lines(quoted, ",")], {type: "text/csv"}), name());
    return [h("button", {click: copy}, "Copy table"), h("button", {click: save}, "Save table")];
}

function tableActions(whole, name) {
    const said = h("output");
    return h("div", {class: "controls"}, tableButtons(whole, () => name, said), said);
}

/// A word of warning beside what it concerns; `why` is read out, and shown beside the pointer.
function badge(text, why) {
    const element = h("span", {class: "badge"}, text);
    withTip(element, `${text}: ${why}`);
    return element;
}

// A box that scrolls is a tab stop, so that arrow keys reach all of it; its height changes with its content.
const scrollWatcher = new ResizeObserver(entries => entries.forEach(({target}) => {
    if (target.scrollWidth > target.clientWidth + 1 || target.scrollHeight > target.clientHeight + 1)
        target.tabIndex = 0;
    else
        target.removeAttribute("tabindex");
}));
function scroller(...content) {
    const box = h("div", {class: "scroll"}, content);
    scrollWatcher.observe(box);
    return box;
}

/// A folded part; printing opens all of them.
const folded = (title, ...content) => h("details", {}, h("summary", {}, title), ...content);

/// Names of scenes may break after each word, in cells and heads alike.
const breakable = name => name.split(/(?<=[_.])/).flatMap(part => [part, h("wbr")]);
const shotName = shot => h("span", {class: "shot-name"}, breakable(shotLabel(shot)));

const cell = (sort, ...content) => ({sort: sort === undefined ? null : sort, content: h("span", {}, ...content)});

const tip = h("div", {class: "tip", hidden: true, role: "tooltip"});
addEventListener("keydown", event => {
    if (event.key === "Escape") tip.hidden = true;
});

/// Shows `text` beside the pointer, or beside the element for keyboard users.
function withTip(element, text) {
    const show = event => {
        const box = element.getBoundingClientRect();
        tip.textContent = text;
        tip.hidden = false;
        tip.style.left = Math.min((event.clientX ?? box.right) + 14, innerWidth - tip.offsetWidth - 8) + "px";
        tip.style.top = Math.min((event.clientY ?? box.top) + 14, innerHeight - tip.offsetHeight - 8) + "px";
    };
    const hide = () => {
        tip.hidden = true;
    };
    for (const name of ["pointermove", "focus"]) element.addEventListener(name, show);
    for (const name of ["pointerleave", "blur"]) element.addEventListener(name, hide);
    element.setAttribute("tabindex", "0");
    element.setAttribute("role", "img");
    element.setAttribute("aria-label", text.replaceAll("\n", "; "));
    return element;
}
