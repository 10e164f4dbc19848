#pragma once
#include "experiments/results/cells/cell.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

/// The finished cells of a results folder: cells/<name>.json. A name is the hash of all that the cell's numbers depend
/// on, so any number of processes can fill one folder, and a killed run continues where it stopped. Each file holds
/// hashes of its content and of its images, so that damaged files are not used as results.
class CellStore {
public:
    /// `notice` gets a sentence for each unusable cell.
    CellStore(std::filesystem::path results, std::function<void(const std::string&)> notice)
        : results_(std::move(results)), notice_(std::move(notice)) {}

    /// The cell; nullopt if it is not done, or if its file or an image is missing, damaged or invalid.
    std::optional<Cell> load(const std::string& name) const;
    /// load() that fails with Error for an undamaged file that is not a valid cell or names images outside the folder.
    std::optional<Cell> load_strictly(const std::string& name) const;
    void save(const std::string& name, const Cell& cell) const;

    /// Names of all files that may be cells, including those of other versions of the study, in order. No file is read.
    std::vector<std::string> names() const;
    /// The cell, even if images are missing; nullopt if its file is missing, damaged or invalid.
    std::optional<Cell> read(const std::string& name) const;
    /// Whether all images of a cell of this folder are those that it made. Fails with Error if one is outside the
    /// folder.
    bool has_images(const Cell& cell) const;
    std::filesystem::path file(const std::string& name) const;

    /// The exclusive right to do a cell while other processes fill the same folder; released when the process ends.
    /// Where the file system has no locks, every process gets it: work may be done twice, with the same result.
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
    /// Claims a cell; null if another process has it, unless `waits`. Load the cell again afterwards: the other process
    /// may have finished it.
    std::unique_ptr<Claim> claim(const std::string& name, bool waits) const;

private:
    std::optional<Cell> parse(const std::string& name) const;
    std::optional<Cell> noting_mistakes(const std::function<std::optional<Cell>()>& read) const;

    std::filesystem::path results_;
    std::function<void(const std::string&)> notice_;
};
