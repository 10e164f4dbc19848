// What a page of a report does once it is there.

import {textureDefinitions} from "../charts/textures.js";
import {scrollWatcher, tip} from "../elements/elements.js";
import {drawAll} from "../elements/later.js";
import {saveTools} from "../elements/save_tools.js";

/// Shows the page, and marks it as ready.
export async function startPage(show) {
    document.body.append(tip, saveTools, textureDefinitions());
    document.querySelectorAll(".scroll").forEach(box => scrollWatcher.observe(box));
    await show();
    scrollToPlace();
    document.documentElement.setAttribute("data-ready", "");
}

/// The browser scrolls before the sections are drawn, and would end elsewhere.
export function reloadInPlace() {
    history.scrollRestoration = "manual";
    history.replaceState({top: scrollY}, "");
    location.reload();
}

function scrollToPlace() {
    if (history.state?.top !== undefined) scrollTo(0, history.state.top);
}

addEventListener("beforeprint", drawAll);
