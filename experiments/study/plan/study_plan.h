#pragma once
#include "core/gpu/device.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/study/config/config.h"
#include "experiments/study/measuring/costs/compiled_shaders.h"

#include <string>
#include <vector>

/// Kinds of cells. `references`: a shot's truth and its entry of the manifest; `renders`: a point with all its seeds;
/// `costs`: what a point's passes do; `times`: times of all points of a shot.
enum class CellKind { references, renders, costs, times };
const std::vector<std::string>& cell_kind_names();  ///< in the order of CellKind
const std::string& name_of(CellKind kind);

/// A cell before it is made. Its name is the hash of all that its numbers depend on except the truth's pixels, so it is
/// known before any work starts. A finished cell keeps the hash of those pixels (Cell::truth).
struct PlannedCell {
    CellKind kind;
    std::string name;                        ///< the cell's name in CellStore
    std::string what;                        ///< "<shot>: <technique> <point>", "<shot>: references", "<shot>: times"
    std::string shot;                        ///< the shot's name
    const PointConfig* technique = nullptr;  ///< of renders and costs
    double units = 1;                        ///< amount of work by kind: references, frames x seeds, shots
    size_t pixels = 0;                       ///< pixels of a frame
};

struct PlannedShot {
    ShotConfig config;
    std::string name;
    nlohmann::json entry;                     ///< manifest entry, as far as it is known before rendering
    std::vector<PlannedCell> cells;           ///< the references first, the times last
    std::vector<std::string> scene_warnings;  ///< with the scene's name; without those of earlier shots
};

/// All cells of a study, in the order in which they are done.
struct StudyPlan {
    std::vector<PlannedShot> shots;
    std::vector<nlohmann::json> skipped;  ///< manifest entries of pairs of shot and point without a cell
    GpuCompilers compilers;               ///< their versions are part of the names of costs cells
    size_t cell_count() const;
};

/// Plans the cells of a study; loads each shot once. `sources`: ssrlab's, on which names of cells depend. `config` must
/// outlive the plan. Fails with Error where a scene or camera is unknown, or where results could not tell two shots
/// apart.
StudyPlan plan_study(const Config& config, const DeviceInfo& device,
                     const std::vector<std::filesystem::path>& search_path, bool keep_all,
                     std::vector<SourceFile> sources = present_sources());
