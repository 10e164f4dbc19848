#include "tests/variants/denoiser_tolerance.h"
#include "tests/variants/golden_denoiser.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>

// The denoiser's passes against what the original's shaders wrote, with the bindings of the original's host code: each
// pass fed the recorded inputs, and the chain run freely.

namespace {

struct Golden {
    std::string set, form;
};
void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.set << ", " << golden.form; }

class AmdDenoiserOf : public testing::TestWithParam<Golden> {
protected:
    static const std::vector<GoldenDenoiserFrame>& frames_of(const std::string& set) {
        static std::map<std::string, std::vector<GoldenDenoiserFrame>> read;
        if (!read.contains(set)) read[set] = read_denoiser_frames(set);
        return read[set];
    }
    void SetUp() override { ASSERT_GE(frames.size(), 2u); }
    void TearDown() override { EXPECT_EQ(TechniqueTest::device().validation_messages(), std::vector<std::string>()); }

    const std::vector<GoldenDenoiserFrame>& frames = frames_of(GetParam().set);
    const nlohmann::json meta = golden_meta(GetParam().set);
    const unsigned border = meta.value("compare_border", 0u);
    AmdDenoiserBench bench{TechniqueTest::device(),
                           frames.front().resolved.extent,
                           {{"denoiser_form", GetParam().form},
                            {"stale_average", true},
                            {"barrier_before_average", true},
                            {"roughness_threshold_alpha", meta["parameters"]["roughnessThreshold (alpha)"]},
                            {"temporal_stability_factor", meta["parameters"]["temporalStabilityFactor"]},
                            {"max_samples", meta["parameters"]["max_samples"]}}};

    IsCompared is_compared(size_t frame) const {
        return [&, frame](unsigned x, unsigned y) { return frames[frame].is_compared(x, y, border); };
    }
    IsCompared is_tile_compared(size_t frame) const {
        const unsigned edge = (border + 7) / 8;
        return [&, frame, edge](unsigned x, unsigned y) {
            const HostImage& tiles = frames[frame].inputs.tiles;
            const bool is_inside = std::min(x, y) >= edge && x + edge < tiles.extent.x && y + edge < tiles.extent.y;
            return is_inside && *tiles.pixel(x, y) > 0;
        };
    }
    /// Null: black, as all histories are before the first frame.
    void upload(const Image& image, const HostImage* pixels) {
        bench.upload(image, pixels ? *pixels : HostImage(image.extent, 4));
    }
    void expect(const std::string& what, size_t frame, const Image& ours, const HostImage& theirs,
                const Tolerance& tolerance) {
        expect_near(what + " of frame " + std::to_string(frame), bench.pass_list.download(ours), theirs,
                    is_compared(frame), tolerance);
    }
};

std::vector<Golden> all_sets_and_forms() {
    std::vector<Golden> all;
    for (const std::string& set : golden_denoiser_sets())
        for (const char* form : {"faithful", "fast"}) all.push_back({set, form});
    return all;
}

}  // namespace

TEST_P(AmdDenoiserOf, EachPassFedTheRecordedInputs) {
    for (size_t k = 0; k < frames.size(); ++k) {
        const GoldenDenoiserFrame &now = frames[k], *before = k > 0 ? &frames[k - 1] : nullptr;
        bench.begin_frame(now.inputs, before ? &before->inputs : nullptr);
        const AmdHistories& h = bench.histories;
        upload(h.radiance.previous, before ? &before->resolved : nullptr);
        upload(h.variance.previous, before ? &before->resolved_variance : nullptr);
        upload(h.sample_count.previous, before ? &before->sample_count : nullptr);
        upload(h.average_radiance.previous, before ? &before->average : nullptr);

        amd_reproject(bench.pass_list, bench.gbuffer, bench.work, h, bench.denoiser);
        expect("reprojected radiance", k, bench.reprojected(), now.reprojected, interpolated);
        expect("reprojected variance", k, h.variance.current, now.reprojected_variance, squared_change);
        expect("sample count", k, h.sample_count.current, now.sample_count, one_half);
        expect_near("average radiance of frame " + std::to_string(k),
                    bench.pass_list.download(h.average_radiance.current), now.average, is_tile_compared(k),
                    one_small_float);

        upload(h.variance.current, &now.reprojected_variance);
        amd_prefilter(bench.pass_list, bench.work, h, bench.denoiser);
        expect("prefiltered radiance", k, h.radiance.previous, now.prefiltered, one_half);
        expect("prefiltered variance", k, h.variance.previous, now.prefiltered_variance, squared_change);

        upload(h.radiance.previous, &now.prefiltered);
        upload(h.variance.previous, &now.prefiltered_variance);
        upload(bench.reprojected(), &now.reprojected);
        amd_resolve_temporal(bench.pass_list, bench.work, h, bench.denoiser);
        expect("resolved radiance", k, h.radiance.current, now.resolved, one_half);
        expect("resolved variance", k, h.variance.current, now.resolved_variance, squared_change);
    }
}

/// Histories are our own from the first frame on; traced rays, tiles and G-buffer are the recorded ones. PSNR of rgb
/// over the compared pixels, for a peak of 1 W sr^-1 m^-2: the brightest that a display shows.
TEST_P(AmdDenoiserOf, WholeChainRunFreely) {
    for (size_t k = 0; k < frames.size(); ++k) {
        bench.begin_frame(frames[k].inputs, k > 0 ? &frames[k - 1].inputs : nullptr);
        amd_denoise(bench.pass_list, bench.gbuffer, bench.work, bench.histories, bench.denoiser);
        const HostImage ours = bench.pass_list.download(bench.histories.radiance.current);
        double sum = 0;
        size_t count = 0;
        for (unsigned y = 0; y < ours.extent.y; ++y)
            for (unsigned x = 0; x < ours.extent.x; ++x) {
                if (!frames[k].is_compared(x, y, border)) continue;
                for (unsigned c = 0; c < 3; ++c) {
                    const double d = ours.pixel(x, y)[c] - frames[k].resolved.pixel(x, y)[c];
                    sum += d * d;
                    ++count;
                }
            }
        ASSERT_GT(count, 100u);
        const double psnr = -10 * std::log10(sum / double(count));
        RecordProperty("psnr_of_frame_" + std::to_string(k), std::to_string(psnr));
        EXPECT_GE(psnr, 60.0) << "frame " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(golden_amd_denoiser, AmdDenoiserOf, testing::ValuesIn(all_sets_and_forms()),
                         [](const auto& info) { return golden_test_name(info.param.set + "_" + info.param.form); });
