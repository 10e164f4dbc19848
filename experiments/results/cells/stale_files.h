#pragma once
#include "experiments/results/cells/cell_store.h"

#include <set>

/// Files of earlier versions of a study in its folder: cells of other code, parameters or references, and images of
/// which no present cell knows.
struct StaleFiles {
    std::vector<std::string> cells;   ///< names
    std::vector<std::string> images;  ///< relative to the folder

    bool is_empty() const { return cells.empty() && images.empty(); }
};

/// Only what the folder's own index knows: whole cells, their images, and those that `before`, the manifest.json of the
/// run before, lists; never a file that lies there for another reason. `manifest` is that of now, with its images;
/// `used` are the names of its cells. They may be of use to another machine that fills the folder.
StaleFiles find_stale_files(const std::filesystem::path& results, const CellStore& cells,
                            const std::set<std::string>& used, const nlohmann::json& manifest,
                            const nlohmann::json& before);

/// Removes them, and folders of images that are empty then.
void remove_stale_files(const std::filesystem::path& results, const CellStore& cells, const StaleFiles& stale);
