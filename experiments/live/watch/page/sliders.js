// Sliders of the parameters that the technique declares.

/// A row for each parameter that the technique reads; `changed(name, value)`, null for what the technique declares.
function sliderRows(parameters, changed) {
    return parameters.filter(p => p.is_read).map(p => {
        const output = element("output", {}, String(p.value)), room = element("span", {class: "parameter-input"});
        const row = element("div", {class: "parameter", "data-name": p.name});
        const show = value => {
            output.value = String(value);
            row.classList.toggle("changed", value !== p.initial);
        };
        const put = value => {
            const input = parameterInput(p, value, now => { show(now), changed(p.name, now === p.initial ? null : now); });
            input.setAttribute("aria-label", p.name);
            room.replaceChildren(input);
        };
        const reset = element("button", {type: "button", click: () => { put(p.initial), show(p.initial), changed(p.name, null); }}, "as declared");
        put(p.value);
        show(p.value);
        const unit = p.unit ? ` (${p.unit})` : "";
        const range = p.choices.length ? p.choices.join(", ") : p.type === "bool" ? "off, on" : `${p.min} to ${p.max}`;
        row.append(element("span", {}, element("b", {}, ...breakable(p.name)), unit), output, room, reset,
                   element("details", {}, element("summary", {}, "meaning"),
                           element("small", {}, `${p.doc}. Range: ${range}; declared ${p.initial}.`)));
        return row;
    });
}
