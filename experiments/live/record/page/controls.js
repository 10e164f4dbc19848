// The page's elements, and the sliders of parameters.

const at = id => document.getElementById(id);

/// An element with attributes; those that are functions become listeners.
function element(tag, attributes, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes))
        typeof value === "function" ? made.addEventListener(name, value) : made.setAttribute(name, value);
    made.append(...children);
    return made;
}

const fourDigits = x => x === null ? "–" : String(Number(x.toPrecision(4)));

/// Ranges that span powers of ten move in equal ratios.
const isLogarithmic = ({min, max}) => min >= 0 && max >= 1000 * (min || 1);

/// Positions 0 to 1000 of a slider, and the values of its parameter.
function scaleOf(p) {
    const isFloat = p.type === "float", rounded = v => isFloat ? Number(v.toPrecision(6)) : Math.round(v);
    const inside = v => Math.min(Math.max(rounded(v), p.min), p.max);
    if (!isLogarithmic(p))
        return {value: at => inside(p.min + (p.max - p.min) * at / 1000),
                place: v => 1000 * (v - p.min) / (p.max - p.min)};
    const least = Math.max(p.min, isFloat ? p.max * 1e-6 : 1), span = Math.log(p.max / least);
    return {value: at => at <= 0 ? p.min : inside(least * Math.exp(span * at / 1000)),
            place: v => v <= least ? 0 : 1000 * Math.log(v / least) / span};
}

/// What changes one parameter, by its type. `changed(value)`.
function parameterInput(p, value, changed) {
    if (p.choices.length)
        return element("select", {change: e => changed(e.target.value)}, ...p.choices.map(choice => {
            const option = element("option", {value: choice}, choice);
            option.selected = choice === value;
            return option;
        }));
    if (p.type === "bool") {
        const box = element("input", {type: "checkbox", change: e => changed(e.target.checked)});
        box.checked = value;
        return box;
    }
    const {value: valueAt, place} = scaleOf(p);
    const input = element(
        "input", {type: "range", min: 0, max: 1000, step: "any", input: e => changed(valueAt(Number(e.target.value)))});
    input.value = place(value);
    return input;
}

/// A name that may go on in the next line behind '_' and '.'.
const breakable = name => name.split(/(?<=[_.])/).flatMap(part => [part, element("wbr", {})]);

/// A row for each parameter that has a slider; `changed(parameter, value)`.
function parameterRows(parameters, changed) {
    return parameters.filter(p => p.is_slider).map(p => {
        const output = element("output", {}, String(p.value));
        const room = element("span", {class: "parameter-input"});
        const put = value => {
            const input = parameterInput(p, value, take);
            input.setAttribute("aria-label", p.name);
            room.replaceChildren(input);
        };
        const take = value => {
            output.value = String(value);
            changed(p, value);
        };
        const reset = element("button", {type: "button", click: () => { put(p.value), take(p.value); }}, "as recorded");
        put(p.value);
        const unit = p.unit ? ` (${p.unit})` : "";
        const range = p.choices.length ? p.choices.join(", ") : p.type === "bool" ? "off, on" : `${p.min} to ${p.max}`;
        return element("div", {class: "parameter", "data-name": p.name},
                       element("span", {}, element("b", {}, ...breakable(p.name)), unit), output, room, reset,
                       element("details", {}, element("summary", {}, "meaning"),
                               element("small", {}, `${p.doc}. Range: ${range}; default ${p.initial}.`)));
    });
}

/// The parameters that have no slider, by the reason.
function leftOut(parameters) {
    const reasons = new Map();
    for (const p of parameters)
        if (!p.is_slider) reasons.set(p.why_not, [...reasons.get(p.why_not) ?? [], `${p.name} = ${p.value}`]);
    return [...reasons].flatMap(([why, names]) => [element("dt", {}, why), element("dd", {}, names.join(", "))]);
}
