#include "tests/variants/frostbite_bench.h"
#include "tests/variants/technique_fixture.h"

#include <random>

// The colour pyramid, and which of its levels a hit is read from.

namespace {

struct FrostbiteColor : TechniqueTest {
    std::mt19937 random{2};
    float uniform() { return float(random() >> 8) * 0x1p-24f; }
};

/// The integral of an image, taken as constant over each texel, from its corner to anywhere: bilinear between the sums
/// over whole texels.
class Integral {
public:
    Integral(const HostImage& image, unsigned channel)
        : width_(image.extent.x + 1), sums_(size_t(width_) * (image.extent.y + 1), 0.0) {
        for (unsigned y = 0; y < image.extent.y; ++y)
            for (unsigned x = 0; x < image.extent.x; ++x)
                at(x + 1, y + 1) = image.pixel(x, y)[channel] + at(x, y + 1) + at(x + 1, y) - at(x, y);
    }

    double to(double x, double y) {
        const unsigned i = std::min(unsigned(x), width_ - 2),
                       k = std::min(unsigned(y), unsigned(sums_.size()) / width_ - 2);
        const double upper = glm::mix(at(i, k), at(i + 1, k), x - i);
        return glm::mix(upper, glm::mix(at(i, k + 1), at(i + 1, k + 1), x - i), y - k);
    }

private:
    double& at(unsigned x, unsigned y) { return sums_[size_t(y) * width_ + x]; }

    unsigned width_;
    std::vector<double> sums_;
};

void expect_means(const HostImage& fine, const HostImage& coarse, const std::string& what) {
    const glm::dvec2 ratio = glm::dvec2(fine.extent) / glm::dvec2(coarse.extent);
    for (unsigned channel = 0; channel < 4; ++channel) {
        Integral integral(fine, channel);
        for (unsigned y = 0; y < coarse.extent.y; ++y)
            for (unsigned x = 0; x < coarse.extent.x; ++x) {
                const double left = x * ratio.x, top = y * ratio.y;
                const double right = left + ratio.x, bottom = top + ratio.y;
                const double sum = integral.to(right, bottom) - integral.to(left, bottom) - integral.to(right, top) +
                                   integral.to(left, top);
                // Sums of at most nine products in float32 of numbers up to 100.
                ASSERT_NEAR(coarse.pixel(x, y)[channel], sum / (ratio.x * ratio.y), 1e-4)
                    << what << " at " << x << ", " << y;
            }
    }
}

TEST_F(FrostbiteColor, LevelsAreMeansAtAnySize) {
    for (const glm::uvec2 extent : {glm::uvec2(64, 32), glm::uvec2(1, 1), glm::uvec2(7, 5), glm::uvec2(1, 9),
                                    glm::uvec2(101, 67), glm::uvec2(255, 3)}) {
        PassList pass_list(device(), extent);
        const ParameterSet none;
        pass_list.begin_frame({}, none, {});
        HostImage color(extent, 4);
        for (float& value : color.values) value = 100 * uniform();
        const Image lit = pass_list.image("lit", Format::rgba32f);
        pass_list.upload(lit, color);
        const Image pyramid = frostbite_color_pyramid(pass_list, lit);
        HostImage fine = pass_list.download(pyramid.mip(0));
        EXPECT_EQ(fine.values, color.values);
        for (unsigned level = 1; level < pyramid.mips; ++level) {
            const HostImage coarse = pass_list.download(pyramid.mip(level));
            ASSERT_EQ(coarse.extent, max(fine.extent / 2u, 1u));
            expect_means(fine, coarse, "level " + std::to_string(level) + " of " + std::to_string(extent.x));
            fine = coarse;
        }
        EXPECT_EQ(fine.extent, glm::uvec2(1));
    }
}

/// A pyramid whose levels show their number.
Image numbered_levels(PassList& pass_list) {
    const unsigned mips = 9;  // of 256 pixels
    const Image pyramid = pass_list.image("numbered", Format::rgba32f, mips);
    for (unsigned level = 0; level < mips; ++level) {
        const Image mip = pyramid.mip(level);
        pass_list.upload(mip, HostImage(mip.extent, 4, float(level)));
    }
    return pyramid;
}

/// Half of what is left of a lobe, seen along the normal, is mirrored into a cone of this half angle (tangent): the
/// angle from the normal up to which half of the distribution of normals (Walter et al. 2007, eq. 33) lies that is
/// left, by summing it up, twice.
double tangent_of_half(double alpha, double bias) {
    const double step = 2e-3 * alpha;
    double below = 0;
    for (double polar = step / 2;; polar += step) {
        const double c = std::cos(polar), s = std::sin(polar), t = s * s + alpha * alpha * c * c;
        below += 2 * alpha * alpha / (t * t) * c * s * step;
        if (below >= 0.5 * (1 - bias)) return std::tan(2 * polar);
    }
}

struct FrostbiteLevels : FrostbiteColor {
    static constexpr glm::uvec2 extent{256, 192};
    CameraPose pose{.vertical_fov = 0.9f};

    /// A wall that the camera sees more and more obliquely to the right.
    static SyntheticHit wall(const CameraRay& ray) {
        const float across = ray.direction.x / -ray.direction.z;
        return {.distance = 4,
                .normal = normalize(glm::vec3(3 * across + 0.3f, 0, 1)),
                .roughness = 0.1f + 0.4f * (ray.direction.y + 0.5f),
                .metalness = 1,
                .specular = 1};
    }

    /// Places of the hits as the rays of each pixel say them: anywhere in front of the camera.
    std::vector<StoredRay> rays_to_hits(FrostbiteBench& bench, std::vector<glm::vec3>& hits) {
        std::vector<StoredRay> rays;
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const CameraRay ray = camera_ray(pose, extent, glm::vec2(x, y) + 0.5f);
                const SyntheticHit surface = wall(ray);
                const glm::vec3 position = ray.origin + surface.distance * ray.direction;
                glm::vec3 direction = reflect(ray.direction, surface.normal);
                float length = 0.01f * std::exp(7 * uniform());
                if (position.z + length * direction.z > -0.2f) direction.z = -std::abs(direction.z);
                hits.push_back(position + length * direction);
                rays.push_back({.direction = direction,
                                .inverse_density = 1,
                                .target = unsigned(uniform() * float(extent.x)) | 100u << 16,
                                .length = length});
            }
        bench.set_frame(0, 0);
        return rays;
    }

    static double row_of(const CameraData& camera, glm::dvec3 position) {
        const glm::dvec4 clip = glm::dmat4(camera.clip_from_view) * glm::dvec4(position, 1);
        return clip.y / clip.w * 0.5 * extent.y;
    }

    void expect_levels(const nlohmann::json& overrides) {
        nlohmann::json parameters = {
            {"taps", "1"}, {"half_resolution", false}, {"neighbor_ray", "direction"}, {"previous_frame", false}};
        parameters.update(overrides);
        FrostbiteBench bench(device(), pose, {.extent = extent}, wall, parameters);
        std::vector<glm::vec3> hits;
        const std::vector<StoredRay> rays = rays_to_hits(bench, hits);
        const HostImage found = bench.resolve(rays, numbered_levels(bench.pass_list)).radiance;
        unsigned compared = 0, sharp = 0, oblique = 0;
        for (unsigned i = 0; i < rays.size(); ++i) {
            const CameraRay ray = camera_ray(pose, extent, glm::vec2(i % extent.x, i / extent.x) + 0.5f);
            const SyntheticHit surface = wall(ray);
            const float mu_o = -dot(ray.direction, surface.normal), r = surface.roughness;
            if (mu_o < 0.01f || r > 0.6f || dot(rays[i].direction, surface.normal) < 0.01f) continue;
            const double bias = float(bench.ray_parameters.importance_bias),
                         scale = float(bench.resolve_parameters.cone_scale);
            double tangent = scale * tangent_of_half(r * r, bias);
            if (bench.resolve_parameters.grazing_cone.is("published"))
                tangent *= glm::mix(std::clamp(2.0 * mu_o, 0.0, 1.0), 1.0, std::sqrt(double(r)));
            if (bench.resolve_parameters.grazing_cone.is("lobe")) tangent *= std::sqrt((1 + 2 * mu_o * mu_o) / 3);
            const glm::vec3 radius(0, float(tangent) * rays[i].length, 0);
            const double pixels =
                std::abs(row_of(bench.camera, hits[i] + radius) - row_of(bench.camera, hits[i] - radius));
            const double level = std::clamp(std::log2(pixels) - 1, 0.0, 8.0);
            // Vulkan guarantees levels no finer than 1 / 16; lavapipe and GPUs have 1 / 256. The sum's steps are
            // 0.5 % of the angle at most: 0.007 of a level.
            ASSERT_NEAR(found.values[4 * i], level, 0.02) << i << " of " << parameters;
            ++compared;
            sharp += level == 0;
            oblique += level > 0 && mu_o < 0.5f;
        }
        EXPECT_GT(compared, 10000u);
        EXPECT_LT(sharp, compared * 7 / 10);
        EXPECT_TRUE(oblique > 1000 || pose.is_orthographic) << oblique;
    }
};

TEST_F(FrostbiteLevels, FitTheConeAtTheHit) {
    expect_levels({{"importance_bias", 0.0}});
    expect_levels({{"importance_bias", 0.7}});
    expect_levels({{"importance_bias", 0.15}, {"grazing_cone", "lobe"}});
    expect_levels({{"cone_scale", 2.5}, {"grazing_cone", "off"}});
    pose.is_orthographic = true;
    pose.orthographic_height = 5;
    expect_levels({{"importance_bias", 0.1}, {"grazing_cone", "off"}, {"max_roughness", 0.6}});
}

}  // namespace
