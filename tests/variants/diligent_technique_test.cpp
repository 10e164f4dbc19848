// DiligentFX's technique as a whole.
#include "tests/variants/diligent_frames.h"
#include "tests/variants/diligent_sequence.h"
#include "tests/variants/mirror_scenes.h"
#include "variants/common/blue_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace {

const char* const presets[] = {"april_2024", "current", "corrected"};

nlohmann::json preset_parameters(const std::string& name) {
    return std::ranges::find(find_technique("diligent_ssr").presets, name, &Preset::name)->parameters;
}

bool are_same(const HostImage& a, const HostImage& b) {  // in what is not a number, too
    return std::ranges::equal(a.values, b.values, {}, std::bit_cast<uint32_t, float>, std::bit_cast<uint32_t, float>);
}

struct DiligentTechnique : DiligentSequence {
    /// glossy_floor before a wall that shines more from frame to frame, seen by a camera that moves.
    std::vector<HostGBuffer> lively_frames(unsigned count) {
        return frames(count, [](unsigned frame) -> SyntheticScene {
            return [=](const CameraRay& ray) {
                SyntheticHit hit = glossy_floor(ray);
                hit.lit *= 1.0f + 0.25f * float(frame);
                return hit;
            };
        });
    }

    /// The passes of the last of these frames, run one by one on one pass_list.
    HostImage by_hand(const std::vector<HostGBuffer>& hosts, const std::string& preset, const nlohmann::json& changes) {
        nlohmann::json parameters = preset_parameters(preset);
        parameters.update(changes);
        parameters.erase("repair_inputs");  // a pass before all of these
        DiligentFrames frame(device(), view.extent, parameters);
        const auto& [params, tracing, filter] = frame.parameters;
        PassList& pass_list = frame.pass_list;
        BlueNoise noise;
        Image reflections;
        for (size_t i = 0; i < hosts.size(); ++i) {
            frame.begin(hosts[i]);
            const GBuffer& gbuffer = frame.gbuffer;
            const bool is_corrected = preset == "corrected";
            const Image numbers =
                noise.render(pass_list, is_corrected ? NoiseShift::r2 : NoiseShift::golden_diagonal_from_half,
                             is_corrected ? NoisePrecision::float_32 : NoisePrecision::bits_8, NoiseStage::fragment);
            const Image color = pass_list.image("color", Format::rgba32f);
            pass_list.upload(color, hosts[tracing.previous_frame && i > 0 ? i - 1 : i].lit);
            const Image depth_before = diligent_reprojected_depth(pass_list, gbuffer);
            const Tracers::Images hierarchies = diligent_depth_hierarchies(pass_list, gbuffer, tracing);
            const DiligentMask mask = frame.mask();
            const DiligentRays rays = diligent_trace(pass_list, gbuffer, hierarchies, numbers, color, mask, tracing);
            const DiligentResolved resolved = diligent_reconstruct(pass_list, gbuffer, rays, mask, filter);
            const DiligentHistories histories = diligent_histories(pass_list, filter);
            diligent_accumulate(pass_list, gbuffer, depth_before, resolved, histories, mask, filter);
            reflections = diligent_cleanup(pass_list, gbuffer, histories.radiance.current, histories.variance.current,
                                           mask, filter);
        }
        return pass_list.download(reflections);
    }
};

TEST_F(DiligentTechnique, RoughnessThatIsTakenForAlphaIsTheRootOfIt) {
    const auto of_roughness = [&](float roughness, bool is_perceptual) {
        const std::vector<HostGBuffer> hosts = frames(2, [=](unsigned) -> SyntheticScene {
            return [=](const CameraRay& ray) {
                SyntheticHit hit = glossy_floor(ray);
                if (hit.metalness > 0) hit.roughness = roughness;
                return hit;
            };
        });
        return render(*make_technique("diligent_ssr", {{"roughness_perceptual", is_perceptual},
                                                       {"float_roughness", true},
                                                       {"roughness_threshold", 0.5}}),
                      hosts);
    };
    EXPECT_TRUE(are_same(of_roughness(0.0625f, false), of_roughness(0.25f, true)));
    EXPECT_FALSE(are_same(of_roughness(0.0625f, true), of_roughness(0.25f, true)));
}

TEST_F(DiligentTechnique, RunsItsPassesInOrder) {
    const std::vector<HostGBuffer> hosts = lively_frames(3);
    for (const std::string preset : presets) {
        std::vector<HostImage> results;
        for (const bool is_half : {false, true})
            for (const bool is_previous : {false, true}) {
                SCOPED_TRACE(testing::Message() << preset << ", half " << is_half << ", previous " << is_previous);
                const nlohmann::json changes = {{"half_resolution", is_half}, {"previous_frame", is_previous}};
                results.push_back(render(hosts, changes, preset));
                EXPECT_TRUE(are_same(results.back(), by_hand(hosts, preset, changes)));
            }
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = 0; j < i; ++j) EXPECT_FALSE(are_same(results[i], results[j])) << preset << i << j;
    }
}

/// The wall shines by the number of the frame.
TEST_F(DiligentTechnique, PreviousFrameShowsTheLastFramesColoursFromTheSecondOn) {
    speed = glm::vec3(0);
    const auto scene_of = [](unsigned frame) -> SyntheticScene {
        return [=](const CameraRay& ray) {
            SyntheticHit hit = floor_before_white(ray);
            hit.lit *= float(frame + 1);
            return hit;
        };
    };
    for (const std::string preset : presets)
        for (const bool is_previous : {false, true})
            for (const unsigned count : {1u, 2u, 4u}) {
                SCOPED_TRACE(testing::Message() << preset << ", previous " << is_previous << ", " << count);
                const HostImage found =
                    render(frames(count, scene_of), {{"previous_frame", is_previous}, {"temporal_accumulation", false}},
                           preset);
                const float expected = float(is_previous ? std::max(count - 1, 1u) : count);
                unsigned shown = 0;
                for (size_t i = 0; i < found.pixel_count(); ++i) {
                    if (found.values[4 * i + 3] < 0.999f || found.values[4 * i] == 0) continue;  // 0: the floor
                    // A weighted mean of eight equal halves, or such a colour over a confidence.
                    EXPECT_NEAR(found.values[4 * i], expected, 0x1p-9f * expected) << i;
                    ++shown;
                }
                EXPECT_GT(shown, 300u);
            }
}

// Closed forms of mirrors, by a wall that radiates its own horizontal coordinate.

/// What mirrors show, beside what the exact mirror ray of their pixel meets (pixels, to the right).
struct Offset {
    double mean = 0, deviation = 0;
};

struct DiligentMirror : DiligentSequence {
    DiligentMirror() { view.extent = {160, 120}; }

    /// W sr^-1 m^-2 at a place of the wall (m): positive wherever it is seen.
    float light(float x, unsigned frame) const { return 20 + x - wall_speed * float(frame); }

    /// A mirror pixel's exact ray, if it meets the wall well inside the screen: what it shows then, and how much that
    /// changes from pixel to pixel.
    struct Exact {
        float light, per_pixel;
    };
    std::optional<Exact> exact(unsigned x, unsigned y, unsigned frame) const {
        const CameraPose here = pose(frame);
        const auto met_by = [&](unsigned column) {
            const CameraRay ray = camera_ray(here, view.extent, glm::vec2(column, y) + 0.5f);
            const glm::vec3 d = ray.direction, p = ray.origin + d * ((-1 - ray.origin.y) / d.y);
            return p + d * glm::vec3(1, -1, 1) * ((-6 - p.z) / d.z);
        };
        const glm::vec3 met = met_by(x);
        FrameView now = view;
        now.frame = frame;
        const glm::vec4 clip = camera_data(here, nullptr, now).clip_from_world * glm::vec4(met, 1);
        const glm::vec2 from_centre = glm::abs(glm::vec2(clip) / clip.w);
        if (mirror_floor(camera_ray(here, view.extent, glm::vec2(x, y) + 0.5f)).metalness == 0 ||
            glm::any(glm::greaterThan(from_centre, glm::vec2(0.8f))))  // beyond, hits may fade
            return std::nullopt;
        return Exact{light(met.x, frame), met_by(x + 1).x - met.x};
    }

    /// In the last of `count` frames.
    Offset offset(unsigned count, const std::string& preset, const nlohmann::json& changes) {
        const HostImage found = render(frames(count,
                                              [&](unsigned frame) -> SyntheticScene {
                                                  return [=, this](const CameraRay& ray) {
                                                      SyntheticHit hit = mirror_floor(ray);
                                                      const float x = (ray.origin + hit.distance * ray.direction).x;
                                                      if (hit.metalness == 0) hit.lit = glm::vec3(light(x, frame));
                                                      return hit;
                                                  };
                                              }),
                                       changes, preset);
        double sum = 0, squares = 0;
        unsigned pixels = 0;
        for (unsigned y = 0; y < view.extent.y; ++y)
            for (unsigned x = 0; x < view.extent.x; ++x) {
                const std::optional<Exact> expected = exact(x, y, count - 1);
                if (!expected || found.pixel(x, y)[3] < 0.99f) continue;
                const double apart = (found.pixel(x, y)[0] - expected->light) / expected->per_pixel;
                sum += apart;
                squares += apart * apart;
                ++pixels;
            }
        EXPECT_GT(pixels, 1500u);
        const double mean = sum / pixels;
        return {mean, std::sqrt(squares / pixels - mean * mean)};
    }
};

/// A held camera, and a wall that moves to the side with what it shows: what a hit shows now, its place showed then.
TEST_F(DiligentMirror, PreviousFrameFollowsAMovingEmitter) {
    speed = glm::vec3(0);
    wall_speed = 0.5f;  // 7 pixels of the wall
    const nlohmann::json unfiltered = {{"previous_frame", true}, {"temporal_accumulation", false}};
    const Offset found = offset(3, "corrected", unfiltered);
    EXPECT_LT(std::abs(found.mean), 0.1);
    EXPECT_LT(found.deviation, 0.5);  // hits lie anywhere in their pixel
}

/// A camera that moves to the side, by 4 pixels of the floor and 1.4 of what it mirrors: history that lagged behind by
/// a pixel would drag the mirror image along, by nine tenths of it.
TEST_F(DiligentMirror, HistoryFollowsTheMirrorImage) {
    speed = {0.15f, 0, 0};
    const Offset found = offset(8, "corrected", nlohmann::json::object());
    EXPECT_LT(std::abs(found.mean), 0.1);
    EXPECT_LT(found.deviation, 0.5);
}

// The composite.

/// Everything radiates 1: whatever the confidence, the composite should be 1. Where half of the rays hit, the original
/// takes the other half for black before it takes it for the fallback. Rays that see the environment where they miss
/// know all there is.
TEST_F(DiligentTechnique, WhiteDipsToThreeQuartersUnlessPremultipliedOrMissesSeeTheEnvironment) {
    view.extent = {160, 120};
    speed = glm::vec3(0);  // held: moved mirrors would mix confidences, too
    for (const float roughness : {0.0f, 0.05f, 0.1f, 0.19f}) {
        const std::vector<HostGBuffer> hosts = frames(3, [=](unsigned) -> SyntheticScene {
            return [=](const CameraRay& ray) {
                SyntheticHit hit = mirror_floor(ray);
                hit.lit = glm::vec3(1);
                if (hit.metalness > 0) hit.roughness = roughness;
                return hit;
            };
        });
        for (const nlohmann::json& parameters :
             {nlohmann::json::object(), {{"premultiply_confidence", true}}, {{"misses", "fallback"}}}) {
            SCOPED_TRACE(testing::Message() << roughness << ", " << parameters);
            const auto technique = make_technique("diligent_ssr", parameters);
            const HostImage incident = composited_incident(*technique, hosts, 1.0f);
            const auto [low, high] = std::ranges::minmax(incident.values);
            const float lost = 0x1p-9f;  // colour and confidence are halves, which may be truncated
            EXPECT_LT(high, 1 + lost);
            if (!parameters.empty() || roughness == 0) {
                EXPECT_GT(low, 1 - lost);
            } else {
                EXPECT_NEAR(low, 0.75f, 0.003f);
            }
        }
    }
}

// Work that no pixel needs.

/// Rough floors, and floors without a specular term.
TEST_F(DiligentTechnique, LeavesOutWhatChangesNoPixelOfTheComposite) {
    for (const std::string preset : presets)
        for (const bool is_half : {false, true})
            for (const bool is_rough : {false, true}) {
                SCOPED_TRACE(testing::Message() << preset << ", half " << is_half << ", rough " << is_rough);
                const std::vector<HostGBuffer> hosts = frames(2, [=](unsigned) -> SyntheticScene {
                    return [=](const CameraRay& ray) {
                        SyntheticHit hit = glossy_floor(ray);
                        hit.roughness = is_rough ? 0.6f : 0.1f;
                        if (!is_rough) hit.metalness = hit.specular = 0;
                        return hit;
                    };
                });
                const nlohmann::json changes = {{"half_resolution", is_half}, {"previous_frame", is_rough}};
                const auto whole = make_technique("diligent_ssr", changes, preset),
                           less = make_technique("diligent_ssr", changes, preset);
                std::vector<std::string> left_out, stages;
                for (const LeftOut& part : less->leave_out({.has_geometry = true,
                                           .has_reflective = is_rough,
                                           .min_roughness = is_rough ? 0.6f : 1.0f,
                                           .max_roughness = is_rough ? 0.6f : 0.0f}))
                    left_out.push_back(part.what);
                const HostImage all = composited_incident(*whole, hosts, 0.5f);
                for (const PassTime& time : times)
                    if (time.stage != "clear") stages.push_back(time.stage);
                const HostImage some = composited_incident(*less, hosts, 0.5f);
                EXPECT_TRUE(are_same(all, some));
                EXPECT_EQ(times.size(), 1u);
                EXPECT_EQ(times.front().stage, "clear");
                EXPECT_TRUE(std::ranges::is_permutation(left_out, stages));
            }
}

TEST_F(DiligentTechnique, LeavesNothingOutWhereSomethingIsSmooth) {
    for (const std::string preset : presets)
        EXPECT_TRUE(make_technique("diligent_ssr", nlohmann::json::object(), preset)
                        ->leave_out({.has_reflective = true,
                                     .min_roughness = 0.15f,
                                     .max_roughness = 0.9f,
                                     .camera_moves = true,
                                     .has_environment = true,
                                     .has_faulty_inputs = true})
                        .empty());
}

/// Histories included.
TEST_F(DiligentTechnique, RepeatsItselfUnlessTheSeedDiffers) {
    for (const std::string preset : presets) {
        const auto with_seed = [&](unsigned seed) {
            view.seed = seed;
            return render(lively_frames(3), nlohmann::json::object(), preset);
        };
        const HostImage first = with_seed(0), other = with_seed(1);
        EXPECT_FALSE(are_same(first, other)) << preset;
        EXPECT_TRUE(are_same(first, with_seed(0))) << preset;
        EXPECT_TRUE(are_same(other, with_seed(1))) << preset;
    }
}

}  // namespace
