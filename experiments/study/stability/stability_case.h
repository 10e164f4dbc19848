#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/json.h"
#include "experiments/results/stability/stability_rows.h"
#include "experiments/study/config/config.h"

/// What a case draws: a shot, changed. The keys of cases.json by the same names; README.md explains them.
struct CaseScene {
    /// Its frames are rendered in this order, which need not ascend.
    ShotConfig shot{.extent = {96, 54}, .frames = {0, 0, 0}};
    std::optional<float> near, far;  ///< m
    glm::vec3 scale{1.0f};           ///< of all geometry; one number in the file scales camera and lights as well
    bool scales_all = false;
    glm::vec3 instance_scale{1.0f};  ///< of each instance, whose mesh is scaled by the inverse
    std::optional<float> roughness;  ///< perceptual, of every surface
    float radiance = 1.0f;           ///< factor of all that shines
    nlohmann::json view;             ///< an entry of a scene.json's `cameras`, in place of `camera`; null: none
    nlohmann::json quads;            ///< surfaces that are added; null: none
    std::string where;               ///< file and place, for messages
};

/// What faults may change, by name, and what of a sound pixel is finite.
const std::vector<std::pair<std::string, HostImage HostGBuffer::*>>& input_images();

/// A change of the G-buffer's values, as a capture of another engine may hold them.
struct InputFault {
    HostImage HostGBuffer::*image = nullptr;
    std::vector<float> value;   ///< one for all channels, or one for each
    bool is_factor = false;     ///< `value` multiplies what is there
    std::string where;          ///< "pixel": the one at `at`; "all"; "every_other": of rows and columns
    glm::vec2 at{0.5f, 0.75f};  ///< share of the picture, from the upper left: by default a place on most scenes' floor
    std::optional<unsigned> step;  ///< the only one of the rendered frames that has it; none: all
};

/// Two pictures for the metrics, in place of a scene: ramps from left to right, in all channels.
struct MetricImages {
    glm::uvec2 size{32, 32};
    glm::vec2 reference{0.0f}, test{0.0f};  ///< at the left and at the right
};

/// One line of the table.
struct StabilityCase : StabilityCaseName {
    CaseScene scene, benign;  ///< `benign`: what its error and time are compared with
    std::string benign_key;   ///< the same for cases whose `benign` is the same
    std::vector<InputFault> faults;
    std::optional<glm::uvec2> size_before;  ///< the technique rendered at this size before
    /// Each frame's lit colour is the composited image of the frame before: mirrors in mirrors.
    bool feeds_back = false;
    bool is_perturbed = false;           ///< amplification is measured
    bool is_truth_same = false;          ///< the path tracer must give the benign case's image
    std::vector<std::string> only;       ///< techniques, or NAME:PRESET; empty: all
    std::optional<MetricImages> images;  ///< then the metrics alone are looked at, and `scene` says nothing

    bool has_truth() const;  ///< whether the path tracer's picture is that of the G-buffer with its faults
};

/// Reads a table of cases. Every combination of the values of a case's `each` is a case of its own, called by them.
/// Fails with Error on unknown keys and names.
std::vector<StabilityCase> read_stability_cases(const std::filesystem::path& file);

/// The table that comes with ssrlab.
std::filesystem::path stability_case_table();
