#include "experiments/results/results_schema.h"

#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/results/cells/estimate_table.h"
#include "experiments/results/verdicts/study_results.h"

#include <map>

namespace {

using nlohmann::json;

struct Meaning {
    const char *unit, *text;
    const char* type = nullptr;  ///< where it is not that of the member which holds it
};

/// By the name of a column, which means the same in all files, or by file and name where it does not.
const std::map<std::string, Meaning>& meanings() {
    static const std::map<std::string, Meaning> all = {
        {"shot",
         {"",
          "Name of the shot: scene, camera and size, then all that is not the default. manifest.json has the parts"}},
        {"scene", {"", "Name of the scene"}},
        {"camera", {"", "Name of the camera"}},
        {"frame", {"", "Number of the frame; empty: all frames of the shot together", "integer"}},
        {"times.frame", {"", "Number of the timed frame after the warm-up; gaps where frames were left out"}},
        {"width", {"pixel", "Width of the image"}},
        {"height", {"pixel", "Height of the image"}},
        {"technique", {"", "Name of the technique"}},
        {"times.technique", {"", "Name of the technique; empty for the G-buffer's stages"}},
        {"time_summary.technique", {"", "Name of the technique; empty for the G-buffer's stages"}},
        {"point",
         {"", "Name of the point: `default`, or its preset and swept parameters. parameters.csv has all values"}},
        {"label", {"", "Name of the point in reports, tables and figures; empty: technique and point"}},
        {"group", {"", "Group of the point; empty: none"}},
        {"preset", {"", "Preset that the point starts from; empty: the technique's default parameters"}},
        {"seed", {"", "Seed of the technique's random numbers"}},
        {"seeds", {"", "Number of seeds that are averaged, or that both points have"}},
        {"target",
         {"",
          "What is compared with the truth: specular (composited reflections), image, incident (incoming radiance "
          "mixed by confidence), or a rung of the truth ladder: camera_radiance, on_screen"}},
        {"metric", {"", "Name of the metric"}},
        {"formula", {"", "Identifier of the metric's formula, since tools disagree on what a name means"}},
        {"mask", {"", "Name of the mask: the set of pixels that count"}},
        {"value",
         {"",
          "Value of the metric; empty if it is not finite, cannot be determined, or if more than 1 % of the pixels are "
          "not finite"}},
        {"hits.value",
         {"",
          "Mean over the seeds: a share of the rays; of distance_error a median; of fetches a number for each ray"}},
        {"low", {"", "Low end of the 95 % interval; empty if none can be given"}},
        {"high", {"", "High end of the 95 % interval"}},
        {"interval",
         {"",
          "Sources of randomness that the interval contains (reference, seeds, pixels); or `none: ` and the reason"}},
        {"ranked", {"", "Whether the interval contains all sources of randomness; only such points are compared"}},
        {"seed_deviation", {"", "Standard deviation over the seeds; empty for a single seed"}},
        {"corrected",
         {"", "Whether the noise of the reference was subtracted from the value, by its two independent halves"}},
        {"uncorrected", {"", "Value before that correction"}},
        {"floor", {"", "Metric between the two halves of the reference: the value that noise alone causes"}},
        {"lit_noise",
         {"", "What the noise of the lit colour adds to the value; empty if unknown. The value still contains it"}},
        {"lit_half_width", {"", "Half the width of the 95 % interval from the noise of the lit colour that remains"}},
        {"pixels",
         {"pixel", "Finite pixels under the mask; over several frames, their sum. In summaries, the worst seed"}},
        {"non_finite", {"pixel", "Pixels of the result that are NaN or infinite"}},
        {"negative", {"pixel", "Pixels of the result below zero"}},
        {"represents_shot",
         {"",
          "Whether the row represents its shot in tables, effects and reports: over all frames where measured, else "
          "the last frame"}},
        {"value_of_power",
         {"",
          "Value without the reference's noise, if the noise grows as a power of its variance (FLIP and absolute "
          "differences)"}},
        {"value_of_bounded",
         {"",
          "Value without the reference's noise, if the noise grows towards a bound (FLIP and absolute differences)"}},
        {"standing",
         {"",
          "Standing among the ranked points of the shot: best, tied (not decided against the best), equivalent "
          "(certainly within the margin) or behind (significantly worse); empty: not ranked"}},
        {"over_best", {"", "Value divided by the value of the best measured point of the shot, paired by seed"}},
        {"over_best_low", {"", "Low end of the 95 % interval of over_best"}},
        {"over_best_high", {"", "High end of the 95 % interval of over_best"}},
        {"p_best",
         {"",
          "P-value of the hypothesis that the point is no worse than the truly best point; adjusted for all points and "
          "shots"}},
        {"p_equivalent",
         {"",
          "P-value of the hypothesis that the point is not within the margin of the best measured point; adjusted for "
          "all points and shots"}},
        {"mse", {"", "Mean squared error of one seed: bias_squared + variance"}},
        {"bias_squared",
         {"", "Squared error that would remain with infinitely many seeds; noise around 0 if there is none"}},
        {"bias_squared_low", {"", "Low end of the 95 % interval of bias_squared"}},
        {"bias_squared_high", {"", "High end of the 95 % interval of bias_squared"}},
        {"variance", {"", "Variance over the seeds"}},
        {"variance_low", {"", "Low end of the 95 % interval of variance"}},
        {"variance_high", {"", "High end of the 95 % interval of variance"}},
        {"baseline_technique", {"", "Technique of the baseline, whose error is the unit"}},
        {"baseline_point", {"", "Point of the baseline, whose error is the unit"}},
        {"scenes", {"", "Number of scenes that are averaged; scenes of one asset count once"}},
        {"shots", {"", "Number of shots of these scenes"}},
        {"over_scenes.ratio", {"", "Error divided by the baseline's error, as a geometric mean over the scenes"}},
        {"over_scenes.low", {"", "Low end of the 95 % interval over scenes like these; empty for fewer than 4 scenes"}},
        {"over_scenes.high", {"", "High end of the 95 % interval over scenes like these"}},
        {"rank", {"", "Place by ratio, 1 for the least; empty if the point lacks too many shots", "integer"}},
        {"rank_low", {"", "Best place if any one scene is left out", "integer"}},
        {"rank_high", {"", "Worst place if any one scene is left out", "integer"}},
        {"over_scenes.over_best",
         {"", "Error divided by the error of the point with rank 1, as a geometric mean over the scenes"}},
        {"over_scenes.p_holm", {"", "P-value of the hypothesis that over_best is 1, adjusted for all points"}},
        {"over_scenes.p_equivalent",
         {"", "P-value of the hypothesis that over_best is not within the margin, adjusted for all points"}},
        {"chance_first", {"", "Probability that the point has the least error, on average over scenes like these"}},
        {"chance_near",
         {"", "Probability that the point has at most 1.1 times the least error, on average over scenes like these"}},
        {"over_scenes.standing",
         {"", "Standing over the scenes: best, tied, equivalent or behind; empty: not ranked, or fewer than 4 scenes"}},
        {"stage",
         {"",
          "Name of the stage, mostly the path of its shader; `clear`: all clears; `total`: all stages of the "
          "technique"}},
        {"hits.stage",
         {"", "Stage that traced the rays; `error`: shares of the squared error by verdict, of the whole technique"}},
        {"milliseconds", {"ms", "Time of the stage in this frame"}},
        {"median_ms", {"ms", "Median time over the frames of all seeds"}},
        {"low_ms", {"ms", "Low end of the 95 % interval of the median"}},
        {"high_ms", {"ms", "High end of the 95 % interval of the median"}},
        {"fronts",
         {"",
          "Costs (time, fetches, bytes, operations, or a chip for its estimated time) for which no ranked point of the "
          "shot has both less error and less "
          "cost"}},
        {"dominated",
         {"",
          "Whether another point of the shot has significantly less error in less time: yes, maybe or no; empty: not "
          "ranked, not timed, or not the primary mask and target"}},
        {"fits_from_ms", {"ms", "Least time budget that the point certainly fits"}},
        {"may_fit_from_ms", {"ms", "Least time budget that the point may fit"}},
        {"frames", {"", "Number of timed frames"}},
        {"clock", {"", "Clock: host_fence (one submission for each stage) or gpu_timestamp"}},
        {"foreign_load", {"", "Share of the machine's CPU time that other programs took; empty if unknown"}},
        {"disturbed", {"", "Whether foreign_load exceeds 0.05"}},
        {"disturbed_share", {"", "Share of the timed frames that other programs disturbed"}},
        {"hits.quantity", {"", "What the value is, as listed below. The first six are verdicts, which add up to 1"}},
        {"costs.quantity", {"", "What is counted, as listed below"}},
        {"costs.value", {"", "Count in the last frame with the first seed"}},
        {"pipeline", {"", "Number of the pipeline within its stage, from 0"}},
        {"shader", {"", "Kind of shader: compute, vertex or fragment; empty: nothing was compiled"}},
        {"chip", {"", "GPU that was compiled for, by Mesa's name"}},
        {"driver", {"", "Compiler and its version"}},
        {"lanes", {"", "Invocations in a wave"}},
        {"vgprs", {"", "Vector registers of a lane"}},
        {"sgprs", {"", "Scalar registers of a wave"}},
        {"spilled_vgprs", {"", "Vector registers that were moved to memory"}},
        {"spilled_sgprs", {"", "Scalar registers that were moved to vector registers"}},
        {"scratch_bytes", {"byte", "Memory of a wave for registers that did not fit"}},
        {"lds_bytes", {"byte", "Shared memory of a workgroup"}},
        {"waves", {"", "Waves that a SIMD can hold at a time"}},
        {"most_waves", {"", "Waves that a SIMD can hold at a time with the smallest shaders"}},
        {"limit", {"", "What limits waves: nothing, registers, scalar registers or shared memory; empty: unknown"}},
        {"code_bytes", {"byte", "Size of the machine code"}},
        {"instructions", {"", "Instructions in the machine code"}},
        {"branches", {"", "Branches in the machine code"}},
        {"latency", {"cycle", "Time of a wave, by the compiler's estimate; loops are assumed to run 8 times"}},
        {"inverse_throughput",
         {"cycle", "Time for which a wave occupies the busiest unit, by the compiler's estimate"}},
        {"hash", {"", "Hash of the machine code"}},
        {"refusal", {"", "Why there are no numbers; empty: there are"}},
        {"product", {"", "Product whose published rates stand for the chip"}},
        {"microseconds", {"us", "Estimated time of the stage: that of the part of the chip that takes longest"}},
        {"estimates.low",
         {"us",
          "Low end of the 95 % interval of microseconds from sampling alone, without blocks whose number of runs is "
          "only bounded"}},
        {"estimates.high", {"us", "High end of the 95 % interval of microseconds from sampling alone"}},
        {"model_low", {"us", "`low`, divided by the largest factor by which estimates exceeded measured times"}},
        {"model_high", {"us", "`high`, multiplied by the largest factor by which measured times exceeded estimates"}},
        {"bound", {"", "Part of the chip that takes longest"}},
        {"vector", {"us", "Time of vector arithmetic alone"}},
        {"scalar", {"us", "Time of scalar instructions alone"}},
        {"shared_memory", {"us", "Time of shared-memory instructions alone"}},
        {"textures", {"us", "Time of the texture units alone: reads and writes of images and buffers"}},
        {"targets", {"us", "Time of writes to colour targets alone"}},
        {"memory", {"us", "Time to move each byte once between memory and chip"}},
        {"estimates.latency", {"us", "Time that waves wait, with as many waves at a time as registers allow"}},
        {"caches", {"us", "Time if each requested byte came through the L2 cache; not part of the estimate"}},
        {"estimates.waves", {"", "Waves of the stage"}},
        {"active_lanes", {"", "Share of active lanes, weighted by vector instructions; 1 without divergence"}},
        {"unmatched", {"", "Share of microseconds in blocks whose number of runs is only bounded"}},
        {"cut_lanes", {"", "Share of the traced lanes with more branches than were recorded"}},
        {"rays", {"ray", "Mean number of rays for each seed; pixels in rows of the stage `error`"}},
        {"against",
         {"", "`baseline`, or the value in which the point differs from the one it is compared with, as `stride=4`"}},
        {"against_technique", {"", "Technique of the point that is compared with"}},
        {"against_point", {"", "Point that is compared with"}},
        {"ratio", {"", "Value of the point divided by the value of the other point; empty if either is not above 0"}},
        {"rounds", {"", "Frames in which both points were timed"}},
        {"p", {"", "Two-sided p-value of the hypothesis that the ratio is 1"}},
        {"family", {"", "`primary` (the study's main error) or `exploratory`"}},
        {"p_holm", {"", "`p`, adjusted for all effects on the same error, or for all times (Holm 1979)"}},
        {"low_holm", {"", "Low end of the interval that excludes 1 if p_holm is below 0.05"}},
        {"high_holm", {"", "High end of that interval"}},
        {"effects.p_equivalent",
         {"", "P-value of the hypothesis that the ratio is not within the margin, by two one-sided tests"}},
        {"p_equivalent_holm", {"", "`p_equivalent`, adjusted as `p_holm`"}},
        {"verdict",
         {"",
          "`less` or `more` if `p_holm` is below 0.05; else `equivalent` if `p_equivalent_holm` is; else `undecided`; "
          "empty without `p`"}},
    };
    return all;
}

const char* type_of(const std::string&) { return "string"; }
const char* type_of(bool) { return "boolean"; }
const char* type_of(unsigned) { return "integer"; }
const char* type_of(size_t) { return "integer"; }
const char* type_of(double) { return "number"; }
const char* type_of(const std::optional<double>&) { return "number"; }

/// The names that a column may hold, with their meanings.
json named_values(const std::string& column) {
    json values = json::array();
    const auto add = [&](const std::string& name, const std::string& meaning) {
        values.push_back({{"name", name}, {"meaning", meaning}});
    };
    if (column == "costs.quantity")
        for (const CostQuantity& quantity : cost_quantities) add(quantity.name, quantity.meaning);
    if (column == "hits.quantity") {
        add("right", "The ray meets a visible point, and the march finds that point within a pixel");
        add("wrong_place", "The ray meets a visible point, and the march reports a hit elsewhere");
        add("false_hit", "The ray meets nothing visible, and the march reports a hit");
        add("avoidable_miss", "The ray meets a visible point, and the march reports a miss");
        add("unavoidable_miss",
            "The ray meets a point that is hidden, off the screen or behind the camera, and the march reports a miss");
        add("empty", "The ray leaves the scene or starts below its surface, and the march reports a miss");
        add("correct", "Sum of right, unavoidable_miss and empty");
        add("miss: REASON", "Avoidable misses, by the reason for which the march ended");
        add("distance_error", "Median of |distance / true distance - 1| over right hits");
        add("fetches", "Reads of the depth buffer for each ray");
        add("error: VERDICT", "Share of the squared error on pixels with that verdict");
    }
    return values;
}

json field(const std::string& name, const std::string& type, const std::string& unit, const std::string& text) {
    json entry = {{"name", name}, {"type", type}, {"description", text}};
    if (!unit.empty()) entry["unit"] = unit;
    if (type == "boolean") entry["trueValues"] = {"1"}, entry["falseValues"] = {"0"};
    return entry;
}

json known_field(const std::string& file, const std::string& name, const char* type) {
    const auto own = meanings().find(file + "." + name);
    const Meaning& meaning = own == meanings().end() ? meanings().at(name) : own->second;
    json entry = field(name, meaning.type ? meaning.type : type, meaning.unit, meaning.text);
    if (json values = named_values(file + "." + name); !values.empty()) entry["values"] = std::move(values);
    return entry;
}

/// What a row of each file is.
const std::map<std::string, const char*>& files() {
    static const std::map<std::string, const char*> all = {
        {"results", "One row for each shot, frame, technique, point, seed, target, metric and mask"},
        {"summary",
         "results.csv averaged over the seeds, with intervals and verdicts: one row for each shot, frame, technique, "
         "point, target, metric and mask"},
        {"splits",
         "Squared errors split into bias and variance, in the last frame of a shot: one row for each shot, technique, "
         "point, target and mask"},
        {"effects",
         "Ratios of the errors of two points with the same seeds. Every point is compared with each baseline of the "
         "study, and with the points that `against` names"},
        {"over_scenes",
         "Errors over all scenes of the study, relative to the baseline: one row for each target, metric, mask and "
         "point"},
        {"times", "Measured times: one row for each shot, technique, point, timed frame and stage"},
        {"time_summary", "Median times over the frames: one row for each shot, technique, point and stage"},
        {"time_effects", "Ratios of the times of the points that effects.csv compares, frame by frame"},
        {"hits",
         "With `hits` in the config: how rays ended. One row for each shot, technique, point, stage, mask and "
         "quantity"},
        {"costs",
         "With `costs` in the config: counted work, independent of the machine. One row for each shot, technique, "
         "point, stage and quantity"},
        {"compiled", "With `gpu_compilers` in the config: what a GPU's compiler makes of each shader"},
        {"estimates",
         "With `costs` and `gpu_compilers` in the config: estimated time of each stage on a GPU that need not be "
         "present"},
        {"parameters",
         "One row for each technique and point. Further columns, one for each parameter of the study's techniques, "
         "have the values"}};
    return all;
}

json resource(const std::string& file, json fields) {
    return {{"name", file},
            {"path", file + ".csv"},
            {"description", files().at(file)},
            {"schema", {{"fields", std::move(fields)}, {"missingValues", {""}}}}};
}

template <class Owner, class Row>
json table(const Table<Owner, Row>& of) {
    const auto rows = rows_in_file(std::vector<Row>(1));
    json fields = json::array();
    for_each_column<typename decltype(rows)::value_type>([&](const auto& column) {
        fields.push_back(known_field(of.name, column.name, type_of(rows.front().*column.member)));
    });
    return resource(of.name, std::move(fields));
}

json parameters_table(const std::vector<ParameterColumn>& parameters) {
    json fields = json::array();
    for (const char* name : names_of_points) fields.push_back(known_field("parameters", name, "string"));
    for (const ParameterColumn& p : parameters) fields.push_back(field(p.name, p.type, p.unit, p.doc));
    return resource("parameters", std::move(fields));
}

}  // namespace

nlohmann::json results_schema(const std::vector<ParameterColumn>& parameters) {
    json resources = json::array();
    for_each_table([&](const auto& of) { resources.push_back(table(of)); });
    resources.push_back(parameters_table(parameters));
    return {{"name", "results"}, {"resources", std::move(resources)}};
}
