// Elements of a page.

/// An element: `h("td", {class: "number"}, "12")`. Attributes that are functions become listeners, null ones are left
/// out.
export function h(tag, attributes = {}, ...children) { return fill(document.createElement(tag), attributes, children); }

/// The same of a drawing.
export function svg(tag, attributes = {}, ...children) {
    return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

export function fill(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function")
            element.addEventListener(name, value);
        else if (value !== null && value !== undefined && value !== false)
            element.setAttribute(name, value === true ? "" : value);
    }
    element.append(...children.flat().filter(c => c !== null && c !== undefined));
    return element;
}

export const at = id => document.getElementById(id);

export function select(label, options, value, changed) {
    const box = h("select", {change: event => changed(event.target.value)});
    fillOptions(box, options, value);
    return h("label", {}, label, box);
}

/// A select() that keeps what is chosen in choice[key].
export const choiceBox = (label, choice, key, options, changed) => select(label, options, choice[key], value => {
    choice[key] = value;
    changed();
});

/// `options`: texts, or [key, text].
export const fillOptions = (box, options, value) => box.replaceChildren(...options.map(o => {
    const [key, text] = Array.isArray(o) ? o : [o, o];
    return h("option", {value: key, selected: key === value}, text);
}));

/// Of {key: {title}}, as options.
export const titlesOf = choices => Object.entries(choices).map(([key, {title}]) => [key, title]);

export const factList = facts =>
    h("dl", {class: "facts"}, facts.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));

/// A square of a colour, for legends.
export const swatch = color => h("span", {class: "swatch", style: `background:${color}`});

/// Makes `element` a button to pointer, keys and screen readers.
export function clickable(element, act) {
    element.setAttribute("role", "button");
    element.classList.add("clickable");
    element.addEventListener("click", act);
    element.addEventListener("keydown", event => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        act(event);
    });
}

// A box that scrolls is a tab stop, so that arrow keys reach all of it; its height changes with its content.
export const scrollWatcher = new ResizeObserver(entries => entries.forEach(({target}) => {
    if (target.scrollWidth > target.clientWidth + 1 || target.scrollHeight > target.clientHeight + 1)
        target.tabIndex = 0;
    else
        target.removeAttribute("tabindex");
}));
export function scroller(...content) {
    const box = h("div", {class: "scroll"}, content);
    scrollWatcher.observe(box);
    return box;
}

/// A folded part; printing opens all of them.
export const folded = (title, ...content) => h("details", {}, h("summary", {}, title), ...content);

/// Names of scenes may break after each word, in cells and heads alike.
export const breakable = name => name.split(/(?<=[_.])/).flatMap(part => [part, h("wbr")]);

/// A word of warning beside what it concerns; `why` is read out, and shown beside the pointer.
export function badge(text, why) {
    const element = h("span", {class: "badge"}, text);
    withTip(element, `${text}: ${why}`);
    return element;
}

export const tip = h("div", {class: "tip", hidden: true, role: "tooltip"});

const tipTexts = new WeakMap();  // by element

function tipFor(event) {
    let element = event.target;
    while (element instanceof Element && !tipTexts.has(element)) element = element.parentElement;
    if (!(element instanceof Element)) return;
    const box = element.getBoundingClientRect();
    tip.textContent = tipTexts.get(element);
    tip.hidden = false;
    tip.style.left = Math.min((event.clientX ?? box.right) + 14, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = Math.min((event.clientY ?? box.top) + 14, innerHeight - tip.offsetHeight - 8) + "px";
}
function hideTip() { tip.hidden = true; }

// For all elements at once: a page has thousands with tips.
for (const name of ["pointermove", "focusin"]) addEventListener(name, tipFor);
for (const name of ["pointerout", "focusout"]) addEventListener(name, hideTip);

/// Shows `text` beside the pointer, or beside the element for keyboard users.
export function withTip(element, text) {
    tipTexts.set(element, text);
    element.setAttribute("tabindex", "0");
    element.setAttribute("role", "img");
    element.setAttribute("aria-label", text.replaceAll("\n", "; "));
    return element;
}

addEventListener("keydown", event => {
    if (event.key === "Escape") hideTip();
});
