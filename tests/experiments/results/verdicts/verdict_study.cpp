// How often verdicts are wrong: made-up studies whose points do not differ, or differ by just the margin, through
// everything that decides. Prints the table of metrics/coverage.md, "False alarms".
//
// usage: verdict_study [STUDIES]    of each kind; 1000 take 2 minutes on a core
#include "experiments/results/tradeoff/pairs.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/judgement.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_diff.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

namespace {

/// What a made-up study is like.
struct Kind {
    std::string text;
    int shots, points;
    unsigned seeds;
    double deviation;      ///< of the logarithm of a seed's error
    double of_scenes = 0;  ///< of the logarithm of a point's error from scene to scene
};

const PrimaryComparisons primary;

StudyResults study_of(const Kind& kind, std::mt19937_64& random, bool is_at_margin = false) {
    std::normal_distribution<double> normal;
    StudyResults tables;
    std::vector<ComparedPoint> techniques;
    for (int p = 0; p < kind.points; ++p) {
        ComparedPoint& v = techniques.emplace_back();
        v.technique = std::to_string(p), v.point = "default", v.is_baseline = p == 0;
        tables.manifest["techniques"].push_back({{"technique", v.technique}, {"point", v.point}, {"baseline", p == 0}});
    }
    for (int shot = 0; shot < kind.shots; ++shot) {
        const std::string name = "scene" + std::to_string(shot);
        tables.manifest["shots"].push_back(
            {{"shot", name}, {"scene", name}, {"references", {{{"hash", std::to_string(random())}}}}});
        for (int p = 0; p < kind.points; ++p) {
            const double truth =
                (is_at_margin && p > 0 ? 1 + primary.margin : 1) * std::exp(kind.of_scenes * normal(random));
            for (unsigned seed = 1; seed <= kind.seeds; ++seed) {
                ResultRow& r = tables.results.emplace_back();
                r.shot = name, r.frame = "0", r.technique = std::to_string(p), r.point = "default", r.seed = seed;
                r.target = primary.target, r.metric = r.formula = primary.metric, r.mask = primary.mask;
                r.floor = 0, r.represents_shot = r.corrected = true;
                r.value = truth * std::exp(kind.deviation * normal(random));
            }
        }
    }
    tables.summary = summarise(tables.results);
    tables.effects = paired_effects(tables.results, techniques);
    set_standings(tables.summary, paired_errors(tables.results, techniques));
    set_verdicts(tables.effects, primary, decided_by_standings(tables.summary));
    match_effects(tables.summary, tables.effects);
    return tables;
}

/// Studies with at least one wrong verdict, by who gave it.
using Alarms = std::map<std::string, int>;

void count_alarms(Alarms& alarms, const Kind& kind, std::mt19937_64& random) {
    const auto is_different = [](const std::string& verdict) {
        return verdict == verdict::less || verdict == verdict::more;
    };
    const StudyResults tables = study_of(kind, random);
    if (kind.of_scenes == 0) {
        alarms["a point is behind in a shot (`standing`)"] +=
            std::ranges::count(tables.summary, standing::behind, &MetricSummary::standing) > 0;
        alarms["an effect (`effects.csv`)"] += std::ranges::any_of(tables.effects, is_different, &EffectRow::verdict);
        alarms["a pair of `ssrlab tradeoff`"] +=
            std::ranges::any_of(pairs_of(tables, primary), is_different, &PairRow::error_verdict);
        const StudyResults again = study_of(kind, random);
        alarms["a number of `ssrlab diff`"] += count_of(diff_studies(tables, again, false).errors, change::changed) > 0;
        const std::string verdict = judge_effects(tables.effects, primary, {"1", "default"}, {"0", "default"}).verdict;
        alarms["`ssrlab judge`, all views"] += verdict == judgement::better || verdict == judgement::worse;
        const StudyResults margin = study_of(kind, random, true);
        alarms["a point at the margin is equivalent (`standing`)"] += std::ranges::any_of(
            margin.summary,
            [](const MetricSummary& e) { return e.technique != "0" && e.p_equivalent.value_or(1) < significance; });
        alarms["an effect at the margin is equivalent"] +=
            std::ranges::any_of(margin.effects, [](const EffectRow& e) { return e.verdict == verdict::equivalent; });
    } else {
        const auto rows = errors_over_scenes(tables.summary, tables.manifest);
        alarms["a point is behind over scenes (`over_scenes.csv`)"] +=
            std::ranges::count(rows, standing::behind, &OverScenesRow::standing) > 0;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const int studies = argc > 1 ? std::atoi(argv[1]) : 1000;
    const std::vector<Kind> kinds = {
        {"4 shots, 13 points, 4 seeds of deviation 0.02", 4, 13, 4, 0.02},
        {"4 shots, 13 points, 8 seeds of deviation 0.02", 4, 13, 8, 0.02},
        {"4 shots, 13 points, 4 seeds of deviation 0.5", 4, 13, 4, 0.5},
        {"43 shots, 13 points, 4 seeds of deviation 0.02", 43, 13, 4, 0.02},
        {"4 scenes, 13 points, deviation 0.5 over scenes", 4, 13, 4, 0.001, 0.5},
        {"43 scenes, 13 points, deviation 0.5 over scenes", 43, 13, 4, 0.001, 0.5},
        {"196 scenes, 49 points, deviation 0.5 over scenes", 196, 49, 4, 0.001, 0.5},
    };
    std::mt19937_64 random(1);
    std::printf("| studies of points that do not differ | verdict | studies with a wrong one |\n|---|---|---|\n");
    for (const Kind& kind : kinds) {
        Alarms alarms;
        const int count = kind.points * kind.shots > 500 ? std::max(studies / 5, 1) : studies;
        for (int study = 0; study < count; ++study) count_alarms(alarms, kind, random);
        for (const auto& [who, wrong] : alarms)
            std::printf("| %s | %s | %.1f %% of %d |\n", kind.text.c_str(), who.c_str(), 100.0 * wrong / count, count);
        std::fflush(stdout);
    }
    return 0;
}
