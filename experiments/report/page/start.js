// Fills the page, top to bottom.

document.body.append(tip);
showStability();
Promise.resolve(report.isStudy ? showStudy() : showStabilityAlone())
    .then(() => document.documentElement.setAttribute("data-ready", ""));

/// Resolves when the pictures are there.
function showStudy() {
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
    return showViewer();
}

function showStabilityAlone() {
    document.querySelectorAll("nav, main > section:not(#stability), #stability > h2").forEach(part => part.remove());
    at("subtitle").textContent = "ssrlab stability";
}
