#pragma once
#include "core/host_image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

/// One quantity of every pixel, from two independent halves of the samples. Each half is the mean of 8 batches. Each
/// batch has its own Owen scramble, so that the spread of the batches measures the error. Samples of one scramble are
/// not independent: their variance can overstate the error by orders of magnitude. Passes are weighted by their numbers
/// of samples.
struct ReferenceOutput {
    HostImage mean;            ///< RGB: (half_a + half_b) / 2
    HostImage half_a, half_b;  ///< RGB, independent of each other
    HostImage variance;  ///< of `mean`, per channel; estimated within the halves with 14 degrees of freedom per pass
};

/// The lower rungs of the truth ladder, which attributes a technique's error to causes. Each rung changes one thing of
/// the rung above. All are means over the lobe like `incident`; times `reflectance` they are specular radiances. They
/// share the samples of `incident`, so that steps between rungs are less noisy than the rungs: see truth_ladder.h.
///
/// `camera_radiance` takes, at the point that the lobe meets first, the emitted and diffusely reflected radiance
/// towards the camera, lit by all light transport. This is what the lit colour buffer would hold. (If the camera is
/// behind the surface, its mirror image in front of the surface counts.) The step loses the dependence on the view, and
/// reflections of reflections. `on_screen` takes `fallback` where the image does not show that point on the side that
/// was met. The step loses what one frame does not show; a technique with a history may know more. Visibility is that
/// of points, not of pixels.
struct TruthLadder {
    /// RGB: variance of the mean difference between a rung and the truth. Both share their samples, so it is below
    /// either's own variance.
    struct ErrorVariance {
        HostImage incident, specular;  ///< variance of rung - incident; of reflectance * rung - specular
    };

    ReferenceOutput camera_radiance, on_screen;
    ErrorVariance camera_radiance_error, on_screen_error;
    HostImage on_screen_share;  ///< one channel: share of the lobe that meets points in the image; an ideal confidence
    HostImage reflectance;      ///< RGB: F0 A + F90 B, as the compositor has it
    HostImage fallback;         ///< RGB: the environment over the lobe, as the G-buffer has it

    bool is_empty() const { return on_screen.mean.values.empty(); }
};

/// Radiances from a small, fixed set of separate samples. They have the same bits for every seed, number and stop of
/// the reference's samples, and are independent of their noise. They weigh relative errors: a weight from the
/// reference's own noise would correlate with the error, and 1 / r^2 of a noisy r is too large on average.
struct ReferenceGuide {
    HostImage specular, incident, diffuse;  ///< RGB, as the outputs of that name
};

/// The path tracer's result for one frame of one camera. Pixel centres and first hits are those of the G-buffer. 288
/// bytes per pixel, 48 of them for each output; with the truth ladder 460.
struct Reference {
    glm::uvec2 extent{0, 0};
    ReferenceOutput image;     ///< full path-traced radiance: diffuse + specular + highlights
    ReferenceOutput diffuse;   ///< the lit colour: what the first hit emits and reflects diffusely; the environment
                               ///< where nothing is hit
    ReferenceOutput specular;  ///< specular reflection of the first hit, without punctual lights
    /// Incident radiance averaged over the visible-normal lobe, weight 1: what a technique estimates.
    ReferenceOutput incident;
    /// RGB, without noise: specular reflection of punctual lights at the first hit. Not in `specular`: no ray meets
    /// such lights, and engines shade them in closed form.
    HostImage highlights;
    /// One channel, from the samples of all light: share of the pixel's radiance that is missing because paths end
    /// after max_depth reflections. Assumes that the missing light is as bright as the pixel: exact where light is the
    /// same everywhere, as between mirrors.
    HostImage cut_share;
    HostImage sample_count;  ///< one channel; `diffuse` has at most ReferenceSettings::lit_samples
    HostImage lobe_samples;  ///< two channels: specular directions of half A and of half B above the horizon
    HostImage directions;    ///< two channels: Directions of each sample; empty without an adaptive share
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
    /// Share of the pixels whose own variance says that they reached target_relative_error. For reports; it stops
    /// nothing.
    float reached_share = 1.0f;
    /// Samples per pixel of each pass, "256+256+512". With a target: the samples that all pixels got, then the most
    /// that a pixel had after each pass, "256, to 1024, to 4096".
    std::string passes;
    std::string stream;       ///< hash of all that decides the samples and their values
    std::string hash;         ///< the key of the cache: stream and stop rule
    bool from_cache = false;  ///< read from the cache, not rendered
};

/// A render stops at whichever limit comes first.
///
/// Samples come in passes over the whole image, and a time limit ends after a whole pass. Sizes of passes depend on the
/// clock but not on results, so no stop adds bias. Without a time limit the first pass has 256 samples, and each later
/// pass doubles the total. The result has the same bits if the render was interrupted, or continued from fewer samples.
///
/// With a target, pixels stop one by one. Stopping when a pixel's error *looks* small would favour pixels that have not
/// met their rare bright paths (up to -33 % with p = 1e-4 a path). The samples of other pixels therefore decide: see
/// sample_allocation.h. All traced samples are kept. Most pixels reach the target, and some do not. With a time limit,
/// the remaining time is used while more than 0.5 % of the pixels miss the target; else their share is only reported. A
/// time limit is kept within 5 %, if necessary by leaving pixels out of the last pass.
struct ReferenceSettings {
    static constexpr unsigned default_samples = 256;
    static constexpr float most_adaptive_share = 8;

    /// Per pixel, at most; rounded up to 16 * 2^k <= 2^24. 0: no such limit, or default_samples if there is no other.
    unsigned max_samples = 0;
    /// Per pixel of `diffuse`, at most, rounded up as max_samples. Techniques read `diffuse`, but are judged by the
    /// specular light: further samples trace that alone. 0: as many as for the specular light.
    unsigned lit_samples = 0;
    /// Further directions of each sample, on average over the image, for the pixels that decide the noise of an MSE
    /// (adaptive_directions.h), at most most_adaptive_share. Not with a target, nor of the lit colour alone.
    float adaptive_share = 0;
    bool adaptive_image = false;  ///< the share is for the noise of the image relative to its brightness, of both lobes
    /// Wall clock, over all continued runs, without the guide's; 0: unlimited. At least one pass of 16 is made.
    double max_seconds = 0;
    float target_relative_error =
        0;  ///< relative standard error of `specular` at each pixel, see relative_error(); 0: no such stop
    unsigned max_depth = 64;  ///< reflections per path
    unsigned seed = 0x5eed;
    /// Per pixel of the guide, rounded up to 16 * 2^k. 16 are enough for roulette (`truth_benchmark --table`); weights
    /// of relative errors need more, see reference_guide.h.
    unsigned guide_samples = 64;
    /// Only `diffuse`, for frames that techniques read but that are not judged. `image`, `specular`, `incident` and the
    /// guide are empty; cut_share is of the diffuse light. Not with a ladder or a target.
    bool lit_only = false;
    bool ladder = false;    ///< also the lower rungs of the truth ladder: about twice the rays
    bool keep_all = false;  ///< also trace what the scene does not need: the same image, slower
};

/// Called from time to time, from one thread at a time: fraction done in [0, 1], rays per second, seconds left. With a
/// target the fraction can fall, since each pass estimates the needed samples anew. If the call throws, the state is
/// saved and the exception reaches the caller.
using ReferenceProgress = std::function<void(double fraction, double rays_per_second, double seconds_left)>;

/// How a render is run; nothing here changes its result.
struct ReferenceRun {
    ReferenceProgress progress;
    std::filesystem::path state_file;  ///< where an unfinished render is saved and continued; empty: nowhere
    std::function<void(const std::string&)>
        notice;  ///< gets sentences for the user, for example about a broken state file
    double seconds_between_saves = 30;
    double seconds_between_reports = 0.25;
};

/// Renders on all cores (those of the caller's TBB arena); the result is the same bits for any number of them.
///
/// run.state_file is written every seconds_between_saves (less often if writing takes more than a twentieth of the
/// time), and when run.progress throws. A render continues a state of the same request. It adds to a finished reference
/// with fewer of the same samples, if can_be_extended() allows it. Any other file there is replaced. The finished
/// reference is not written: see write_reference().
///
/// Fails with Error if the extent is zero or too large, or a setting out of range; with MachineError if the disk is
/// full.
Reference render_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const ReferenceRun& run = {});

/// Hash of the image that a reference shows and of its samples: scene content, pose, camera, extent, seed, depth,
/// parts, shares. Fails with Error if scene.content_hash is empty.
std::string reference_request(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                              const ReferenceSettings& settings);

/// Hash of all that decides a render's samples and their values: the request, the code of the path tracer and the
/// platform. Fails as reference_request().
std::string reference_stream(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                             const ReferenceSettings& settings);

/// `stream` and the stop rule: "<32 hex digits>-n1024", "...-n65536-e0.03-t600".
std::string reference_key(const std::string& stream, const ReferenceSettings& settings);

/// The limits in a key, if the key belongs to `stream`. Settings that decide no stop have their defaults.
std::optional<ReferenceSettings> settings_of_key(const std::string& stream, const std::string& key);

/// The hash of all sources that references depend on and of how they were compiled; see code_version.cmake.
std::string groundtruth_code_version();
