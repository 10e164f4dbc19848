#pragma once
#include "experiments/results/cells/cell.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

/// The finished cells of a results folder: cells/<name>.json. The name is the hash of all that the cell's numbers
/// depend on, so any number of processes can fill one folder, and a killed run continues where it stopped. Each file
/// holds a hash of its own content, and hashes of its images, so that damaged files are not used as results.
class CellStore {
public:
    /// `notice` gets a sentence for each cell that is there and cannot be used.
    CellStore(std::filesystem::path results, std::function<void(const std::string&)> notice)
        : results_(std::move(results)), notice_(std::move(notice)) {}

    /// Nothing if the cell has not been done, or if its file or one of its images is missing, damaged, or not what a
    /// cell has.
    std::optional<Cell> load(const std::string& name) const;
    /// As load(), but for a file that is whole and does not hold a cell, or images out of the folder, fails with Error.
    std::optional<Cell> load_strictly(const std::string& name) const;
    void save(const std::string& name, const Cell& cell) const;

    /// Names of all cells whose files are whole, of other versions of the study too; their images are not looked at.
    std::vector<std::string> names() const;
    /// The cell, even if its images are missing; nothing if its file is missing, damaged, or holds none.
    std::optional<Cell> read(const std::string& name) const;
    std::filesystem::path file(const std::string& name) const;

    /// The exclusive right to do a cell while others fill the same folder, released when the process ends. Where the
    /// file system has no locks, every process gets it: work may then be done twice, with the same result.
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
    std::unique_ptr<Claim> claim(const std::string& name, bool waits) const;

private:
    std::optional<Cell> parse(const std::string& name) const;
    std::optional<Cell> noting_mistakes(const std::function<std::optional<Cell>()>& read) const;

    std::filesystem::path results_;
    std::function<void(const std::string&)> notice_;
};
