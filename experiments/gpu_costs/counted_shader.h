#pragma once
#include <string>
#include <vector>

/// The storage buffer that a counted shader adds to: 64-bit numbers, low word first, one for each of
/// most_shader_counters. The shader adds to the buffer's content.
inline constexpr const char* shader_counts_buffer = "shader_counts";
inline constexpr unsigned most_shader_counters = 64;

/// What one number of the buffer counts.
struct ShaderCounter {
    enum class What {
        invocations,       ///< invocations that ran, without helpers of derivatives
        idle_invocations,  ///< compute invocations that wrote nothing; none in fragment shaders
        completed,         ///< invocations that reached the end of main, not a discard
        writes,            ///< instructions that write to an image, a buffer or the workgroup's memory
        operations,        ///< scalar arithmetic
        shared_bytes,      ///< of the workgroup's memory, read and written
        atomics,
        // Counters of one image or buffer:
        texel_fetches,  ///< of one texel each: texelFetch, imageLoad
        samples,        ///< through the sampler's filter
        gathers,        ///< of four texels
        texel_writes,
        buffer_bytes_read,
        buffer_bytes_written,
    } what;
    std::string resource;  ///< the image's variable or the buffer's block
};

/// Returns the shader (expanded, without #version) with code that adds up its counters when an invocation ends.
std::string with_counters(const std::string& glsl);

/// Makes the compiled functions of a shader from with_counters() count what they do, and returns what each counter
/// counts. The shader computes the same bits. Fragment shaders without discard and without their own depth are set to
/// be tested before they run: counting would otherwise run fragments that the tests reject. Fails with Error if there
/// are too many resources.
///
/// Arithmetic is what the GLSL compiler states, before a driver's optimisation: one operation for each component of a
/// result, 2n - 1 for a dot product of n, likewise in products of matrices. Functions such as sin, pow or normalize
/// count one for each component. Loads, stores, moves, address comparisons and branches count none.
std::vector<ShaderCounter> count_in(std::vector<unsigned>& spirv);
