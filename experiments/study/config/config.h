#pragma once
#include "core/gbuffer/composite.h"
#include "core/gbuffer/gbuffer_formats.h"
#include "core/scene/camera.h"
#include "core/scene/gltf/load_gltf.h"
#include "experiments/results/files/comparisons.h"
#include "experiments/results/files/targets.h"
#include "groundtruth/reference/reference.h"

#include <algorithm>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

/// One camera of one scene at one resolution, over some frames; or one G-buffer from files.
struct ShotConfig {
    std::string scene;                 ///< a scene's name, or a path to a .json/.gltf/.glb
    GltfChoices choices;               ///< of the command line, in place of the scene's own
    std::string camera;                ///< "": the scene's first
    bool has_planes_of_scene = false;  ///< derive_planes() in place of the camera's own
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};  ///< poses, ascending: rendered in this order, so histories work
    unsigned warm_up = 0;             ///< frames at the first pose before it is played: rendered, not measured
    unsigned repeat = 1;  ///< how often the last pose is rendered in a row; a shot of one pose has its flicker measured
    std::optional<unsigned> change;   ///< the first of `frames` after the scene's step: how long it ghosts is measured
    bool measures_last_only = false;  ///< else every one of `frames` is measured ...
    unsigned measure_from = 0;        ///< ... that is not before this one

    std::filesystem::path gbuffer;  ///< in place of a scene: a folder with gbuffer.exr and camera.json
    std::filesystem::path
        reference;  ///< of that G-buffer: what `ssrlab reference` wrote; without one nothing is measured
    size_t reference_pattern_at = 0;  ///< where in its text what the config says begins, behind the config's folder

    bool direct_lit = false;           ///< SSR reads rasterised direct light in place of the path-traced lit colour
    bool lit_has_environment = false;  ///< that image also holds the environment's specular reflections
    bool has_probe = false;  ///< reflections fall back to a probe (reflection_probe.h), else to the environment
    DepthFormat depth_format = DepthFormat::d32f;
    DepthDirection depth_direction = DepthDirection::standard;
    unsigned normal_bits = 0;  ///< RasterizerOptions::normal_bits
    GBufferFormats gbuffer_formats = GBufferFormats::exact;
    std::string name_suffix;  ///< of these seven, those that are not the study's own: ".d16.reversed"

    std::string label, group;  ///< how tables and figures show it, and what it belongs to; "": its name, nothing

    /// But for label and group.
    bool is_played_like(const ShotConfig& other) const {
        ShotConfig named_alike = other;
        named_alike.label = label, named_alike.group = group;
        return *this == named_alike;
    }
    bool operator==(const ShotConfig&) const = default;
};

/// More shots than anyone can run or look at.
inline constexpr size_t most_shots = 10000;

/// Where a point is left out: `only_if` and `skip_if` of its entry (conditions.h).
struct PointCondition {
    bool skips = false;    ///< skip_if: the point is left out where all tests hold; else where one does not
    nlohmann::json tests;  ///< name to condition
};

struct ExternalImages;

/// A technique and one point of its parameters.
struct PointConfig {
    std::string technique;
    std::string preset;         ///< "": none
    nlohmann::json parameters;  ///< values that differ from the preset's or default ones
    nlohmann::json swept;       ///< those of them that a design gave it (design.h); an empty object if it has none
    std::string point;          ///< its name in results (point_name.h)
    std::string label, group;   ///< how tables and figures show it, and what it belongs to; "": its name, nothing
    std::vector<unsigned> seeds;
    bool depends_on_seed = true;  ///< else all seeds give the same, see Technique::depends_on_seed()
    bool is_baseline = false;     ///< all other points are compared with it, over the seeds that both have
    nlohmann::json against;  ///< parameter values, or null: it is compared with the point that differs in these alone,
    std::string against_point;  ///< of the same technique; "" for that point itself
    bool is_timed = true;
    std::vector<PointCondition> conditions;          ///< on shots
    std::shared_ptr<const ExternalImages> external;  ///< whose frames it is; nullptr: ssrlab renders it
};

struct TimingConfig {
    unsigned frames = 15;  ///< measured per technique, after the warm-up; 0: no timing
    unsigned warm_up = 3;
    float most_share = 1.0f / 3;  ///< of what a shot's other cells took: what its times may take
    bool has_copies = true;       ///< of each point, which give the noise of times and what skipped work saves
};

/// Which rays of a technique are compared with what they truly meet.
struct JudgedRays {
    unsigned every = 1;        ///< of the pixels along each axis
    unsigned seeds = 1000000;  ///< the first of a point's seeds, at most
};

/// Seeds of a point whose result depends on them, if the config names none: few seeds give wide intervals, and those of
/// fewer skewed errors do not cover.
inline constexpr unsigned default_seeds = 8;

/// Of which frames images are kept.
enum class KeptImages {
    none,
    last,      ///< of each shot's last
    measured,  ///< of every measured one
    played     ///< of each shot's last, and of those before it the reflections alone, which a viewer plays
};

/// A study: everything that `ssrlab run` reads.
struct Config {
    std::filesystem::path file;  ///< what it was read from
    std::string title;
    std::vector<ShotConfig> shots;
    std::vector<PointConfig> techniques;
    ReferenceSettings reference;
    bool measures_lit_noise = true;  ///< see LitNoise
    bool filters_lit = false;        ///< what techniques read, see filter_lit()
    bool has_reference = true;       ///< else no error is measured: frames are timed and rays judged
    CompositeFormula composite = CompositeFormula::split_sum;
    TimingConfig timing;
    std::optional<JudgedRays> hits;          ///< none: no ray is judged
    bool counts_costs = false;               ///< what each stage does, see count_costs()
    std::vector<std::string> gpu_compilers;  ///< chips, see compiled_shaders.h
    bool has_cost_cells() const { return counts_costs || !gpu_compilers.empty(); }
    KeptImages kept_images = KeptImages::last;
    std::vector<std::string> metrics;  ///< names of metrics/metric.h
    std::vector<std::string> masks;
    std::vector<std::string> targets;
    PrimaryComparisons primary;
    std::vector<std::string> frame_metrics;    ///< of all measured frames but the last, and of their mean; may be empty
    std::vector<std::string> frame_masks;      ///< of each of those frames; their mean has all masks
    float reflective_max_roughness = 0.6f;     ///< the mask `reflective`: perceptual roughness at most this ...
    float reflective_min_reflectance = 0.02f;  ///< ... and F0 A + F90 B (largest channel) at least this
    bool is_tuned = false;                     ///< has a 'tune': for `ssrlab tune`, not `run`
    nlohmann::json source;                     ///< as read, with what it `extends`, for the manifest
};

/// A point as people read it: its label, or else the technique and the point's name.
std::string display_name(const Config& config, const std::string& technique, const std::string& point);

/// Whether the reference of each shot's last frame must have a truth ladder.
inline bool needs_ladder(const Config& config) { return std::ranges::any_of(config.targets, is_ladder_rung); }

/// Reads and checks a config; its keys are in experiments/README.md. Every mistake is an Error that names file and key.
/// Scenes are only looked up later; techniques, parameters, metrics and masks are checked here, before any work starts.
Config read_config(const std::filesystem::path& file);

/// JSON Schema (2020-12) of a study's config; with the name of a technique, of that technique's `parameters` alone.
nlohmann::json config_schema(const std::string& technique);

/// The text with the tables of a config's keys between its lines `<!-- keys of study -->` (scene, capture, shot,
/// technique, table, tune) and `<!-- end of keys -->`. Fails where one of them is missing.
std::string with_key_tables(const std::string& markdown);
