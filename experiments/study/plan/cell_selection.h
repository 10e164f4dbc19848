#pragma once
#include "experiments/study/plan/study_plan.h"

#include <functional>

/// The cells that a process does, of a study that several processes share.
class CellSelection {
public:
    /// Terms of different kinds narrow the selection; terms of one kind add up. Without terms all cells are selected.
    /// Fails with Error on any other term.
    ///
    /// - `references`, `renders`, `costs`, `times`: kinds of cells.
    /// - `shot=NAME`, `technique=NAME`: * stands for any text.
    /// - `shard=I/N`: the I-th (from 1) of N parts, drawn by the cells' names.
    /// - `cell=HASH`: the beginning of a cell's name.
    explicit CellSelection(const std::vector<std::string>& terms = {});

    bool is_all() const { return tests_.empty(); }
    bool is_shard() const;  ///< whether it is one of several parts; a part may be empty
    bool holds(const PlannedCell& cell) const;

private:
    using Test = std::function<bool(const PlannedCell&)>;
    /// by kind of term: one test of each kind must hold
    std::vector<std::pair<std::string, std::vector<Test>>> tests_;
};
