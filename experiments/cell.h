#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// One row of results.csv; the columns are explained in experiments/RESULTS.md.
struct ResultRow {
    std::string shot, scene, camera;
    unsigned frame = 0, width = 0, height = 0;
    std::string variant, point;
    unsigned seed = 0;
    std::string target, metric, formula, mask;
    std::optional<double> value;  ///< none where it is not finite, e.g. the PSNR of equal images
    bool is_corrected = false;
    std::optional<double> uncorrected, low, high, floor;
    size_t pixels = 0, non_finite = 0, negative = 0;
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

/// What a run makes of one shot and variant point: the unit of work that is done once, kept, and never done again.
struct Cell {
    std::vector<ResultRow> rows;
    std::vector<TimeRow> times;
    nlohmann::json images = nlohmann::json::array();  ///< entries of manifest.json's `images`
};

/// The finished cells of a results folder: cells/<hash>.json. The name is the hash of all that the cell's numbers depend
/// on, so any number of processes can fill one folder, and a killed run continues where it stopped.
class CellStore {
public:
    explicit CellStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Nothing if the cell has not been done, or its file does not read back whole.
    std::optional<Cell> load(const std::string& hash) const;
    void save(const std::string& hash, const Cell& cell) const;

private:
    std::filesystem::path folder_;
};
