// The first screen: what the scenes say together and each shot says, and for the chosen one its pictures and its errors against time.

const answerChoice = {
    shot: null
};

const answerOf = shot => report.answers.find(a => a.shot === shot);
/// Label of what the answer calls the baseline; undefined where it has none.
const baselineLabel = shot => {
    const baseline = answerOf(shot)?.baseline;
    return baseline ? pointLabel(baseline) : undefined;
};

/// The sections below show the chosen shot, too.
function showShotBelow(shot) {
    for (const part of document.querySelectorAll("details.shot[data-shot]")) part.open = part.dataset.shot === shot;
    if (viewer.shot !== null && report.images.some(i => i.shot === shot)) chooseShot(shot);
}

/// The viewer at that shot with the truth, this point and the best, or the baseline beside the best itself.
function openPoint(row) {
    const best = answerOf(row.shot)?.best, isOther = best && pointLabel(best) !== pointLabel(row);
    const points = unique([pointLabel(row), isOther ? pointLabel(best) : baselineLabel(row.shot)].filter(Boolean));
    return openViewer({shot: row.shot, points});
}

/// Resolves when the pictures are there.
function showAnswers() {
    const shots = unique(report.errors.map(r => r.shot));
    answerChoice.shot = shots[0];
    at("over-scenes").textContent = report.overScenes;
    pointListeners.push(drawAnswerCharts);
    showBudget();
    showWhy();
    return drawAnswers(shots);
}

function drawAnswers(shots) {
    const isChosen = shot => shot === answerChoice.shot;
    const choose = shot => () => {
        answerChoice.shot = shot;
        drawAnswers(shots);
        showShotBelow(shot);
        at("answer-shots").querySelector("[aria-pressed=true]").focus();
    };
    at("answer-shots")
        .replaceChildren(...shots.map(
            shot =>
                h("li", {},
                  h("button", {
                      "aria-pressed": String(isChosen(shot)),
                      click: choose(shot),
                      title: [shot, answerOf(shot)?.sentence].filter(Boolean).join("\n")
                  },
                    answerText(shot)))));
    at("answer-shots")
        .style.setProperty(
            "--lines",
            shots.length <= mostWhole        ? "none" :
                shots.length <= mostTwoLines ? 2 :
                                               1);
    const perceptual = answerOf(answerChoice.shot)?.perceptual_sentence;
    at("answer-note").replaceChildren(perceptual ?? "");
    drawAnswerCharts();
    return drawAnswerPictures();
}

/// The outer box may cut the text off after some lines; the inner one keeps it one text.
const answerText = shot =>
    h("span", {class: "cut"},
      h("span", {}, h("b", {}, shortShot(shot)), " ", answerOf(shot)?.sentence ?? "No technique is named."));
// Of many shots only the chosen one's sentence is shown whole, of others two lines or one.
const mostWhole = 3, mostTwoLines = 6;

/// Rows of the shot of the headline's target and mask, by the name of a metric.
const headlineRows = (shot, metric) => {
    const {target, mask} = headline;
    const of = report.errors.filter(r => r.shot === shot && r.metric === metric && r.value !== null);
    const narrow = (rows, key, wanted) => rows.filter(r => r[key] === preferred(unique(rows.map(r => r[key])), wanted));
    return narrow(narrow(of, "target", target), "mask", mask);
};

/// Names of the metrics that stand side by side: one or two.
const headlineMetrics = () => {
    const first = headlineMetric(report.errors);
    return [first, otherMetric(first, report.errors)].filter(Boolean).map(key => key.split("|")[0]);
};

function drawAnswerCharts() {
    const {shot} = answerChoice, metrics = headlineMetrics();
    const charts = metrics.map(metric => errorTimeChart(shot, headlineRows(shot, metric), {width: 420, height: 320}));
    at("answer-charts").replaceChildren(...charts.filter(Boolean));
    drawBudget(shot);
    drawWhy(shot);
    at("answer-legend").replaceChildren(pointLegend(headlineRows(shot, metrics[0])));
}

/// [{title, image, row}]: truth, best and baseline.
function answerPictures(shot) {
    const ofShot = report.images.map((image, index) => ({...image, index})).filter(i => i.shot === shot);
    const frames = ofShot.map(i => Number(i.frame ?? 0)),
          own = ofShot.filter((_, i) => frames[i] === Math.max(...frames));
    const target = preferred(unique(own.map(i => i.target)), "image"), answer = answerOf(shot);
    const {metric} = headline;
    const text = p => `${metric} ${number(p.value, 3)} ${interval(p, 3)}`;
    const of = (title, point) => point && {
        title: `${title}: ${pointLabel(point)}`,
        text: text(point),
        row: {shot, ...point},
        image: own.find(i => i.target === target && i.kind === "result" && pointKey(i) === pointKey(point))
    };
    return [
        {title: "truth", text: target, image: own.find(i => i.target === target && i.kind === "reference")},
        of(answer?.tied?.length ? "best, not distinguishable from others" : "best", answer?.best),
        of("baseline", answer?.baseline)
    ].filter(Boolean);
}

async function drawAnswerPictures() {
    const {shot} = answerChoice, wanted = answerPictures(shot);
    const hasPictures = wanted.some(p => p.image) && typeof DecompressionStream !== "undefined";
    at("answer-pictures").hidden = !hasPictures;
    if (!hasPictures) return;
    const images = await Promise.all(wanted.map(p => p.image && loadImage(p.image.index).catch(() => null)));
    if (answerChoice.shot !== shot) return;  // another choice was made meanwhile
    const exposure = manifestShots().find(s => s.shot === shot)?.exposure_ev,
          codes = displayTable(Number.isFinite(exposure) ? exposure : 0, "none");
    at("answer-pictures").replaceChildren(...wanted.map(({title, text, row}, i) => {
        const caption = h("figcaption", {}, h("b", {}, title), " ", h("small", {}, text));
        if (!images[i])
            return h(
                "figure", {}, caption,
                h("p", {class: "note"}, "Its image is in the results folder, not in this page."));
        const canvas =
            h("canvas",
              {width: images[i].width, height: images[i].height, role: "img", "aria-label": `${title}, ${shot}`});
        canvas.getContext("2d").putImageData(colorPixels(images[i], codes), 0, 0);
        if (row) {
            clickable(canvas, () => openPoint(row));
            canvas.tabIndex = 0;
            canvas.title = "Open in the viewer";
        }
        return h("figure", {}, caption, canvas);
    }));
}
