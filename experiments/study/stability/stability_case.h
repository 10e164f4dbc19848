#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/json.h"
#include "experiments/results/stability/stability_rows.h"
#include "experiments/study/config/config.h"

/// A shot with the changes of a case. Members have the names of the keys of cases.json, which README.md explains.
struct CaseScene {
    /// Frames are rendered in this order, which need not ascend.
    ShotConfig shot{.extent = {96, 54}, .frames = {0, 0, 0}};
    std::optional<float> near, far;  ///< m
    glm::vec3 scale{1.0f};           ///< of all geometry; a single number in the file also scales camera and lights
    bool scales_all = false;
    glm::vec3 instance_scale{1.0f};  ///< of each instance; meshes are scaled by the inverse
    std::optional<float> roughness;  ///< perceptual, of every surface
    float radiance = 1.0f;           ///< factor of all emitted light
    nlohmann::json view;             ///< an entry of a scene.json's `cameras` that replaces `camera`; null: none
    nlohmann::json quads;            ///< added surfaces; null: none
    std::string where;               ///< file and place, for messages
};

/// The images that faults may change, by name; is_sound() looks at the same images.
const std::vector<std::pair<std::string, HostImage HostGBuffer::*>>& input_images();

/// A fault in the G-buffer's values, as another engine's capture may have.
struct InputFault {
    HostImage HostGBuffer::*image = nullptr;
    std::vector<float> value;      ///< one for all channels, or one for each
    bool is_factor = false;        ///< `value` multiplies the pixel's value; else replaces it
    std::string where;             ///< "pixel": the one at `at`; "all"; "every_other": row and column
    glm::vec2 at{0.5f, 0.75f};     ///< share of the picture from the upper left; default: on most scenes' floor
    std::optional<unsigned> step;  ///< the only rendered frame with the fault; none: all frames
};

/// Two pictures for the metrics instead of a scene: ramps from left to right, in all channels.
struct MetricImages {
    glm::uvec2 size{32, 32};
    glm::vec2 reference{0.0f}, test{0.0f};  ///< at the left and at the right
};

/// One line of the table.
struct StabilityCase : StabilityCaseName {
    CaseScene scene, benign;  ///< `benign`: the case that error and time are compared with
    std::string benign_key;   ///< equal for cases with equal `benign`
    std::vector<InputFault> faults;
    std::optional<glm::uvec2> size_before;  ///< size at which the technique rendered earlier frames
    /// Each frame's lit colour is the composited image of the frame before: mirrors in mirrors.
    bool feeds_back = false;
    bool is_perturbed = false;           ///< whether amplification is measured
    bool is_truth_same = false;          ///< whether the path tracer must give the benign case's image
    std::vector<std::string> only;       ///< techniques, or NAME:PRESET; empty: all
    std::optional<MetricImages> images;  ///< if set, only the metrics are tested, and `scene` is unused

    bool has_truth() const;  ///< whether the path tracer shows the same as the G-buffer with its faults
};

/// Reads a table of cases. Every combination of the values of a case's `each` is a separate case, named by the values.
/// Fails with Error on unknown keys and names.
std::vector<StabilityCase> read_stability_cases(const std::filesystem::path& file);

/// The table that comes with ssrlab.
std::filesystem::path stability_case_table();
