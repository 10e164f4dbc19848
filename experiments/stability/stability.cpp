#include "experiments/stability/stability.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "metrics/metric.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <thread>

namespace {

template <class T, class Name>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::string>& wanted, const char* what,
                      const Name& names_of) {
    if (wanted.empty()) return all;
    std::vector<std::string> known;
    for (const T& one : all)
        for (const std::string& name : names_of(one))
            if (!std::ranges::count(known, name)) known.push_back(name);
    for (const std::string& name : wanted)
        if (!std::ranges::count(known, name)) fail("unknown ", what, " '", name, "'", suggestion(name, known));
    std::vector<T> result;
    std::ranges::copy_if(all, std::back_inserter(result), [&](const T& one) {
        const std::vector<std::string> names = names_of(one);
        return std::ranges::any_of(wanted, [&](const auto& name) { return std::ranges::count(names, name) > 0; });
    });
    return result;
}

std::vector<std::string> names_of_case(const StabilityCase& c) { return {c.name, c.family, c.group}; }
std::vector<std::string> names_of_point(const StabilityPoint& p) { return {p.variant, p.variant + ":" + p.label()}; }

/// Means of eight blocks of the last three quarters of a long sequence: the last four against the first four.
void measure_drift(StabilityRow& row) {
    const std::vector<double>& means = row.run.means;
    constexpr size_t blocks = 8, least = 8;
    const size_t length = means.size() * 3 / 4 / blocks;
    if (length < least) return;
    double block[blocks];
    for (size_t b = 0; b < blocks; ++b) {
        const auto from = means.end() - ptrdiff_t((blocks - b) * length);
        block[b] = std::accumulate(from, from + ptrdiff_t(length), 0.0) / double(length);
    }
    const auto mean_of = [&](size_t from) {
        return (block[from] + block[from + 1] + block[from + 2] + block[from + 3]) / 4;
    };
    const double early = mean_of(0), late = mean_of(4);
    double squares = 0;
    for (size_t b = 0; b < blocks; ++b) squares += std::pow(block[b] - (b < 4 ? early : late), 2);
    if (early <= 0) return;
    row.drift = late / early - 1;
    row.drift_noise = std::sqrt(squares / 6 / 2) / early;  // of a difference of two means of four
}

/// Of a geometric series the changes of the second half are those of the first times the gain to the power of their
/// number. Single changes are lost in noise once the series has converged.
void measure_gain(StabilityRow& row) {
    const std::vector<double>& means = row.run.means;
    const size_t half = (means.size() - 1) / 2;
    double early = 0, late = 0;
    for (size_t i = 0; i < half; ++i) {
        early += std::abs(means[i + 1] - means[i]);
        late += std::abs(means[half + i + 1] - means[half + i]);
    }
    if (early > 0) row.gain = std::pow(late / early, 1.0 / double(half));
}

HostImage ramp(glm::uvec2 size, glm::vec2 ends) {
    HostImage image(size, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const double share = size.x > 1 ? double(i % size.x) / double(size.x - 1) : 0.0;
        image.set_rgb(i, glm::vec3(float((1 - share) * double(ends.x) + share * double(ends.y))));
    }
    return image;
}

/// The value as the error of a row whose benign error is not known; what is no number is refused.
StabilityRow metric_row(const StabilityCase& what, const Metric& metric) {
    StabilityRow row{.case_name = what.name, .group = what.group, .variant = "metrics", .point = metric.name};
    try {
        const MetricImages& images = *what.images;
        const ImagePair pair = image_pair(ramp(images.size, images.reference), ramp(images.size, images.test),
                                          {.flip_exposures = FlipExposures{.start = 0, .stop = 0, .count = 1}});
        const double value = measure(metric, pair);
        if (std::isfinite(value))
            row.error = value;
        else
            row.run.refusal = "its value is no number: " + std::to_string(value);
    } catch (const Error& error) {
        row.run.refusal = error.what();
    }
    row.verdict = verdict_of(row);
    return row;
}

struct BenignRun {
    std::optional<double> error;
    double milliseconds = 0;
};

/// One case on its way through the techniques.
class CaseJudge {
public:
    CaseJudge(Device& device, CaseDrawer& drawer, const StabilityCase& what, const CaseFrames& benign,
              std::map<std::string, BenignRun>& benign_runs)
        : device_(device),
          what_(what),
          benign_(benign),
          benign_runs_(benign_runs),
          frames_(drawer.draw(what.scene, what.faults)) {
        if (what.size_before) {
            CaseScene smaller = what.scene;
            smaller.size = *what.size_before;
            before_ = drawer.draw(smaller);
        }
        if (!what.is_perturbed) return;
        for (const Perturbation& p : perturbations())
            perturbed_.emplace_back(p, drawer.draw(what.scene, what.faults, p.apply));
    }

    StabilityRow row(const StabilityPoint& point) {
        StabilityRow row{
            .case_name = what_.name, .group = what_.group, .variant = point.variant, .point = point.label()};
        row.run = run_case(device_, point, what_, frames_, true, before_ ? &*before_ : nullptr);
        if (row.run.refusal.empty()) {
            if (what_.has_truth()) row.error = relative_error(frames_, row.run.specular);
            const BenignRun& benign = benign_run(point);
            row.benign_error = benign.error;
            if (benign.milliseconds > 0) row.time_ratio = row.run.milliseconds / benign.milliseconds;
            measure_drift(row);
            if (what_.feeds_back) measure_gain(row);
            for (const auto& [perturbation, frames] : perturbed_)
                row.amplifications.push_back(
                    amplification(perturbation, frames_, row.run, run_case(device_, point, what_, frames, false)));
        }
        row.verdict = verdict_of(row);
        return row;
    }

    /// What the path tracer made of it. Where it must give the benign case's picture, that one is its truth.
    StabilityRow path_tracer_row() const {
        StabilityRow row{.case_name = what_.name, .group = what_.group, .variant = "path_tracer", .point = "default"};
        row.run.non_finite = frames_.reference->non_finite_samples;
        if (row.run.non_finite) row.run.first_non_finite = "samples";
        for (size_t i = 0; i < frames_.truth.pixel_count(); ++i) {
            const glm::vec3 c = frames_.truth.rgb(i);
            row.run.spread_pixels += !(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
            row.run.negative += std::min({c.x, c.y, c.z}) < 0;
        }
        if (what_.is_truth_same) {
            row.error = relative_error(benign_, frames_.truth);
            row.benign_error = 0.0;
        }
        if (frames_.reference->seconds > 0 && benign_.reference->seconds > 0)
            row.time_ratio = frames_.reference->seconds / benign_.reference->seconds;
        row.verdict = verdict_of(row);
        return row;
    }

private:
    const BenignRun& benign_run(const StabilityPoint& point) {
        const auto [entry, is_new] = benign_runs_.try_emplace(point.variant + ":" + point.label());
        if (is_new) {
            const StabilityCase plain{.scene = what_.benign};
            const CaseRun run = run_case(device_, point, plain, benign_, false);
            if (run.refusal.empty()) entry->second = {relative_error(benign_, run.specular), run.milliseconds};
        }
        return entry->second;
    }

    Device& device_;
    const StabilityCase& what_;
    const CaseFrames& benign_;
    std::map<std::string, BenignRun>& benign_runs_;
    CaseFrames frames_;
    std::optional<CaseFrames> before_;
    std::vector<std::pair<Perturbation, CaseFrames>> perturbed_;
};

/// Cases that are compared with the same one, which is drawn and rendered once for all of them.
std::vector<std::vector<size_t>> batches_of(const std::vector<StabilityCase>& cases) {
    std::map<std::string, size_t> known;
    std::vector<std::vector<size_t>> batches;
    for (size_t i = 0; i < cases.size(); ++i) {
        const auto [entry, is_new] = known.emplace(cases[i].benign_key, batches.size());
        if (is_new) batches.emplace_back();
        batches[entry->second].push_back(i);
    }
    // The longest first, so that no thread is left with one of them when the others have nothing more to do.
    std::ranges::stable_sort(batches, std::greater(), [](const auto& batch) { return batch.size(); });
    return batches;
}

/// What the threads share.
struct Work {
    const std::vector<StabilityCase>& cases;
    const std::vector<StabilityPoint>& points;
    const std::vector<std::filesystem::path>& search_path;
    const std::function<void(const std::vector<StabilityRow>&, double)>& done;
    const std::vector<std::vector<size_t>> batches = batches_of(cases);
    std::mutex mutex;  ///< of all that follows
    size_t next_batch = 0, done_cases = 0;
    std::vector<std::vector<StabilityRow>> rows = std::vector<std::vector<StabilityRow>>(cases.size());
    std::exception_ptr failure;
    TruthStore truths;

    const std::vector<size_t>* take_batch() {
        const std::lock_guard lock(mutex);
        return failure || next_batch == batches.size() ? nullptr : &batches[next_batch++];
    }

    void finish(size_t index, std::vector<StabilityRow> finished) {
        const std::lock_guard lock(mutex);
        rows[index] = std::move(finished);
        done(rows[index], double(++done_cases) / double(cases.size()));
    }
};

std::vector<StabilityRow> rows_of(const StabilityCase& what, CaseJudge& judge,
                                  const std::vector<StabilityPoint>& points) {
    std::vector<StabilityRow> rows = {judge.path_tracer_row()};
    for (const StabilityPoint& point : points) {
        if (!what.only.empty() && !std::ranges::count(what.only, point.variant)) continue;
        rows.push_back(judge.row(point));
        rows.back().run.specular = {};
    }
    return rows;
}

void run_batch(Device& device, Work& work, const std::vector<size_t>& batch) {
    CaseDrawer drawer(device, work.search_path, work.truths);
    std::optional<CaseFrames> benign;
    std::map<std::string, BenignRun> benign_runs;
    for (const size_t i : batch) {
        const StabilityCase& what = work.cases[i];
        if (what.images) {
            std::vector<StabilityRow> rows;
            for (const Metric& metric : all_metrics()) rows.push_back(metric_row(what, metric));
            work.finish(i, std::move(rows));
            continue;
        }
        if (!benign) benign = drawer.draw(what.benign);
        CaseJudge judge(device, drawer, what, *benign, benign_runs);
        work.finish(i, rows_of(what, judge, work.points));
    }
}

}  // namespace

std::vector<StabilityCase> chosen_cases(const std::filesystem::path& table, const std::vector<std::string>& names) {
    return chosen(read_stability_cases(table), names, "case", names_of_case);
}

std::vector<StabilityPoint> chosen_points(const std::vector<std::string>& names) {
    return chosen(stability_points(), names, "technique", names_of_point);
}

std::vector<StabilityRow> run_stability(std::span<Device* const> devices, const std::filesystem::path& table,
                                        const StabilitySelection& selection,
                                        const std::vector<std::filesystem::path>& search_path,
                                        const std::function<void(const std::vector<StabilityRow>&, double)>& done) {
    const std::vector<StabilityCase> cases = chosen_cases(table, selection.cases);
    const std::vector<StabilityPoint> points = chosen_points(selection.variants);
    Work work{.cases = cases, .points = points, .search_path = search_path, .done = done};
    {
        std::vector<std::jthread> threads;
        for (Device* device : devices)
            threads.emplace_back([&work, device] {
                try {
                    while (const std::vector<size_t>* batch = work.take_batch()) run_batch(*device, work, *batch);
                } catch (...) {
                    const std::lock_guard lock(work.mutex);
                    if (!work.failure) work.failure = std::current_exception();
                }
            });
    }
    if (work.failure) std::rethrow_exception(work.failure);
    std::vector<StabilityRow> rows;
    for (std::vector<StabilityRow>& own : work.rows) std::ranges::move(own, std::back_inserter(rows));
    return rows;
}
