// Parts of a page that are made when the reader comes near them: hundreds of shots have more than a browser shows at once.

import {h} from "./elements.js";

/// So many parts alike are made with the page; of more, each is made when the reader comes near it.
export const mostAtOnce = 8;

const watcher = new IntersectionObserver(
    entries => entries.filter(e => e.isIntersecting).forEach(e => e.target.drawNow()), {rootMargin: "100%"});

/// Calls `draw` once, when `place` comes near the window. Printing calls it at once.
export function drawLater(place, draw) {
    place.classList.add("later");
    place.drawNow = () => {
        watcher.unobserve(place);
        place.classList.remove("later");
        draw();
    };
    watcher.observe(place);
    return place;
}

/// draw(item) of all items, an element each; of many items places of so many CSS pixels until the reader is near.
export const drawnLater = (items, draw, height) => items.map(item => {
    if (items.length <= mostAtOnce) return draw(item);
    const place = h("div", {style: `min-height: ${height}px`});
    return drawLater(place, () => place.replaceWith(draw(item)));
});

/// A folded part whose content `draw()` makes when it is opened.
export function foldedLater(title, draw) {
    const part = h("details", {}, h("summary", {}, title));
    part.drawNow = () => {
        if (part.open && part.children.length === 1) part.append(...draw());
    };
    part.addEventListener("toggle", part.drawNow);
    return part;
}

/// Makes all that is still to be made, as paper needs it; what is made may hold further parts.
export function drawAll() {
    const left = () => document.querySelectorAll(".later, details:not([open])");
    for (let parts = left(); parts.length; parts = left())
        for (const part of parts) {
            if (part instanceof HTMLDetailsElement) part.open = true;
            part.drawNow?.();
        }
}
