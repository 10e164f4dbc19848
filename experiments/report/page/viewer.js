// The viewer: which images are shown, and how.

const viewer = {
    shot: null,
    target: null,
    mode: "color",
    layout: "side",
    hasErrorRow: false,
    exposure: 0,
    scale: 0,
    images: [],
    visible: new Set(),
    active: 0,
    previous: 1,
    panes: [],
    pinned: null,
    pointed: null,
    drag: null,
};

const reference = () => viewer.images.find(i => i.kind === "reference");
const isError = mode => mode === "absolute" || mode === "relative";
const mostSideBySide = 6;

function showViewer() {
    if (!report.images.length) {
        at("viewer").append(h("p", {class: "note"}, "This study has no images."));
        return;
    }
    if (typeof DecompressionStream === "undefined") {
        at("viewer").append(h("p", {class: "note"}, "Images need a browser of 2023 or later (DecompressionStream)."));
        return;
    }
    viewer.shot = report.images[0].shot;
    at("viewer").append(
        ...report.notes.map(text => h("p", {class: "warning", role: "note"}, text)),
        h("div", {class: "controls", id: "viewer-choice"}), h("div", {class: "controls", id: "viewer-look"}),
        h("div", {class: "controls", id: "viewer-images"}), h("div", {class: "panes", id: "panes"}),
        h("div", {class: "scroll", id: "readout", "aria-live": "off"}),
        h("p", {class: "note"}, "Wheel or ", h("kbd", {}, "+"), h("kbd", {}, "-"),
          "zoom, drag pans, a click pins the pixel whose values are listed, arrow keys move it. ", h("kbd", {}, "1"),
          "to ", h("kbd", {}, "9"), "show one image in place, ", h("kbd", {}, "Space"), "flips to the one before, ",
          h("kbd", {}, "e"), "its error, ", h("kbd", {}, "0"), "resets. Magenta: not finite."));
    showLook();
    addEventListener("keydown", viewerKey);
    new ResizeObserver(drawAll).observe(at("panes"));
    return chooseShot(viewer.shot);
}

async function chooseShot(shot) {
    viewer.shot = shot;
    const targets = unique(report.images.filter(i => i.shot === shot).map(i => i.target));
    viewer.target = preferred(targets, viewer.target);
    const exposure = manifestShots().find(s => s.shot === shot)?.exposure_ev;
    setExposure(Number.isFinite(exposure) ? exposure : 0);
    at("viewer-choice")
        .replaceChildren(
            select("Shot", unique(report.images.map(i => i.shot)), shot, chooseShot),
            select(
                "Target", targets, viewer.target,
                t => {
                    viewer.target = t;
                    return chooseImages();
                }),
            h("button", {id: "layout-side", click: () => setLayout("side")}, "Side by side"),
            h("button", {id: "layout-flip", click: () => setLayout("flip")}, "Flip in place"));
    await chooseImages();
}

/// Loads all images of the shot and target; the reference comes first.
async function chooseImages() {
    const {shot, target} = viewer;
    const wanted = report.images.map((image, index) => ({...image, index}))
                       .filter(
                           i => i.shot === shot &&
                               i.target === (i.kind === "reference" || !isLadderRung(target) ? target : "incident"));
    wanted.sort((a, b) => (b.kind === "reference") - (a.kind === "reference"));
    const images = await Promise.all(wanted.map(i => loadImage(i.index)));
    if (viewer.shot !== shot || viewer.target !== target) return;  // another choice was made meanwhile
    Object.assign(viewer, {
        images,
        visible: new Set(images.slice(0, mostSideBySide)),
        active: 0,
        previous: Math.min(1, images.length - 1),
        pinned: null,
        pointed: null,
        scale: 0
    });
    Object.assign(view, {x: 0.5, y: 0.5, zoom: 1});
    showImageList();
    layOut();
}

function showLook() {
    const modes = [["color", "colour"], ...Object.entries(scalarModes).map(([key, mode]) => [key, mode.title])];
    at("viewer-look")
        .append(
            select(
                "Show", modes, viewer.mode,
                mode => {
                    viewer.mode = mode;
                    viewer.scale = 0;
                    layOut();
                }),
            h("label", {}, h("input", {
                  type: "checkbox",
                  id: "error-row",
                  change: event => {
                      viewer.hasErrorRow = event.target.checked;
                      layOut();
                  }
              }),
              "absolute error below"),
            h("label", {}, "Exposure (EV)", h("input", {
                  type: "range",
                  id: "exposure",
                  min: -10,
                  max: 10,
                  step: 0.25,
                  input: event => {
                      setExposure(Number(event.target.value));
                      paint();
                  }
              }),
              h("output", {id: "exposure-text"})),
            h("label", {}, "False-colour scale ×", h("input", {
                  type: "range",
                  id: "scale",
                  min: -6,
                  max: 6,
                  step: 0.25,
                  value: 0,
                  input: event => {
                      viewer.scale = Number(event.target.value);
                      paint();
                  }
              })),
            h("span", {class: "color-bar", id: "color-bar"}, h("span", {}, "0"),
              h("canvas", {width: 256, height: 1, role: "img", "aria-label": "Colour scale"}),
              h("output", {id: "scale-text"})),
            h("button", {
                click: () => {
                    zoomAbout(0.5, 0.5, 1.5);
                    drawAll();
                },
                "aria-label": "Zoom in"
            },
              "+"),
            h("button", {
                click: () => {
                    zoomAbout(0.5, 0.5, 1 / 1.5);
                    drawAll();
                },
                "aria-label": "Zoom out"
            },
              "−"),
            h("button", {id: "reset", click: reset}, "Reset view"));
    const bar = at("color-bar").querySelector("canvas").getContext("2d");
    magma.forEach((color, i) => {
        bar.fillStyle = `rgb(${color})`;
        bar.fillRect(i, 0, 1, 1);
    });
}

function setExposure(value) {
    viewer.exposure = Math.min(Math.max(value, -10), 10);
    at("exposure").value = viewer.exposure;
    at("exposure-text").textContent = (viewer.exposure > 0 ? "+" : "") + number(viewer.exposure);
}

function reset() {
    Object.assign(view, {x: 0.5, y: 0.5, zoom: 1});
    viewer.scale = 0;
    viewer.pinned = null;
    at("scale").value = 0;
    const exposure = manifestShots().find(s => s.shot === viewer.shot)?.exposure_ev;
    setExposure(Number.isFinite(exposure) ? exposure : 0);
    paint();
}

function showImageList() {
    at("viewer-images")
        .replaceChildren(...viewer.images.map(
            (image, i) =>
                h("label", {}, h("input", {
                      type: "checkbox",
                      checked: viewer.visible.has(image),
                      change: event => {
                          event.target.checked ? viewer.visible.add(image) : viewer.visible.delete(image);
                          layOut();
                      }
                  }),
                  i < 9 ? h("kbd", {}, String(i + 1)) : null, image.label)));
}

function setLayout(layout) {
    viewer.layout = layout;
    layOut();
    viewer.panes[0]?.canvas.focus({preventScroll: true});
}

/// Makes the panes that the layout asks for: one per image, with that of its error below it if asked for.
function layOut() {
    for (const name of ["side", "flip"]) at("layout-" + name).setAttribute("aria-pressed", viewer.layout === name);
    at("panes").classList.toggle("flip", viewer.layout === "flip");
    at("viewer-images").hidden = viewer.layout === "flip" && viewer.images.length === 1;
    const shown =
        viewer.layout === "flip" ? [viewer.images[viewer.active]] : viewer.images.filter(i => viewer.visible.has(i));
    const hasError = image => viewer.hasErrorRow && reference() && image !== reference();
    const columns =
        shown.map(image => [{image, mode: viewer.mode}, ...(hasError(image) ? [{image, mode: "absolute"}] : [])]);
    const wanted = columns.flat();
    while (viewer.panes.length < wanted.length) viewer.panes.push(newPane());
    viewer.panes.length = wanted.length;
    viewer.panes.forEach((pane, i) => Object.assign(pane, {wanted: wanted[i]}));
    at("panes").replaceChildren(...columns.map(
        column => h("div", {}, viewer.panes.filter(p => column.includes(p.wanted)).map(p => p.element))));
    paint();
}

/// Fills the panes' pictures anew: colours depend on mode, exposure and scale.
function paint() {
    const table = displayTable(viewer.exposure), ref = reference();
    const maxima = {};
    const maximumOf = mode => maxima[mode] ??=
        sharedMaximum(isError(mode) ? viewer.images.filter(i => i !== ref) : viewer.images, ref, mode) * 2 **
        viewer.scale;
    for (const pane of viewer.panes) {
        const {image, mode} = pane.wanted;
        const isColor = mode === "color" || (isError(mode) && (image === ref || !ref));
        const pixels = isColor ? colorPixels(image, table) : falseColorPixels(image, ref, mode, maximumOf(mode));
        const place = viewer.images.indexOf(image);
        setPane(pane, image, pixels, [
            place < 9 ? h("kbd", {}, String(place + 1)) : "", image.label,
            isColor ? "" : h("small", {}, " " + scalarModes[mode].title)
        ]);
    }
    const falseMode = viewer.mode !== "color" ? viewer.mode : viewer.hasErrorRow ? "absolute" : null;
    at("color-bar").hidden = !falseMode || (isError(falseMode) && !ref);
    if (!at("color-bar").hidden)
        at("scale-text").textContent =
            `${number(maximumOf(falseMode), 3)} (${scalarModes[falseMode].formula}; one scale for all)`;
    drawAll();
}

function drawAll() {
    for (const pane of viewer.panes)
        if (pane.image) drawPane(pane, viewer.pinned);
    showReadout();
}

/// The values of all images at the pinned or pointed pixel.
function showReadout() {
    const place = viewer.pinned ?? viewer.pointed;
    if (!place || !viewer.images.length) {
        at("readout").replaceChildren(h("p", {class: "note"}, "Point at an image to read all values of a pixel."));
        return;
    }
    const ref = reference(), i = place.y * viewer.images[0].width + place.x;
    const columns = ["Image", "R", "G", "B", "Luminance", "Absolute error", "Relative error"].map(
        (name, c) => ({name, number: c > 0}));
    const rows = viewer.images.map(image => {
        const rgb = pixelRgb(image, i),
              error = mode => image === ref || !ref ? "–" : number(scalarModes[mode].of(rgb, pixelRgb(ref, i)), 5);
        return [
            image.label, ...rgb.map(v => cell(v, number(v, 5))), number(luminance(rgb), 5), error("absolute"),
            error("relative")
        ];
    });
    at("readout").replaceChildren(table(
        columns, rows,
        {caption: `Pixel ${place.x}, ${place.y}${viewer.pinned ? " (pinned: click it again to let go)" : ""}`}));
}
