#pragma once
#include "core/gpu/device.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/study/config/config.h"
#include "experiments/study/measuring/costs/compiled_shaders.h"

#include <string>
#include <vector>

/// What a cell holds. `references`: the truth of a shot and what is said of it; `renders`: a point with all its seeds;
/// `costs`: what its passes do; `times`: those of all points of a shot.
enum class CellKind { references, renders, costs, times };
const std::vector<std::string>& cell_kind_names();  ///< in the order of CellKind
const std::string& name_of(CellKind kind);

/// A cell before it is made: its name is the hash of all that its numbers depend on but the truth's pixels, so that it
/// is known before any work starts. What the pixels were is kept in the cell (Cell::truth).
struct PlannedCell {
    CellKind kind;
    std::string name;                        ///< as CellStore knows it
    std::string what;                        ///< "<shot>: <technique> <point>", "<shot>: references", "<shot>: times"
    std::string shot;                        ///< its name
    const PointConfig* technique = nullptr;  ///< of renders and costs
    double units = 1;                        ///< of its kind's work: references, frames x seeds, shots
    size_t pixels = 0;                       ///< of a frame
};

struct PlannedShot {
    ShotConfig config;
    std::string name;
    nlohmann::json entry;                     ///< of the manifest, as far as it is known before anything is rendered
    std::vector<PlannedCell> cells;           ///< the references first, the times last
    std::vector<std::string> scene_warnings;  ///< with its name, but those of shots before
};

/// All cells of a study, in the order in which they are done.
struct StudyPlan {
    std::vector<PlannedShot> shots;
    std::vector<nlohmann::json> skipped;  ///< pairs of shot and point that have no cell: the manifest's entries
    GpuCompilers compilers;               ///< whose versions are part of the names of costs cells
    size_t cell_count() const;
};

/// Loads each shot once. Fails with Error where a scene or camera is unknown, or where two shots could not be told
/// apart in the results. `config` must outlive the plan. `sources`: of ssrlab, on which cells' names depend.
StudyPlan plan_study(const Config& config, const DeviceInfo& device,
                     const std::vector<std::filesystem::path>& search_path, bool keep_all,
                     std::vector<SourceFile> sources = present_sources());
