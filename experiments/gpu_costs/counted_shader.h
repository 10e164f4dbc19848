#pragma once
#include <string>
#include <vector>

/// The storage buffer in which a counted shader adds up: 64-bit numbers, low word first, one for each of
/// most_shader_counters. Its content is what the shader finds in it, and more.
inline constexpr const char* shader_counts_buffer = "shader_counts";
inline constexpr unsigned most_shader_counters = 64;

/// What one number of the buffer counts.
struct ShaderCounter {
    enum class What {
        invocations,       ///< that ran, helpers of derivatives aside
        idle_invocations,  ///< of a compute shader: those that wrote nothing; of a fragment shader: none
        completed,         ///< that came to the end of main, not to a discard
        writes,            ///< instructions that write to an image, a buffer or the workgroup's memory
        operations,        ///< scalar arithmetic
        shared_bytes,      ///< of the workgroup's memory, read and written
        atomics,
        // Of one image or buffer:
        texel_fetches,  ///< of one texel each: texelFetch, imageLoad
        samples,        ///< through the sampler's filter
        gathers,        ///< of four texels
        texel_writes,
        buffer_bytes_read,
        buffer_bytes_written,
    } what;
    std::string resource;  ///< the image's variable or the buffer's block
};

/// The shader, expanded and without #version, as one that adds its counters up when an invocation ends.
std::string with_counters(const std::string& glsl);

/// Lets the functions of such a shader, compiled, count what they do, and says what each counter holds, by its place.
/// Nothing but the counters changes: the shader computes the same bits. Fragment shaders without a discard and without
/// a depth of their own are made to be tested before they run (which a shader without side effects may be, and on all
/// devices is): counting would otherwise run what the tests reject. Fails with Error if there are too many resources.
///
/// Arithmetic is what the compiler of GLSL states, before any driver's optimisation: one operation for each component
/// of a result, 2n - 1 of a dot product of n, and so on in products of matrices; functions such as sin, pow or
/// normalize count as one for each component. Loads, stores, moves, comparisons of addresses and branches are none.
std::vector<ShaderCounter> count_in(std::vector<unsigned>& spirv);
