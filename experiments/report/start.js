// Fills the page, top to bottom.

document.body.append(tip);
showHead();
if (report.errors.length) {
    showChoice();
    choiceListeners.push(showSummary, showScatter);
    choiceListeners.forEach(f => f());
} else {
    at("summary").append(h("p", {class: "note"}, "results.csv has no rows."));
}
showStages();
showReferences();
showNeeds();
showParameters();
Promise.resolve(showViewer()).then(() => document.documentElement.setAttribute("data-ready", ""));
