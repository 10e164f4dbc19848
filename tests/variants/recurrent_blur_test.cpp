// The recurrent blur by what its formulas come to: means and variances of noise over frames, the width of its disk, and
// where history of a mirror is found.
#include "tests/variants/synthetic_gbuffer.h"
#include "tests/variants/technique_fixture.h"
#include "tests/variants/technique_passes.h"

#include <random>

namespace {

/// A wall across the view, which reflects.
SyntheticScene wall(float distance, float roughness) {
    return [=](const CameraRay& ray) -> SyntheticHit {
        return {.distance = distance / -ray.direction.z,
                .normal = {0, 0, 1},
                .roughness = roughness,
                .metalness = 1,
                .specular = 1};
    };
}

struct RecurrentBlurTest : TechniqueTest {
    CameraPose pose{.vertical_fov = 1.0f, .near = 0.1f, .far = 100.0f};
    ParameterSet params;
    glm::uvec2 extent{64, 48};

    RecurrentBlurTest() {  // what makes it other than an average
        add_denoiser(params, "recurrent_blur");
        params.assign({{"max_roughness", 1},
                       {"scale_free", true},
                       {"flicker_suppression", 0},
                       {"adaptive_trust", 0},
                       {"clamp_intensity", 0},
                       {"damp_fireflies", false}});
    }

    /// Frame `frame` of a camera at rest before `scene`, whose pixels' own rays see `seen` (rgb, confidence) and are
    /// `ray_length` (m) long.
    HostImage render(PassList& pass_list, unsigned frame, const SyntheticScene& scene, const HostImage& seen,
                     float ray_length, unsigned seed = 0) {
        const CameraData camera =
            camera_data(pose, frame > 0 ? &pose : nullptr, {.extent = extent, .frame = frame, .seed = seed});
        const GBuffer gbuffer = upload_gbuffer(pass_list, pose, camera, scene);
        pass_list.begin_frame(camera, params, gbuffer.images());
        const Image own_radiance = pass_list.image("own_radiance", Format::rgba32f),
                    own_length = pass_list.image("own_length", Format::r32f);
        pass_list.upload(own_radiance, seen);
        pass_list.upload(own_length, HostImage(extent, 1, ray_length));
        return pass_list.download(blurred(pass_list, gbuffer, own_radiance, own_length));
    }

    static Image blurred(PassList& pass_list, const GBuffer& gbuffer, const Image& radiance, const Image& length) {
        return denoiser_passes("recurrent_blur", pass_list, gbuffer,
                               {{"own_radiance", radiance}, {"own_length", length}})
            .radiance;
    }

    HostImage noise(std::mt19937& random) const {
        std::uniform_real_distribution<float> uniform(0, 1);
        HostImage image(extent, 4, 1.0f);
        for (size_t i = 0; i < image.pixel_count(); ++i) image.set_rgb(i, glm::vec3(uniform(random)));
        return image;
    }
};

double variance_of(const HostImage& image) {
    double sum = 0, squares = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const double value = image.values[4 * i];
        sum += value, squares += value * value;
    }
    const double mean = sum / double(image.pixel_count());
    return squares / double(image.pixel_count()) - mean * mean;
}

/// Without its disk it is a mean over the frames until they are max_frames, then an exponential one: of noise of
/// variance v there is v / n left, then v / (2 max_frames - 1).
TEST_F(RecurrentBlurTest, AveragesFramesAndThenForgets) {
    params.assign({{"spatial_filter", false}, {"max_frames", 6}});
    PassList pass_list(device(), extent);
    std::mt19937 random(7);
    for (unsigned frame = 0; frame < 40; ++frame) {
        const double left = variance_of(render(pass_list, frame, wall(3, 0.5f), noise(random), 1.0f)) * 12;
        const double expected = frame < 6 ? 1.0 / (frame + 1) : 1.0 / 11;
        // The variance of 3072 numbers scatters by a fortieth at most: five of those, one false alarm in a million.
        if (frame < 6 || frame > 30) {
            EXPECT_NEAR(left, expected, 5.0 / 40 * expected) << "frame " << frame;
        }
    }
}

/// In the first frame a point is seen by pixels within the radius alone, 0.1 * radius * ray length * sqrt(roughness),
/// and in frame n by 1 - 0.999 (1 - n^(strength - 1)) of it.
TEST_F(RecurrentBlurTest, ReachesAsFarAsItsDisk) {
    const float distance = 3, ray_length = 2, roughness = 0.64f, wide = 3;
    params.assign(
        {{"radius", wide}, {"adapt", 0}, {"luma_phi", 0}, {"strength", 0.5}, {"smooth_disocclusions", false}});
    const double pixels_per_metre = extent.y / (2 * std::tan(0.5 * pose.vertical_fov) * distance);
    const double first = 0.1 * wide * ray_length * std::sqrt(roughness) * pixels_per_metre;
    for (const unsigned frames : {1u, 4u}) {
        double farthest = 0;
        for (unsigned seed = 0; seed < 24; ++seed) {
            PassList pass_list(device(), extent);
            HostImage image;
            for (unsigned frame = 0; frame < frames; ++frame) {
                HostImage seen(extent, 4, 1.0f);
                for (size_t i = 0; i < seen.pixel_count(); ++i) seen.set_rgb(i, glm::vec3(0));
                const bool is_last = frame + 1 == frames;
                if (is_last) seen.set_rgb(24 * extent.x + 32, glm::vec3(1));
                image = render(pass_list, frame, wall(distance, roughness), seen, ray_length, seed);
            }
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x)
                    if (image.pixel(x, y)[0] > 0)
                        farthest = std::max(farthest, std::hypot(double(x) - 32, double(y) - 24));
        }
        const double expected = first * (1 - 0.999 * (1 - std::pow(frames, -0.5)));
        // The last of eight taps lies at 0.968 of the radius; places are rounded to pixels, by 0.71 at most. Of 24
        // seeds' disks, each turned differently, one reaches the whole pixel before that.
        EXPECT_LE(farthest, 0.968 * expected + 0.71) << frames << " frames";
        EXPECT_GE(farthest, 0.968 * expected - 1.0) << frames << " frames";
    }
}

/// A camera that moves along a mirror: what stands still in it is far behind the surface, and moves with the camera's
/// eye.
TEST_F(RecurrentBlurTest, FindsHistoryWhereTheMirrorShowsIt) {
    const float distance = 2, behind = 6;  // m: of the wall; of what it mirrors, on the same line of sight
    params.assign({{"spatial_filter", false}, {"clamp_intensity", 0}});
    const glm::vec3 step(0.1f, 0, 0);
    const auto stripes = [&](const CameraPose& from) {  // fixed in the mirrored world
        HostImage image(extent, 4, 1.0f);
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const CameraRay ray = camera_ray(from, extent, glm::vec2(x, y) + 0.5f);
                const float at = ray.origin.x + ray.direction.x / -ray.direction.z * (distance + behind);
                image.set_rgb(size_t(y) * extent.x + x, glm::vec3(0.5f + 0.5f * std::sin(2.0f * at)));
            }
        return image;
    };
    const auto error_with = [&](float ray_length) {
        PassList pass_list(device(), extent);
        CameraPose before = pose;
        HostImage expected, found;
        for (unsigned frame = 0; frame < 6; ++frame) {
            CameraPose now = pose;
            now.world_from_view[3] += glm::vec4(float(frame) * step, 0.0f);
            const CameraData camera =
                camera_data(now, frame > 0 ? &before : nullptr, {.extent = extent, .frame = frame});
            const SyntheticScene scene = wall(distance, 0.0f);
            const GBuffer gbuffer = upload_gbuffer(pass_list, now, camera, scene);
            pass_list.upload(gbuffer.motion, motion_of(now, camera, scene));
            pass_list.begin_frame(camera, params, gbuffer.images());
            const Image own_radiance = pass_list.image("own_radiance", Format::rgba32f),
                        own_length = pass_list.image("own_length", Format::r32f);
            expected = stripes(now);
            pass_list.upload(own_radiance, expected);
            // Along the pixel's line of sight, which is longer towards the corners.
            HostImage lengths(extent, 1);
            for (unsigned y = 0; y < extent.y; ++y)
                for (unsigned x = 0; x < extent.x; ++x)
                    *lengths.pixel(x, y) = ray_length / -camera_ray(now, extent, glm::vec2(x, y) + 0.5f).direction.z;
            pass_list.upload(own_length, lengths);
            found = pass_list.download(blurred(pass_list, gbuffer, own_radiance, own_length));
            before = now;
        }
        double squares = 0;
        size_t count = 0;
        for (unsigned y = 8; y < extent.y - 8; ++y)
            for (unsigned x = 16; x < extent.x - 16; ++x, ++count) {
                const double difference = found.pixel(x, y)[0] - expected.pixel(x, y)[0];
                squares += difference * difference;
            }
        return std::sqrt(squares / double(count));
    };
    // Bilinear look-ups of stripes of 20 pixels: 1 % of their amplitude in each of five frames.
    EXPECT_LT(error_with(behind), 0.03);
    EXPECT_GT(error_with(0.01f), 0.1) << "as if they were painted on the wall";
}

}  // namespace
