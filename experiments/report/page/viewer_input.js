// What pointer and keys do to the viewer.

function newPane() {
    const pane = createPane({
        wheel: event => {
            event.preventDefault();
            const {u, v} = pointerPlace(pane, event);
            zoomAbout(u, v, 2 ** (-event.deltaY / (event.deltaMode ? 10 : 300)));
            drawAll();
        },
        pointerdown: event => {
            pane.canvas.setPointerCapture(event.pointerId);
            viewer.drag = {x: event.clientX, y: event.clientY, hasMoved: false};
        },
        pointermove: event => {
            viewer.pointed = pointerPlace(pane, event);
            if (viewer.drag) pan(pane, event);
            drawAll();
        },
        pointerup: event => {
            if (viewer.drag && !viewer.drag.hasMoved) pin(pointerPlace(pane, event));
            viewer.drag = null;
        },
        pointercancel: () => {
            viewer.drag = null;
        },
    });
    return pane;
}

function pan(pane, event) {
    const {drag} = viewer, dx = event.clientX - drag.x, dy = event.clientY - drag.y;
    if (!drag.hasMoved && Math.hypot(dx, dy) < 3) return;  // a click of an unsteady hand
    const box = pane.canvas.getBoundingClientRect();
    view.x -= dx / box.width / view.zoom;
    view.y -= dy / box.height / view.zoom;
    limitView();
    viewer.drag = {x: event.clientX, y: event.clientY, hasMoved: true};
}

function pin(place) {
    const isSame = viewer.pinned && viewer.pinned.x === place.x && viewer.pinned.y === place.y;
    viewer.pinned = isSame ? null : {x: place.x, y: place.y};
    drawAll();
}

function showInPlace(index) {
    if (index >= viewer.images.length) return;
    if (index !== viewer.active) viewer.previous = viewer.active;
    viewer.active = index;
    viewer.layout = "flip";
    layOut();
}

/// Keys work while the viewer has the focus or the pointer; those that a focused control needs are left to it.
function viewerKey(event) {
    const section = at("viewer"), focused = document.activeElement;
    if (event.ctrlKey || event.metaKey || event.altKey || !(section.contains(focused) || section.matches(":hover")) ||
        !viewer.images.length)
        return;
    const isControl = ["INPUT", "SELECT", "BUTTON"].includes(focused.tagName);
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (event.key >= "1" && event.key <= "9")
        showInPlace(Number(event.key) - 1);
    else if (event.key === " " && !isControl)
        showInPlace(viewer.previous);
    else if (event.key === "0")
        reset();
    else if (event.key === "+" || event.key === "-") {
        zoomAbout(0.5, 0.5, event.key === "+" ? 1.5 : 1 / 1.5);
        drawAll();
    } else if (event.key === "e") {
        viewer.mode = isError(viewer.mode) ? "color" : "absolute";
        at("viewer-look").querySelector("select").value = viewer.mode;
        layOut();
    } else if (arrows[event.key] && viewer.pinned && !isControl)
        movePin(...arrows[event.key]);
    else
        return;
    event.preventDefault();
}

function movePin(dx, dy) {
    const {width, height} = viewer.images[0];
    viewer.pinned = {
        x: Math.min(Math.max(viewer.pinned.x + dx, 0), width - 1),
        y: Math.min(Math.max(viewer.pinned.y + dy, 0), height - 1)
    };
    drawAll();
}
