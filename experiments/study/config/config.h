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
    GltfChoices choices;               ///< choices of the command line, which override the scene's own
    std::string camera;                ///< "": the scene's first camera
    bool has_planes_of_scene = false;  ///< near and far planes come from derive_planes(), not from the camera
    glm::uvec2 extent{480, 270};
    std::vector<unsigned> frames{0};  ///< poses, ascending: rendered in this order, so histories work
    unsigned warm_up = 0;             ///< rendered frames of the first pose, not measured, before the shot is played
    unsigned repeat = 1;  ///< renderings of the last pose in a row; flicker is measured if the shot has one pose
    std::optional<unsigned> change;   ///< the first of `frames` after the scene's step; ghosting is measured from here
    bool measures_last_only = false;  ///< true: only the last frame is measured; false: every frame ...
    unsigned measure_from = 0;        ///< ... from this one on

    std::filesystem::path gbuffer;    ///< a folder with gbuffer.exr and camera.json, instead of a scene
    std::filesystem::path reference;  ///< reference of `gbuffer`, from `ssrlab reference`; empty: nothing is measured
    size_t reference_pattern_at = 0;  ///< length of the config's folder within `reference`

    bool direct_lit = false;           ///< SSR reads rasterised direct light, not the path-traced lit colour
    bool lit_has_environment = false;  ///< the rasterised light includes the environment's specular reflections
    bool has_probe = false;  ///< reflections fall back to a probe (reflection_probe.h), else to the environment
    DepthFormat depth_format = DepthFormat::d32f;
    DepthDirection depth_direction = DepthDirection::standard;
    unsigned normal_bits = 0;  ///< RasterizerOptions::normal_bits
    GBufferFormats gbuffer_formats = GBufferFormats::exact;
    std::string name_suffix;  ///< settings above that differ from the study's own: ".d16.reversed"

    std::string label, group;  ///< names of the shot and of its group in tables; "": by its name, no group

    /// Where the config names scene and camera: "study.json:3:6: shots[0]".
    struct Places {
        std::string scene, camera;
        bool operator==(const Places&) const = default;
    };
    Places named_at;

    /// Whether both shots are equal except for label, group and places.
    bool is_played_like(const ShotConfig& other) const {
        ShotConfig named_alike = other;
        named_alike.label = label, named_alike.group = group, named_alike.named_at = named_at;
        return *this == named_alike;
    }
    bool operator==(const ShotConfig&) const = default;
};

/// Limit of shots in a study.
inline constexpr size_t most_shots = 10000;

/// A condition under which a point is left out: `only_if` or `skip_if` of its entry (conditions.h).
struct PointCondition {
    bool skips = false;    ///< true (skip_if): leave out where all tests hold; false (only_if): where any fails
    nlohmann::json tests;  ///< conditions by name
};

struct ExternalImages;

/// A technique and one point of its parameters.
struct PointConfig {
    std::string technique;
    std::string preset;         ///< "": none
    nlohmann::json parameters;  ///< values that differ from the preset's, or from the defaults without a preset
    nlohmann::json swept;       ///< those of `parameters` that a design set (design.h); else an empty object
    std::string point;          ///< the point's name in results (point_name.h)
    std::string label, group;   ///< names of the point and of its group in tables; "": by its name, no group
    std::vector<unsigned> seeds;
    bool depends_on_seed = true;  ///< false: all seeds give the same result, see Technique::depends_on_seed()
    bool is_baseline = false;     ///< all other points are compared with this one, over common seeds
    nlohmann::json against;       ///< null, or the values in which alone the point's partner differs
    std::string against_point;    ///< the partner's name, of the same technique; "": this is a partner
    bool is_timed = true;
    std::vector<PointCondition> conditions;          ///< on shots
    std::shared_ptr<const ExternalImages> external;  ///< another program's frames; nullptr: ssrlab renders the point
    std::string how_it_ended;  ///< EndedPoint::how, which keeps the point from all shots; "": it ended nothing
};

struct TimingConfig {
    unsigned frames = 15;  ///< timed frames of each technique, after the warm-up; 0: no timing
    unsigned warm_up = 3;
    float most_share = 1.0f / 3;  ///< most time that timing may take, as a share of the time of the shot's other cells
    bool has_copies = true;  ///< copies of points are timed: they show the noise of times and what skipped work saves
};

/// Which rays of a technique are compared with what they truly hit.
struct JudgedRays {
    unsigned every = 1;        ///< every n-th pixel along each axis
    unsigned seeds = 1000000;  ///< at most so many of a point's first seeds
};

/// Number of seeds of a point whose result depends on seeds, if the config names none. Fewer seeds give wide intervals,
/// and intervals of skewed errors that are too narrow.
inline constexpr unsigned default_seeds = 8;

/// The frames whose images are kept.
enum class KeptImages {
    none,
    last,      ///< each shot's last frame
    measured,  ///< every measured frame
    played     ///< each shot's last frame; of earlier frames the reflections alone, for a viewer that plays them
};

/// A study: everything that `ssrlab run` reads.
struct Config {
    std::filesystem::path file;  ///< the config's file
    std::string title;
    std::vector<ShotConfig> shots;
    std::vector<PointConfig> techniques;
    ReferenceSettings reference;
    bool measures_lit_noise = true;  ///< see LitNoise
    bool filters_lit = false;        ///< filter_lit() is applied to the lit colour that techniques read
    bool has_reference = true;       ///< false: no error is measured; frames are timed and rays judged
    CompositeFormula composite = CompositeFormula::split_sum;
    TimingConfig timing;
    std::optional<JudgedRays> hits;          ///< none: no ray is judged
    bool counts_costs = false;               ///< see count_costs()
    std::vector<std::string> gpu_compilers;  ///< chips, see compiled_shaders.h
    bool has_cost_cells() const { return counts_costs || !gpu_compilers.empty(); }
    KeptImages kept_images = KeptImages::last;
    std::vector<std::string> metrics;  ///< names of metrics/metric.h
    std::vector<std::string> masks;
    std::vector<std::string> targets;
    PrimaryComparisons primary;
    std::vector<std::string> frame_metrics;    ///< of frames before the last, and of the mean; may be empty
    std::vector<std::string> frame_masks;      ///< of frames before the last; the mean has all masks
    float reflective_max_roughness = 0.6f;     ///< the mask `reflective`: perceptual roughness at most this ...
    float reflective_min_reflectance = 0.02f;  ///< ... and F0 A + F90 B (largest channel) at least this
    bool is_tuned = false;                     ///< the config has the key 'tune': it is for `ssrlab tune`, not `run`
    nlohmann::json source;                     ///< the config as read, with what it `extends`; for the manifest
};

/// The name of a point for readers: its label, or else technique and point.
std::string display_name(const Config& config, const std::string& technique, const std::string& point);

/// Whether the reference of each shot's last frame must have a truth ladder.
inline bool needs_ladder(const Config& config) { return std::ranges::any_of(config.targets, is_ladder_rung); }

/// Reads and checks a config (keys: experiments/docs/reference/study_keys.md). Every mistake is an Error that names
/// file and key. Techniques, parameters, metrics and masks are checked here, before any work starts; scenes only later.
Config read_config(const std::filesystem::path& file);

/// JSON Schema (2020-12) of a study's config. With the name of a technique: the schema of that technique's
/// `parameters`.
nlohmann::json config_schema(const std::string& technique);

/// The keys of each kind of object in a config, as described() has them: study, scene, capture, shot and so on.
nlohmann::json key_descriptions();
