#pragma once
#include "experiments/study/plan/study_plan.h"

#include <functional>

/// Which cells a process does, of a study that several share.
class CellSelection {
public:
    /// Terms, each of which narrows what the ones before left, but terms of one kind add up:
    /// `references`, `renders`, `costs`, `times`; `shot=NAME` and `technique=NAME`, where * stands for any text;
    /// `shard=I/N`, the I-th (from 1) of N parts, drawn by the cells' names; `cell=HASH`, the beginning of a name.
    /// None: all cells. Fails with Error on any other term.
    explicit CellSelection(const std::vector<std::string>& terms = {});

    bool is_all() const { return tests_.empty(); }
    bool is_shard() const;  ///< one of several parts, which may come out empty
    bool holds(const PlannedCell& cell) const;

private:
    using Test = std::function<bool(const PlannedCell&)>;
    std::vector<std::pair<std::string, std::vector<Test>>> tests_;  ///< by kind of term: one of each must hold
};
