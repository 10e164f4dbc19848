// Rows of a technique's parameters, each with what changes it.

import "./parameters.css";
import {breakable, h} from "./elements.js";

/// Ranges that span powers of ten move in equal ratios.
const isLogarithmic = ({min, max}) => min >= 0 && max >= 1000 * (min || 1);

/// Positions 0 to 1000 of a slider, and the values of its parameter.
function scaleOf(p) {
    const isFloat = p.type === "float", rounded = v => isFloat ? Number(v.toPrecision(6)) : Math.round(v);
    const inside = v => Math.min(Math.max(rounded(v), p.min), p.max);
    if (!isLogarithmic(p))
        return {
            value: at => inside(p.min + (p.max - p.min) * at / 1000),
            place: v => 1000 * (v - p.min) / (p.max - p.min)
        };
    const least = Math.max(p.min, isFloat ? p.max * 1e-6 : 1), span = Math.log(p.max / least);
    return {
        value: at => at <= 0 ? p.min : inside(least * Math.exp(span * at / 1000)),
        place: v => v <= least ? 0 : 1000 * Math.log(v / least) / span
    };
}

/// What changes one parameter, by its type. `changed(value)`.
function parameterInput(p, value, changed) {
    const name = {"aria-label": p.name};
    if (p.choices.length)
        return h(
            "select", {...name, change: e => changed(e.target.value)},
            p.choices.map(choice => h("option", {value: choice, selected: choice === value}, choice)));
    if (p.type === "bool")
        return h("input", {...name, type: "checkbox", checked: value, change: e => changed(e.target.checked)});
    const {value: valueAt, place} = scaleOf(p);
    const input = h(
        "input",
        {...name, type: "range", min: 0, max: 1000, step: "any", input: e => changed(valueAt(Number(e.target.value)))});
    input.value = place(value);
    return input;
}

/// A row for each of the parameters; `changed(parameter, value)`. `original`: a parameter's value that its button puts
/// back, `origin`: what the button says.
export const parameterRows = (parameters, {original, origin, changed}) => parameters.map(p => {
    const output = h("output", {}, String(p.value)), room = h("span", {class: "parameter-input"});
    const show = value => {
        output.value = String(value);
        row.classList.toggle("changed", value !== original(p));
    };
    const take = value => {
        show(value);
        changed(p, value);
    };
    const put = value => room.replaceChildren(parameterInput(p, value, take));
    const reset = () => {
        put(original(p));
        take(original(p));
    };
    const range = p.choices.length ? p.choices.join(", ") : p.type === "bool" ? "off, on" : `${p.min} to ${p.max}`;
    const row = h(
        "div", {class: "parameter", "data-name": p.name},
        h("span", {}, h("b", {}, breakable(p.name)), p.unit ? ` (${p.unit})` : ""), output, room,
        h("button", {type: "button", click: reset}, origin),
        h("details", {}, h("summary", {}, "meaning"),
          h("small", {}, `${p.doc}. Range: ${range}; default ${p.initial}.`)));
    put(p.value);
    show(p.value);
    return row;
});
