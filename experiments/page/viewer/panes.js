// One picture in a frame: it draws its image at the view that all panes share.

import {h} from "../elements/elements.js";
import {putPixels} from "../images/colors.js";

/// The shared view: `x`, `y` in [0, 1] is the image point in the middle of each pane; `zoom` 1 fits the image to the
/// pane.
export const view = {
    x: 0.5,
    y: 0.5,
    zoom: 1
};
const maximumZoom = 64;

export function limitView() {
    view.zoom = Math.min(Math.max(view.zoom, 1), maximumZoom);
    const half = 0.5 / view.zoom;
    view.x = Math.min(Math.max(view.x, half), 1 - half);
    view.y = Math.min(Math.max(view.y, half), 1 - half);
}

export function createPane(listeners) {
    const canvas = h("canvas", {tabindex: 0, role: "img", ...listeners});
    const caption = h("figcaption");
    return {
        canvas,
        caption,
        element: h("figure", {class: "pane"}, caption, canvas),
        image: null,
        picture: document.createElement("canvas"),
        second: null  // right of the split
    };
}

/// Makes the pane show `pixels` (ImageData) of `image`, and `second` right of the split, if there is one.
export function setPane(pane, image, pixels, second, caption, target) {
    pane.image = image;
    putPixels(pane.picture, pixels);
    pane.second = second ? putPixels(pane.second ?? document.createElement("canvas"), second) : null;
    pane.caption.replaceChildren(...caption);
    pane.caption.title = pane.caption.textContent;
    pane.canvas.setAttribute("aria-label", `${pane.caption.textContent}, ${target}`);
    pane.canvas.style.aspectRatio = `${image.width} / ${image.height}`;
}

/// Canvas pixels per image pixel, and the canvas position of the image's corner.
function paneTransform(pane) {
    const scale = pane.canvas.width / pane.image.width * view.zoom;
    return {
        scale,
        left: pane.canvas.width / 2 - view.x * pane.image.width * scale,
        top: pane.canvas.height / 2 - view.y * pane.image.height * scale
    };
}

/// `pinned`: a pixel; `box`: [x, y, width, height] in pixels; `splitAt` in [0, 1] of the pane's width. Any may be null.
export function drawPane(pane, {pinned, splitAt, box}) {
    const {canvas, image} = pane;
    const width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio)),
          height = Math.max(1, Math.round(width * image.height / image.width));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    const context = canvas.getContext("2d"), {scale, left, top} = paneTransform(pane);
    context.fillStyle = "#000";
    context.fillRect(0, 0, width, height);
    context.imageSmoothingEnabled = scale < 1;
    context.drawImage(pane.picture, left, top, image.width * scale, image.height * scale);
    if (pane.second) drawSecond(context, pane, Math.round(splitAt * width), {scale, left, top});
    if (pinned) {
        const size = Math.max(scale, 5);
        outline(
            context, left + (pinned.x + 0.5) * scale - size / 2, top + (pinned.y + 0.5) * scale - size / 2, size, size);
    }
    if (box) outline(context, left + box[0] * scale, top + box[1] * scale, box[2] * scale, box[3] * scale);
}

function drawSecond(context, pane, x, {scale, left, top}) {
    const {canvas, image} = pane;
    context.save();
    context.beginPath();
    context.rect(x, 0, canvas.width - x, canvas.height);
    context.clip();
    context.fillRect(x, 0, canvas.width - x, canvas.height);
    context.drawImage(pane.second, left, top, image.width * scale, image.height * scale);
    context.restore();
    context.fillRect(x - 2, 0, 4, canvas.height);
    context.fillStyle = "#fff";
    context.fillRect(x - 1, 0, 2, canvas.height);
    context.beginPath();
    context.arc(x, canvas.height / 2, 7 * devicePixelRatio, 0, 7);
    context.fill();
    context.strokeStyle = "#000";
    context.stroke();
}

/// White within black, so that it shows on any picture.
function outline(context, x, y, width, height) {
    context.lineWidth = 1;
    for (const [color, grow] of [["#000", 1.5], ["#fff", 0.5]]) {
        context.strokeStyle = color;
        context.strokeRect(x - grow, y - grow, width + 2 * grow, height + 2 * grow);
    }
}

/// Where a pointer event is: `u`, `v` in the pane in [0, 1], and the image pixel under it.
export function pointerPlace(pane, event) {
    const box = pane.canvas.getBoundingClientRect();
    const u = (event.clientX - box.left) / box.width, v = (event.clientY - box.top) / box.height;
    const clampTo = (value, size) => Math.min(Math.max(Math.floor(value * size), 0), size - 1);
    return {
        u,
        v,
        x: clampTo(view.x + (u - 0.5) / view.zoom, pane.image.width),
        y: clampTo(view.y + (v - 0.5) / view.zoom, pane.image.height)
    };
}

/// Zooms about the point at `u`, `v` of the panes, which stays where it is.
export function zoomAbout(u, v, factor) {
    const before = view.zoom;
    view.zoom = Math.min(Math.max(view.zoom * factor, 1), maximumZoom);
    view.x += (u - 0.5) * (1 / before - 1 / view.zoom);
    view.y += (v - 0.5) * (1 / before - 1 / view.zoom);
    limitView();
}
