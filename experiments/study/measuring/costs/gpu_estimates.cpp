#include "experiments/study/measuring/costs/gpu_estimates.h"

#include "core/error.h"
#include "experiments/gpu_costs/chips/chip_time.h"
#include "experiments/gpu_costs/chips/shader_work.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

namespace {

/// A stage on a chip, with what is not known of it.
struct StageEstimate {
    struct Group {
        StageWork work;
        double uncertain_latency = 0;  ///< clocks of its waves in blocks of which runs are known at most
        double fetches = 0;
    };
    struct Sample {
        double scale;  ///< groups of the pass for each of these
        std::vector<Group> groups;
    };
    StageWork all, uncertain;         ///< of all groups, as the traced ones say it
    double wave_error = 0;            ///< standard error of all.wave_latency (clocks)
    double fetches = 0;               ///< the same, to be held against those that are counted
    std::vector<Sample> samples;      ///< of each pass
    double active = 0, possible = 0;  ///< vector clocks x lanes
    double cut = 0, lanes = 0;        ///< lanes whose trace is not whole, of all that were traced
    std::string refusal;
};

/// Clocks of a wave of a pass: of the longest if all groups were traced. Else of the mean one, since a longer one may
/// have been missed, and no interval holds that.
struct WaveLatency {
    double clocks = 0, uncertain = 0;  ///< in blocks of which runs are known at most
    double error = 0;                  ///< standard error of sampling
};

WaveLatency wave_latency(const StageEstimate::Sample& sample) {
    const double count = double(sample.groups.size());
    WaveLatency longest, mean;
    double waves = 0;
    for (const auto& [work, uncertain, fetches] : sample.groups) {
        mean.clocks += work.work.latency, mean.uncertain += uncertain, waves += work.waves;
        if (work.waves > 0 && work.work.latency / work.waves > longest.clocks)
            longest = {.clocks = work.work.latency / work.waves, .uncertain = uncertain / work.waves};
    }
    if (sample.scale <= 1 || waves == 0 || count < 2) return longest;
    mean.clocks /= waves, mean.uncertain /= waves;
    double squares = 0;
    for (const StageEstimate::Group& group : sample.groups) {
        const double residual = group.work.work.latency - mean.clocks * group.work.waves;
        squares += residual * residual;
    }
    mean.error = std::sqrt(squares / (count - 1) * count * (1 - 1 / sample.scale)) / waves;
    return mean;
}

void add_pass(StageEstimate& stage, const TracedFrame::Pass& pass, const ShaderWork& code) {
    const std::vector<WaveCounts>& groups = pass.traced.at(code.lanes);
    if (groups.empty()) return;
    const double scale = double(pass.groups) / double(groups.size());
    StageEstimate::Sample sample{.scale = scale, .groups = {}};
    for (const WaveCounts& group : groups) {
        auto& [work, uncertain_latency, fetches] = sample.groups.emplace_back();
        ChipWork uncertain;
        for (size_t b = 0; b < group.waves.size(); ++b) {
            const double runs = double(group.waves[b]);
            if (runs == 0) continue;
            work.work.add(code.blocks[b].work, runs);
            uncertain.add(code.blocks[b].uncertain, runs);
            fetches += double(group.lanes[b]) * pass.flow.blocks[b].fetches;
            const double clocks = code.blocks[b].work.vector;
            stage.active += clocks * double(group.lanes[b]) * scale;
            stage.possible += clocks * runs * code.lanes * scale;
        }
        work.waves = double(group.started), uncertain_latency = uncertain.latency;
        work.resident_latency = work.work.latency / code.resident_waves;
        stage.all.work.add(work.work, scale), stage.uncertain.work.add(uncertain, scale);
        stage.all.waves += work.waves * scale;
        stage.all.resident_latency += work.resident_latency * scale;
        stage.uncertain.resident_latency += uncertain.latency / code.resident_waves * scale;
        stage.cut += double(group.cut), stage.lanes += double(group.lanes.empty() ? 0 : group.lanes[0]);
        stage.fetches += fetches * scale;
    }
    const WaveLatency wave = wave_latency(sample);
    stage.all.wave_latency += wave.clocks, stage.uncertain.wave_latency += wave.uncertain;
    stage.wave_error += wave.error;
    stage.samples.push_back(std::move(sample));
}

/// The standard error of the time that a part takes for a stage, as the traced groups say it, and if `time_of_fetch` is
/// taken from each of their fetches. `cost`: without traffic, which is counted and not sampled. Passes have their
/// groups at the same places, so that they err together.
double error_of_sums(const StageEstimate& stage, const ChipTimePart& part, double time_of_fetch, const PassCost& cost,
                     const ChipRates& rates) {
    double error = 0;
    for (const auto& [scale, groups] : stage.samples) {
        const double count = double(groups.size());
        if (groups.size() < 2 || scale <= 1) continue;
        double sum = 0, squares = 0;
        for (const StageEstimate::Group& group : groups) {
            const double residual = chip_time(group.work, cost, rates).*part.member - time_of_fetch * group.fetches;
            sum += residual, squares += residual * residual;
        }
        const double of_group = std::max(0.0, (squares - sum * sum / count) / (count - 1));
        error += count * scale * std::sqrt(of_group / count * (1 - 1 / scale));
    }
    return error;
}

/// The standard error of the time that a part takes for a stage. `ratio`: of the fetches of all groups to those that
/// the traced ones say, where the ratio estimator (Cochran 1977, "Sampling Techniques", chapter 6) is used: fetches are
/// known of all invocations, and groups that fetch more do more. 1 where it is not.
double standard_error(const StageEstimate& stage, const ChipTimePart& part, double ratio, const PassCost& cost,
                      const ChipRates& rates) {
    if (const StageWork all = stage.all.times(ratio);
        part.member == &ChipTime::latency && is_of_one_wave(all, rates))  // so of more than 0 clocks
        return chip_time(all, cost, rates).latency * stage.wave_error / all.wave_latency;
    const double time = chip_time(stage.all, cost, rates).*part.member;
    if (ratio == 1) return error_of_sums(stage, part, 0, cost, rates);
    return ratio * error_of_sums(stage, part, time / stage.fetches, cost, rates);
}

/// Of a stage or a frame; microseconds.
struct ChipEstimate {
    ChipTime parts;
    double time = 0;
    std::map<std::string, double> by_bound;  ///< time of the stages that a part bounds
    double error = 0;                        ///< standard error of sampling
    double uncertain = 0;                    ///< of blocks of which runs are known at most
    double active = 0, possible = 0;
    double cut = 0, lanes = 0, waves = 0;

    void add(const ChipEstimate& other) {
        for (const ChipTimePart& part : chip_time_parts) parts.*part.member += other.parts.*part.member;
        parts.caches += other.parts.caches;
        for (const auto& [bound, of_bound] : other.by_bound) by_bound[bound] += of_bound;
        time += other.time, error += other.error, uncertain += other.uncertain;
        active += other.active, possible += other.possible;
        cut += other.cut, lanes += other.lanes, waves += other.waves;
    }
};

ChipEstimate estimate_of(const StageEstimate& stage, const PassCost& cost, const ChipRates& rates) {
    PassCost no_traffic = cost;
    no_traffic.unique_bytes = 0;
    ChipEstimate estimate{.parts = chip_time(stage.all, cost, rates)};
    const ChipTimePart& sampled = bound_of(estimate.parts);
    double ratio = stage.fetches > 0 && cost.fetches > 0 ? double(cost.fetches) / stage.fetches : 1;
    if (standard_error(stage, sampled, ratio, no_traffic, rates) >=
        standard_error(stage, sampled, 1, no_traffic, rates))
        ratio = 1;
    estimate.parts = chip_time(stage.all.times(ratio), cost, rates);
    const ChipTimePart& part = bound_of(estimate.parts);
    estimate.error = standard_error(stage, part, ratio, no_traffic, rates);
    estimate.time = estimate.parts.*part.member;
    estimate.by_bound[part.name] = estimate.time;
    estimate.uncertain = chip_time(stage.uncertain.times(ratio), no_traffic, rates).*part.member;
    estimate.active = stage.active, estimate.possible = stage.possible;
    estimate.cut = stage.cut, estimate.lanes = stage.lanes, estimate.waves = stage.all.waves;
    return estimate;
}

EstimateRow row_of(const std::string& shot, const PointConfig& point, const std::string& stage, const Chip& chip) {
    EstimateRow row;
    row.shot = shot, row.technique = point.technique, row.point = point.point, row.stage = stage;
    row.chip = chip.name, row.driver = chip.driver;
    return row;
}

void set_numbers(EstimateRow& row, const ChipEstimate& estimate) {
    constexpr double normal_95 = 1.96;
    const double half = normal_95 * estimate.error;
    row.microseconds = estimate.time;
    row.low = std::max(0.0, estimate.time - estimate.uncertain - half), row.high = estimate.time + half;
    row.bound = std::ranges::max_element(estimate.by_bound, {}, [](const auto& entry) { return entry.second; })->first;
    row.vector = estimate.parts.vector, row.scalar = estimate.parts.scalar;
    row.shared_memory = estimate.parts.shared_memory, row.textures = estimate.parts.textures;
    row.targets = estimate.parts.targets, row.memory = estimate.parts.memory;
    row.latency = estimate.parts.latency, row.caches = estimate.parts.caches;
    row.waves = estimate.waves;
    if (estimate.possible > 0) row.active_lanes = estimate.active / estimate.possible;
    row.unmatched = estimate.time > 0 ? estimate.uncertain / estimate.time : 0;
    row.cut_lanes = estimate.lanes > 0 ? estimate.cut / estimate.lanes : 0;
}

/// The codes of the frame's passes, of each recipe once; refusals in place of those that there are not.
struct FrameCode {
    std::map<std::string, ShaderWork> by_recipe;
    std::map<std::string, std::string> refusals;
};

FrameCode compile_frame(const TracedFrame& frame, const Chip& chip, const ChipRates& rates, ChipCompilation how) {
    struct Pipeline {
        std::string key;
        MarkedShader marks;
    };
    FrameCode code;
    std::vector<Pipeline> pipelines;
    std::vector<PipelineRecipe> recipes;
    std::set<std::string> seen;
    for (const TracedFrame::Pass& pass : frame.passes) {
        const std::string key = bytes_of({pass.recipe});
        if (!seen.insert(key).second) continue;
        try {
            pipelines.push_back({.key = key, .marks = marked(pass.recipe, pass.flow)});
            for (const PipelineRecipe& recipe : {pass.original, pass.recipe, pipelines.back().marks.recipe})
                recipes.push_back(recipe);
        } catch (const Error& e) {
            code.refusals[key] = e.what();
        }
    }
    how.has_assembly = true;
    const std::vector<CompiledPipeline> compiled = compile_for_chip(chip, recipes, how);
    for (size_t i = 0; i < pipelines.size(); ++i) {
        const std::span<const CompiledPipeline> forms = std::span(compiled).subspan(3 * i, 3);
        const Pipeline& p = pipelines[i];
        if (const auto refused = std::ranges::find_if(forms, [](const auto& f) { return !f.refusal.empty(); });
            refused != forms.end())
            code.refusals[p.key] = refused->refusal;
        else
            try {
                code.by_recipe.emplace(p.key, shader_work(p.marks, forms[0].shaders.back(), forms[1].shaders.back(),
                                                          forms[2].shaders.back(), chip.name, rates));
            } catch (const Error& e) {
                code.refusals[p.key] = e.what();
            }
    }
    return code;
}

std::vector<EstimateRow> rows_of_chip(const TracedFrame& frame, const std::string& shot, const PointConfig& point,
                                      const Chip& chip, const ChipRates& rates, const ChipCompilation& how) {
    const FrameCode code = compile_frame(frame, chip, rates, how);
    std::map<std::string, StageEstimate> traced;
    for (const TracedFrame::Pass& pass : frame.passes) {
        StageEstimate& stage = traced[pass.stage];
        const std::string key = bytes_of({pass.recipe});
        if (const auto found = code.by_recipe.find(key); found != code.by_recipe.end())
            add_pass(stage, pass, found->second);
        else
            stage.refusal = code.refusals.at(key);
    }

    std::vector<EstimateRow> rows;
    EstimateRow total = row_of(shot, point, "total", chip);
    ChipEstimate of_frame;
    for (const PassCost& cost : frame.costs) {
        EstimateRow row = row_of(shot, point, cost.stage, chip);
        row.product = rates.product;
        if (const StageEstimate& stage = traced[cost.stage]; stage.refusal.empty()) {
            const ChipEstimate estimate = estimate_of(stage, cost, rates);
            set_numbers(row, estimate);
            of_frame.add(estimate);
        } else {
            row.refusal = stage.refusal;
            total.refusal = cost.stage + ": " + stage.refusal;
        }
        rows.push_back(row);
    }
    total.product = rates.product;
    if (total.refusal.empty()) set_numbers(total, of_frame);
    rows.push_back(total);
    return rows;
}

}  // namespace

std::string refusal_in(const std::vector<EstimateRow>& rows) {
    for (const EstimateRow& row : rows)
        if (!row.refusal.empty() && !row.product.empty()) return row.stage + " on " + row.chip + ": " + row.refusal;
    return "";
}

std::vector<EstimateRow> refused_estimates(const std::string& why, const std::string& shot, const PointConfig& point,
                                           const GpuCompilers& compilers) {
    std::vector<EstimateRow> rows;
    for (const GpuCompilers::Entry& compiler : compilers.entries)
        rows.emplace_back(row_of(shot, point, "total", compiler.chip)).refusal = why;
    return rows;
}

std::vector<EstimateRow> estimate_rows(const TracedFrame& frame, const std::string& shot, const PointConfig& point,
                                       const GpuCompilers& compilers, const ChipCompilation& how) {
    std::vector<EstimateRow> rows;
    if (frame.passes.empty()) return rows;
    for (const GpuCompilers::Entry& compiler : compilers.entries) {
        const std::optional<ChipRates> rates = chip_rates(compiler.chip.name);
        if (compiler.refusal.empty() && rates) {
            const std::vector<EstimateRow> of_chip = rows_of_chip(frame, shot, point, compiler.chip, *rates, how);
            rows.insert(rows.end(), of_chip.begin(), of_chip.end());
            continue;
        }
        EstimateRow row = row_of(shot, point, "total", compiler.chip);
        row.refusal =
            compiler.refusal.empty() ? "ssrlab has no published rates of " + compiler.chip.name : compiler.refusal;
        rows.push_back(row);
    }
    return rows;
}
