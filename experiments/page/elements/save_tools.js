// Buttons at the table or plot that the reader points at, or has the focus in: they save it as a file that other programs open.

import {h, svg} from "./elements.js";
import {saveFile} from "./files.js";
import {tableButtons} from "./tables.js";

export const saveTools = h("div", {id: "save-tools", role: "group", "aria-label": "Save", hidden: true});

/// "results_fence.main.160x90.csv": the section, and the shot where its parts have one.
function savedName(element, extension) {
    const words = [element.closest("section")?.id, element.closest("[data-shot]")?.dataset.shot];
    return words.filter(Boolean).join("_") + "." + extension;
}

/// A plot as a file of its own: with the page's colours, letters and textures in it.
function plotText(picture) {
    const copy = picture.cloneNode(true), {width, height} = picture.viewBox.baseVal, page = getComputedStyle(document.documentElement);
    const rules = [...document.styleSheets].flatMap(sheet => [...sheet.cssRules])
                      .filter(rule => /^\.mark-|^svg/.test(rule.selectorText))
                      .map(rule => rule.cssText);
    Object.entries({width, height, "font-family": page.fontFamily, color: page.color}).forEach(([k, v]) => copy.setAttribute(k, v));
    copy.prepend(svg("style", {}, rules.join("\n")), svg("rect", {width: "100%", height: "100%", fill: "var(--page)"}));
    const textures = document.querySelector(".definitions defs");
    if (textures && copy.innerHTML.includes("url(")) copy.prepend(textures.cloneNode(true));
    return new XMLSerializer().serializeToString(copy).replace(/var\((--[\w-]+)\)/g, (_, name) => page.getPropertyValue(name).trim());
}

/// The same in pixels, twice as many as the plot's own.
function plotPicture(picture) {
    const image = new Image(), {width, height} = picture.viewBox.baseVal;
    return new Promise((resolve, reject) => {
        image.onload = () => {
            const canvas = h("canvas", {width: 2 * width, height: 2 * height});
            canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
            canvas.toBlob(resolve, "image/png");
        };
        image.onerror = () => reject(new Error("the plot cannot be drawn"));
        image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(plotText(picture));
    });
}

function toolsOf(element) {
    if (element instanceof HTMLTableElement) return tableButtons(element, () => savedName(element, "csv"));
    return [
        h("button", {click: () => saveFile(new Blob([plotText(element)], {type: "image/svg+xml"}), savedName(element, "svg"))}, "Save SVG"),
        h("button", {click: async () => saveFile(await plotPicture(element), savedName(element, "png"))}, "Save PNG")
    ];
}

let saveToolsOf = null, savesLater = 0;

function showSaveTools(target) {
    const element = target instanceof Element ? target.closest(savable) : null;
    if (saveTools.contains(target)) return clearTimeout(savesLater);
    if (!element || element === saveToolsOf && !saveTools.hidden) {
        clearTimeout(savesLater);
        if (!element) savesLater = setTimeout(() => saveTools.hidden = true, 400);  // time to reach them
        return undefined;
    }
    clearTimeout(savesLater);
    saveToolsOf = element;
    saveTools.replaceChildren(...toolsOf(element));
    saveTools.hidden = false;
    const box = (element.closest(".scroll") ?? element).getBoundingClientRect(), own = saveTools.getBoundingClientRect();
    const right = Math.min(box.left + element.getBoundingClientRect().width, box.right, innerWidth - 8);
    saveTools.style.left = `${scrollX + Math.max(right - own.width, 0)}px`;
    saveTools.style.top = `${scrollY + box.top - (box.top > own.height ? own.height : 0)}px`;
    return undefined;
}

for (const name of ["pointerover", "focusin"]) addEventListener(name, event => showSaveTools(event.target));

const savable = "main table, main .chart > svg, main svg.matrix";
