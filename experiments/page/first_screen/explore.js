// The reader's choice of metric and points, and what it shows: the matrix, charts of error against time, the table.

import {at, choiceBox, h} from "../elements/elements.js";
import {drawnLater} from "../elements/later.js";
import {costAxis, costBox, costListeners, costOf, errorTimeChart} from "./error_time.js";
import {matrix, sortedPoints, sortKeys, timeRows} from "./matrix.js";
import {choiceListeners, chosenRows, otherRows, showChoice, showSummary} from "./summary.js";
import {pointLegend, pointListeners, pointsChanged} from "../sections/parts.js";
import {chipKinds, howEstimated} from "../study/costs.js";
import {byShot, ofShot, pointKey, report, shortShot} from "../study/data.js";
import {better} from "../study/errors.js";
import {isOneSeed} from "../study/mistakes.js";
import {
    chartedRows, choice, comparedPoints, filteredRows, mostNamed, pointGroups, shownPoints, singleChangeKeys, sweeps, sweptParameters,
    techniques
} from "../study/points.js";
import {unique} from "../values.js";

const mostShots = 32;  // of the matrix; further ones have pages of their own
const matrixShots = [...byShot(report.errors).keys()], shownPage = {first: "0"};

/// A box for the page of the matrix; null where there is one alone.
function pageBox() {
    const firsts = matrixShots.map((_, i) => i).filter(i => i % mostShots === 0);
    const last = first => Math.min(first + mostShots, matrixShots.length) - 1;
    const text = first => `${first + 1} to ${last(first) + 1}: ${shortShot(matrixShots[first])} to ${shortShot(matrixShots[last(first)])}`;
    return firsts.length > 1 ? choiceBox("Shots of the matrix", shownPage, "first", firsts.map(i => [String(i), text(i)]), drawMatrix) : null;
}

/// Shows the page of the matrix that has the shot.
export function showInMatrix(shot) {
    const box = at("results")?.querySelector("#page-choice select");
    if (!box) return;
    const place = matrixShots.indexOf(shot), first = String(place - place % mostShots);
    if (first === shownPage.first) return;
    box.value = shownPage.first = first;
    drawMatrix();
}

const matchText = (shown, all) => shown === all ? `${all} points` : `${shown} of ${all} points`;

export function showExplorer() {
    const swept = unique(techniques.flatMap(v => sweptParameters.get(v)));
    const changed = key => value => {
        shownPoints[key] = value;
        pointsChanged();
    };
    const choose = (label, key, options) => choiceBox(label, shownPoints, key, options, pointsChanged);
    const filter = h("input", {
        type: "search",
        id: "filter",
        placeholder: "words of a point's name",
        input: event => changed("filter")(event.target.value)
    });
    const box = (label, key) => h(
        "label", {},
        h("input",
          {type: "checkbox", id: key, checked: shownPoints[key], change: event => changed(key)(event.target.checked)}),
        label);
    const colours = [
        ...(comparedPoints.length <= mostNamed ? [["point", "points"]] : []), ["technique", "techniques"],
        ...(pointGroups.length > 1 ? [["group", "groups"]] : []), ...swept.map(name => [name, name])
    ];
    const singles = `also show ${singleChangeKeys.size} points that change one parameter of a baseline`;
    at("points-choice").append(...[
        h("label", {}, "Filter", filter), choose("Sort by", "sort", Object.entries(sortKeys)),
        box("group by technique", "isGrouped"),
        techniques.includes("none") &&
            choose("Cells relative to", "relativeTo", [["best", "the least"], ["none", "none"]]),
        choose("Colours and shapes stand for", "colourBy", colours),
        costBox(),
        singleChangeKeys.size > 0 && box(singles, "hasSingleChanges"),
        h("output", {id: "match", "aria-live": "polite"})
    ].filter(Boolean));
    showChoice();
    at("page-choice").append(pageBox() ?? "");
    const draw = () => {
        drawMatrix();
        drawErrorTime();
        showSummary();
    };
    choiceListeners.push(draw);
    pointListeners.push(draw);
    costListeners.push(drawErrorTime);
    draw();
}

const ofPage = rows => matrixShots.slice(Number(shownPage.first), Number(shownPage.first) + mostShots)
                           .flatMap(shot => ofShot(rows, shot));

function drawMatrix() {
    const rows = filteredRows(chosenRows());
    at("match").textContent = matchText(unique(rows.map(pointKey)).length, unique(chosenRows().map(pointKey)).length);
    at("matrix").replaceChildren(
        rows.length ? matrix([ofPage(chosenRows()), ofPage(otherRows()), timeRows(ofPage(chosenRows()))], sortedPoints(rows)) :
                      h("p", {class: "note"}, "No point has a name with these words."));
}

function drawErrorTime() {
    const rows = chosenRows(), others = otherRows();
    const timed = rows.some(costOf), isLog = better(choice.metric.split("|")[0]) === "lower";
    at("error-time-note").textContent = [
        costAxis.kind in chipKinds ? `Times are estimates for a GPU that the study did not use. ${howEstimated()}` :
        costAxis.kind !== "time" ?
            "Counted work of all stages of a technique in the last frame: no times of a machine." :
            timed ? "Times are totals of a technique's stages, as medians over the frames. Lines are 95 % intervals." :
                    "No times were measured.",
        isLog && timed && "Grey steps join the points that no other point beats in both numbers, whatever the intervals say.",
        timed && sweeps.length && "Coloured lines join points that differ in one parameter.",
        "The dashed line is none. The dotted line is the lower bound for any single-frame technique (see Truth ladder), with its interval.",
        isLog && "An arrow marks a noise-corrected error that is not above 0.",
        rows.some(isOneSeed) && "A hollow mark has a single seed, so it has no interval and is left out of the steps.",
        "Point at a mark to read its parameters and numbers. Click it to open its images."
    ].filter(Boolean).join(" ");
    at("legend").replaceChildren(pointLegend(rows));
    const charted = chartedRows([...rows, ...others]).filter(r => r.value !== null);
    const pair = shot => h(
        "div", {class: "pair"}, [rows, others].map(own => errorTimeChart(shot, ofShot(own, shot))).filter(Boolean));
    const shots = [...byShot(rows).keys()].filter(shot => ofShot(charted, shot).length);
    at("scatter").replaceChildren(...drawnLater(shots, pair, 450));
}
