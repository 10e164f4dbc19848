// Fills the page, top to bottom.

document.body.append(tip, textureDefinitions());
document.querySelectorAll(".scroll").forEach(box => scrollWatcher.observe(box));
showStability();
Promise.resolve(report.diff ? showDiff() : report.isStudy ? showStudy() : showStabilityAlone())
    .then(scrollToPlace)
    .then(() => document.documentElement.setAttribute("data-ready", ""));

/// Paper cannot be unfolded; what is drawn on opening may hold further parts.
addEventListener("beforeprint", () => {
    for (let part; (part = document.querySelector("details:not([open])"));) {
        part.open = true;
        part.drawNow?.();
    }
});

/// Resolves when the pictures are there.
async function showStudy() {
    showHead();
    await showAnswers();
    await new Promise(painted => setTimeout(painted));  // the first screen, before the rest is made
    if (report.errors.length)
        showExplorer();
    else
        leaveOut("results");
    showHits();
    showStages();
    showCompiled();
    showEstimates();
    showRoughness();
    showSplits();
    showEffects();
    showTemporal();
    showReferences();
    showNeeds();
    showParameters();
    showProvenance();
    return showViewer();
}

function showStabilityAlone() {
    document.querySelectorAll("nav, main > section:not(#stability), #stability > h2").forEach(part => part.remove());
    at("subtitle").textContent = "ssrlab stability";
}
