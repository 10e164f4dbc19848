// The page of a report: fills it, top to bottom.

import "./style.css";
import "./viewer/viewer.css";
import {at} from "./elements/elements.js";
import {showAnswers} from "./first_screen/answers.js";
import {showExplorer} from "./first_screen/explore.js";
import {showCompiled} from "./sections/compiled.js";
import {showEffects} from "./sections/effects.js";
import {showErrorShares} from "./sections/error_shares.js";
import {showEstimates} from "./sections/estimates.js";
import {showHead, showNeeds, showParameters, showReferences} from "./sections/facts.js";
import {showHits} from "./sections/hits.js";
import {leaveOut} from "./sections/parts.js";
import {showProvenance} from "./sections/provenance.js";
import {showRoughness} from "./sections/roughness.js";
import {showSplits} from "./sections/splits.js";
import {showStability} from "./sections/stability.js";
import {showStages} from "./sections/stages.js";
import {startPage} from "./sections/start.js";
import {showTemporal} from "./sections/temporal.js";
import {report} from "./study/data.js";
import {showViewer} from "./viewer/viewer.js";

/// Resolves when the pictures are there.
async function showStudy() {
    showHead();
    await showAnswers();
    await new Promise(painted => setTimeout(painted));  // the first screen, before the rest is made
    if (report.errors.length)
        showExplorer();
    else
        leaveOut("results");
    showErrorShares();
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

function showStabilityAlone() { at("subtitle").textContent = "ssrlab stability"; }

startPage(() => {
    showStability();
    return report.isStudy ? showStudy() : showStabilityAlone();
});

// What a browser's console reaches as `ssrlab`, and tests.
export * from "./charts/axes.js";
export * from "./charts/plots.js";
export * from "./charts/styles.js";
export * from "./charts/textures.js";
export * from "./elements/elements.js";
export * from "./first_screen/answers.js";
export * from "./first_screen/error_time.js";
export * from "./images/colors.js";
export * from "./images/differences.js";
export * from "./images/packed.js";
export * from "./sections/stages.js";
export * from "./sections/start.js";
export * from "./study/answers.js";
export * from "./study/costs.js";
export * from "./study/data.js";
export * from "./study/errors.js";
export * from "./study/mistakes.js";
export * from "./study/points.js";
export * from "./values.js";
export * from "./viewer/chooser.js";
export * from "./viewer/crops.js";
export * from "./viewer/input.js";
export * from "./viewer/keep.js";
export * from "./viewer/look.js";
export * from "./viewer/page_images.js";
export * from "./viewer/panes.js";
export * from "./viewer/state.js";
export * from "./viewer/viewer.js";
