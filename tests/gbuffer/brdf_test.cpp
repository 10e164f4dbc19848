#include "core/shared/brdf.h"
#include "core/gpu/passes/pass_list.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <cstring>
#include <random>

namespace {

const char* const names[16] = {"D alpha^2", "root", "V",      "Schlick",   "m.x",    "m.y", "m.z", "i.x",
                               "i.y",       "i.z",  "weight", "cap bound", "cosine", "F0",  "F90", "basis"};

std::array<float, 16> on_the_cpu(glm::vec4 in) {
    const float alpha = ggx_alpha(in.w);
    const glm::vec3 o(std::sqrt(1 - in.z * in.z), 0, in.z);
    const glm::vec3 m = sample_ggx_normal(o, alpha, in, 1), i = sample_ggx_reflection_bounded(o, alpha, in);
    return {ggx_distribution(m, alpha) * alpha * alpha,
            smith_root(o.z, alpha),
            smith_visibility(o.z, in.x + 0.01f, alpha),
            schlick_weight(o.z),
            m.x,
            m.y,
            m.z,
            i.x,
            i.y,
            i.z,
            ggx_reflection_weight(o.z, i.z, alpha),
            ggx_cap_bound(o.z, alpha),
            sample_cosine(in).z,
            specular_f0(glm::vec3(in.x), in.y, 0.5f).x,
            specular_f90(in.y, 0.5f),
            glm::dot(basis_from_normal(m)[0], glm::vec3(1, 2, 3))};
}

}  // namespace

TEST(brdf, is_the_same_on_the_device) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::vec4> inputs(10000);
    for (glm::vec4& in : inputs)
        in = {uniform(random), uniform(random), 0.02f + 0.98f * uniform(random), uniform(random)};

    PassList pass_list(test_device(), {1, 1});
    const ParameterSet none;
    pass_list.begin_frame({}, none, {});
    const Buffer in = pass_list.buffer("Inputs", inputs.size() * sizeof(glm::vec4)),
                 out = pass_list.buffer("Values", inputs.size() * 16 * sizeof(float));
    pass_list.upload(in, std::as_bytes(std::span(inputs)));
    pass_list.compute("tests/gbuffer/brdf_values.comp")
        .use(in)
        .use(out)
        .dispatch_groups({(inputs.size() + 63) / 64, 1, 1});
    const std::vector<std::byte> bytes = pass_list.download(out);
    std::vector<float> values(inputs.size() * 16);
    std::memcpy(values.data(), bytes.data(), bytes.size());

    double largest[16] = {};
    for (size_t n = 0; n < inputs.size(); ++n) {
        const auto expected = on_the_cpu(inputs[n]);
        for (int k = 0; k < 16; ++k) {
            // Vulkan asks no more of sin, cos and pow than 2^-11 absolute, of division and sqrt a few units in the last
            // place; lavapipe's sin and cos are within 1e-5. Near the horizon, weight and visibility amplify the error
            // of the cosine.
            const double error =
                std::abs(double(values[16 * n + k]) - expected[k]) / std::max(1.0, std::abs(double(expected[k])));
            largest[k] = std::max(largest[k], error);
            ASSERT_LT(error, 1e-3) << names[k] << " of input " << n;
        }
    }
    for (int k = 0; k < 16; ++k) std::printf("%-10s largest difference %.1e\n", names[k], largest[k]);
}
