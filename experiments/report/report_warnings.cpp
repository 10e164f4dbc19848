#include "experiments/report/report_warnings.h"

#include "core/list_text.h"
#include "core/number_text.h"
#include "experiments/results/answers/answer_text.h"
#include "experiments/results/files/manifest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

double number(const json& value, double fallback) { return value.is_number() ? value.get<double>() : fallback; }
std::string text(const json& value) { return value.is_string() ? value.get<std::string>() : "?"; }
bool is_true(const json& value) { return value.is_boolean() && value.get<bool>(); }

/// Warnings of the manifest are clauses: this ends them as sentences end.
std::string ended(std::string clause) {
    if (!clause.empty() && clause.back() != '.') clause += '.';
    return clause;
}

/// Rounded towards zero: 99.96 % that falls short must not be read as 100 %.
double rounded_down(double share) { return std::floor(share * 1000.0) / 1000.0; }

void warn_of_study(std::vector<std::string>& warnings, const json& manifest) {
    for (const json& warning : member(manifest, "warnings"))
        if (warning.is_string()) warnings.push_back("This study: " + ended(warning.get<std::string>()));
    if (!is_true(member(manifest, "is_complete")))
        warnings.push_back("This study is not finished: some techniques or shots may be missing.");
    if (member(member(member(manifest, "config"), "reference"), "lit_noise") == false)
        warnings.push_back(
            "This study did not measure what the noise of the lit colour adds to errors (reference.lit_noise). "
            "Intervals do not hold this noise.");
}

/// Whether the makers of the cells differ in `part`, in what `shown` says of it.
bool differ(const json& provenance, const char* part, std::initializer_list<const char*> shown) {
    for (const json& maker : provenance)
        for (const char* key : shown)
            if (member(member(maker, part), key) != member(member(provenance.front(), part), key)) return true;
    return false;
}

/// The shots that each machine timed, by its name and processor.
std::map<std::string, Names> shots_by_host(const json& clock) {
    std::map<std::string, Names> shots;
    for (const json& load : member(clock, "load")) {
        const json& host = member(load, "host");
        shots[text(member(host, "name")) + " (" + text(member(host, "cpu")) + ")"].push_back(
            text(member(load, "shot")));
    }
    return shots;
}

void warn_of_hosts(std::vector<std::string>& warnings, const json& clock) {
    const std::map<std::string, Names> shots = shots_by_host(clock);
    if (shots.size() < 2) return;
    const Names list = names_of(shots, [](const auto& of) { return joined(of.second) + " on " + of.first; });
    warnings.push_back(
        "Times were measured on different machines. Compare times within one shot only: " + joined(list, "; ") + ".");
}

void warn_of_provenance(std::vector<std::string>& warnings, const json& provenance, const json& clock) {
    if (!provenance.is_array()) return;
    Names different;
    const auto add = [&](bool is_different, const char* what) {
        if (is_different) different.push_back(what);
    };
    add(differ(provenance, "host", {"name", "cpu", "cores", "memory_gib"}), "hosts");
    add(differ(provenance, "host", {"kernel"}), "kernels");
    add(differ(provenance, "device", {"name", "driver", "api"}), "devices or drivers");
    add(differ(provenance, "ssrlab", {"commit", "code", "compiler", "build"}), "versions of ssrlab");
    const size_t machines = shots_by_host(clock).size();
    const bool are_known =
        std::ranges::all_of(member(clock, "load"), [](const json& load) { return member(load, "host").is_object(); });
    // Other machines that only rendered do nothing to the times of one; of several, warn_of_hosts() says more.
    const char* const of_times = machines > 1 ? "."
                                 : machines == 1 && are_known && different == Names{"hosts"}
                                     ? ". All times were measured on one machine."
                                     : ". Compare times within one shot only.";
    if (!different.empty())
        warnings.push_back("Parts of this study were made by different " + joined(different) +
                           ": `provenance` in manifest.json says which" + of_times);
    if (std::ranges::any_of(provenance,
                            [](const json& maker) { return is_true(member(member(maker, "ssrlab"), "dirty")); }))
        warnings.push_back(
            "The program or its shaders differ from the commit. `code` in manifest.json identifies them, the commit "
            "does not.");
}

/// One warning for each reason, with all points that have it.
void warn_of_variation(std::vector<std::string>& warnings, const json& techniques) {
    std::map<std::pair<std::string, std::string>, Names> points;  // by technique and reason
    for (const json& v : techniques) {
        const json& why = member(v, "not_repeatable");
        if (!why.is_string()) continue;
        points[{text(member(v, "technique")), why.get<std::string>()}].push_back(text(member(v, "point")));
    }
    for (const auto& [what, names] : points)
        warnings.push_back(what.first + " (" + joined(names) +
                           "): results differ from run to run. Their intervals do not hold the scatter between runs. " +
                           "The reason: " + ended(what.second));
}

std::string shots_of(const json& proof) { return joined(names_of(member(proof, "shots"), text)); }

void warn_of_clock(std::vector<std::string>& warnings, const json& clock, bool has_times) {
    if (!has_times) return;
    const json& proofs = member(clock, "proofs");
    if (!proofs.is_array() || proofs.empty()) warnings.push_back("No timer was validated: times may be wrong.");
    for (const json& proof : proofs) {
        const json& verdict = member(proof, "verdict");
        if (verdict == "failed")
            warnings.push_back(
                "Timer validation failed: on a quiet machine, passes of 1 : 10 : 100 work did not take 1 : 10 : 100 of "
                "the time. Do not trust the times of " +
                shots_of(proof) + ".");
        else if (verdict != "passed")
            warnings.push_back("The timer was not validated for the times of " + shots_of(proof) +
                               ", because other programs used the machine.");
    }
    if (member(clock, "aa_floors").empty())
        warnings.push_back("No point was timed twice (A/A pair): the noise floor of times is unknown.");
}

void warn_of_load(std::vector<std::string>& warnings, std::span<const TimeSummary> times) {
    std::map<std::string, double> shares;
    for (const TimeSummary& t : times) shares[t.shot] = std::max(shares[t.shot], t.disturbed_share);
    for (const auto& [shot, share] : shares)
        if (share > 0)
            warnings.push_back(shot + ": other programs disturbed " + percent_text(share) +
                               " of the timed frames. The times of this shot may be too long. Run the study again on "
                               "a quiet machine to measure them anew.");
}

void warn_of_shot(std::vector<std::string>& warnings, const json& shot) {
    const std::string name = text(member(shot, "shot")) + ": ";
    for (const json& warning : member(shot, "warnings"))
        if (warning.is_string()) warnings.push_back(name + ended(warning.get<std::string>()));
    const json& reference = member(shot, "reference");
    const double target_error = number(member(reference, "target_relative_error"), 0.0);
    const double reached = number(member(reference, "reached_share"), 1.0);
    if (target_error > 0 && reached < 1.0)
        warnings.push_back(name + "only " + percent_text(rounded_down(reached)) +
                           " of the reference's pixels reached the relative error of " + percent_text(target_error) +
                           " that the study asks for. Intervals account for the noise that is left.");
    for (const json& of_frame : member(shot, "references"))
        for (const json& warning : member(of_frame, "warnings"))
            if (warning.is_string())
                warnings.push_back(name + "frame " + std::to_string(uint64_t(number(member(of_frame, "frame"), 0.0))) +
                                   ": " + ended(warning.get<std::string>()));
    if (const double bad = number(member(reference, "non_finite_samples"), 0.0); bad > 0)
        warnings.push_back(name + std::to_string(uint64_t(bad)) +
                           " samples of the reference were not finite and were left out. The reference may be biased.");
}

constexpr double most_lit_noise = 0.1;  ///< share of an error

/// The worst of each shot: techniques read light that is too noisy.
void warn_of_light(std::vector<std::string>& warnings, std::span<const MetricSummary> errors) {
    std::map<std::string, std::pair<double, const MetricSummary*>> worst;
    for (const MetricSummary& e : errors) {
        if (!e.lit_noise || !e.value || e.mask != "reflective") continue;
        const double share = *e.lit_noise / std::max(std::abs(*e.value), 1e-300);
        auto& [most, row] = worst.try_emplace(e.shot, most_lit_noise, nullptr).first->second;
        if (share > most) most = share, row = &e;
    }
    for (const auto& [shot, found] : worst)
        if (const MetricSummary* e = found.second)
            warnings.push_back(shot + ": the noise of the path-traced light that techniques read makes up to " +
                               percent_text(found.first) + " of an error (" + e->technique + " " + e->point + ", " +
                               e->metric + " of " + e->target +
                               "). Intervals allow for this noise. More samples of the reference reduce it.");
}

constexpr size_t most_pixel_warnings = 12;  ///< the rest is counted: nobody reads a hundred

std::vector<std::string> pixel_warnings(std::span<const MetricSummary> errors) {
    std::map<std::string, std::pair<size_t, size_t>> worst;
    for (const MetricSummary& e : errors) {
        if (e.non_finite == 0 && e.negative == 0) continue;
        auto& [non_finite, negative] = worst[e.shot + ", " + e.technique + " (" + e.point + "), " + e.target + ": "];
        non_finite = std::max(non_finite, e.non_finite);
        negative = std::max(negative, e.negative);
    }
    std::vector<std::string> warnings;
    for (const auto& [where, counts] : worst) {
        if (counts.first)
            warnings.push_back(where + std::to_string(counts.first) +
                               (counts.first == 1 ? " pixel is" : " pixels are") +
                               " NaN or infinite and left out of every mean. A mask with more than 1 % of such pixels "
                               "has no mean.");
        if (counts.second)
            warnings.push_back(where + std::to_string(counts.second) +
                               (counts.second == 1 ? " pixel is" : " pixels are") + " negative.");
    }
    return warnings;
}

void warn_of_pixels(std::vector<std::string>& warnings, std::span<const MetricSummary> errors) {
    const std::vector<std::string> found = pixel_warnings(errors);
    const size_t shown = std::min(found.size(), most_pixel_warnings);
    warnings.insert(warnings.end(), found.begin(), found.begin() + long(shown));
    if (found.size() > shown)
        warnings.push_back(std::to_string(found.size() - shown) +
                           " more warnings about pixels that are negative or not finite: see the columns negative and "
                           "non_finite of summary.csv.");
}

}  // namespace

std::vector<std::string> report_warnings(const json& manifest, std::span<const MetricSummary> errors,
                                         std::span<const TimeSummary> times) {
    std::vector<std::string> warnings;
    warn_of_study(warnings, manifest);
    warn_of_variation(warnings, member(manifest, "techniques"));
    warn_of_provenance(warnings, member(manifest, "provenance"), member(manifest, "clock"));
    warn_of_hosts(warnings, member(manifest, "clock"));
    warn_of_clock(warnings, member(manifest, "clock"), !times.empty());
    warn_of_load(warnings, times);
    for (const json& shot : member(manifest, "shots")) warn_of_shot(warnings, shot);
    warn_of_light(warnings, errors);
    warn_of_pixels(warnings, errors);
    return warnings;
}
