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

/// Of the truth, as relative_error() has errors: from the difference of its two halves. None where it is black.
std::optional<double> noise_of(const CaseFrames& frames) {
    if (!frames.reference) return std::nullopt;
    const ReferenceOutput& specular = frames.reference->specular;
    double noise = 0, truth = 0;
    for (size_t i = 0; i < frames.truth.pixel_count(); ++i) {
        if (!frames.is_judged[i]) continue;
        const glm::dvec3 t(frames.truth.rgb(i)),
            difference = glm::dvec3(specular.half_a.rgb(i)) - glm::dvec3(specular.half_b.rgb(i));
        noise += glm::dot(difference, difference) / 4, truth += glm::dot(t, t);
    }
    if (truth == 0) return std::nullopt;
    return noise / truth;
}

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
        row.run = run_case(device_, point, what_, frames_, {.is_scanned = true}, before_ ? &*before_ : nullptr);
        if (row.run.refusal.empty()) {
            if (what_.has_truth()) row.error = relative_error(frames_, row.run.specular);
            const BenignRun& benign = benign_run(point, 1);
            row.benign_error = benign.error;
            if (is_near_worse(row, frames_.truth.pixel_count())) average_seeds(row, point);
            if (benign.milliseconds > 0) row.time_ratio = row.run.milliseconds / benign.milliseconds;
            measure_drift(row);
            if (what_.feeds_back) measure_gain(row);
            for (const auto& [perturbation, frames] : perturbed_)
                row.amplifications.push_back(
                    amplification(perturbation, frames_, row.run, run_case(device_, point, what_, frames)));
        }
        row.verdict = verdict_of(row);
        return row;
    }

    /// What the path tracer made of it; of a case that it is not asked about nothing. Where it must give the benign
    /// case's picture, that one is its truth; else its error is its own noise.
    std::optional<StabilityRow> path_tracer_row() const {
        if (!frames_.reference) return std::nullopt;
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
        } else {
            row.error = noise_of(frames_), row.benign_error = noise_of(benign_);
        }
        if (frames_.reference->seconds > 0 && benign_.reference->seconds > 0)
            row.time_ratio = frames_.reference->seconds / benign_.reference->seconds;
        row.verdict = verdict_of(row);
        return row;
    }

private:
    /// Over so many seeds; a technique that draws no random number shows it by the second.
    void average_seeds(StabilityRow& row, const StabilityPoint& point) {
        const unsigned most = frames_.truth.pixel_count() < 1000 ? 9 : 3;
        double error = *row.error, benign_error = *row.benign_error;
        for (unsigned seed = 2; seed <= most; ++seed) {
            const CaseResult run =
                run_case(device_, point, what_, frames_, {.seed = seed}, before_ ? &*before_ : nullptr);
            const std::optional<double> own = relative_error(frames_, run.specular);
            const std::optional<double> own_benign = benign_run(point, seed).error;
            if (!own || !own_benign || (*own == *row.error && *own_benign == *row.benign_error)) return;
            error += *own, benign_error += *own_benign;
        }
        row.error = error / most, row.benign_error = benign_error / most, row.seeds = most;
    }

    const BenignRun& benign_run(const StabilityPoint& point, unsigned seed) {
        const auto [entry, is_new] =
            benign_runs_.try_emplace(point.variant + ":" + point.label() + " " + std::to_string(seed));
        if (is_new) {
            const StabilityCase plain{.scene = what_.benign};
            const CaseResult run = run_case(device_, point, plain, benign_, {.seed = seed});
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

/// In frames of 96x54: what a smaller one takes is what its passes take, whatever their size.
double work_in(const StabilityCase& what) {
    const double pixels = double(what.scene.size.x) * what.scene.size.y / (96 * 54);
    return double(what.scene.poses.size()) * std::max(1.0, pixels) * (what.is_perturbed ? 4 : 1);
}

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
    const auto work = [&](const std::vector<size_t>& batch) {
        return std::accumulate(batch.begin(), batch.end(), 0.0,
                               [&](double sum, size_t i) { return sum + work_in(cases[i]); });
    };
    std::ranges::stable_sort(batches, std::greater(), work);
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

bool is_for(const StabilityCase& what, const StabilityPoint& point) {
    return what.only.empty() || std::ranges::any_of(names_of_point(point), [&](const std::string& name) {
               return std::ranges::count(what.only, name) > 0;
           });
}

std::vector<StabilityRow> rows_of(const StabilityCase& what, CaseJudge& judge,
                                  const std::vector<StabilityPoint>& points) {
    std::vector<StabilityRow> rows;
    if (std::optional<StabilityRow> row = judge.path_tracer_row()) rows.push_back(std::move(*row));
    for (const StabilityPoint& point : points) {
        if (!is_for(what, point)) continue;
        rows.push_back(judge.row(point));
        rows.back().run.specular = {};
    }
    return rows;
}

/// Of a case that could not even be drawn.
std::vector<StabilityRow> refused_rows(const StabilityCase& what, const std::vector<StabilityPoint>& points,
                                       const std::string& refusal) {
    std::vector<StabilityRow> rows;
    for (const StabilityPoint& point : points) {
        if (!is_for(what, point)) continue;
        StabilityRow row{.case_name = what.name, .group = what.group, .variant = point.variant, .point = point.label()};
        row.run.refusal = refusal, row.verdict = verdict_of(row);
        rows.push_back(std::move(row));
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
        std::vector<StabilityRow> rows;
        try {
            CaseJudge judge(device, drawer, what, *benign, benign_runs);
            rows = rows_of(what, judge, work.points);
        } catch (const MachineError& error) {
            rows = refused_rows(what, work.points, error.what());
        }
        work.finish(i, std::move(rows));
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
