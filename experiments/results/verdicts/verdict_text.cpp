#include "experiments/results/verdicts/verdict_text.h"

#include "core/files.h"
#include "core/json.h"
#include "core/json_types.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "experiments/results/verdicts/judged_sequences.h"
#include "metrics/video_jod.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using nlohmann::json;
using Lines = std::vector<std::string>;

constexpr const char* verdict_file = "verdict.json";
constexpr size_t most_shown = 3;

std::filesystem::path file_in(const std::filesystem::path& folder) { return path_inside(folder, verdict_file); }

std::string judged_metric(const JudgedView& view, const PrimaryComparisons& primary) {
    return view.what == judged_number::error     ? primary.metric
           : view.what == judged_number::flicker ? "frame_difference"
           : view.what == judged_number::ghosts  ? "ghost_share"
                                                 : video_jod_name;
}

std::string change_text(const JudgedView& view) {
    return number_text(view.change) + " [" + number_text(view.low) + ", " + number_text(view.high) + "]";
}

/// Why a ratio is undecided that better light would decide.
std::string light_text(const JudgedView& view) {
    constexpr double much = 1.2;  // less hardly changes what an interval excludes
    if (view.verdict != judgement::undecided || view.of_light < much) return "";
    return ". The noise of the light in these frames widens the interval by a factor of up to " +
           number_text(view.of_light, 3) + ". Add half images, or make the light with more `scene-for --samples`";
}

std::string sentence_on(const JudgedView& view, const PrimaryComparisons& primary, const std::string& before) {
    const std::string start = view.shot + ": " + view.what + " (" + judged_metric(view, primary) + ") ";
    if (!view.no_interval.empty()) return start + view.verdict + ", " + view.no_interval;
    const bool is_ratio = view.no_change == 1;
    const std::string more = is_ratio                                 ? " times"
                             : view.what == judged_number::visibility ? " JOD further from the truth"
                                                                      : " more";
    const std::string found =
        start + change_text(view) + more + (is_ratio ? " that of " : " than in ") + before + ": " + view.verdict;
    if (is_ratio && view.low == 1 && view.high == 1) return found;  // the same pixels
    return found + " (p " + number_text(view.p_holm, 2) + "; " + number_text(view.detectable, 3) + more +
           " would be seen in 95 % of runs)" + light_text(view);
}

/// "error in A and B; flicker in A": what has the verdict of the whole.
std::string where_text(const Judgement& judged) {
    Lines parts;
    for (const char* what :
         {judged_number::error, judged_number::flicker, judged_number::ghosts, judged_number::visibility}) {
        Lines shots;
        for (const JudgedView& view : judged.views)
            if (view.what == what && view.verdict == judged.verdict) shots.push_back(view.shot);
        if (!shots.empty()) parts.push_back(std::string(what) + " in " + listed(shots, most_shown));
    }
    return joined(parts, "; ");
}

/// Of a number whose differences are judged: `rose` and `earlier` in words, and the least difference that counts.
std::string rule_of_differences(const std::string& rose, const std::string& earlier, double visible,
                                const std::string& unit, const JudgeLimits& limits) {
    const bool has_tolerance = limits.worse_by > 1;
    return rose +
           (has_tolerance ? " by more than " + number_text(limits.worse_by - 1) + " times " + earlier + ", or times " +
                                number_text(visible) + unit + " if that is more"
                          : "") +
           ". It is equivalent if it certainly changed by less than " + number_text(visible) + unit +
           (has_tolerance ? " or than that" : "") + ".";
}

Lines rules_of(const Judgement& judged, const JudgeLimits& limits) {
    const auto has = [&](const char* what) { return std::ranges::count(judged.views, what, &JudgedView::what) > 0; };
    const std::string what = has(judged_number::flicker) ? "Error or flicker" : "An error";
    Lines rules = {what + " of these frames is worse if it is certainly more than " +
                       (limits.worse_by > 1 ? number_text(limits.worse_by) + " times that" : "that") +
                       " of the earlier frames.",
                   what + " is equivalent if it certainly changed by less than " +
                       percent_text(limits.most_equivalent() - 1) + "."};
    if (has(judged_number::ghosts))
        rules.push_back(rule_of_differences("A share of ghosts is worse if it certainly rose", "the earlier share",
                                            visible_ghost, "", limits));
    if (has(judged_number::visibility))
        rules.push_back(rule_of_differences(
            "Visibility is worse if the distance from the truth, 10 less cvvdp_0_5_6_video, certainly rose",
            "the earlier distance", visible_jod, " JOD", limits));
    rules.push_back(counted(judged.views.size(), "number") + " of all views " +
                    (judged.views.size() == 1 ? "is" : "are") + " judged together: at most " +
                    percent_text(judge_significance) + " of runs without a change are called worse or better.");
    return rules;
}

json numbers_json(const Judgement& judged) {
    json all = json::array();
    for (const JudgedView& view : judged.views) {
        json number = {{"shot", view.shot}, {"what", view.what}, {"verdict", view.verdict}, {"p", view.p_holm}};
        if (!view.no_interval.empty())
            number["why"] = view.no_interval;
        else
            number.update({{"change", view.change},
                           {"low", view.low},
                           {"high", view.high},
                           {"no_change", view.no_change},
                           {"detectable", view.detectable}});
        all.push_back(std::move(number));
    }
    return all;
}

}  // namespace

Lines VerdictText::lead() const {
    Lines lines = rules;
    const size_t shown = std::min(deciding, most_shown);
    lines.insert(lines.end(), numbers.begin(), numbers.begin() + std::ptrdiff_t(shown));
    if (shown < numbers.size())
        lines.push_back(std::string(verdict_file) + " holds all " + counted(numbers.size(), "number") + ".");
    return lines;
}

VerdictText verdict_text(const Judgement& judged, const PrimaryComparisons& primary, const JudgeLimits& limits,
                         const std::string& before) {
    VerdictText text{.headline = judged.verdict + " against " + before};
    if (judged.verdict == judgement::identical) {
        text.rules = {"All images have the same bytes, so nothing was compared."};
        return text;
    }
    if (judged.verdict == judgement::worse || judged.verdict == judgement::better)
        text.headline += ": " + where_text(judged);
    text.rules = rules_of(judged, limits);
    std::vector<const JudgedView*> views;
    for (const JudgedView& view : judged.views) views.push_back(&view);
    std::ranges::stable_sort(views, {},
                             [&](const JudgedView* v) { return std::pair(v->verdict != judged.verdict, v->p_holm); });
    for (const JudgedView* view : views) text.numbers.push_back(sentence_on(*view, primary, before));
    text.deciding = size_t(std::ranges::count(judged.views, judged.verdict, &JudgedView::verdict));
    return text;
}

VerdictText text_without_verdict(const Lines& errors) {
    return {.headline = "no verdict: there are no earlier frames to compare with",
            .rules = {},
            .numbers = errors,
            .deciding = errors.size()};
}

void write_verdict(const std::filesystem::path& folder, const VerdictText& text, const Judgement* judged,
                   const JudgeLimits& limits) {
    const json verdict = {{"verdict", judged ? json(judged->verdict) : json()},
                          {"headline", text.headline},
                          {"sentences", text.lead()},
                          {"worse_by", limits.worse_by},
                          {"margin", limits.margin},
                          {"false_alarms", judge_significance},
                          {"numbers", judged ? numbers_json(*judged) : json::array()}};
    write_text(file_in(folder), verdict.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

std::optional<VerdictLead> read_verdict(const std::filesystem::path& folder) {
    const std::filesystem::path file = file_in(folder);
    if (!std::filesystem::exists(file)) return {};
    static const json types = json::parse(R"({"headline": "text", "sentences": ["text"]})");
    const json verdict = read_json(file);
    require_type(verdict, types, file.string(), OtherMembers::allowed);
    return VerdictLead{verdict["headline"], verdict["sentences"]};
}

void remove_verdict(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::remove(file_in(folder), error);
}
