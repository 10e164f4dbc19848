#pragma once
#include "core/gpu/passes/pass_list.h"
#include "variants/common/condition.h"
#include "variants/common/technique_entry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <optional>
#include <variant>

// What a technique.json, or the file of a denoiser, says, once it was read and judged. `place` begins messages: file,
// line, column and key. Of several images, buffers, results, limits or extents, and of what a shader has under one
// name, the first counts whose condition holds: in_use().

/// A part of the screen, in pixels or in texels that each stand for some.
struct ScreenShare {
    unsigned divisor = 1;
    bool rounds_up = false;
    unsigned margin = 0, times = 1;  ///< pixels added before it is divided; factor after that
    glm::uvec2 size{0, 0};           ///< if not 0, in place of all that

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
    /// Levels: so many, until both sides have one texel, or until the shorter one has.
    enum class Mips { count, all, of_shorter_side } mips_until = Mips::count;
    unsigned mips = 1;
    bool has_history = false;  ///< `previous_NAME` is what the frame before wrote
    bool is_kept = false;      ///< black at first, and what passes leave out keeps what older frames wrote
    std::string same_as;       ///< if not empty, another name of that image, and nothing else of this counts
    Condition is_cleared = Condition::never();  ///< before the first pass of a frame that writes it ...
    glm::vec4 cleared_to{0};                    ///< ... to this
    Condition when;
    std::string place;

    unsigned mips_of(glm::uvec2 extent) const;
};

struct DeclaredBuffer {
    std::string name;
    unsigned bytes = 0, bytes_per_pixel = 0;  ///< their sum counts, by pixels of `share`
    ScreenShare share;
    std::string times;  ///< a parameter that bytes_per_pixel are multiplied by; "": none
    Condition when;
    std::string place;
};

/// An image that a pass reads or writes.
struct DeclaredUse {
    std::string image;
    std::string as;  ///< its name in the shader
    /// All of its mips, `mip`, or of a pass that runs for each the one that it runs for, or the one before that.
    enum class Mips { all, one, current, finer } mips = Mips::all;
    unsigned mip = 0;
    Condition is_linear = Condition::never();
    Wrap wrap_u = Wrap::clamp, wrap_v = Wrap::clamp;
    bool is_in_place = false;  ///< is written where it is read, by the invocation that reads it
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
    std::string shader;              ///< as PassList::compute() and ::fragment() find it
    glm::uvec2 groups{0, 0};         ///< workgroups, if not 0 ...
    glm::uvec2 pixels_per_group{0};  ///< ... or each for so many pixels of the screen ...
    std::string arguments;           ///< ... or as many as this buffer says, if not empty ...
    unsigned arguments_at = 0;       ///< ... at this byte
    Condition when;

    bool is_compute() const { return shader.ends_with(".comp"); }
};

/// What `#include "name"` stands for in a pass.
struct DeclaredInclude {
    std::string name, file;
    bool needs_half_floats = false;  ///< of the device, in shaders
    Condition when;
};

/// The level that a pass runs for, of those that run for each, or the last one of an image.
struct MipValue {
    std::string last_of;  ///< "": the level of the pass
};
/// A value of the shader's push_constant block.
using PushValue = std::variant<int, float, glm::vec4, MipValue>;

/// What compute invocations stand for: pixels of `image`, or of `share`.
struct DeclaredExtent {
    std::string image;
    ScreenShare share;
    Condition when;
};

/// What a pass does not do for a shot of which `when` is known to hold: all of it, or a part.
struct DeclaredLeftOut {
    std::string part, fact, why;
    bool keeps_bits = true;
    Constants constants;  ///< that switch the part off
    Condition when;
};

struct DeclaredPass {
    std::vector<DeclaredForm> forms;
    std::string stage;
    std::vector<DeclaredUse> reads, writes;
    std::vector<DeclaredTest> depth, stencil;
    std::vector<std::string> buffers;
    std::vector<std::string> tracers;  ///< slots that its shader includes
    unsigned rays = 1;                 ///< of a pixel, at most ...
    std::string rays_parameter;        ///< ... or, if not empty, the parameter that says how many
    std::vector<DeclaredExtent> over;  ///< of compute passes; none: the first image that it writes, or the screen
    std::string each_mip_of;           ///< runs for each level of that image ...
    unsigned first_mip = 0;            ///< ... from this on
    std::vector<DeclaredInclude> includes;
    std::map<std::string, PushValue> set;
    bool has_environment = false;                      ///< reads it along rays
    std::map<std::string, Condition> scene_constants;  ///< of core/gpu/pipelines/shader.h that its shader looks at
    std::vector<DeclaredLeftOut> left_out;
    std::string cleared;     ///< an image or buffer, in place of a shader ...
    std::string cleared_to;  ///< ... to a parameter's value, if not empty, else to that of `set`
    Condition when;
    std::string place;

    /// Fails a program that asks for it where none holds: the last one always does.
    const DeclaredForm& form(const KnownValues& known) const;
    bool is_compute() const { return forms.front().is_compute(); }
};

/// What passes find besides their own in a technique with a denoiser: two buffers for its rays. One of its traced
/// pixels is what DeclaredPass::over can name.
inline const std::vector<std::string> ray_buffers = {"directions", "hits"};
inline const std::string traced_pixels = "traced_pixels";
/// What passes of a denoiser find besides (variants/denoisers/denoiser.h).
inline const std::vector<std::string> denoiser_images = {
    "hit_color",     "own_radiance", "own_length",           "ray_radiance",
    "ray_direction", "screen_probe", "screen_probe_nearness"};
inline const std::string seen_rays_buffer = "seen_rays";

/// The first whose condition holds is what the frame shows.
struct DeclaredResult {
    std::string radiance, confidence;
    unsigned channel = 0;  ///< of the confidence
    Condition when;
    std::string place;
};

/// Rougher surfaces, and those without a specular term, get a confidence of 0.
struct RoughnessLimit {
    std::string parameter;
    bool is_excluded = false;   ///< surfaces of just that roughness, too
    bool is_alpha = false;      ///< the parameter is of squared roughness
    bool is_of_8_bits = false;  ///< surfaces are compared by what 8 bits keep of them
    Condition when;

    /// Whether no surface from this perceptual roughness on gets another one.
    bool excludes_all_from(float roughness, const KnownValues& known) const;
    /// "as smooth as max_roughness".
    std::string surfaces_within() const;
};

/// What 8 bits keep of a squared roughness (amd_sssr/lists.glsl) and of a roughness (diligent_ssr/mask.frag).
float alpha_of_8_bits(float alpha);
float roughness_of_8_bits(float perceptual);

/// Makes the picture of the rays that its passes write, in place of a DeclaredResult.
struct DeclaredDenoiser {
    std::string initial;                                 ///< of the parameter `denoiser`
    nlohmann::json defaults = nlohmann::json::object();  ///< of parameters that come with it
    std::string place;
};

/// Who makes pyramids of depth, where the first holds; without one variants/common/depth_pyramid.h.
struct DeclaredPyramid {
    std::string maker;  ///< of pyramid_makers() of pass_list.h
    Condition when;
};

struct Declaration {
    std::string name;          ///< of its folder
    bool is_denoiser = false;  ///< runs in a technique that has traced rays
    bool reads_inputs = true;  ///< has shaders, and so the parameter `repair_inputs`
    std::vector<Parameter> parameters;
    std::vector<TracerSlot> slots;
    size_t parameters_before_tracers = 0;  ///< of `parameters`, those of the tracers stand behind so many
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
    Condition draws_random_numbers;  ///< itself, not in its tracers
    std::vector<NotRepeatable> not_repeatable;
    std::vector<RoughnessLimit> reflects;

    /// With its conditions.
    KnownValues known_values(const ParameterSet& params, const std::optional<SceneFacts>& facts = {}) const;
    /// Stages that run and whose shaders look at a constant of a scene (core/gpu/pipelines/shader.h).
    std::vector<std::string> readers_of(const std::string& scene_constant, const KnownValues& known) const;
    /// Passes that run, in their order.
    std::vector<const DeclaredPass*> passes_in_use(const KnownValues& known) const;
};

/// The first whose condition holds; null where none does.
template <class T>
const T* first_that_holds(const std::vector<T>& all, const KnownValues& known) {
    const auto found = std::ranges::find_if(all, [&](const T& one) { return one.when.holds(known); });
    return found == all.end() ? nullptr : &*found;
}

/// Those whose condition holds, and of several with one name, which `name` is, the first of them.
template <class T>
std::vector<const T*> in_use(const std::vector<T>& all, std::string T::*name, const KnownValues& known) {
    std::vector<const T*> found;
    for (const T& one : all)
        if (one.when.holds(known) &&
            std::ranges::none_of(found, [&](const T* other) { return other->*name == one.*name; }))
            found.push_back(&one);
    return found;
}
