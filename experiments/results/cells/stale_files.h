#pragma once
#include "experiments/results/cells/cell_store.h"

#include <set>

/// Files of earlier versions of a study in its folder: cells of other code, parameters or references, and images that
/// no present cell lists.
struct StaleFiles {
    std::vector<std::string> cells;   ///< names
    std::vector<std::string> images;  ///< relative to the folder

    bool is_empty() const { return cells.empty() && images.empty(); }
};

/// Finds stale files among those that ssrlab wrote: undamaged cells, their images, and images that `before` lists;
/// never another file in the folder. `before`: manifest.json of the previous run. `manifest`: the present one, with its
/// images. `used`: names of its cells. Another machine that fills the folder may still use stale files.
StaleFiles find_stale_files(const std::filesystem::path& results, const CellStore& cells,
                            const std::set<std::string>& used, const nlohmann::json& manifest,
                            const nlohmann::json& before);

/// Removes the stale files, and folders of images that become empty.
void remove_stale_files(const std::filesystem::path& results, const CellStore& cells, const StaleFiles& stale);
