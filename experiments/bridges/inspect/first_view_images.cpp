#include "experiments/bridges/inspect/first_view_images.h"

#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/png.h"
#include "groundtruth/paths/path_tracer.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr uint8_t other_surface = 1, other_color = 2, other_normal = 4;

FirstViewImages images_of(glm::uvec2 extent) {
    return {.color = HostImage(extent, 3),
            .normal = HostImage(extent, 3),
            .depth = HostImage(extent, 1),
            .material = HostImage(extent, 1)};
}

bool shows_other_surface(const FirstViewImages& a, const FirstViewImages& b, size_t i) {
    constexpr float nearness = 0.01f;
    const float depth_a = a.depth.values[i], depth_b = b.depth.values[i];
    return a.material.values[i] != b.material.values[i] ||
           std::abs(depth_a - depth_b) > nearness * std::max(std::abs(depth_a), std::abs(depth_b));
}

/// Filters of textures round to 8 bits on some devices.
bool has_other_color(glm::vec3 a, glm::vec3 b) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(a[c] - b[c]) <= 0.01f + 0.01f * std::max(std::abs(a[c]), std::abs(b[c])))) return true;
    return false;
}

bool has_other_normal(glm::vec3 a, glm::vec3 b) {
    const float degree = glm::radians(1.0f);
    return !(glm::length(a - b) <= 2.0f * std::sin(0.5f * degree));
}

}  // namespace

FirstViewImages rasterised_first_view(Device& device, const Scene& scene, const FirstView& view) {
    Rasterizer rasterizer(device, scene, {.extent = view.extent, .is_still = true});
    const GBuffer gbuffer = rasterizer.render(scene.camera(""), {.extent = view.extent});
    PassList& pass_list = rasterizer.pass_list();
    const HostImage depth = pass_list.download(gbuffer.depth), base = pass_list.download(gbuffer.base_color),
                    emission = pass_list.download(gbuffer.emission), normal = pass_list.download(gbuffer.normal),
                    material = pass_list.download(gbuffer.material_id);
    FirstViewImages images = images_of(view.extent);
    for (size_t i = 0; i < depth.pixel_count(); ++i) {
        images.material.values[i] = material.values[i];
        if (material.values[i] == 0) continue;
        images.color.set_rgb(i, base.rgb(i) + emission.rgb(i));
        images.normal.set_rgb(i, normal.rgb(i));
        images.depth.values[i] = view_distance(rasterizer.camera(), depth.values[i]);
    }
    return images;
}

FirstViewImages traced_first_view(const Scene& scene, const FirstView& view) {
    PathTracerSettings settings;
    settings.learns_lights = false;
    const PathTracer tracer(scene, view.scene, view.camera, view.extent, settings);
    FirstViewImages images = images_of(view.extent);
    tbb::parallel_for(0u, view.extent.y, [&](unsigned y) {
        for (unsigned x = 0; x < view.extent.x; ++x) {
            const FirstHit hit = tracer.first_hit(x, y);
            if (!hit.is_hit) continue;
            const size_t i = size_t(y) * view.extent.x + x;
            images.color.set_rgb(i, hit.base_color + hit.emitted);
            images.normal.set_rgb(i, hit.normal);
            images.depth.values[i] = hit.depth;
            images.material.values[i] = float(hit.material + 1);
        }
    });
    return images;
}

size_t FirstViewDifference::pixels() const {
    return size_t(std::ranges::count_if(differs, [](uint8_t d) { return d != 0; }));
}

FirstViewDifference difference_of(const FirstViewImages& a, const FirstViewImages& b) {
    FirstViewDifference difference;
    difference.differs.resize(a.depth.pixel_count());
    for (size_t i = 0; i < difference.differs.size(); ++i) {
        uint8_t& differs = difference.differs[i];
        if (shows_other_surface(a, b, i))
            differs = other_surface;
        else
            differs = (has_other_color(a.color.rgb(i), b.color.rgb(i)) ? other_color : 0) |
                      (has_other_normal(a.normal.rgb(i), b.normal.rgb(i)) ? other_normal : 0);
        difference.surfaces += (differs & other_surface) != 0;
        difference.colors += (differs & other_color) != 0, difference.normals += (differs & other_normal) != 0;
    }
    return difference;
}

nlohmann::ordered_json to_json(const FirstViewDifference& difference) {
    return {{"pixels", difference.differs.size()},
            {"differ", difference.pixels()},
            {"other_surface", difference.surfaces},
            {"other_color", difference.colors},
            {"other_normal", difference.normals}};
}

HostImage picture_of(const FirstViewImages& rasterised, const FirstViewImages& traced,
                     const FirstViewDifference& difference, float exposure_ev) {
    constexpr unsigned gap = 4;
    const glm::uvec2 extent = rasterised.depth.extent, cell = extent + gap;
    HostImage picture({3 * cell.x - gap, 3 * cell.y - gap}, 3, 1.0f);
    float nearest = 0;
    for (const float depth : traced.depth.values)
        if (depth > 0 && (nearest == 0 || depth < nearest)) nearest = depth;
    const auto linear = [](glm::vec3 code) {
        return glm::vec3(linear_from_srgb(code.x), linear_from_srgb(code.y), linear_from_srgb(code.z));
    };
    const auto shown = [&](const FirstViewImages& images, unsigned row, size_t i) {
        if (row == 0) return glm::clamp(images.color.rgb(i) * std::exp2(exposure_ev), 0.0f, 1.0f);
        if (images.material.values[i] == 0) return glm::vec3(0.0f);
        if (row == 1) return linear(0.5f + 0.5f * images.normal.rgb(i));
        const float depth = images.depth.values[i];
        return linear(glm::vec3(depth > 0 ? std::clamp(nearest / depth, 0.0f, 1.0f) : 1.0f));
    };
    const std::array<uint8_t, 3> shown_differences = {other_surface | other_color, other_surface | other_normal,
                                                      other_surface};
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned y = 0; y < extent.y; ++y)
            for (unsigned x = 0; x < extent.x; ++x) {
                const size_t i = size_t(y) * extent.x + x;
                const glm::vec3 left = shown(rasterised, row, i), middle = shown(traced, row, i);
                const float grey = 0.25f * (middle.x + middle.y + middle.z) / 3.0f;
                const glm::vec3 right =
                    difference.differs[i] & shown_differences[row] ? glm::vec3(1, 0, 0) : glm::vec3(grey);
                const glm::vec3 columns[] = {left, middle, right};
                for (unsigned column = 0; column < 3; ++column)
                    picture.set_rgb(size_t(row * cell.y + y) * picture.extent.x + column * cell.x + x, columns[column]);
            }
    return picture;
}
