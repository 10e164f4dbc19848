#pragma once
#include "core/gpu/passes/pass_list.h"
#include "variants/common/condition.h"
#include "variants/common/technique_entry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <optional>
#include <variant>

// The content of a technique.json, or of a denoiser's file, read and checked. `place` begins messages: file, line,
// column and key. Among several images, buffers, results, limits or extents, and among resources of one name in a
// shader, the first counts whose condition holds: in_use().

/// An extent relative to the screen's.
struct ScreenShare {
    unsigned divisor = 1;
    bool rounds_up = false;
    unsigned margin = 0, times = 1;  ///< pixels added before the division; factor after it
    glm::uvec2 size{0, 0};           ///< if not 0, replaces all of the above

    glm::uvec2 of(glm::uvec2 screen) const {
        if (size.x > 0) return size;
        return max((screen + margin + (rounds_up ? divisor - 1 : 0)) / divisor, glm::uvec2(1)) * times;
    }
    bool operator==(const ScreenShare&) const = default;
};

struct DeclaredImage {
    std::string name;
    Format format{};
    ScreenShare share;
    /// Levels: `mips`, until both sides have one texel, or until the shorter side has.
    enum class Mips { count, all, of_shorter_side } mips_until = Mips::count;
    unsigned mips = 1;
    bool has_history = false;  ///< `previous_NAME` holds the previous frame's content
    bool is_kept = false;      ///< black at first; pixels that passes do not write keep older frames' content
    std::string same_as;       ///< if not empty, this is another name of that image, and no other member counts
    Condition is_cleared = Condition::never();  ///< before the first pass of a frame that writes it ...
    glm::vec4 cleared_to{0};                    ///< ... to this
    Condition when;
    std::string place;

    unsigned mips_of(glm::uvec2 extent) const;
};

struct DeclaredBuffer {
    std::string name;
    unsigned bytes = 0, bytes_per_pixel = 0;  ///< the size is their sum, with the pixels of `share`
    ScreenShare share;
    std::string times;  ///< parameter that multiplies bytes_per_pixel; "": none
    Condition when;
    std::string place;
};

/// An image that a pass reads or writes.
struct DeclaredUse {
    std::string image;
    std::string as;  ///< its name in the shader
    /// All mips; `mip`; or, in a pass that runs for each mip, the current one or the one before.
    enum class Mips { all, one, current, finer } mips = Mips::all;
    unsigned mip = 0;
    Condition is_linear = Condition::never();
    Wrap wrap_u = Wrap::clamp, wrap_v = Wrap::clamp;
    bool is_in_place = false;  ///< each invocation writes only where it reads
    Condition when;
    std::string place;
};

/// The depth or stencil buffer of a fragment pass.
struct DeclaredTest {
    std::string image;
    DepthTest::Compare compare = DepthTest::Compare::less;  ///< of depth
    Stencil::Mode mode = Stencil::Mode::off;                ///< of stencil
    bool is_written = false;  ///< of depth by `write`, of stencil with Stencil::Mode::write
    unsigned value = 0;       ///< of stencil
    Condition when;
    std::string place;
};

/// One shader of a pass, and over what it runs.
struct DeclaredForm {
    std::string shader;              ///< as for PassList::compute() and ::fragment()
    glm::uvec2 groups{0, 0};         ///< workgroups, if not 0 ...
    glm::uvec2 pixels_per_group{0};  ///< ... or each for so many pixels of the screen ...
    std::string arguments;           ///< ... or as many as this buffer says, if not empty ...
    unsigned arguments_at = 0;       ///< ... at this byte
    Condition when;

    bool is_compute() const { return shader.ends_with(".comp"); }
};

/// The file for `#include "name"` in a pass.
struct DeclaredInclude {
    std::string name, file;
    bool needs_half_floats = false;  ///< only if the device has them in shaders
    Condition when;
};

/// The current level of a pass that runs for each level, or the last level of an image.
struct MipValue {
    std::string last_of;  ///< "": the level of the pass
};
/// A value of the shader's push_constant block.
using PushValue = std::variant<int, float, glm::vec4, MipValue>;

/// The extent of a compute pass: pixels of `image`, or of `share`.
struct DeclaredExtent {
    std::string image;
    ScreenShare share;
    Condition when;
};

/// A part of a pass, or all of it, that is left out if `when` is known to hold for the shot.
struct DeclaredLeftOut {
    std::string part, fact, why;
    bool keeps_bits = true;
    Constants constants;  ///< constants that switch the part off
    Condition when;
};

struct DeclaredPass {
    std::vector<DeclaredForm> forms;
    std::string stage;
    std::vector<DeclaredUse> reads, writes;
    std::vector<DeclaredTest> depth, stencil;
    std::vector<std::string> buffers;
    std::vector<std::string> tracers;  ///< slots that its shader includes
    unsigned rays = 1;                 ///< rays of a pixel, at most ...
    std::string rays_parameter;        ///< ... or, if not empty, the parameter with their number
    std::vector<DeclaredExtent> over;  ///< of compute passes; none: the first written image, or the screen
    std::string each_mip_of;           ///< runs for each level of that image ...
    unsigned first_mip = 0;            ///< ... from this on
    std::vector<DeclaredInclude> includes;
    std::map<std::string, PushValue> set;
    bool has_environment = false;                      ///< reads the environment along rays
    std::map<std::string, Condition> scene_constants;  ///< of core/gpu/pipelines/shader.h that its shader reads
    std::vector<DeclaredLeftOut> left_out;
    std::string cleared;     ///< an image or buffer to clear, instead of running a shader ...
    std::string cleared_to;  ///< ... to this parameter's value, if not empty, else to that of `set`
    Condition when;
    std::string place;

    /// The first form whose condition holds, else the last one.
    const DeclaredForm& form(const KnownValues& known) const;
    bool is_compute() const { return forms.front().is_compute(); }
};

/// What passes of a technique with a denoiser can use besides their own: two buffers of rays, and an extent of one
/// invocation per traced pixel for DeclaredPass::over.
inline const std::vector<std::string> ray_buffers = {"directions", "hits"};
inline const std::string traced_pixels = "traced_pixels";
/// What passes of a denoiser can use besides (variants/denoisers/denoiser.h).
inline const std::vector<std::string> denoiser_images = {
    "hit_color",     "own_radiance", "own_length",           "ray_radiance",
    "ray_direction", "screen_probe", "screen_probe_nearness"};
inline const std::string seen_rays_buffer = "seen_rays";

/// A result of the frame; the first one whose condition holds counts.
struct DeclaredResult {
    std::string radiance, confidence;
    unsigned channel = 0;  ///< of the confidence
    Condition when;
    std::string place;
};

/// A roughness above which surfaces get a confidence of 0, like surfaces without a specular term.
struct RoughnessLimit {
    std::string parameter;
    bool is_excluded = false;   ///< also surfaces of exactly that roughness
    bool is_alpha = false;      ///< the parameter is a squared roughness
    bool is_of_8_bits = false;  ///< compares roughness rounded to 8 bits
    Condition when;

    /// Whether all surfaces from this perceptual roughness on get a confidence of 0.
    bool excludes_all_from(float roughness, const KnownValues& known) const;
    /// "as smooth as max_roughness".
    std::string surfaces_within() const;
};

/// A squared roughness (amd_sssr/lists.glsl) and a roughness (diligent_ssr/mask.frag) rounded to 8 bits.
float alpha_of_8_bits(float alpha);
float roughness_of_8_bits(float perceptual);

/// A denoiser for the rays that the technique's passes write, instead of a DeclaredResult.
struct DeclaredDenoiser {
    std::string initial;                                 ///< of the parameter `denoiser`
    nlohmann::json defaults = nlohmann::json::object();  ///< of parameters that come with denoisers
    std::string place;
};

/// The maker of depth pyramids; the first one whose condition holds counts. Without one:
/// variants/common/depth_pyramid.h.
struct DeclaredPyramid {
    std::string maker;  ///< of pyramid_makers() (declared_passes.h)
    Condition when;
};

struct Declaration {
    std::string name;           ///< name of its folder
    bool is_denoiser = false;   ///< runs in a technique that has traced rays
    bool reads_inputs = true;   ///< has shaders, and therefore the parameter `repair_inputs`
    bool names_device = false;  ///< see names_device()
    std::vector<Parameter> parameters;
    std::vector<TracerSlot> slots;
    size_t parameters_before_tracers = 0;  ///< number of `parameters` before those of the tracers
    std::string tracers_source;
    nlohmann::json tracer_defaults = nlohmann::json::object();
    std::vector<DeclaredPyramid> pyramids;
    std::optional<DeclaredDenoiser> denoiser;
    std::vector<NamedCondition> conditions;
    std::vector<DeclaredImage> images;
    std::vector<DeclaredBuffer> buffers;
    std::vector<DeclaredPass> passes;
    std::vector<DeclaredResult> results;
    TechniqueLimits limits{};
    Condition draws_random_numbers;  ///< by its own passes, not by tracers
    std::vector<NotRepeatable> not_repeatable;
    std::vector<RoughnessLimit> reflects;

    /// The known values, with the declaration's named conditions.
    KnownValues known_values(const ParameterSet& params, const std::optional<SceneFacts>& facts = {}) const;
    /// Stages that run and whose shaders read a constant of a scene (core/gpu/pipelines/shader.h).
    std::vector<std::string> readers_of(const std::string& scene_constant, const KnownValues& known) const;
    /// Passes that run, in their order.
    std::vector<const DeclaredPass*> passes_in_use(const KnownValues& known) const;
};

/// Whether a condition of the written declaration names `device.is_gpu`.
bool names_device(const nlohmann::json& written);

/// The first element whose condition holds; null if none does.
template <class T>
const T* first_that_holds(const std::vector<T>& all, const KnownValues& known) {
    const auto found = std::ranges::find_if(all, [&](const T& one) { return one.when.holds(known); });
    return found == all.end() ? nullptr : &*found;
}

/// The elements whose condition holds; of several with the same member `name`, the first.
template <class T>
std::vector<const T*> in_use(const std::vector<T>& all, std::string T::*name, const KnownValues& known) {
    std::vector<const T*> found;
    for (const T& one : all)
        if (one.when.holds(known) &&
            std::ranges::none_of(found, [&](const T* other) { return other->*name == one.*name; }))
            found.push_back(&one);
    return found;
}
