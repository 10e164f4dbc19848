// What sections are made of: choices, folded parts of shots, legends of points.

import {legend, legendGroups} from "../charts/styles.js";
import {at, choiceBox, h} from "../elements/elements.js";
import {drawLater, mostAtOnce} from "../elements/later.js";
import {manifestShots, shotLabel} from "../study/data.js";
import {headline, headlineMetric, metricKey, metricName} from "../study/errors.js";
import {filteredRows, shownPoints} from "../study/points.js";
import {preferred, unique} from "../values.js";

/// What draws anew when filter, legend or colours change.
export const pointListeners = [];
export const pointsChanged = () => pointListeners.forEach(f => f());
const hasManyShots = manifestShots().length > mostAtOnce;

/// draw() fills `place`, anew when the shown points change; in a study of many shots while the reader is near. Returns
/// what fills it anew.
export function drawnPart(place, draw) {
    const update = () => hasManyShots ? drawLater(place, draw) : draw();
    pointListeners.push(update);
    update();
    return update;
}

/// A button per series: it shows and hides the series in all charts.
export function pointLegend(rows) {
    const groups = legendGroups(filteredRows(rows)), {hidden} = shownPoints;
    const entries = groups.map(({label, keys, style}) => ({
                                   label,
                                   style,
                                   isShown: keys.some(k => !hidden.has(k)),
                                   toggle: () => {
                                       const isShown = keys.some(k => !hidden.has(k));
                                       keys.forEach(k => isShown ? hidden.add(k) : hidden.delete(k));
                                       pointsChanged();
                                   }
                               }));
    const all = hide => () => {
        groups.flatMap(g => g.keys).forEach(k => hide ? hidden.add(k) : hidden.delete(k));
        pointsChanged();
    };
    return legend(entries, groups.length > 4 ? [["all", all(false)], ["none", all(true)]] : []);
}

/// A box for each of the `keys` (target, metric, mask) of `choice`, with the values that `rows` have; it begins with
/// the headline's.
export const choiceBoxes = (choice, keys, rows, changed) => keys.map(key => {
    const isMetric = key === "metric", values = unique(rows.map(isMetric ? metricKey : r => r[key]));
    choice[key] = isMetric ? headlineMetric(rows) : preferred(values, headline[key]);
    const label = key[0].toUpperCase() + key.slice(1);
    return choiceBox(label, choice, key, isMetric ? values.map(m => [m, metricName(m)]) : values, changed);
});

/// A folded part per shot, those of the first row open; `draw(shot)` gives its content when it is opened, and anew when
/// the shown points change, or its `redraw()` is called.
export function shotParts(shots, draw) {
    const columns = Math.max(1, Math.floor(innerWidth / 1200));  // as the style sheet's .shots
    const parts = shots.map((shot, i) => {
        const body = h("div"),
              part =
                  h("details", {open: i < columns, "data-shot": shot, class: "shot"}, h("summary", {}, shotLabel(shot)),
                    body);
        let isDrawn = false;
        const update = part.drawNow = () => {  // printing does not wait for events
            if (part.open && !isDrawn) body.replaceChildren(...draw(shot));
            isDrawn = part.open;
        };
        part.addEventListener("toggle", update);
        part.redraw = () => {
            isDrawn = false;
            update();
        };
        update();
        return part;
    });
    const all = h("div", {class: "shots"}, parts);
    all.redraw = () => parts.forEach(part => part.redraw());
    pointListeners.push(all.redraw);
    return all;
}

/// Takes a section that a study has nothing for off the page, and the link to it.
export function leaveOut(id) {
    at(id).remove();
    document.querySelector(`nav a[href="#${id}"]`)?.remove();
}

/// A sentence for each reason why some of `count` rows have no numbers; `place` names a row, `all` all of them.
export function refusalsNote(refused, count, place, all) {
    const sentences = unique(refused.map(r => r.refusal)).map(reason => {
        const places = refused.filter(r => r.refusal === reason).map(place);
        const where = places.length === count ? all : places.join(", ");
        return h("li", {class: "warning"}, `${where}: ${reason}.`);
    });
    return sentences.length ? h("ul", {class: "refusals", "aria-label": "What has no numbers, and why"}, sentences) : "";
}

export const longList = 6;  // of paragraphs; longer ones are folded
export const longTable = 20;  // rows; longer tables are folded

/// The part of a section that shows one chip and shot of the reader's choice, kept in `choice`: `draw()` gives its
/// content, `chips` and `shots` are [key, text].
export function chipPart(id, choice, {chips, shots, draw}) {
    Object.assign(choice, {chip: chips[0][0], shot: shots[0][0]});
    const body = h("div"), update = () => body.replaceChildren(...draw());
    pointListeners.push(update);
    update();
    const choosers = [
        choiceBox("Chip", choice, "chip", chips, update),
        shots.length > 1 ? choiceBox("Shot", choice, "shot", shots, update) : null
    ];
    at(id).append(h("div", {class: "controls"}, choosers), body);
}
