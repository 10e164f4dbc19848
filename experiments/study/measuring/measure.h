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

/// What a technique's output is compared as. Of another program's frame only the first and the last are known.
struct CompositedImages {
    HostImage specular;         ///< by Config::composite
    HostImage incident = {};    ///< mix(fallback, radiance, confidence)
    HostImage confidence = {};  ///< one channel
    HostImage radiance = {};    ///< as the technique gave it; nothing where its confidence is 0
    HostImage image = {};       ///< all light, of another program; of ours the truth's own light is added
};

/// What all frames of one pose are measured against: made once, used for every technique, point and seed.
struct PoseTruth {
    HostImage diffuse;                          ///< the truth's own: the lit colour that techniques read
    std::optional<ReferenceHalves> lit_halves;  ///< of it
    HostImage direct;  ///< and what `image` adds to every result: the same with the highlights of punctual lights
    std::map<std::string, MetricReference> targets;  ///< by name, with all metrics; where everything is measured
    std::optional<MetricReference> frame_reference;  ///< `specular` with Config::frame_metrics; in shots of several
                                                     ///< frames, of those that are compared
    /// A rung of the truth ladder as an output: what is composited where `incident` is known only so far. The variances
    /// are those of its difference from the truth, with which it shares samples.
    struct Rung {
        std::string name;
        ReferenceHalves incident, specular;
    };
    std::vector<Rung> rungs;  ///< those among Config::targets, where everything is measured
    HostImage view_depth, normal, material_id;
    FlipExposures flip_exposures;
    std::string content_hash;  ///< of the reference's pixels
};

/// One rendered frame: its pose, and the data of its G-buffer on it and on the frame before.
struct FrameTruth {
    std::shared_ptr<const PoseTruth> pose;
    HostImage roughness, reflectance;  ///< one channel; F0 A + F90 B per pixel
    HostImage emission;                ///< RGB, of the surfaces
    std::vector<Mask> masks;           ///< Config::masks; those of a technique's confidence are made by masks_of()
};

/// Value by value; of one size.
HostImage sum(const HostImage& a, const HostImage& b);

/// How much of a pose is to be measured.
struct PoseUse {
    bool has_targets = false, has_frame_reference = false;
};
/// `use` is empty where the reference is of the lit colour alone. Fails if a target of `use` is a rung of the truth
/// ladder, and the reference has none.
PoseTruth pose_truth(const Reference& reference, const Config& config, float exposure_ev, PoseUse use);
FrameTruth frame_truth(std::shared_ptr<const PoseTruth> pose, const HostGBuffer& gbuffer, const Config& config);

/// Config::masks of one result, in their order; without `confidence` (empty) those that do not depend on it.
std::vector<Mask> masks_of(const FrameTruth& truth, const HostImage& confidence, const Config& config);

/// All targets that the result shows x metrics x masks. `row` holds what all rows share: shot, frame, technique, point,
/// seed.
std::vector<ResultRow> measure_targets(const PoseTruth& truth, const CompositedImages& result,
                                       std::span<const Mask> masks, const ResultRow& row);

/// What one frame of a shot adds to the mean over its frames.
struct FrameRows {
    std::vector<ResultRow> rows;
    std::vector<NoisyMap> noise;  ///< of each row's value, as score() gives it
};

/// Config::frame_metrics x masks of one frame's specular.
FrameRows measure_frame(const PoseTruth& truth, const HostImage& specular, std::span<const Mask> masks,
                        const ResultRow& row);

/// direct + specular; of another program's frame its own image.
HostImage composited_image(const PoseTruth& truth, const CompositedImages& result);

/// What a target compares with the truth: for the rungs of the truth ladder the incident radiance. `image` is
/// composited_image() of the same result. Empty where the result does not show it.
const HostImage& tested_image(const std::string& target, const CompositedImages& result, const HostImage& image);
