#pragma once
#include "core/gpu/passes/pass_graph.h"
#include "variants/common/variant_entry.h"
#include "variants/declared/condition.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <optional>
#include <variant>

// What a technique.json says, once it was read and judged. `place` begins messages: file, line, column and key. Of
// several images, buffers or results, and of what a shader has under one name, the first counts whose condition holds:
// in_use().

struct DeclaredImage {
    std::string name;
    Format format{};
    unsigned divisor = 1;   ///< of the screen's extent ...
    glm::uvec2 size{0, 0};  ///< ... or, if not 0, an extent of its own
    unsigned mips = 1;
    bool has_history = false;  ///< `previous_NAME` is what the frame before wrote
    Condition when;
    std::string place;

    glm::uvec2 extent(glm::uvec2 screen) const { return size.x > 0 ? size : max(screen / divisor, glm::uvec2(1)); }
};

struct DeclaredBuffer {
    std::string name;
    unsigned bytes = 0, bytes_per_pixel = 0;  ///< their sum counts, by pixels of the screen
    Condition when;
    std::string place;
};

/// An image that a pass reads or writes.
struct DeclaredUse {
    std::string image;
    std::string as;               ///< its name in the shader
    std::optional<unsigned> mip;  ///< none: all of them
    Condition is_linear = Condition::never();
    Wrap wrap_u = Wrap::clamp, wrap_v = Wrap::clamp;
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

/// A member of the shader's push_constant block.
using PushValue = std::variant<int, float, glm::vec4>;

struct DeclaredPass {
    std::string shader;      ///< as PassGraph::compute() and ::fragment() find it
    bool is_compute = true;  ///< else a fragment shader over the whole of what it writes
    std::string stage;
    std::vector<DeclaredUse> reads, writes;
    std::optional<DeclaredTest> depth, stencil;
    std::vector<std::string> buffers;
    std::vector<std::string> tracers;  ///< slots that its shader includes
    unsigned rays = 1;                 ///< of a pixel, at most ...
    std::string rays_parameter;        ///< ... or, if not empty, the parameter that says how many
    std::string over;                  ///< image with a pixel for each invocation; "": the first that it writes
    std::map<std::string, PushValue> set;
    bool has_environment = false;                      ///< reads it along rays
    std::map<std::string, Condition> scene_constants;  ///< of core/gpu/pipelines/shader.h that its shader looks at
    std::string cleared;                               ///< an image or buffer, in place of a shader
    Condition when;
    std::string place;
};

/// What passes find besides their own in a technique with a resolve (variants/resolves/ray_inputs.h): two buffers for
/// its rays, and an image for shaders that draw them. One of its traced pixels is what DeclaredPass::over can name.
inline const std::vector<std::string> ray_buffers = {"directions", "hits"};
inline const std::string below_horizon_image = "below_horizon", traced_pixels = "traced_pixels";

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
    bool is_excluded = false;  ///< surfaces of just that roughness, too
};

/// Makes the picture of the rays that its passes write, in place of a DeclaredResult.
struct DeclaredResolve {
    std::string initial;                                 ///< of the parameter `resolve`
    nlohmann::json defaults = nlohmann::json::object();  ///< of parameters that come with it
    std::string place;
};

struct Technique {
    std::string name;  ///< of its folder
    std::vector<Parameter> parameters;
    std::vector<TracerSlot> slots;
    std::string tracers_source;
    nlohmann::json tracer_defaults = nlohmann::json::object();
    std::optional<DeclaredResolve> resolve;
    std::vector<DeclaredImage> images;
    std::vector<DeclaredBuffer> buffers;
    std::vector<DeclaredPass> passes;
    std::vector<DeclaredResult> results;
    VariantLimits limits{};
    Condition draws_random_numbers;  ///< itself, not in its tracers
    std::optional<RoughnessLimit> reflects;
};

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

/// Runs it. Needs no more than its parameters and tracers until it renders.
std::unique_ptr<Variant> make_declared(std::shared_ptr<const Technique> technique);
