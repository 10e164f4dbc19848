#include "experiments/timing.h"

#include "core/gpu/device.h"
#include "experiments/render_variant.h"
#include "experiments/results.h"
#include "variants/registry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>

namespace {

void add_rows(std::vector<TimeRow>& rows, TimeRow row, const std::vector<PassTime>& times) {
    for (const PassTime& t : times) {
        row.stage = t.stage, row.milliseconds = t.milliseconds;
        rows.push_back(row);
    }
}

/// A variant with images and pipelines of its own, ready to render.
struct TimedCopy {
    const VariantConfig& config;
    enum class Purpose { recorded, twin, complete } purpose;
    std::unique_ptr<PassGraph> graph;
    std::unique_ptr<Variant> variant;
    std::vector<LeftOut> kept_parts;  ///< by a complete copy: what the others leave out
    std::vector<double> totals;
    std::map<std::string, std::vector<double>> stages;

    TimedCopy(const VariantConfig& c, Purpose p, PassGraph& like)
        : config(c),
          purpose(p),
          graph(std::make_unique<PassGraph>(like.device(), like.extent())),
          variant(make_variant(c.variant, c.parameters, c.preset)) {}

    void render(const CameraData& camera, const GBuffer& gbuffer) {
        render_variant(*graph, *variant, camera, config.seeds.front(), gbuffer);
        graph->times();  // waits for the device: the next copy starts on an idle one
    }

    /// The times of the last frame; `row`: shot, frame and clock.
    void record(std::vector<TimeRow>& rows, TimeRow row) {
        const std::vector<PassTime> times = graph->times();
        for (const PassTime& t : times) stages[t.stage].push_back(t.milliseconds);
        totals.push_back(graph->frame_milliseconds());
        if (purpose != Purpose::recorded) return;
        row.variant = config.variant, row.point = config.point, row.seed = config.seeds.front();
        add_rows(rows, row, times);
        add_rows(rows, row, {{"total", totals.back()}});
    }
};

std::vector<TimedCopy> make_copies(const Config& config, PassGraph& like, bool keep_all, const SceneFacts& facts) {
    using enum TimedCopy::Purpose;
    std::vector<TimedCopy> copies;
    for (const VariantConfig& variant : config.variants) {
        if (!variant.is_timed) continue;
        std::vector<LeftOut> left_out;
        for (const auto purpose : {recorded, twin}) {
            TimedCopy& copy = copies.emplace_back(variant, purpose, like);
            if (!keep_all) left_out = copy.variant->leave_out(facts);
        }
        if (!left_out.empty()) copies.emplace_back(variant, complete, like).kept_parts = left_out;
    }
    return copies;
}

std::vector<SavedTime> saved_times(const std::vector<TimedCopy>& copies) {
    std::map<std::string, double> longest;
    for (const TimedCopy& copy : copies)
        for (const LeftOut& part : copy.kept_parts) {
            const auto stage = copy.stages.find(part.what);
            if (stage == copy.stages.end()) continue;
            double& time = longest[part.what];
            time = std::max(time, median_interval(stage->second).median);
        }
    std::vector<SavedTime> saved;
    for (const auto& [stage, milliseconds] : longest) saved.push_back({stage, milliseconds});
    return saved;
}

std::vector<AaPair> pairs_of(const std::vector<TimedCopy>& copies) {
    std::vector<AaPair> pairs;
    for (const TimedCopy& copy : copies) {
        const double median = median_interval(copy.totals).median;
        if (copy.purpose == TimedCopy::Purpose::recorded)
            pairs.push_back({.variant = copy.config.variant, .point = copy.config.point, .first_ms = median});
        else if (copy.purpose == TimedCopy::Purpose::twin)
            pairs.back().second_ms = median;
    }
    return pairs;
}

}  // namespace

double AaPair::floor() const {
    const double mean = 0.5 * (first_ms + second_ms);
    return mean > 0 ? std::abs(second_ms - first_ms) / mean : 0.0;
}

std::vector<FrameStep> timed_steps(const std::vector<unsigned>& frames, unsigned count) {
    const unsigned last = unsigned(frames.size()) - 1, period = std::max(2 * last, 1u);
    std::vector<FrameStep> steps;
    for (unsigned i = 0; i < count; ++i) {
        const unsigned place = i % period;
        FrameStep step{.index = i, .frame = frames[place <= last ? place : period - place]};
        if (i > 0) step.previous_frame = steps.back().frame;
        steps.push_back(step);
    }
    return steps;
}

std::vector<std::vector<size_t>> timed_turns(size_t count, unsigned rounds) {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t(0));
    std::mt19937 dice(1);
    std::vector<std::vector<size_t>> turns;
    for (unsigned round = 0; round < rounds; ++round) {
        std::ranges::shuffle(order, dice);
        turns.push_back(order);
    }
    return turns;
}

ShotTimes time_variants(FrameSource& source, const Shot& shot, const Config& config,
                        const std::function<const HostImage&(unsigned frame)>& lit, bool keep_all,
                        const std::function<void(double)>& report) {
    ShotTimes result;
    std::vector<TimedCopy> copies = make_copies(config, source.graph(), keep_all, shot.facts);
    if (config.timing.frames == 0 || copies.empty()) return result;

    const std::string clock = source.graph().clock() == Clock::host_fence ? "host_fence" : "gpu_timestamp";
    const unsigned rounds = config.timing.warm_up + config.timing.frames;
    const std::vector<std::vector<size_t>> turns = timed_turns(copies.size(), rounds);
    for (const FrameStep& step : timed_steps(shot.config.frames, rounds)) {
        const bool is_measured = step.index >= config.timing.warm_up;
        const TimeRow row{.shot = shot.name(), .frame = step.index - config.timing.warm_up, .clock = clock};
        const GBuffer gbuffer = source.render(step, 0, lit(step.frame));
        const std::vector<PassTime> source_times = source.graph().times();
        for (const size_t place : turns[step.index]) copies[place].render(source.camera(), gbuffer);
        if (is_measured) {
            add_rows(result.rows, row, source_times);
            for (TimedCopy& copy : copies) copy.record(result.rows, row);
        }
        report(double(step.index + 1) / rounds);
    }
    result.pairs = pairs_of(copies);
    result.saved = saved_times(copies);
    return result;
}

nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot) {
    nlohmann::json pairs = nlohmann::json::array(), saved = nlohmann::json::object();
    for (const AaPair& p : times.pairs)
        pairs.push_back({{"shot", shot},
                         {"variant", p.variant},
                         {"point", p.point},
                         {"first_ms", p.first_ms},
                         {"second_ms", p.second_ms},
                         {"floor", p.floor()}});
    for (const SavedTime& s : times.saved) saved[s.stage] = s.milliseconds;
    return {{"shot", shot}, {"aa_pairs", pairs}, {"saved_ms", saved}};
}

void add_timing(nlohmann::json& manifest, const nlohmann::json& entry) {
    nlohmann::json& clock = manifest["clock"];
    for (const nlohmann::json& pair : entry["aa_pairs"]) clock["aa_pairs"].push_back(pair);
    // What takes hardly longer than submitting nothing is as noisy as that: it counts only where there is nothing else.
    const auto is_long = [&](const nlohmann::json& pair) {
        return pair["first_ms"].get<double>() > 10 * clock["empty_submit_ms"].get<double>();
    };
    const bool has_long = std::ranges::any_of(clock["aa_pairs"], is_long);
    double floor = 0;
    for (const nlohmann::json& pair : clock["aa_pairs"])
        if (is_long(pair) || !has_long) floor = std::max(floor, pair["floor"].get<double>());
    clock["aa_floor"] = floor;

    for (nlohmann::json& shot : manifest["shots"])
        for (nlohmann::json& part : shot["left_out"])
            if (shot["shot"] == entry["shot"] && entry["saved_ms"].contains(part["what"]))
                part["saved_ms"] = entry["saved_ms"][part["what"].get<std::string>()];
}
