#include "experiments/study/stability/stability.h"

#include "core/error.h"
#include "experiments/study/config/chosen.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/stability/amplification.h"
#include "metrics/metric.h"

#include <cmath>
#include <future>
#include <map>
#include <mutex>
#include <numeric>

namespace {

StabilityRow empty_row(const StabilityCase& what, const std::string& technique, const std::string& point = "default") {
    StabilityRow row;
    row.case_name = what.name, row.group = what.group, row.technique = technique, row.point = point;
    return row;
}

StabilityRow judged(StabilityRow row) {
    row.verdict = verdict_of(row);
    return row;
}

/// Means of eight blocks of the last three quarters of a long sequence: the last four against the first four.
void measure_drift(StabilityRow& row, const std::vector<double>& means) {
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
void measure_gain(StabilityRow& row, const std::vector<double>& means) {
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
    StabilityRow row = empty_row(what, "metrics", metric.name);
    try {
        const MetricImages& images = *what.images;
        const ImagePair pair = image_pair(ramp(images.size, images.reference), ramp(images.size, images.test),
                                          {.flip_exposures = FlipExposures{.start = 0, .stop = 0, .count = 1}});
        const double value = measure(metric, pair);
        if (std::isfinite(value))
            row.error = value;
        else
            row.refusal = "its value is no number: " + std::to_string(value);
    } catch (const Error& error) {
        row.refusal = error.what();
    }
    return judged(row);
}

std::vector<StabilityRow> metric_rows(const StabilityCase& what) {
    std::vector<StabilityRow> rows;
    for (const Metric& metric : all_metrics()) rows.push_back(metric_row(what, metric));
    return rows;
}

struct BenignRun {
    std::optional<double> error;
    double milliseconds = 0;
};

/// Of the truth, as relative_error() has errors: from the difference of its two halves. None where it is black.
std::optional<double> noise_of(const CaseFrames& frames) {
    if (!frames.reference) return std::nullopt;
    const ReferenceOutput& specular = frames.reference->specular;
    const std::optional<double> difference = relative_difference(frames, specular.half_a, specular.half_b);
    return difference ? std::optional(*difference / 4) : std::nullopt;
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
            smaller.shot.extent = *what.size_before;
            before_ = drawer.draw(smaller);
        }
        if (!what.is_perturbed) return;
        for (const Perturbation& p : perturbations())
            perturbed_.emplace_back(p, drawer.draw(what.scene, what.faults, p.apply));
    }

    StabilityRow row(const PointConfig& point) {
        StabilityRow row = empty_row(what_, point.technique, point.point);
        CaseResult run = run_case(device_, point, what_, frames_, {.is_scanned = true}, before_ ? &*before_ : nullptr);
        static_cast<CaseFindings&>(row) = run;
        row.stages = std::move(run.stages), row.zero_products = std::move(run.zero_products);
        if (!row.refusal.empty()) return judged(row);
        const BenignRun& benign = benign_run(point, stability_seed);
        set_errors(row, what_.has_truth() ? relative_error(frames_, run.specular) : std::nullopt, benign.error);
        if (is_near_worse(row, frames_.truth.pixel_count())) average_seeds(row, point);
        if (benign.milliseconds > 0) row.time_ratio = run.milliseconds / benign.milliseconds;
        measure_drift(row, run.means);
        if (what_.feeds_back) measure_gain(row, run.means);
        for (const auto& [perturbation, frames] : perturbed_)
            measure_amplification(row, perturbation, frames_, run, run_case(device_, point, what_, frames));
        return judged(row);
    }

    /// What the path tracer made of it; of a case that it is not asked about nothing. Where it must give the benign
    /// case's picture, that one is its truth; else its error is its own noise.
    std::optional<StabilityRow> path_tracer_row() const {
        if (!frames_.reference) return std::nullopt;
        StabilityRow row = empty_row(what_, "path_tracer");
        row.non_finite = frames_.reference->non_finite_samples;
        if (row.non_finite) row.first_non_finite = "samples";
        for (size_t i = 0; i < frames_.truth.pixel_count(); ++i) {
            const glm::vec3 c = frames_.truth.rgb(i);
            row.spread_pixels += !is_finite(c), row.negative += std::min({c.x, c.y, c.z}) < 0;
        }
        if (what_.is_truth_same)
            set_errors(row, relative_error(benign_, frames_.truth), 0.0);
        else
            set_errors(row, noise_of(frames_), noise_of(benign_));
        if (frames_.reference->seconds > 0 && benign_.reference->seconds > 0)
            row.time_ratio = frames_.reference->seconds / benign_.reference->seconds;
        return judged(row);
    }

private:
    /// Over so many seeds; a technique that draws no random number shows it by the second.
    void average_seeds(StabilityRow& row, const PointConfig& point) {
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
        set_errors(row, error / most, benign_error / most);
        row.seeds = most;
    }

    const BenignRun& benign_run(const PointConfig& point, unsigned seed) {
        const auto [entry, is_new] =
            benign_runs_.try_emplace(point.technique + ":" + point.point + " " + std::to_string(seed));
        if (is_new) {
            const CaseResult run = run_case(device_, point, {}, benign_, {.seed = seed});
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
    const double pixels = double(what.scene.shot.extent.x) * what.scene.shot.extent.y / (96 * 54);
    return double(what.scene.shot.frames.size()) * std::max(1.0, pixels) * (what.is_perturbed ? 4 : 1);
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

bool is_for(const StabilityCase& what, const PointConfig& point) {
    const std::vector<std::string> names = names_of_point(point);
    return what.only.empty() || std::ranges::find_first_of(names, what.only) != names.end();
}

/// What the threads share.
class Work {
public:
    using Done = std::function<void(const std::vector<StabilityRow>&, double)>;
    Work(const StabilitySelection& selection, const StabilityFolders& folders, const Done& done)
        : cases_(chosen_cases(selection)),
          points_(all_points(selection.techniques)),
          folders_(folders),
          done_(done),
          batches_(batches_of(cases_)),
          rows_(cases_.size()) {}

    /// Takes batches until none is left, or one has failed.
    void run(Device& device) {
        try {
            while (const std::vector<size_t>* batch = take_batch()) run_batch(device, *batch);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            next_batch_ = batches_.size();
            throw;
        }
    }

    /// In the order of the cases.
    std::vector<StabilityRow> rows() const {
        std::vector<StabilityRow> all;
        for (const std::vector<StabilityRow>& own : rows_) std::ranges::copy(own, std::back_inserter(all));
        return all;
    }

private:
    const std::vector<size_t>* take_batch() {
        const std::lock_guard lock(mutex_);
        return next_batch_ < batches_.size() ? &batches_[next_batch_++] : nullptr;
    }

    void run_batch(Device& device, const std::vector<size_t>& batch) {
        CaseDrawer drawer(device, folders_.search_path, folders_.cache, points_);
        std::optional<CaseFrames> benign;
        std::map<std::string, BenignRun> benign_runs;
        for (const size_t i : batch) {
            const StabilityCase& what = cases_[i];
            if (!what.images && !benign) benign = drawer.draw(what.benign);
            std::vector<StabilityRow> rows =
                what.images ? metric_rows(what) : rows_of(device, drawer, what, *benign, benign_runs);
            const std::lock_guard lock(mutex_);
            rows_[i] = std::move(rows);
            done_(rows_[i], double(++done_cases_) / double(cases_.size()));
        }
    }

    std::vector<StabilityRow> rows_of(Device& device, CaseDrawer& drawer, const StabilityCase& what,
                                      const CaseFrames& benign, std::map<std::string, BenignRun>& benign_runs) const {
        std::vector<StabilityRow> rows;
        const auto for_points = [&](const auto& row_of) {
            for (const PointConfig& point : points_)
                if (is_for(what, point)) rows.push_back(row_of(point));
        };
        try {
            CaseJudge judge(device, drawer, what, benign, benign_runs);
            if (std::optional<StabilityRow> row = judge.path_tracer_row()) rows.push_back(std::move(*row));
            for_points([&](const PointConfig& point) { return judge.row(point); });
        } catch (const MachineError& error) {  // the case could not even be drawn
            rows.clear();
            for_points([&](const PointConfig& point) {
                StabilityRow row = empty_row(what, point.technique, point.point);
                row.refusal = error.what();
                return judged(row);
            });
        }
        return rows;
    }

    const std::vector<StabilityCase> cases_;
    const std::vector<PointConfig> points_;
    const StabilityFolders& folders_;
    const Done& done_;
    const std::vector<std::vector<size_t>> batches_;
    std::mutex mutex_;  ///< of all that follows
    size_t next_batch_ = 0, done_cases_ = 0;
    std::vector<std::vector<StabilityRow>> rows_;
};

}  // namespace

std::vector<StabilityCase> chosen_cases(const StabilitySelection& selection) {
    return chosen(read_stability_cases(selection.table), selection.cases, "case", [](const StabilityCase& c) {
        return std::vector{c.name, c.family, c.group};
    });
}

std::vector<StabilityRow> run_stability(std::span<Device* const> devices, const StabilitySelection& selection,
                                        const StabilityFolders& folders,
                                        const std::function<void(const std::vector<StabilityRow>&, double)>& done) {
    Work work(selection, folders, done);
    std::vector<std::future<void>> workers;
    for (Device* device : devices)
        workers.push_back(std::async(std::launch::async, [&work, device] { work.run(*device); }));
    for (std::future<void>& worker : workers) worker.wait();
    for (std::future<void>& worker : workers) worker.get();
    return work.rows();
}
