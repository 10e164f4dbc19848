// Values: lists that may be missing, and numbers as text.

/// Four significant digits; exponents only where the plain form is long.
export function number(x, digits = 4) {
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

export const interval = (row, digits = 4) => row.low === null || row.low === undefined ?
    whyNoInterval(row) :
    `[${number(row.low, digits)}, ${number(row.high, digits)}]`;

/// Of numbers that stand below each other.
export const twoDecimals = x => x.toFixed(2);

export const percent = (x, digits = 3) => x === null || x === undefined ? "–" : number(100 * x, digits) + " %";
export const percentInterval = r =>
    r.low === null ? "" : ` [${(100 * r.low).toFixed(1)}, ${(100 * r.high).toFixed(1)}]`;

/// 12 345 678 as 12.3 M: counts have more digits than anyone compares.
export function countText(count) {
    const [size, letter] = [[1e9, "G"], [1e6, "M"], [1e3, "k"]].find(([size]) => count >= size) ?? [1, ""];
    return letter ? `${number(count / size, 3)} ${letter}` : String(count);
}

export const microseconds = value => `${number(value, 3)} µs`;
export const unique = list => [...new Set(list)];

/// Of a manifest of another version a list may be missing.
export const list = value => Array.isArray(value) ? value : [];

/// The value if it is present, else the first one.
export const preferred = (values, value) => values.includes(value) ? value : values[0];

/// The rows that have the value under a key, or else those that share the first row's.
export function preferredRows(rows, key, value) {
    const shown = preferred(unique(rows.map(row => row[key])), value);
    return rows.filter(row => row[key] === shown);
}

/// Key to rows, in the order in which keys first come.
export function grouped(rows, keyOf) {
    const groups = new Map();
    for (const row of rows) {
        const key = keyOf(row);
        groups.has(key) ? groups.get(key).push(row) : groups.set(key, [row]);
    }
    return groups;
}
