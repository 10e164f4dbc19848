// Fills the page, top to bottom.

document.body.append(tip, textureDefinitions());
showStability();
Promise.resolve(report.isStudy ? showStudy() : showStabilityAlone())
    .then(() => document.documentElement.setAttribute("data-ready", ""));

/// Paper cannot be unfolded.
addEventListener("beforeprint", () => {
    for (const part of document.querySelectorAll("details:not([open])")) {
        part.open = true;
        part.drawNow?.();
    }
});

/// Resolves when the pictures are there.
function showStudy() {
    showHead();
    let pictures = null;
    if (report.errors.length) {
        pictures = showAnswers();
        showExplorer();
    } else {
        leaveOut("answers");
        at("results").append(h("p", {class: "note"}, "results.csv has no rows."));
    }
    showHits();
    showStages();
    showRoughness();
    showSplits();
    showEffects();
    showTemporal();
    showReferences();
    showNeeds();
    showParameters();
    showProvenance();
    return Promise.all([pictures, showViewer()]);
}

function showStabilityAlone() {
    document.querySelectorAll("nav, main > section:not(#stability), #stability > h2").forEach(part => part.remove());
    at("subtitle").textContent = "ssrlab stability";
}
