#pragma once
#include "core/host_image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

/// One quantity of every pixel, from two independent halves of the samples. Each half is the mean of 8 batches, and
/// each batch has an Owen scramble of its own, so that the spread of the batches measures the error: samples of one
/// scramble are not independent, and their own variance overstates it by up to orders of magnitude. Combining passes of
/// different length weighs each by its samples.
struct ReferenceOutput {
    HostImage mean;            ///< RGB: (half_a + half_b) / 2
    HostImage half_a, half_b;  ///< RGB, independent of each other
    HostImage variance;        ///< of `mean`, per channel; within the halves, 14 degrees of freedom per pass
};

/// The lower rungs of the truth ladder, which attributes a technique's error to causes: each changes one thing
/// of the one above it. All are means over the lobe like `incident` (times `reflectance` they are specular radiances),
/// and share its samples, so that the steps between rungs are less noisy than the rungs: see truth_ladder.h.
///
/// `camera_radiance` takes, at what the lobe meets first, the radiance that leaves diffusely and by emission towards
/// the camera, lit by all light transport: what the lit colour buffer would hold of it (where the camera is behind the
/// surface, its mirror image before it counts). What is lost is the dependence on the view, and reflections of
/// reflections. `on_screen` takes `fallback` where the image does not show that point, on the side that was met: what
/// is lost is what one frame does not show; a technique with a history may know more. Visibility is that of points, not
/// of pixels.
struct TruthLadder {
    /// RGB: variance of the mean of what a rung changes. Both share their samples, so that it is less than either's
    /// own.
    struct ErrorVariance {
        HostImage incident, specular;  ///< of rung - incident; of reflectance * rung - specular
    };

    ReferenceOutput camera_radiance, on_screen;
    ErrorVariance camera_radiance_error, on_screen_error;
    HostImage on_screen_share;  ///< one channel: share of the lobe that meets what the image shows; an ideal confidence
    HostImage reflectance;      ///< RGB: F0 A + F90 B, as the compositor has it
    HostImage fallback;         ///< RGB: the environment over the lobe, as the G-buffer has it

    bool is_empty() const { return on_screen.mean.values.empty(); }
};

/// Radiances from a small, fixed set of samples of their own: the same bits for every seed, number and stop of the
/// reference's samples are, and independent of their noise. Relative errors are weighted by it: a weight made of the
/// reference's own noise would be correlated with what it weighs, and 1 / r^2 of a noisy r is too large on average.
struct ReferenceGuide {
    HostImage specular, incident, diffuse;  ///< RGB, as the outputs of that name
};

/// What the path tracer knows of one frame of one camera. Pixel centres and first hits are those of the G-buffer.
/// 288 bytes per pixel, 48 of them for each output; with the truth ladder 460.
struct Reference {
    glm::uvec2 extent{0, 0};
    ReferenceOutput image;     ///< full path-traced radiance: diffuse + specular + highlights
    ReferenceOutput diffuse;   ///< the lit colour: what the first hit emits and reflects diffusely; the environment
                               ///< where nothing is hit
    ReferenceOutput specular;  ///< specular reflection of the first hit, of all but the punctual lights
    /// Incident radiance averaged over the visible-normal lobe, weight 1: what a technique estimates.
    ReferenceOutput incident;
    /// RGB, without noise: the punctual lights that the first hit reflects specularly. No part of `specular`, since no
    /// ray meets them and engines shade them in closed form.
    HostImage highlights;
    /// One channel, from the samples of all light: share of the pixel's radiance that is missing since paths end after
    /// max_depth reflections, if what they would have met were as bright as the pixel itself; exact where light is the
    /// same everywhere, as between mirrors.
    HostImage cut_share;
    HostImage sample_count;  ///< one channel; of `diffuse` ReferenceSettings::lit_samples at most
    HostImage lobe_samples;  ///< two channels: how many samples of half A and of half B are above the horizon
    HostImage depth;         ///< one channel: distance along -z (m), 0 where nothing was hit
    HostImage geometric_normal, normal;  ///< XYZ, world space, as in the G-buffer
    HostImage material_id;               ///< one channel: material index + 1, 0: background
    ReferenceGuide guide;
    TruthLadder ladder;  ///< empty unless ReferenceSettings::ladder

    bool is_lit_only() const { return specular.mean.values.empty(); }

    double seconds = 0;  ///< wall clock, over all continued runs, without the guide's
    double rays = 0;     ///< of both kinds, over all runs, without the guide's
    /// Samples with NaN or Inf, whose parts count as zero: an image is valid only if 0.
    uint64_t non_finite_samples = 0;
    /// Share of the pixels that reached target_relative_error by their own stated variance: a report, no stop.
    float reached_share = 1.0f;
    /// Samples per pixel of each pass, "256+256+512"; with a target those that all pixels got, and then the most that
    /// any pixel held after each pass: "256, to 1024, to 4096".
    std::string passes;
    std::string stream;       ///< hash of all that decides which samples are drawn, and their values
    std::string hash;         ///< the key of the cache: stream and stop rule
    bool from_cache = false;  ///< it was not rendered now
};

/// A render stops at whichever limit comes first.
///
/// Samples come in passes over the whole image, a time limit ends after a whole one, and their sizes depend on the
/// clock but not on what was found: no stop adds bias. Without a time limit the passes are 256 and then double,
/// whatever was rendered before, so that the result is the same bits whether it was interrupted, or continued from
/// fewer samples.
///
/// With a target, pixels stop one by one. Stopping when the error *looks* small would favour pixels that have not yet
/// met their rare bright paths (up to -33 % with p = 1e-4 a path), so the samples of other pixels decide: see
/// sample_allocation.h. All that is traced is kept. Most pixels then reach the target and some do not. With a time
/// limit as well, the time that is left is spent while more than 0.5 % do not; else it is reported and not acted on. A
/// time limit is kept within 5 %, by leaving pixels out of the last pass if need be.
struct ReferenceSettings {
    static constexpr unsigned default_samples = 256;

    /// Per pixel, at most; rounded up to 16 * 2^k <= 2^24. 0: no such limit, or default_samples if there is no other.
    unsigned max_samples = 0;
    /// Per pixel of `diffuse`, at most, rounded up as max_samples: techniques read it, and the specular light is what
    /// they are judged by. The rest is traced for the specular light alone. 0: as many as of that.
    unsigned lit_samples = 0;
    /// Wall clock, over all continued runs, without the guide's; 0: unlimited. At least one pass of 16 is made.
    double max_seconds = 0;
    float target_relative_error =
        0;  ///< relative standard error of `specular` at each pixel, see relative_error(); 0: no such stop
    unsigned max_depth = 64;  ///< reflections per path
    unsigned seed = 0x5eed;
    /// Per pixel of the guide, rounded up to 16 * 2^k. 16 are enough for roulette (`truth_benchmark --table`); weights
    /// of relative errors want more, see reference_guide.h.
    unsigned guide_samples = 64;
    /// `diffuse` alone, for frames that techniques read and that nothing is compared with: `image`, `specular`,
    /// `incident` and the guide are empty, and cut_share is of the diffuse light. Without a ladder and a target.
    bool lit_only = false;
    bool ladder = false;    ///< also the lower rungs of the truth ladder: about twice the rays
    bool keep_all = false;  ///< trace also what the scene does not need: the same image, slower
};

/// Called now and then, from one thread at a time: fraction done in [0, 1], rays per second, seconds left. With a
/// target the fraction can fall, since what pixels need is estimated anew at each pass. If it throws, the state is
/// saved and the exception goes on to the caller.
using ReferenceProgress = std::function<void(double fraction, double rays_per_second, double seconds_left)>;

/// How a render is run; nothing here changes its result.
struct ReferenceRun {
    ReferenceProgress progress;
    std::filesystem::path state_file;  ///< where an unfinished render is kept, and picked up; empty: nowhere
    std::function<void(const std::string&)> notice;  ///< gets sentences for the user, e.g. of a broken state file
    double seconds_between_saves = 30;
    double seconds_between_reports = 0.25;
};

/// Renders on all cores (those of the caller's TBB arena); the result is the same bits for any number of them.
///
/// run.state_file is written every seconds_between_saves (or less often, if writing takes more than a twentieth of the
/// time), and when run.progress throws. A render that finds the state of the same request continues it; one that finds
/// a finished reference of the same samples with less of them adds to it, where ReferenceSettings says that it can; any
/// other file there is replaced. The finished reference is not written: see write_reference().
///
/// Fails with Error if the extent is zero or too large, or a setting out of range; with MachineError if the disk is
/// full.
Reference render_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const ReferenceRun& run = {});

/// Hash of what a reference is asked to show: scene content, pose, camera, extent, seed, depth, parts. Fails with
/// Error if scene.content_hash is empty.
std::string reference_request(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                              const ReferenceSettings& settings);

/// Hash of all that decides which samples a render draws and what they are: the request, the
/// code of the path tracer and the platform. Fails as reference_request().
std::string reference_stream(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                             const ReferenceSettings& settings);

/// `stream` and the stop rule: "<32 hex digits>-n1024", "...-n65536-e0.03-t600".
std::string reference_key(const std::string& stream, const ReferenceSettings& settings);

/// The limits in a key, if it is one of `stream`; settings that do not decide a stop have their defaults.
std::optional<ReferenceSettings> settings_of_key(const std::string& stream, const std::string& key);

/// The hash of all sources that references depend on and of how they were compiled; see code_version.cmake.
std::string groundtruth_code_version();
