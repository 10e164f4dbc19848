// Tracers against what rays truly meet: the yardsticks are as good as they say, and looking at rays changes none. All
// tests play the same frames to the same probe (Player, Probed), and so stand in one file of over 400 lines.
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/study/measuring/rays/answered_rays.h"
#include "experiments/study/measuring/rays/exact_rays.h"
#include "experiments/study/measuring/rays/judged_hits.h"
#include "experiments/study/measuring/render_technique.h"
#include "variants/registry.h"
#include "variants/tracers/outcome.h"
#include "variants/tracers/tracers.h"

#include <gtest/gtest.h>
#include <cstring>

namespace {

using Parameters = nlohmann::json;

size_t differing_bits(const HostImage& a, const HostImage& b) {
    if (a.values.size() != b.values.size()) return std::max(a.values.size(), b.values.size());
    size_t count = 0;
    for (size_t i = 0; i < a.values.size(); ++i) count += std::memcmp(&a.values[i], &b.values[i], sizeof(float)) != 0;
    return count;
}

struct ExactTracers : testing::Test {
    static Device& device() {
        static Device shared;
        return shared;
    }
    void TearDown() override { EXPECT_EQ(device().validation_messages(), std::vector<std::string>()); }

    static std::string message_of(const std::function<void()>& action) {
        try {
            action();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    }
};

/// The frames of a scene in direct light.
struct Player {
    Shot shot;
    Rasterizer rasterizer;
    GBuffer gbuffer;

    Player(const std::string& scene, glm::uvec2 extent, bool has_layers = true)
        : shot(load_shot({.scene = scene, .extent = extent}, scene_search_path())),
          rasterizer(ExactTracers::device(), shot.scene, {.extent = extent, .has_depth_layers = has_layers}) {
        play(0);
    }
    void play(unsigned frame) {
        gbuffer = rasterizer.render(shot.camera, {.extent = shot.config.extent, .frame = frame});
        rasterizer.light_directly(gbuffer);
    }
    const CameraData& camera() const { return rasterizer.camera(); }
    HostGBuffer host() { return download_gbuffer(rasterizer.pass_list(), gbuffer, camera(), DepthFormat::d32f); }
};

/// A technique at one point of its parameters, with a probe plugged in that knows the scene.
struct Probed {
    Player& player;
    std::unique_ptr<Technique> technique;
    PassList pass_list;
    RayProbe probe;
    ExactRays exact;

    Probed(Player& player, const std::string& name, const Parameters& parameters = Parameters::object(),
           const std::string& preset = "")
        : player(player),
          technique(make_technique(name, parameters, preset)),
          pass_list(ExactTracers::device(), player.shot.config.extent),
          exact(player.shot, 0, player.camera()) {
        technique->ray_probe = &probe;
        probe.exact_hits = [this](const RecordedRays& recorded) { return exact.hits(recorded); };
        probe.answers = [this](const RecordedRays& marched, const AskedRays& asked) {
            const GBuffer& g = this->player.gbuffer;
            const AnsweredRays answered({.lit = pass_list.download(g.lit),
                                         .fallback = pass_list.download(g.fallback),
                                         .normal = pass_list.download(g.normal),
                                         .reflectance = {},
                                         .true_specular = {}});
            return answered.choose(marched, exact.hits(marched), asked);
        };
    }
    Reflections render(unsigned seed = 0) {
        return render_technique(pass_list, *technique, player.camera(), seed, player.gbuffer);
    }
    /// Quantities of the rays of a frame, by pass.
    std::map<std::string, std::map<std::string, double>> judge(unsigned seed = 0) {
        probe.is_recording = true;
        render(seed);
        JudgedHits judged;
        for (const RecordedRays& recorded : probe.recorded)
            judged.add(seed, recorded, exact.hits(recorded), player.shot.config.extent, 1, {{.name = "all"}});
        std::map<std::string, std::map<std::string, double>> quantities;
        for (const HitRow& row : judged.rows({})) quantities[row.stage][row.quantity] = row.value;
        return quantities;
    }
};

constexpr glm::uvec2 small(96, 54);

}  // namespace

TEST_F(ExactTracers, ExactSceneIsRightAboutEveryRay) {
    struct Technique {
        const char* scene;
        const char* name;
        const char* preset;
        Parameters parameters;
        size_t passes;
    };
    for (const Technique& t :
         {Technique{"mirror_pillars", "mcguire_dda", "", {}, 1},
          {"roughness_gradient", "amd_sssr", "corrected", {{"samples_per_quad", 4}}, 1},
          {"roughness_gradient", "diligent_ssr", "best", {}, 1},
          // Probes, smooth and rough surfaces.
          {"roughness_gradient", "frostbite_sssr", "best", {{"min_rays", 2}, {"max_rays", 4}}, 3}}) {
        Player player(t.scene, small);
        Parameters parameters = t.parameters;
        parameters["tracer"] = "exact_scene";
        if (t.passes > 1) parameters["rough_tracer"] = "exact_scene";
        Probed probed(player, t.name, parameters, t.preset);
        const auto passes = probed.judge(3);
        EXPECT_EQ(passes.size(), t.passes) << t.name;
        for (const auto& [stage, quantities] : passes) {
            EXPECT_EQ(quantities.at("correct"), 1.0) << stage;
            EXPECT_GT(quantities.at("right"), 0.05) << stage << ": some are hits";
            EXPECT_LT(quantities.at("right"), 0.999) << stage << ": some are none";
            EXPECT_EQ(quantities.at("distance_error"), 0.0) << stage;
        }
    }
}

/// With all rays answered a technique is one with the tracer exact_scene, with none it is itself; between them each ray
/// ends where the one or the other lets it end.
TEST_F(ExactTracers, AnsweredRaysEndAsExactOnesAndAllOthersAsTheMarchs) {
    struct Technique {
        const char* name;
        const char* preset;
        Parameters march, exact;
    };
    for (const Technique& t :
         {Technique{"mcguire_dda", "any_scale", {}, {{"tracer", "exact_scene"}}},
          {"amd_sssr", "corrected", {}, {{"tracer", "exact_scene"}}},
          {"diligent_ssr", "corrected", {}, {{"tracer", "exact_scene"}}},
          {"frostbite_sssr", "best", {}, {{"tracer", "exact_scene"}, {"rough_tracer", "exact_scene"}}},
          {"simple_ssr", "corrected", {{"rays", 4}}, {{"rays", 4}, {"tracer", "exact_scene"}}},
          {"four_mode_ssr", "corrected", {}, {{"tracer", "exact_scene"}}}}) {
        Player player("roughness_gradient", small);
        const auto radiance = [&](Parameters parameters) {
            Probed probed(player, t.name, parameters, t.preset);
            return probed.pass_list.download(probed.render(3).radiance);
        };
        const auto answered = [&](const char* selector, double share) {
            Parameters parameters = t.march;
            parameters.update({{"exact_rays", selector}, {"exact_share", share}});
            return parameters;
        };
        EXPECT_EQ(differing_bits(radiance(answered("random", 1)), radiance(t.exact)), 0u) << t.name;
        EXPECT_EQ(differing_bits(radiance(answered("oracle", 0)), radiance(t.march)), 0u) << t.name;

        const auto recorded = [&](const Parameters& parameters) {
            Probed probed(player, t.name, parameters, t.preset);
            probed.probe.is_recording = true;
            probed.render(3);
            return probed.probe.recorded;
        };
        const auto part = recorded(answered("confidence", 0.3)), march = recorded(t.march), exact = recorded(t.exact);
        ASSERT_EQ(part.size(), march.size()) << t.name;
        size_t as_march = 0, as_exact = 0;
        for (size_t pass = 0; pass < part.size(); ++pass)
            for (size_t i = 0; i < part[pass].rays.size(); ++i) {
                const auto is_same = [&](const RayRecord& end) {
                    const RayRecord& found = part[pass].rays[i];
                    return found.outcome == end.outcome && found.position == end.position &&
                           found.distance == end.distance;
                };
                const bool is_march = is_same(march[pass].rays[i]), is_exact = is_same(exact[pass].rays[i]);
                ASSERT_TRUE(is_march || is_exact) << t.name << ' ' << pass << ' ' << i;
                as_march += is_march && !is_exact, as_exact += is_exact && !is_march;
            }
        EXPECT_GT(as_march, 100u) << t.name;
        EXPECT_GT(as_exact, 100u) << t.name;
    }
}

TEST_F(ExactTracers, SeveralRaysOfAPixelAreRecordedEach) {
    Player player("roughness_gradient", small);
    Probed probed(player, "frostbite_sssr", {{"min_rays", 4}, {"max_rays", 4}}, "best");
    probed.probe.is_recording = true;
    probed.render();
    size_t with_four = 0, distinct = 0;
    for (const RecordedRays& recorded : probed.probe.recorded)
        if (recorded.rays_per_pixel == 4)
            for (size_t i = 0; i < recorded.rays.size(); i += 4) {
                if (recorded.rays[i].is_traced == 0 || recorded.rays[i + 3].is_traced == 0) continue;
                ++with_four;
                distinct += recorded.rays[i].direction != recorded.rays[i + 3].direction;
            }
    EXPECT_GT(with_four, 500u);
    EXPECT_GT(distinct, with_four / 2) << "rough surfaces' go different ways";
}

TEST_F(ExactTracers, RecordingChangesNoBit) {
    struct Technique {
        const char* name;
        const char* preset;
        Parameters parameters;
        size_t passes;
    };
    for (const Technique& t : {Technique{"none", "", {}, 0},
                               {"mcguire_dda", "", {}, 1},
                               {"amd_sssr", "corrected", {}, 1},
                               {"diligent_ssr", "current", {{"tracer", "exact_layer"}}, 1},
                               {"frostbite_sssr", "best", {{"max_rays", 4}, {"rough_tracer", "dda"}}, 3}}) {
        Player player("passing_pillars", small);
        Probed plain(player, t.name, t.parameters, t.preset), recorded(player, t.name, t.parameters, t.preset);
        ASSERT_EQ(plain.technique->not_repeatable(), "") << t.name;
        plain.technique->ray_probe = nullptr;
        recorded.probe.is_recording = true;
        for (unsigned frame = 0; frame < 3; ++frame) {  // what was recorded must not show in histories either
            player.play(frame);
            const Reflections a = plain.render(5), b = recorded.render(5);
            const std::string where = std::string(t.name) + " " + t.preset + ", frame " + std::to_string(frame);
            EXPECT_EQ(differing_bits(plain.pass_list.download(a.radiance), recorded.pass_list.download(b.radiance)), 0u)
                << where;
            EXPECT_EQ(differing_bits(plain.pass_list.download(a.confidence), recorded.pass_list.download(b.confidence)),
                      0u)
                << where;
            EXPECT_EQ(recorded.probe.recorded.size(), t.passes) << where;
        }
    }
}

/// Costs are counted by shaders that differ from those that run.
TEST_F(ExactTracers, CountingChangesNoBitAndGivesTheSameTwice) {
    Player player("passing_pillars", small);
    const auto technique = [&] { return Probed(player, "amd_sssr", {}, "corrected"); };
    Probed plain = technique(), counted = technique(), again = technique();
    CostCounter counter, another;
    for (unsigned frame = 0; frame < 2; ++frame) {
        player.play(frame);
        if (frame == 1) counted.pass_list.watch(&counter), again.pass_list.watch(&another);
        const Reflections a = plain.render(5), b = counted.render(5);
        again.render(5);
        EXPECT_EQ(differing_bits(plain.pass_list.download(a.radiance), counted.pass_list.download(b.radiance)), 0u);
    }
    const std::vector<PassCost> costs = counter.costs(), twice = another.costs();
    ASSERT_GT(costs.size(), 5u);
    ASSERT_EQ(costs.size(), twice.size());
    for (size_t i = 0; i < costs.size(); ++i)
        for (const CostQuantity& quantity : cost_quantities)
            EXPECT_EQ(costs[i].*quantity.member, twice[i].*quantity.member) << costs[i].stage << ' ' << quantity.name;
}

/// What the tracer itself says that it fetched, and what the pass reads besides, by its shader.
TEST_F(ExactTracers, CountedFetchesAreThoseOfTheRecordedRays) {
    Player player("fence", {160, 90});
    Probed probed(player, "mcguire_dda", {{"tracer", "fixed_stride"}, {"fixed_stride.front_faces_only", false}});
    probed.probe.is_recording = true;
    probed.render();
    size_t expected = 0;
    for (const RayRecord& ray : probed.probe.recorded.at(0).rays)
        if (ray.is_traced > 0) expected += ray.fetches + 3;  // depth, normal, geometric normal of where it starts
    const size_t of_rays = expected;
    const HostGBuffer g = player.host();
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        ++expected;  // depth
        if (g.depth.values[i] == g.camera.depth.z) continue;
        const bool has_diffuse_specular = g.emission.values[4 * i + 3] > 0;  // then nobody asks for the base colour's
        expected += has_diffuse_specular ? 1 : 2;
        if (has_diffuse_specular || g.base_color.values[4 * i + 3] > 0) ++expected;  // normal
    }
    EXPECT_GT(of_rays, expected / 2);
    probed.probe.is_recording = false;
    CostCounter counter;
    probed.pass_list.watch(&counter);
    probed.render();
    const std::vector<PassCost> costs = counter.costs();
    ASSERT_EQ(costs.at(0).stage, "mcguire_dda/trace");
    EXPECT_EQ(costs[0].fetches, expected);
    EXPECT_EQ(costs[0].invocations, 160u * 96) << "by 8 x 8 pixels";
}

TEST_F(ExactTracers, WhatIsRecordedIsWhatWasTraced) {
    Player player("fence", {160, 90});
    Probed probed(player, "mcguire_dda");
    probed.probe.is_recording = true;
    probed.render();
    ASSERT_EQ(probed.probe.recorded.size(), 1u);
    const RecordedRays& recorded = probed.probe.recorded.front();
    EXPECT_EQ(recorded.stage, "mcguire_dda/trace");
    ASSERT_EQ(recorded.rays.size(), 160u * 90);
    const HostGBuffer g = player.host();
    const HostImage ends = probed.pass_list.download(probed.pass_list.image("hit", Format::rgba32f));
    size_t traced = 0, hits = 0, fetches = 0;
    for (unsigned y = 0; y < 90; ++y)
        for (unsigned x = 0; x < 160; ++x) {
            const RayRecord& ray = recorded.rays[y * 160 + x];
            const bool has_specular = g.base_color.pixel(x, y)[3] > 0 || g.emission.pixel(x, y)[3] > 0;
            const bool reflects = *g.material_id.pixel(x, y) > 0 && has_specular && g.normal.pixel(x, y)[3] <= 0.6f;
            ASSERT_EQ(ray.is_traced > 0, reflects) << x << ", " << y;
            traced += reflects;
            if (!reflects) continue;
            ASSERT_NEAR(glm::length(ray.direction), 1, 1e-5) << "unit, as far as floats go";
            ASSERT_NEAR(-ray.origin.z, view_distance(g.camera, *g.depth.pixel(x, y)), 1e-4f * -ray.origin.z)
                << "of the pixel's surface, with the precision of its depth";
            fetches += ray.fetches;
            const float* end = ends.pixel(x, y);
            ASSERT_EQ(ray.outcome == outcome_hit, end[3] > 0);
            ASSERT_EQ(ray.confidence, end[3]);
            if (ray.outcome != outcome_hit) continue;
            ++hits;
            ASSERT_EQ(ray.distance, end[2]);
            ASSERT_NEAR(ray.position.x, end[0] * 160, 1e-4) << "uv of a position, rounded";
            ASSERT_NEAR(ray.position.y, end[1] * 90, 1e-4);
            ASSERT_EQ(ray.pixel, glm::uvec2(ray.position));
        }
    EXPECT_GT(traced, 3000u);
    EXPECT_LT(traced, 160u * 90);
    EXPECT_GT(hits, 1000u);
    EXPECT_GT(fetches, 5 * traced) << "pixel by pixel along the line";
}

TEST_F(ExactTracers, ExactLayerIsRightAtLeastAsOftenAsOthers) {
    // Measured, less half a thousandth: each of its rules is worth as little as a thousandth of one scene's rays.
    for (const auto& [scene, bound] : {std::pair("fence", 0.8640),
                                       {"floating_holes", 0.9859},
                                       {"curved_mirror", 0.9946},
                                       {"mirror_pillars", 0.9668},
                                       {"grazing", 0.9800}}) {
        Player player(scene, {160, 90});
        const auto correct = [&](const std::string& tracer) {
            return Probed(player, "mcguire_dda", {{"tracer", tracer}}).judge().at("mcguire_dda/trace").at("correct");
        };
        const double yardstick = correct("exact_layer");
        for (const char* tracer : {"dda", "hierarchy", "frostbite_hierarchical", "frostbite_linear"})
            // Within a pixel of a silhouette it is for the samples to decide, and for luck: 0.2 % of rays.
            EXPECT_GT(yardstick, correct(tracer) - 0.002) << scene << ", " << tracer;
        EXPECT_GT(yardstick, bound) << scene;
    }
}

TEST_F(ExactTracers, TheSecondLayerOnlyEndsRays) {
    Player player("floating_holes", {160, 90});
    const auto rays_of = [&](const char* layers) {
        Probed probed(player, "mcguire_dda", {{"dda.layers", layers}});
        probed.probe.is_recording = true;
        probed.render();
        return probed.probe.recorded.at(0).rays;
    };
    const std::vector<RayRecord> one = rays_of("1"), two = rays_of("2");
    size_t hidden = 0;
    for (size_t i = 0; i < one.size(); ++i) {
        ASSERT_NE(one[i].outcome, outcome_hidden);
        if (two[i].outcome == outcome_hidden) {
            ++hidden;
            ASSERT_LE(two[i].distance, one[i].distance) << i;
            continue;
        }
        ASSERT_EQ(two[i].outcome, one[i].outcome) << i;
        ASSERT_EQ(two[i].distance, one[i].distance) << i;
        ASSERT_EQ(two[i].pixel, one[i].pixel) << i;
    }
    EXPECT_GT(hidden, 50u);
}

TEST_F(ExactTracers, WhoCannotAskOrSeeIsToldSo) {
    Player player("fence", small, false);
    Probed asking(player, "mcguire_dda", {{"tracer", "exact_scene"}});
    EXPECT_TRUE(asking.technique->uses_scene_data());
    const std::string no_scene =
        "the tracer exact_scene, and exact_rays, use scene data, which only ssrlab's commands provide, and not for "
        "captures";
    asking.probe.exact_hits = {}, asking.probe.answers = {};
    EXPECT_EQ(message_of([&] { asking.render(); }), no_scene);
    asking.technique->ray_probe = nullptr;
    EXPECT_EQ(message_of([&] { asking.render(); }), no_scene);
    Probed asking_some(player, "mcguire_dda", {{"exact_rays", "random"}});
    asking_some.probe.answers = {};
    EXPECT_EQ(message_of([&] { asking_some.render(); }), no_scene);
    Probed giving_up(player, "amd_sssr", {{"exact_rays", "random"}}, "sdk_1_5");
    EXPECT_TRUE(message_of([&] {
                    giving_up.render();
                }).starts_with("exact_rays needs a march whose rays do not depend on each other; "));
    Probed asking_twice(player, "mcguire_dda", {{"tracer", "exact_scene"}, {"exact_rays", "random"}});
    EXPECT_EQ(message_of([&] { asking_twice.render(); }),
              "exact_rays lets the scene answer some rays, tracer = exact_scene all of them: one of both is enough");

    for (const Parameters& parameters : {Parameters{{"tracer", "exact_layer"}}, Parameters{{"dda.layers", "2"}}}) {
        Probed seeing(player, "mcguire_dda", parameters);
        EXPECT_TRUE(seeing.technique->needs_depth_layers());
        EXPECT_EQ(message_of([&] { seeing.render(); }),
                  "the chosen tracer reads the layer behind the visible surfaces: captures lack it, and scenes' frames "
                  "have it only if the technique's needs_depth_layers() returns true");
    }
    Probed by_parameter(player, "mcguire_dda",
                        {{"tracer", "exact_layer"}, {"exact_layer.thickness_from", "parameter"}});
    EXPECT_FALSE(by_parameter.technique->needs_depth_layers());
    EXPECT_EQ(message_of([&] { by_parameter.render(); }), "no error");
}

TEST_F(ExactTracers, DiligentFxKeepsItsLimitsWithWhatFits) {
    Player player("roughness_gradient", small);
    for (const TracerEntry& tracer : tracer_table()) {
        Probed probed(player, "diligent_ssr", {{"tracer", tracer.name}});
        EXPECT_EQ(tracer.fits_webgl2, tracer.name != "exact_scene") << tracer.name;
        EXPECT_EQ(probed.technique->limits, tracer.fits_webgl2 ? Limits::webgl2 : Limits::none) << tracer.name;
        EXPECT_EQ(message_of([&] { probed.render(); }), "no error") << tracer.name;
        probed.probe.is_recording = true;  // by buffers, which are no part of the technique
        EXPECT_EQ(message_of([&] { probed.render(); }), "no error") << tracer.name;
        EXPECT_EQ(probed.probe.recorded.size(), 1u) << tracer.name;
    }
}
