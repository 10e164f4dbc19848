// Over 400 lines: what is timed of a shot, how its rounds are played within the budget, and what is read from them, all
// of which are about TimedCopy. Which rounds count is in timed_rounds.h.
#include "experiments/study/measuring/times/timing.h"

#include "core/elapsed.h"
#include "core/gpu/device.h"
#include "core/in_flight.h"
#include "experiments/study/measuring/render_technique.h"
#include "experiments/study/measuring/times/clock_proofs.h"
#include "experiments/study/measuring/times/timed_rounds.h"
#include "variants/registry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <set>

namespace {

void add_rows(std::vector<TimeRow>& rows, TimeRow row, const std::vector<PassTime>& times) {
    for (const PassTime& t : times) {
        row.stage = t.stage, row.milliseconds = t.milliseconds;
        rows.push_back(row);
    }
}

/// A technique with images and pipelines of its own, ready to render.
struct TimedCopy {
    const PointConfig& config;
    enum class Purpose { recorded, twin, complete } purpose;
    std::unique_ptr<PassList> pass_list;
    std::unique_ptr<Technique> technique;
    std::vector<LeftOut> kept_parts;  ///< by a complete copy: what the others leave out
    struct Frame {
        std::vector<PassTime> stages;
        double total;
    };
    std::vector<Frame> frames;  ///< one for each measured round, up to the last that it played
    double planned_ms = 0;      ///< of a frame, by the last one that warmed it up
    bool is_spared = false;     ///< where time is short, as others of its technique and purpose are played
    bool plays = true;

    TimedCopy(const PointConfig& c, Purpose p, PassList& like)
        : config(c),
          purpose(p),
          pass_list(std::make_unique<PassList>(like.device(), like.extent())),
          technique(make_technique(c.technique, c.parameters, c.preset)) {}

    void render(const CameraData& camera, const GBuffer& gbuffer) {
        const InFlightText technique_at_work(in_flight().technique, config.technique),
            point_at_work(in_flight().point, config.point);
        render_technique(*pass_list, *technique, camera, config.seeds.front(), gbuffer);
        pass_list->times();  // waits for the device: the next copy starts on an idle one
    }

    void record() { frames.push_back({pass_list->times(), pass_list->frame_milliseconds()}); }

    /// The rows of one round; `row`: shot, frame, clock and load.
    void add_to(std::vector<TimeRow>& rows, size_t round, TimeRow row) const {
        if (purpose != Purpose::recorded) return;
        row.technique = config.technique, row.point = config.point, row.seed = config.seeds.front();
        add_rows(rows, row, frames[round].stages);
        add_rows(rows, row, {{"total", frames[round].total}});
    }

    double median_total(const std::vector<size_t>& rounds) const {
        std::vector<double> totals;
        for (const size_t round : rounds) totals.push_back(frames[round].total);
        return median_interval(totals).value;
    }
    /// None if the stage did not run.
    std::optional<double> median_of(const std::string& stage, const std::vector<size_t>& rounds) const {
        std::vector<double> times;
        for (const size_t round : rounds)
            for (const PassTime& t : frames[round].stages)
                if (t.stage == stage) times.push_back(t.milliseconds);
        if (times.empty()) return {};
        return median_interval(times).value;
    }
};

/// The rounds that count among those that a copy played.
using RoundsOfCopy = std::function<std::vector<size_t>(const TimedCopy&)>;

TimingLoad load_of(const std::vector<RoundLoad>& rounds, const std::vector<size_t>& chosen) {
    TimingLoad load{.frames = unsigned(chosen.size())};
    for (const RoundLoad& round : rounds) load.left_out += round.is_disturbed();
    for (const size_t i : chosen) {
        load.disturbed += rounds[i].is_disturbed();
        if (rounds[i].foreign) load.largest = std::max(load.largest.value_or(0.0), *rounds[i].foreign);
        load.stolen = std::max(load.stolen, rounds[i].stolen);
    }
    load.left_out -= load.disturbed;
    return load;
}

/// Fewer tell next to nothing of the noise of times: of two pairs Student's t is 4.3.
constexpr size_t fewest_twins = 3;

std::vector<TimedCopy> make_copies(const Config& config, PassList& like, bool keep_all, const SceneFacts& facts) {
    using enum TimedCopy::Purpose;
    std::vector<TimedCopy> copies;
    std::set<std::string> has_twin, has_complete;  // techniques
    size_t twins = 0;
    for (const PointConfig& technique : config.techniques) {
        if (!technique.is_timed) continue;
        std::vector<LeftOut> left_out;
        for (const auto purpose : {recorded, twin}) {
            if (purpose == twin && !config.timing.has_copies) continue;
            TimedCopy& copy = copies.emplace_back(technique, purpose, like);
            if (purpose == twin) copy.is_spared = !has_twin.insert(technique.technique).second && twins >= fewest_twins;
            twins += purpose == twin;
            if (!keep_all) left_out = copy.technique->leave_out(facts);
        }
        if (left_out.empty() || !config.timing.has_copies) continue;
        TimedCopy& copy = copies.emplace_back(technique, complete, like);
        copy.is_spared = !has_complete.insert(technique.technique).second, copy.kept_parts = left_out;
    }
    return copies;
}

/// The copy that gives the rows of the same point as another one.
const TimedCopy& recorded_like(const TimedCopy& other, const std::vector<TimedCopy>& copies) {
    return *std::ranges::find_if(copies, [&](const TimedCopy& copy) {
        return copy.purpose == TimedCopy::Purpose::recorded && &copy.config == &other.config;
    });
}

std::vector<SavedTime> saved_times(const std::vector<TimedCopy>& copies, const RoundsOfCopy& rounds_of) {
    std::map<std::string, double> largest;
    for (const TimedCopy& copy : copies)
        for (const LeftOut& part : copy.kept_parts) {
            const std::string& stage = part.stage.empty() ? part.what : part.stage;
            const std::vector<size_t> rounds = rounds_of(copy);
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

std::vector<Saving> savings_of(const std::vector<TimedCopy>& copies, const RoundsOfCopy& rounds_of) {
    std::vector<Saving> savings;
    for (const TimedCopy& copy : copies) {
        const std::vector<size_t> rounds = rounds_of(copy);
        if (copy.purpose != TimedCopy::Purpose::complete || rounds.empty()) continue;
        const TimedCopy& lean = recorded_like(copy, copies);
        std::vector<double> shares;
        for (const size_t round : rounds) shares.push_back(1 - lean.frames[round].total / copy.frames[round].total);
        savings.push_back({.technique = copy.config.technique,
                           .point = copy.config.point,
                           .complete_ms = copy.median_total(rounds),
                           .share = median_interval(shares)});
    }
    return savings;
}

std::vector<AaPair> pairs_of(const std::vector<TimedCopy>& copies, const RoundsOfCopy& rounds_of) {
    std::vector<AaPair> pairs;
    for (const TimedCopy& copy : copies)
        if (const std::vector<size_t> rounds = rounds_of(copy);
            copy.purpose == TimedCopy::Purpose::twin && !rounds.empty())
            pairs.push_back({.technique = copy.config.technique,
                             .point = copy.config.point,
                             .first_ms = recorded_like(copy, copies).median_total(rounds),
                             .second_ms = copy.median_total(rounds)});
    return pairs;
}

/// What the copies that play take of a round.
double playing_ms(const std::vector<TimedCopy>& copies) {
    double ms = 0;
    for (const TimedCopy& copy : copies) ms += copy.plays ? copy.planned_ms : 0;
    return ms;
}

/// Sends away, in their order, the spared copies that do not fit into so much of a round's time as well.
void keep_what_fits(std::vector<TimedCopy>& copies, double most_ms) {
    for (TimedCopy& copy : copies) most_ms -= copy.is_spared ? 0 : copy.planned_ms;
    for (TimedCopy& copy : copies) {
        if (!copy.is_spared) continue;
        copy.plays = copy.planned_ms <= most_ms;
        if (copy.plays)
            most_ms -= copy.planned_ms;
        else
            copy.pass_list.reset();  // its images
    }
}

/// After least_rounds: all go on if `most_ms` of a round's time, for each round that is wanted, is enough; else the
/// points without their copies if that is; else the points alone whose order is open.
void choose_who_goes_on(std::vector<TimedCopy>& copies, double most_ms) {
    using enum TimedCopy::Purpose;
    if (playing_ms(copies) <= most_ms) return;
    for (TimedCopy& copy : copies) copy.plays = copy.plays && copy.purpose == recorded;
    if (playing_ms(copies) <= most_ms) return;
    std::vector<std::vector<double>> times;
    for (const TimedCopy& copy : copies) {
        if (copy.purpose != recorded) continue;
        for (std::vector<double>& of_point = times.emplace_back(); const TimedCopy::Frame& frame : copy.frames)
            of_point.push_back(std::max(frame.total, 1e-9));
    }
    const std::vector<bool> is_open = open_orders(times);
    auto at = is_open.begin();
    for (TimedCopy& copy : copies)
        if (copy.purpose == recorded) copy.plays = *at++;
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
    return std::max(of_pairs, median_interval(differences).value * normal_quantile / normal_median);
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

ShotTimes time_techniques(FrameSource& source, const Shot& shot, const Config& config,
                          const std::function<const HostImage&(unsigned frame)>& lit, bool keep_all, double budget,
                          const std::function<void(double)>& report, const CpuTimesReader& cpu_times) {
    ShotTimes result;
    const auto start = std::chrono::steady_clock::now();
    std::vector<TimedCopy> copies = make_copies(config, source.pass_list(), keep_all, shot.facts);
    if (config.timing.frames == 0 || copies.empty()) return result;

    const unsigned warm_up = config.timing.warm_up, wanted = config.timing.frames,
                   most = warm_up + (1 + most_repeated_frames) * wanted;
    const std::vector<std::vector<size_t>> turns = timed_turns(copies.size(), most);
    const std::vector<FrameStep> steps = timed_steps(shot.config.frames, most);
    std::vector<std::vector<PassTime>> source_times;  // by measured round
    const auto play = [&](const FrameStep& step) {
        const GBuffer gbuffer = source.render(step, 0, lit(step.frame));
        source_times.push_back(source.pass_list().times());
        for (const size_t place : turns[step.index])
            if (copies[place].plays) copies[place].render(source.camera(), gbuffer);
    };

    double warm_seconds = 0;  // of the last round before those that are measured
    for (unsigned i = 0; i < warm_up; ++i) {
        const auto start_of_round = std::chrono::steady_clock::now();
        play(steps[i]);
        warm_seconds = seconds_since(start_of_round);
    }
    source_times.clear();
    for (TimedCopy& copy : copies) copy.planned_ms = copy.pass_list->frame_milliseconds();
    const double seconds_per_ms = warm_seconds / std::max(playing_ms(copies), 1e-9);  // with the G-buffer's part
    budget -= seconds_since(start);
    keep_what_fits(copies, budget / least_rounds / seconds_per_ms);

    LoadWindow load(cpu_times);
    while (load.rounds().size() + warm_up < most && load.quiet() < wanted) {
        const size_t rounds = load.rounds().size();
        if (rounds == least_rounds)
            choose_who_goes_on(copies, (budget - load.seconds()) / double(wanted - rounds) / seconds_per_ms);
        // Known before the round: what it takes has no say in whether it is measured.
        const double planned_seconds = seconds_per_ms * playing_ms(copies);
        if (rounds >= least_rounds && (planned_seconds == 0 || load.seconds() + planned_seconds > budget)) break;
        play(steps[warm_up + rounds]);
        for (TimedCopy& copy : copies)
            if (copy.plays) copy.record();
        load.end_round();
        if (load.quiet() + load.untold() >= wanted) load.tell_rest();
        const double of_budget = std::min(load.seconds() / std::max(budget, 1e-9), double(rounds + 1) / least_rounds);
        report(std::min(std::max(double(rounds + 1) / wanted, of_budget), 0.99));
    }
    load.tell_rest();

    const auto rounds_among = [&](size_t played) {
        return chosen_rounds(std::span(load.rounds()).first(played), wanted);
    };
    const auto rounds_of = [&](const TimedCopy& copy) { return rounds_among(copy.frames.size()); };
    const auto row_of = [&](size_t round) {
        return TimeRow{.shot = shot.name(),
                       .frame = unsigned(round),
                       .clock = source.pass_list().clock() == Clock::host_fence ? "host_fence" : "gpu_timestamp",
                       .foreign_load = load.rounds()[round].foreign,
                       .disturbed = load.rounds()[round].is_disturbed()};
    };
    const std::vector<size_t> chosen = rounds_among(load.rounds().size());
    for (const size_t round : chosen) add_rows(result.rows, row_of(round), source_times[round]);
    for (const TimedCopy& copy : copies)
        for (const size_t round : rounds_of(copy)) copy.add_to(result.rows, round, row_of(round));
    result.pairs = pairs_of(copies, rounds_of);
    result.saved = saved_times(copies, rounds_of);
    result.savings = savings_of(copies, rounds_of);
    result.load = load_of(load.rounds(), chosen);
    return result;
}

nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot, const ClockProof& clock) {
    nlohmann::json pairs = nlohmann::json::array(), saved = nlohmann::json::object(), largest;
    if (times.load.largest) largest = *times.load.largest;
    for (const AaPair& p : times.pairs)
        pairs.push_back({{"shot", shot},
                         {"technique", p.technique},
                         {"point", p.point},
                         {"first_ms", p.first_ms},
                         {"second_ms", p.second_ms},
                         {"floor", p.floor()}});
    for (const SavedTime& s : times.saved) saved[s.stage] = s.milliseconds;
    nlohmann::json savings = nlohmann::json::array();
    for (const Saving& s : times.savings)
        savings.push_back({{"shot", shot},
                           {"technique", s.technique},
                           {"point", s.point},
                           {"complete_ms", s.complete_ms},
                           {"share", s.share.value},
                           {"low", s.share.low},
                           {"high", s.share.high}});
    return {{"shot", shot},
            {"aa_pairs", pairs},
            {"saved_ms", saved},
            {"savings", savings},
            {"load",
             {{"frames", times.load.frames},
              {"disturbed_frames", times.load.disturbed},
              {"left_out_frames", times.load.left_out},
              {"largest_foreign_load", largest},
              {"largest_stolen_share", times.load.stolen}}},
            {"clock", clock_entry(clock)}};
}

double disturbed_share(const nlohmann::json& timing_entry) {
    if (!timing_entry.is_object()) return 0;
    const nlohmann::json& load = timing_entry.at("load");
    return load.at("disturbed_frames").get<double>() / std::max(load.at("frames").get<double>(), 1.0);
}

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
