#pragma once
#include "experiments/reference_noise.h"
#include "metrics/seed_pairs.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// One row of results.csv; the columns are explained in experiments/RESULTS.md.
struct ResultRow {
    std::string shot, scene, camera;
    std::string frame;  ///< its number, or "all": over the frames of the shot
    unsigned width = 0, height = 0;
    std::string variant, point;
    unsigned seed = 0;
    std::string target, metric, formula, mask;
    std::optional<double> value;  ///< none where it is not finite, e.g. the PSNR of equal images
    bool is_corrected = false;
    std::optional<double> uncorrected, low, high, floor;
    std::optional<double> lit_noise, lit_half_width;  ///< see LitNoise
    size_t pixels = 0, non_finite = 0, negative = 0;
};

/// One row of splits.csv: what of an error is the same for all seeds, and what differs.
struct SplitRow {
    std::string shot, frame, variant, point, target, mask;
    unsigned seeds = 0;
    double mse = 0, bias_squared = 0, variance = 0;
    std::optional<double> variance_low, variance_high;
    size_t pixels = 0;
    std::optional<double> bias_squared_low, bias_squared_high;
    // Kept in cells, for effects, but not in splits.csv.
    std::vector<unsigned> seed_numbers;  ///< of `pairs`
    SeedPairs pairs;
    std::vector<float> reference_noise;  ///< of bias_squared, see ReferenceNoise::sums
};

/// One row of times.csv.
struct TimeRow {
    std::string shot, variant, point;
    unsigned seed = 0;
    std::string stage;
    unsigned frame = 0;
    double milliseconds = 0;
    std::string clock;
};

/// What a run makes of one shot and variant point with all its seeds: the unit of work that is done once, kept, and
/// never done again.
struct Cell {
    std::vector<ResultRow> rows;
    std::vector<SplitRow> splits;
    std::vector<ReferenceNoise> reference_noise;
    std::vector<TimeRow> times;
    nlohmann::json images = nlohmann::json::array();  ///< entries of manifest.json's `images`
    nlohmann::json timing;                            ///< as timing_entry() gives it; null where nothing was timed
    std::vector<std::string> notes;                   ///< sentences for the manifest: what could not be told, and why
};

/// The finished cells of a results folder: cells/<hash>.json. The name is the hash of all that the cell's numbers
/// depend on, so any number of processes can fill one folder, and a killed run continues where it stopped.
class CellStore {
public:
    explicit CellStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Nothing if the cell has not been done, or its file does not read back whole.
    std::optional<Cell> load(const std::string& hash) const;
    void save(const std::string& hash, const Cell& cell) const;

    /// The right to do a cell while others fill the same folder. The system takes it back when the process ends,
    /// however it ends. Where the file system knows no locks, everyone has it: then work may be done twice, with the
    /// same result.
    class Claim {
    public:
        Claim(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
        ~Claim();
        Claim(const Claim&) = delete;
        Claim& operator=(const Claim&) = delete;

    private:
        std::filesystem::path file_;
        int descriptor_;
    };
    /// Nothing if another process has it, unless `waits`. Load again once it is given: the other may have finished.
    std::unique_ptr<Claim> claim(const std::string& hash, bool waits) const;

private:
    std::filesystem::path folder_;
};
