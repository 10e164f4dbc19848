#include "experiments/results/results_schema.h"

#include "experiments/results/cells/estimate_table.h"
#include "experiments/results/verdicts/study_results.h"

#include <map>

namespace {

using nlohmann::json;

struct Meaning {
    const char *unit, *text;
    const char* type = nullptr;  ///< where it is not that of the member which holds it
};

/// By the name of a column, which means the same in all files, or by file and name where it does not. RESULTS.md says
/// more.
const std::map<std::string, Meaning>& meanings() {
    static const std::map<std::string, Meaning> all = {
        {"shot", {"", "name of the shot; manifest.json has its label and all else"}},
        {"scene", {"", "name of the scene"}},
        {"camera", {"", "name of the camera"}},
        {"frame", {"", "number of the frame; empty: over all frames of the shot", "integer"}},
        {"times.frame", {"", "number of the timed frame, after the warm-up"}},
        {"width", {"pixel", "width of the image"}},
        {"height", {"pixel", "height of the image"}},
        {"technique", {"", "name of the technique; in times.csv and time_summary.csv empty: of the G-buffer"}},
        {"point", {"", "name of the parameter point; parameters.csv has its values"}},
        {"label", {"", "how report, tables and figures name the point; empty: by technique and point"}},
        {"group", {"", "what the point belongs to; empty: nothing"}},
        {"preset", {"", "the technique's preset that the point starts from; empty: none"}},
        {"seed", {"", "of the technique's random numbers"}},
        {"seeds", {"", "how many seeds were averaged or are common to both"}},
        {"target", {"", "what is compared: specular, image, incident, camera_radiance or on_screen"}},
        {"metric", {"", "name of the metric"}},
        {"formula", {"", "id of the metric's formula"}},
        {"mask", {"", "which pixels count"}},
        {"value", {"", "value of the metric; empty where it is not finite or cannot be determined"}},
        {"hits.value",
         {"", "mean over the seeds: a share of the rays, of distance_error the median, of fetches per ray"}},
        {"low", {"", "low end of the 95 % interval of value or ratio; empty where none can be given"}},
        {"high", {"", "high end of that interval"}},
        {"interval", {"", "what the interval holds, or none and why"}},
        {"ranked", {"", "whether the interval holds all that is random"}},
        {"seed_deviation", {"", "standard deviation over the seeds"}},
        {"corrected", {"", "whether the reference's noise was subtracted"}},
        {"uncorrected", {"", "the value before that correction"}},
        {"floor", {"", "what the reference's own noise scores"}},
        {"lit_noise", {"", "what the noise of the lit colour adds to value"}},
        {"lit_half_width", {"", "half the width of the 95 % interval that it leaves beside that"}},
        {"pixels", {"pixel", "finite pixels under the mask; over frames their sum"}},
        {"non_finite", {"pixel", "pixels of the result that are NaN or infinite"}},
        {"negative", {"pixel", "pixels of the result below zero"}},
        {"represents_shot", {"", "whether the row represents its shot"}},
        {"value_of_power", {"", "value without the reference's noise, which grows as a power of its variance"}},
        {"value_of_bounded", {"", "value without the reference's noise, which grows towards a bound"}},
        {"standing", {"", "best, tied, equivalent or behind among the points of its shot; empty: not ranked"}},
        {"over_best", {"", "value over that of the best measured point of its shot, paired by seed"}},
        {"over_best_low", {"", "low end of its 95 % interval"}},
        {"over_best_high", {"", "high end of its 95 % interval"}},
        {"p_best",
         {"", "p-value of: no worse than the truly best point; adjusted for all points and shots of the error"}},
        {"p_equivalent", {"", "p-value of: not within the margin of the best measured point; adjusted likewise"}},
        {"mse", {"", "bias_squared + variance"}},
        {"bias_squared", {"", "squared error that would remain over infinitely many seeds"}},
        {"bias_squared_low", {"", "low end of its 95 % interval"}},
        {"bias_squared_high", {"", "high end of its 95 % interval"}},
        {"variance", {"", "variance over the seeds"}},
        {"variance_low", {"", "low end of its 95 % interval"}},
        {"variance_high", {"", "high end of its 95 % interval"}},
        {"baseline_technique", {"", "technique of what errors are multiples of"}},
        {"baseline_point", {"", "point of what errors are multiples of"}},
        {"scenes", {"", "how many scenes were averaged; those of one asset count once"}},
        {"shots", {"", "how many shots these have"}},
        {"over_scenes.ratio", {"", "geometric mean over the scenes of the error over the baseline's"}},
        {"over_scenes.low", {"", "low end of its 95 % interval over scenes like these; empty below 4"}},
        {"over_scenes.high", {"", "high end of that interval"}},
        {"rank", {"", "place by ratio, 1 the least; empty: lacks shots", "integer"}},
        {"rank_low", {"", "lowest place if any one scene is left out", "integer"}},
        {"rank_high", {"", "highest place if any one scene is left out", "integer"}},
        {"over_scenes.over_best", {"", "error over that of the first rank, geometric mean over the scenes"}},
        {"over_scenes.p_holm", {"", "p-value of: over_best is 1; adjusted for all points of the error"}},
        {"over_scenes.p_equivalent", {"", "p-value of: over_best is not within the margin; adjusted likewise"}},
        {"chance_first", {"", "probability to err least on average over scenes like these"}},
        {"chance_near", {"", "probability to err at most 10 % more than the point that does"}},
        {"over_scenes.standing",
         {"", "best, tied, equivalent or behind over the scenes; empty: not ranked, or fewer than 4"}},
        {"stage", {"", "name of the pass; total: all of the technique's"}},
        {"hits.stage", {"", "the pass that traced the rays; error: of the whole technique"}},
        {"milliseconds", {"ms", "time of the stage in this frame"}},
        {"median_ms", {"ms", "median time over the frames"}},
        {"low_ms", {"ms", "low end of its 95 % interval"}},
        {"high_ms", {"ms", "high end of its 95 % interval"}},
        {"fronts",
         {"",
          "costs (time, fetches, bytes, operations) where no ranked point of the shot has both less error and less "
          "cost"}},
        {"dominated",
         {"",
          "yes: another point of the shot significantly beats it by this error and by time; maybe; no; empty: not "
          "ranked or timed, or of another mask or target than the primary error"}},
        {"fits_from_ms", {"ms", "least time budget that the point fits"}},
        {"may_fit_from_ms", {"ms", "least time budget that it may fit"}},
        {"frames", {"", "how many frames were timed"}},
        {"clock", {"", "what took the time: host_fence or gpu_timestamp"}},
        {"foreign_load", {"", "share of the machine's CPU time that other programs took meanwhile"}},
        {"disturbed", {"", "whether that was above 0.05"}},
        {"disturbed_share", {"", "share of the frames that other programs disturbed"}},
        {"quantity", {"", "what became of the rays"}},
        {"costs.quantity", {"", "what is counted of the stage's passes"}},
        {"costs.value", {"", "how many; bytes of the quantities that are called so"}},
        {"pipeline", {"", "number of the pipeline within its stage, from 0"}},
        {"shader", {"", "compute, vertex or fragment; empty: nothing was compiled"}},
        {"chip", {"", "the GPU that was compiled for, by Mesa's name"}},
        {"driver", {"", "the compiler and its version"}},
        {"lanes", {"", "invocations of a wave"}},
        {"vgprs", {"", "vector registers of a lane"}},
        {"sgprs", {"", "scalar registers of a wave"}},
        {"spilled_vgprs", {"", "vector registers that were moved to memory"}},
        {"spilled_sgprs", {"", "scalar registers that were moved to vector registers"}},
        {"scratch_bytes", {"byte", "memory of a wave"}},
        {"lds_bytes", {"byte", "shared memory of a workgroup"}},
        {"waves", {"", "that a SIMD holds at a time"}},
        {"most_waves", {"", "that it could hold"}},
        {"limit",
         {"", "why it holds no more: nothing, registers, scalar registers or shared memory; empty: not known"}},
        {"code_bytes", {"byte", "size of the machine code"}},
        {"instructions", {"", "of the machine code"}},
        {"branches", {"", "of the machine code"}},
        {"latency", {"cycle", "the compiler's estimate of a wave's time"}},
        {"inverse_throughput", {"cycle", "the compiler's estimate of how long a wave keeps the busiest unit"}},
        {"hash", {"", "of the machine code: the same code has the same"}},
        {"refusal", {"", "why there are no numbers"}},
        {"product", {"", "whose published rates stand for the chip"}},
        {"microseconds", {"us", "estimate of how long the chip takes for the stage: of the part that takes longest"}},
        {"estimates.low",
         {"us",
          "of the 95 % interval of that, without blocks of which it is only known that they ran "
          "so often at most"}},
        {"estimates.high", {"us", "of the 95 % interval of that"}},
        {"model_low", {"us", "`low` by the least that a measured time was of such estimates"}},
        {"model_high", {"us", "`high` by the most, likewise"}},
        {"bound", {"", "the part of the chip that takes longest"}},
        {"vector", {"us", "arithmetic of vectors, if nothing else held it up"}},
        {"scalar", {"us", "scalar instructions, likewise"}},
        {"shared_memory", {"us", "the workgroups' memory, likewise"}},
        {"textures", {"us", "the texture units: loads, samples and stores of images, words of buffers, likewise"}},
        {"targets", {"us", "writes to colour targets, likewise"}},
        {"memory", {"us", "each byte once between memory and chip, likewise"}},
        {"estimates.latency", {"us", "waves that wait, as many at a time as registers let be, likewise"}},
        {"caches", {"us", "each byte that is asked for through the last cache that is fast: if no other held any"}},
        {"estimates.waves", {"", "waves of the stage"}},
        {"active_lanes", {"", "share of the lanes that run, weighted by vector instructions"}},
        {"unmatched", {"", "share of the estimate in blocks of which it is only known that they ran so often at most"}},
        {"cut_lanes", {"", "share of the traced lanes that decided more than their traces hold"}},
        {"rays", {"ray", "rays of one seed, on average; of the stage error pixels"}},
        {"against", {"", "baseline, or the value in which the point differs from what it is compared with"}},
        {"against_technique", {"", "technique of what the point is compared with"}},
        {"against_point", {"", "point of what the point is compared with"}},
        {"ratio", {"", "of the point's value to the other's"}},
        {"rounds", {"", "frames in which both were timed"}},
        {"p", {"", "two-sided p-value of: the ratio is 1"}},
        {"family", {"", "primary, or exploratory"}},
        {"p_holm", {"", "p adjusted for its family: all effects on the same error, or on times"}},
        {"low_holm", {"", "low end of the interval at the level that p_holm is judged at"}},
        {"high_holm", {"", "high end of that interval"}},
        {"effects.p_equivalent", {"", "p-value of: the ratio is not within the margin; of two one-sided tests"}},
        {"p_equivalent_holm", {"", "p_equivalent adjusted for the family of p_holm"}},
        {"verdict",
         {"",
          "less or more by p_holm at 0.05, else equivalent by p_equivalent_holm, else undecided; empty without a p"}},
    };
    return all;
}

const char* type_of(const std::string&) { return "string"; }
const char* type_of(bool) { return "boolean"; }
const char* type_of(unsigned) { return "integer"; }
const char* type_of(size_t) { return "integer"; }
const char* type_of(double) { return "number"; }
const char* type_of(const std::optional<double>&) { return "number"; }

json field(const std::string& name, const std::string& type, const std::string& unit, const std::string& text) {
    json entry = {{"name", name}, {"type", type}, {"description", text}};
    if (!unit.empty()) entry["unit"] = unit;
    if (type == "boolean") entry["trueValues"] = {"1"}, entry["falseValues"] = {"0"};
    return entry;
}

json known_field(const std::string& file, const std::string& name, const char* type) {
    const auto own = meanings().find(file + "." + name);
    const Meaning& meaning = own == meanings().end() ? meanings().at(name) : own->second;
    return field(name, meaning.type ? meaning.type : type, meaning.unit, meaning.text);
}

json resource(const std::string& file, json fields) {
    return {
        {"name", file}, {"path", file + ".csv"}, {"schema", {{"fields", std::move(fields)}, {"missingValues", {""}}}}};
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
