#include "tests/variants/diligent_frames.h"
#include "tests/variants/variant_fixture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

// All passes of recorded sequences, from the G-buffer to the reflections, with the recorded random numbers: each stage
// reads what our own stages before it wrote, and histories are our own from the first frame on.

namespace {

struct Chain {
    std::string sequence, variant, factor;
};
void PrintTo(const Chain& chain, std::ostream* out) {
    *out << chain.sequence << ", " << chain.variant << ", factor " << chain.factor;
}

/// Sequences of which all is recorded.
std::vector<Chain> recorded_chains() {
    std::vector<Chain> chains;
    for (const std::string& sequence : diligent_sets_with("f0/noise.exr"))
        for (const char* variant : {"head", "seed"})
            for (const char* factor : {"0.9", "1"})
                if (is_golden(sequence + "/f0/temporal_" + variant + "_" + factor + ".exr"))
                    chains.push_back({sequence, variant, factor});
    return chains;
}

struct Stages {
    Image resolved, accumulated, reflections;
};

struct DiligentChainOf : VariantTest, testing::WithParamInterface<Chain> {
    Stages render(DiligentFrames& frames, const HostImage& noise) {
        PassGraph& graph = frames.graph;
        const GBuffer& gbuffer = frames.gbuffer;
        const auto& [params, tracing, filter] = frames.parameters;
        const Image numbers = graph.image_of("blue_noise", Format::rg32f, noise.extent);
        graph.upload(numbers, noise);
        const Image reprojected_depth = diligent_reprojected_depth(graph, gbuffer);
        const Image hierarchy = diligent_depth_hierarchy(graph, gbuffer, tracing);
        const DiligentMask mask = frames.mask();
        const DiligentRays rays = diligent_trace(graph, gbuffer, hierarchy, numbers, gbuffer.lit, mask, tracing);
        const DiligentResolved resolved = diligent_reconstruct(graph, gbuffer, rays, mask, filter);
        const DiligentHistories histories = diligent_histories(graph, filter);
        diligent_accumulate(graph, gbuffer, reprojected_depth, resolved, histories, mask, filter);
        const Image& radiance = histories.radiance.current;
        return {resolved.radiance, radiance,
                diligent_cleanup(graph, gbuffer, radiance, histories.variance.current, mask, filter)};
    }

    /// Of colours and confidence for a peak of 1, over the pixels that the mask of that frame keeps, but for the share
    /// `left_out` of them that differ most.
    double psnr(const std::string& frame_folder, const std::string& stage, const HostImage& ours, double left_out) {
        const HostImage golden = golden_layer(read_golden(frame_folder + stage + ".exr"), "rad"),
                        mask = golden_layer(read_golden(frame_folder + "aux.exr"), "mask");
        std::vector<double> squares;
        for (size_t i = 0; i < golden.pixel_count(); ++i) {
            if (mask.values[i] != 1) continue;
            squares.push_back(0);
            for (size_t c = 4 * i; c < 4 * i + 4; ++c)
                squares.back() += std::pow(double(ours.values[c]) - golden.values[c], 2) / 4;
        }
        std::ranges::sort(squares);
        squares.resize(squares.size() - size_t(left_out * double(squares.size())));
        EXPECT_GT(squares.size(), 10000u);
        return -10 * std::log10(std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size()));
    }

    /// A pixel whose two candidates of history are alike takes the other one after any rounding, and its neighbours
    /// follow: one pixel of 28 000 can cost 10 dB. The last thousandth of the pixels apart, all stages of all frames
    /// reach 69 dB.
    void expect_like(const std::string& frame_folder, const std::string& stage, const HostImage& ours) {
        EXPECT_GE(psnr(frame_folder, stage, ours, 0.001), 65.0) << frame_folder << stage;
    }
    /// With all pixels: 60.1 to 65.7 dB.
    void expect_final(const std::string& frame_folder, const std::string& stage, const HostImage& ours) {
        const double all = psnr(frame_folder, stage, ours, 0);
        RecordProperty("psnr", std::to_string(all));
        EXPECT_GE(all, 60.0) << frame_folder << stage;
    }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DiligentChainOf);

TEST_P(DiligentChainOf, RecordedSequence) {
    const auto& [sequence, variant, factor] = GetParam();
    nlohmann::json parameters = diligent_preset(variant);
    parameters.update(diligent_sequence_parameters(sequence));
    parameters["temporal_radiance_stability_factor"] = nlohmann::json::parse(factor);
    const unsigned count = diligent_frame_count(sequence);
    DiligentFrames frames(device(), diligent_golden_frame(sequence, 0).extent(), parameters);
    for (unsigned frame = 0; frame < count; ++frame) {
        const std::string folder = diligent_frame_folder(sequence, frame);
        frames.begin(diligent_golden_frame(sequence, frame));
        const Stages stages = render(frames, golden_layer(read_golden(folder + "noise.exr"), "U"));
        expect_like(folder, "spatial_" + variant, frames.graph.download(stages.resolved));
        expect_like(folder, "temporal_" + variant + "_" + factor, frames.graph.download(stages.accumulated));
        if (frame < count - 1) continue;
        const HostImage reflections = frames.graph.download(stages.reflections);
        expect_like(folder, "bilateral_" + variant + "_" + factor, reflections);
        expect_final(folder, "bilateral_" + variant + "_" + factor, reflections);
    }
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_chain, DiligentChainOf, testing::ValuesIn(recorded_chains()),
                         [](const auto& info) {
                             return golden_test_name(info.param.sequence + info.param.variant + info.param.factor);
                         });

}  // namespace
