#pragma once
#include "experiments/gpu_costs/chips/compiled_shader.h"
#include "experiments/results/cells/reference_noise.h"
#include "experiments/results/files/columns.h"
#include "metrics/seed_pairs.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// One row of results.csv; the columns are explained in experiments/docs/reference/result_columns.md.
struct ResultRow {
    std::string shot, scene, camera;
    std::string frame;  ///< frame number, or over_frames
    unsigned width = 0, height = 0;
    std::string technique, point;
    unsigned seed = 0;
    std::string target, metric, formula, mask;
    std::optional<double> value;  ///< none if not finite, for example the PSNR of equal images
    bool corrected = false;
    std::optional<double> uncorrected, low, high, floor;
    std::optional<double> lit_noise, lit_half_width;  ///< see LitNoise
    size_t pixels = 0, non_finite = 0, negative = 0;
    bool represents_shot = false;  ///< see mark_representative_rows(); false in cells
    NoiseGrowth growth = {};       ///< no column: Score::growth while frames are measured; empty in cells

    COLUMNS(ResultRow, shot, scene, camera, frame, width, height, technique, point, seed, target, metric, formula, mask,
            value, corrected, uncorrected, low, high, floor, lit_noise, lit_half_width, pixels, non_finite, negative,
            represents_shot)
};

/// One row of splits.csv: the bias and the variance of an error.
struct SplitRow {
    std::string shot, frame, technique, point, target, mask;
    unsigned seeds = 0;
    double mse = 0, bias_squared = 0, variance = 0;
    std::optional<double> variance_low, variance_high;
    size_t pixels = 0;
    std::optional<double> bias_squared_low, bias_squared_high;
    // Kept in cells, for effects, but not in splits.csv.
    std::vector<unsigned> seed_numbers;  ///< of `pairs`
    SeedPairs pairs;
    std::vector<float> reference_noise;  ///< noise in bias_squared, see ReferenceNoise::sums
    /// LitNoise of bias_squared, as in ResultRow; empty where `mse` is not measured.
    std::optional<double> lit_noise, lit_half_width;

    COLUMNS(SplitRow, shot, frame, technique, point, target, mask, seeds, mse, bias_squared, variance, variance_low,
            variance_high, pixels, bias_squared_low, bias_squared_high)
};

/// One row of times.csv.
struct TimeRow {
    std::string shot, technique, point;
    unsigned seed = 0;
    std::string stage;
    unsigned frame = 0;
    double milliseconds = 0;
    std::string clock;
    std::optional<double> foreign_load = {};  ///< see CpuTimes; none where the system does not report it
    bool disturbed = false;                   ///< other programs took too much CPU time meanwhile

    COLUMNS(TimeRow, shot, technique, point, seed, stage, frame, milliseconds, clock, foreign_load, disturbed)
};

/// One row of hits.csv: how the rays of one pass ended.
struct HitRow {
    std::string shot, frame, technique, point;
    std::string stage;  ///< the pass
    std::string mask;   ///< mask of the pixels where the rays start
    /// a verdict of judged_hits.h; "correct": the sum of right ones; "miss: " and a tracer's outcome of avoidable
    /// misses; "distance_error"; "fetches", "fetches: " and "median", "90 %" or "most"
    std::string quantity;
    unsigned seeds = 0;
    double rays = 0;  ///< mean over the seeds
    double value = 0;
    std::optional<double> low, high;  ///< over the seeds; none for a single seed

    COLUMNS(HitRow, shot, frame, technique, point, stage, mask, quantity, seeds, rays, value, low, high)
};

/// One row of costs.csv: what the passes of a stage do in the shot's last frame.
struct CostRow {
    std::string shot, technique, point, stage;
    std::string quantity;  ///< a name of cost_quantities, experiments/gpu_costs/pass_cost.h
    size_t value = 0;

    COLUMNS(CostRow, shot, technique, point, stage, quantity, value)
};

/// One row of compiled.csv: what a GPU's compiler made of one shader of a stage.
struct CompiledRow : CompilerNumbers {
    std::string shot, technique, point, stage;
    unsigned pipeline = 0;  ///< a stage may run several, for mips or materials
    std::string shader;     ///< "compute", "vertex" or "fragment"; "": refused
    std::string chip, driver;
    std::optional<double> waves, most_waves;  ///< see Occupancy
    std::string limit;                        ///< what limits `waves`, see Occupancy
    std::string refusal;                      ///< why there are no numbers

    static constexpr auto columns() {
        const auto numbers = std::apply(
            [](const auto&... number) {
                return std::tuple(Column{number.name, number.member}...);
            },
            compiler_numbers);
        return std::tuple_cat(MEMBER_COLUMNS(CompiledRow, shot, technique, point, stage, pipeline, shader, chip, driver,
                                             lanes, waves, most_waves, limit),
                              numbers, MEMBER_COLUMNS(CompiledRow, hash, refusal));
    }
};

/// One row of estimates.csv: a stage's estimated time on a chip in microseconds, see gpu_estimates.h. A row with a
/// refusal has no numbers.
struct EstimateRow {
    std::string shot, technique, point, stage;  ///< stage: also `total`
    std::string chip, driver, product;
    std::optional<double> microseconds, low, high;
    std::string bound;  ///< the part of the chip that takes longest, see ChipTime
    std::optional<double> vector, scalar, shared_memory, textures, targets, memory, latency, caches;
    std::optional<double> waves, active_lanes, unmatched, cut_lanes;
    std::string refusal;  ///< why there are no numbers

    COLUMNS(EstimateRow, shot, technique, point, stage, chip, driver, product, microseconds, low, high, bound, vector,
            scalar, shared_memory, textures, targets, memory, latency, caches, waves, active_lanes, unmatched,
            cut_lanes, refusal)
};

/// What was measured: the rows of a cell, or of all cells of a study in their order.
struct MeasuredRows {
    std::vector<ResultRow> results = {};
    std::vector<SplitRow> splits = {};
    std::vector<TimeRow> times = {};
    std::vector<HitRow> hits = {};
    std::vector<CostRow> costs = {};
    std::vector<CompiledRow> compiled = {};
    std::vector<EstimateRow> estimates = {};
    std::vector<ReferenceNoise> reference_noise = {};

    /// The lists of rows with columns, by their names in cell files.
    static constexpr auto lists() {
        return std::tuple_cat(std::tuple(Column{"rows", &MeasuredRows::results}),
                              MEMBER_COLUMNS(MeasuredRows, splits, times, hits, costs, compiled, estimates));
    }
};

/// Calls `use(list)` for each of MeasuredRows::lists().
template <class Use>
void for_each_list(Use use) {
    std::apply([&](const auto&... list) { (use(list), ...); }, MeasuredRows::lists());
}

/// The unit of work that is done once and kept: one point in one shot with all its seeds, the times of a shot, or its
/// references.
struct Cell : MeasuredRows {
    nlohmann::json images = nlohmann::json::array();  ///< entries of manifest.json's `images`
    nlohmann::json timing;                            ///< timing_entry(); null where nothing was timed
    std::vector<std::string> notes;                   ///< sentences for the manifest: what is unknown, and why
    std::string truth;                                ///< ShotTruth::content_hash() of the truth behind its numbers
    nlohmann::json shot;        ///< manifest entry of the shot with its references; null in other cells
    double seconds = 0;         ///< time to make the cell; for references including opening the shot
    nlohmann::json provenance;  ///< maker, place and time, see provenance.h
    std::string name;           ///< the cell's name in CellStore
};

void to_json(nlohmann::json& json, const Cell& cell);
/// Reads JSON that read_cell() has checked.
void from_json(const nlohmann::json& json, Cell& cell);
/// Reads what to_json() wrote. Fails with Error that names the member if one is missing, unknown, or of another type or
/// length. `where`: file and place, for the message.
Cell read_cell(const nlohmann::json& json, const std::string& where);
