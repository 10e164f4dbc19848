// Fills the page, top to bottom.

document.body.append(tip);
showHead();
if (report.errors.length) {
    showChoice();
    choiceListeners.push(showOverview, showSummary, showScatter);
    choiceListeners.forEach(f => f());
} else {
    at("summary").append(h("p", {class: "note"}, "results.csv has no rows."));
}
showRoughness();
showSplits();
showHits();
showStages();
showEffects();
showTemporal();
showReferences();
showNeeds();
showParameters();
Promise.resolve(showViewer()).then(() => document.documentElement.setAttribute("data-ready", ""));
