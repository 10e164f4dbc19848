#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "groundtruth/reference/reference.h"
#include "metrics/masks.h"
#include "metrics/score.h"

#include <map>
#include <memory>
#include <optional>

/// A technique's output in the forms that are compared. Of another program's frame only the first and the last are
/// known.
struct CompositedImages {
    HostImage specular;         ///< composited by Config::composite
    HostImage incident = {};    ///< mix(fallback, radiance, confidence)
    HostImage confidence = {};  ///< one channel
    HostImage radiance = {};    ///< the technique's own; 0 where its confidence is 0
    HostImage image = {};       ///< all light, of another program; empty for techniques
};

/// The truth of one pose, used for all its frames, techniques, points and seeds.
struct PoseTruth {
    HostImage diffuse;                          ///< the lit colour of the truth, which techniques read
    std::optional<ReferenceHalves> lit_halves;  ///< halves of `diffuse`
    HostImage direct;  ///< `diffuse` and the highlights of punctual lights: what `image` adds to every result
    std::map<std::string, MetricReference> targets;  ///< by name, with all metrics; of frames with full measure
    /// `specular` with Config::frame_metrics, for shots of several frames
    std::optional<MetricReference> frame_reference;
    /// A rung of the truth ladder as an output: the composited image if `incident` is known only up to this rung.
    /// Variances are those of its difference from the truth, as both share samples.
    struct Rung {
        std::string name;
        ReferenceHalves incident, specular;
    };
    std::vector<Rung> rungs;  ///< those among Config::targets, in frames with full measure
    HostImage view_depth, normal, material_id;
    FlipExposures flip_exposures;
    std::string content_hash;  ///< hash of the reference's pixels
};

/// One rendered frame: the truth of its pose, and data of this and the previous G-buffer.
struct FrameTruth {
    std::shared_ptr<const PoseTruth> pose;
    HostImage roughness, reflectance;  ///< one channel; F0 A + F90 B per pixel
    HostImage emission;                ///< RGB, of the surfaces
    std::vector<Mask> masks;           ///< Config::masks; masks_of() makes those of a technique's confidence
};

/// Sum value by value; both have one size.
HostImage sum(const HostImage& a, const HostImage& b);

/// How much of a pose is to be measured.
struct PoseUse {
    bool has_targets = false, has_frame_reference = false;
};
/// The truth of a pose from its reference. `use` is empty where only the lit colour is needed. Fails with Error if a
/// target of `use` is a rung of the truth ladder that the reference lacks.
PoseTruth pose_truth(const Reference& reference, const Config& config, float exposure_ev, PoseUse use);
FrameTruth frame_truth(std::shared_ptr<const PoseTruth> pose, const HostGBuffer& gbuffer, const Config& config);

/// Config::masks of one result, in their order. With empty `confidence`: those that do not depend on it.
std::vector<Mask> masks_of(const FrameTruth& truth, const HostImage& confidence, const Config& config);

/// Rows for all targets that the result has x metrics x masks. `row` holds what all rows share: shot, frame, technique,
/// point, seed.
std::vector<ResultRow> measure_targets(const PoseTruth& truth, const CompositedImages& result,
                                       std::span<const Mask> masks, const ResultRow& row);

/// One frame's part of the mean over a shot's frames.
struct FrameRows {
    std::vector<ResultRow> rows;
    std::vector<NoisyMap> noise;  ///< noise of each row's value, as in Score
};

/// Config::frame_metrics x masks of one frame's specular.
FrameRows measure_frame(const PoseTruth& truth, const HostImage& specular, std::span<const Mask> masks,
                        const ResultRow& row);

/// direct + specular; for another program's frame its own image.
HostImage composited_image(const PoseTruth& truth, const CompositedImages& result);

/// The image of the result that `target` compares with the truth: for rungs of the truth ladder the incident radiance.
/// `image` is composited_image() of the result. Empty where the result lacks it.
const HostImage& tested_image(const std::string& target, const CompositedImages& result, const HostImage& image);
