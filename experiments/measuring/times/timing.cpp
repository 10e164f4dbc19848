#include "experiments/measuring/times/timing.h"

#include "core/gpu/device.h"
#include "experiments/measuring/render_variant.h"
#include "experiments/measuring/times/clock_proofs.h"
#include "variants/registry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <thread>

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
    struct Frame {
        std::vector<PassTime> stages;
        double total;
    };
    std::vector<Frame> frames;  ///< one for each measured round

    TimedCopy(const VariantConfig& c, Purpose p, PassGraph& like)
        : config(c),
          purpose(p),
          graph(std::make_unique<PassGraph>(like.device(), like.extent())),
          variant(make_variant(c.variant, c.parameters, c.preset)) {}

    void render(const CameraData& camera, const GBuffer& gbuffer) {
        render_variant(*graph, *variant, camera, config.seeds.front(), gbuffer);
        graph->times();  // waits for the device: the next copy starts on an idle one
    }

    void record() { frames.push_back({graph->times(), graph->frame_milliseconds()}); }

    /// The rows of one round; `row`: shot, frame, clock and load.
    void add_to(std::vector<TimeRow>& rows, size_t round, TimeRow row) const {
        if (purpose != Purpose::recorded) return;
        row.variant = config.variant, row.point = config.point, row.seed = config.seeds.front();
        add_rows(rows, row, frames[round].stages);
        add_rows(rows, row, {{"total", frames[round].total}});
    }

    double median_total(const std::vector<size_t>& rounds) const {
        std::vector<double> totals;
        for (const size_t round : rounds) totals.push_back(frames[round].total);
        return median_interval(totals).median;
    }
    /// None if the stage did not run.
    std::optional<double> median_of(const std::string& stage, const std::vector<size_t>& rounds) const {
        std::vector<double> times;
        for (const size_t round : rounds)
            for (const PassTime& t : frames[round].stages)
                if (t.stage == stage) times.push_back(t.milliseconds);
        if (times.empty()) return {};
        return median_interval(times).median;
    }
};

/// A round that was measured.
struct Round {
    std::vector<PassTime> source_times;
    std::optional<double> foreign_load;

    bool is_disturbed() const { return foreign_load.value_or(0.0) > disturbing_load; }
};

/// Foreign load of rounds that last load_window together, each of which then has it.
class LoadWindow {
public:
    LoadWindow(std::vector<Round>& rounds, const CpuTimesReader& cpu_times)
        : rounds_(rounds), cpu_times_(cpu_times), start_(cpu_times()) {}

    /// Tells the load of the rounds since the last time, if they took long enough; if `is_last`, waits until that is
    /// so.
    void update(bool is_last) {
        CpuTimes now = cpu_times_();
        if (const double missing = load_window - (now.wall - start_.wall); missing > 0) {
            if (!is_last) return;
            std::this_thread::sleep_for(std::chrono::duration<double>(missing));  // few ticks would tell anything
            now = cpu_times_();
        }
        for (; told_ < rounds_.size(); ++told_) {
            rounds_[told_].foreign_load = foreign_load(start_, now);
            quiet_ += !rounds_[told_].is_disturbed();
        }
        start_ = now;
    }
    size_t quiet() const { return quiet_; }  ///< of those whose load is told
    size_t untold() const { return rounds_.size() - told_; }

private:
    std::vector<Round>& rounds_;
    const CpuTimesReader& cpu_times_;
    CpuTimes start_;
    size_t told_ = 0, quiet_ = 0;
};

/// The first `count` quiet rounds, or all of them and the least disturbed others, in their order.
std::vector<size_t> chosen_rounds(const std::vector<Round>& rounds, size_t count) {
    std::vector<size_t> order(rounds.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {},
                             [&](size_t i) { return rounds[i].is_disturbed() ? *rounds[i].foreign_load : 0.0; });
    order.resize(std::min(count, order.size()));
    std::ranges::sort(order);
    return order;
}

TimingLoad load_of(const std::vector<Round>& rounds, const std::vector<size_t>& chosen) {
    TimingLoad load;
    for (const Round& round : rounds) load.left_out += round.is_disturbed();
    for (const size_t i : chosen) {
        load.disturbed += rounds[i].is_disturbed();
        if (rounds[i].foreign_load) load.largest = std::max(load.largest.value_or(0.0), *rounds[i].foreign_load);
    }
    load.left_out -= load.disturbed;
    return load;
}

std::vector<TimedCopy> make_copies(const Config& config, PassGraph& like, bool keep_all, const SceneFacts& facts) {
    using enum TimedCopy::Purpose;
    std::vector<TimedCopy> copies;
    for (const VariantConfig& variant : config.variants) {
        if (!variant.is_timed) continue;
        std::vector<LeftOut> left_out;
        for (const auto purpose : {recorded, twin}) {
            if (purpose == twin && !config.timing.has_copies) continue;
            TimedCopy& copy = copies.emplace_back(variant, purpose, like);
            if (!keep_all) left_out = copy.variant->leave_out(facts);
        }
        if (!left_out.empty() && config.timing.has_copies)
            copies.emplace_back(variant, complete, like).kept_parts = left_out;
    }
    return copies;
}

/// The copy that gives the rows of the same point as another one.
const TimedCopy& recorded_like(const TimedCopy& other, const std::vector<TimedCopy>& copies) {
    return *std::ranges::find_if(copies, [&](const TimedCopy& copy) {
        return copy.purpose == TimedCopy::Purpose::recorded && &copy.config == &other.config;
    });
}

std::vector<SavedTime> saved_times(const std::vector<TimedCopy>& copies, const std::vector<size_t>& rounds) {
    std::map<std::string, double> largest;
    for (const TimedCopy& copy : copies)
        for (const LeftOut& part : copy.kept_parts) {
            const std::string& stage = part.stage.empty() ? part.what : part.stage;
            const std::optional<double> complete = copy.median_of(stage, rounds);
            if (!complete) continue;
            const double saved = *complete - recorded_like(copy, copies).median_of(stage, rounds).value_or(0.0);
            const auto [entry, is_new] = largest.try_emplace(stage, saved);
            entry->second = std::max(entry->second, saved);
        }
    std::vector<SavedTime> saved;
    for (const auto& [stage, milliseconds] : largest) saved.push_back({stage, milliseconds});
    return saved;
}

std::vector<Saving> savings_of(const std::vector<TimedCopy>& copies, const std::vector<size_t>& rounds) {
    std::vector<Saving> savings;
    for (const TimedCopy& copy : copies) {
        if (copy.purpose != TimedCopy::Purpose::complete) continue;
        const TimedCopy& lean = recorded_like(copy, copies);
        std::vector<double> shares;
        for (const size_t round : rounds) shares.push_back(1 - lean.frames[round].total / copy.frames[round].total);
        savings.push_back({.variant = copy.config.variant,
                           .point = copy.config.point,
                           .complete_ms = copy.median_total(rounds),
                           .share = median_interval(shares)});
    }
    return savings;
}

std::vector<AaPair> pairs_of(const std::vector<TimedCopy>& copies, const std::vector<size_t>& rounds) {
    std::vector<AaPair> pairs;
    for (const TimedCopy& copy : copies)
        if (copy.purpose == TimedCopy::Purpose::twin)
            pairs.push_back({.variant = copy.config.variant,
                             .point = copy.config.point,
                             .first_ms = recorded_like(copy, copies).median_total(rounds),
                             .second_ms = copy.median_total(rounds)});
    return pairs;
}

/// One entry for each proof, with the shots that were timed by its clock.
void add_proof(nlohmann::json& proofs, const nlohmann::json& entry) {
    for (nlohmann::json& proof : proofs) {
        nlohmann::json alone = proof;
        alone.erase("shots");
        if (alone == entry["clock"]) return proof["shots"].push_back(entry["shot"]);
    }
    proofs.push_back(entry["clock"]);
    proofs.back()["shots"] = {entry["shot"]};
}

/// The 95 % quantile of the difference between two copies of one point, of as few as one pair: that of a normal
/// distribution with the median of the pairs' differences, or that of the pairs themselves (linear between order
/// statistics) where it is larger, as a few of them may be disturbed. It does not grow with their number, as the
/// largest does.
double floor_of(const nlohmann::json& pairs, const nlohmann::json& proofs) {
    constexpr double normal_median = 0.67449, normal_quantile = 1.95996;  // of |x|, x of variance 1: 50 %, 95 %
    double empty_submit_ms = 0;
    for (const nlohmann::json& proof : proofs)
        empty_submit_ms = std::max(empty_submit_ms, proof["empty_submit_ms"].get<double>());
    // What takes hardly longer than submitting nothing is as noisy as that: it counts only where there is nothing else.
    const auto is_long = [&](const nlohmann::json& pair) {
        return pair["first_ms"].get<double>() > 10 * empty_submit_ms;
    };
    const bool has_long = std::ranges::any_of(pairs, is_long);
    std::vector<double> differences;
    for (const nlohmann::json& pair : pairs)
        if (is_long(pair) || !has_long) differences.push_back(pair["floor"]);
    std::ranges::sort(differences);
    const double place = 0.95 * double(differences.size() - 1), share = place - std::floor(place);
    const size_t below = size_t(place), above = std::min(below + 1, differences.size() - 1);
    const double of_pairs = (1 - share) * differences[below] + share * differences[above];
    return std::max(of_pairs, median_interval(differences).median * normal_quantile / normal_median);
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
                        const std::function<void(double)>& report, const CpuTimesReader& cpu_times) {
    ShotTimes result;
    std::vector<TimedCopy> copies = make_copies(config, source.graph(), keep_all, shot.facts);
    if (config.timing.frames == 0 || copies.empty()) return result;

    const std::string clock = source.graph().clock() == Clock::host_fence ? "host_fence" : "gpu_timestamp";
    const unsigned warm_up = config.timing.warm_up, wanted = config.timing.frames,
                   most = warm_up + (1 + most_repeated_frames) * wanted;
    const std::vector<std::vector<size_t>> turns = timed_turns(copies.size(), most);
    std::vector<Round> rounds;
    std::optional<LoadWindow> load;
    for (const FrameStep& step : timed_steps(shot.config.frames, most)) {
        if (step.index == warm_up) load.emplace(rounds, cpu_times);
        const GBuffer gbuffer = source.render(step, 0, lit(step.frame));
        std::vector<PassTime> source_times = source.graph().times();
        for (const size_t place : turns[step.index]) copies[place].render(source.camera(), gbuffer);
        if (step.index < warm_up) continue;
        rounds.push_back({std::move(source_times), {}});
        for (TimedCopy& copy : copies) copy.record();
        load->update(load->quiet() + load->untold() == wanted || step.index + 1 == most);
        if (load->quiet() >= wanted) break;
        report(std::min(double(load->quiet() + load->untold()) / wanted, 0.99));
    }

    const std::vector<size_t> chosen = chosen_rounds(rounds, wanted);
    for (const size_t i : chosen) {
        const TimeRow row{.shot = shot.name(),
                          .frame = unsigned(i),
                          .clock = clock,
                          .foreign_load = rounds[i].foreign_load,
                          .is_disturbed = rounds[i].is_disturbed()};
        add_rows(result.rows, row, rounds[i].source_times);
        for (const TimedCopy& copy : copies) copy.add_to(result.rows, i, row);
    }
    result.pairs = pairs_of(copies, chosen);
    result.saved = saved_times(copies, chosen);
    result.savings = savings_of(copies, chosen);
    result.load = load_of(rounds, chosen);
    return result;
}

nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot, const ClockProof& clock) {
    nlohmann::json pairs = nlohmann::json::array(), saved = nlohmann::json::object(), largest;
    if (times.load.largest) largest = *times.load.largest;
    for (const AaPair& p : times.pairs)
        pairs.push_back({{"shot", shot},
                         {"variant", p.variant},
                         {"point", p.point},
                         {"first_ms", p.first_ms},
                         {"second_ms", p.second_ms},
                         {"floor", p.floor()}});
    for (const SavedTime& s : times.saved) saved[s.stage] = s.milliseconds;
    nlohmann::json savings = nlohmann::json::array();
    for (const Saving& s : times.savings)
        savings.push_back({{"shot", shot},
                           {"variant", s.variant},
                           {"point", s.point},
                           {"complete_ms", s.complete_ms},
                           {"share", s.share.median},
                           {"low", s.share.low},
                           {"high", s.share.high}});
    return {{"shot", shot},
            {"aa_pairs", pairs},
            {"saved_ms", saved},
            {"savings", savings},
            {"load",
             {{"disturbed_frames", times.load.disturbed},
              {"left_out_frames", times.load.left_out},
              {"largest_foreign_load", largest}}},
            {"clock", clock_entry(clock)}};
}

double disturbed_frames(const nlohmann::json& timing_entry) {
    return timing_entry.is_object() ? timing_entry.at("load").at("disturbed_frames").get<double>() : 0.0;
}

bool is_disturbed(const nlohmann::json& timing_entry) { return disturbed_frames(timing_entry) > 0; }

void add_timing(nlohmann::json& manifest, const nlohmann::json& entry) {
    nlohmann::json& clock = manifest["clock"];
    add_proof(clock["proofs"], entry);
    nlohmann::json load = entry["load"];
    load["shot"] = entry["shot"];
    clock["load"].push_back(load);
    for (const nlohmann::json& pair : entry["aa_pairs"]) clock["aa_pairs"].push_back(pair);
    for (const nlohmann::json& saving : entry.value("savings", nlohmann::json::array()))
        clock["savings"].push_back(saving);
    if (!entry["aa_pairs"].empty())
        clock["aa_floors"][entry["shot"].get<std::string>()] = floor_of(entry["aa_pairs"], clock["proofs"]);

    for (nlohmann::json& shot : manifest["shots"])
        for (nlohmann::json& part : shot["left_out"])
            if (shot["shot"] == entry["shot"] && entry["saved_ms"].contains(part["stage"]))
                part["saved_ms"] = entry["saved_ms"][part["stage"].get<std::string>()];
}
