#include "groundtruth/environment_table.h"

#include "core/shared/environment.h"
#include "groundtruth/lobes.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr unsigned max_cells_across = 1024;

/// Mean luminance of the bilinearly filtered image over each texel: positive wherever the image is.
std::vector<float> texel_means(const HostImage& image) {
    const int width = int(image.extent.x), height = int(image.extent.y);
    const float tent[3] = {0.125f, 0.75f, 0.125f};
    std::vector<float> means(image.pixel_count(), 0.0f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const int from_x = (x + dx + width) % width, from_y = std::clamp(y + dy, 0, height - 1);
                    means[size_t(y) * width + x] +=
                        tent[dx + 1] * tent[dy + 1] * luminance(image.rgb(size_t(from_y) * width + from_x));
                }
    return means;
}

}  // namespace

EnvironmentTable::EnvironmentTable(const Environment& environment, bool compensate) : rotation_(environment.rotation) {
    const bool is_image = environment.type == Environment::Type::image;
    const glm::uvec2 extent = is_image ? environment.latlong.extent : glm::uvec2(2, 1);
    // A cell is a block of texels; the last one of a row or column may be smaller.
    const unsigned block = (extent.x + max_cells_across - 1) / max_cells_across;
    width_ = (extent.x + block - 1) / block;
    height_ = (extent.y + block - 1) / block;
    cell_extent_ = glm::vec2(float(block) / float(extent.x), float(block) / float(extent.y));

    std::vector<double> sum(size_t(width_) * height_, 0.0), solid_angle(sum.size());
    const std::vector<float> means = is_image ? texel_means(environment.latlong) : std::vector<float>(2, 1.0f);
    for (unsigned y = 0; y < extent.y; ++y) {
        const double top = std::cos(M_PI * y / extent.y), bottom = std::cos(M_PI * (y + 1) / extent.y);
        const double texel_angle = 2 * M_PI / extent.x * (top - bottom);
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t cell = size_t(y / block) * width_ + x / block;
            sum[cell] += texel_angle * means[size_t(y) * extent.x + x];
            solid_angle[cell] += texel_angle;
        }
    }
    double total = 0;
    for (double part : sum) total += part;
    mean_luminance_ = is_image ? total / (4 * M_PI) : luminance(environment.color);
    if (compensate)
        for (size_t i = 0; i < sum.size(); ++i) sum[i] = std::max(0.0, sum[i] - mean_luminance_ * solid_angle[i]);

    cells_ = AliasTable(sum);
    density_.resize(cells_.size());
    for (size_t i = 0; i < density_.size(); ++i) density_[i] = float(cells_.probability(i) / solid_angle[i]);
}

glm::vec3 EnvironmentTable::sample(glm::uvec2 bits, float& pdf) const {
    const auto [cell, rest] = cells_.sample(bits.x);
    pdf = density_[cell];
    const float x = float(rest) * 0x1p-32f, y = float(bits.y) * 0x1p-32f;
    const float column = float(cell % width_), row = float(cell / width_);
    const float u0 = column * cell_extent_.x, u1 = std::min(1.0f, u0 + cell_extent_.x);
    const float top = std::cos(pi * row * cell_extent_.y),
                bottom = std::cos(pi * std::min(1.0f, (row + 1) * cell_extent_.y));
    const float v = std::acos(std::clamp(top + y * (bottom - top), -1.0f, 1.0f)) / pi;
    return environment_direction({u0 + x * (u1 - u0), v}, rotation_);
}

float EnvironmentTable::pdf(glm::vec3 direction) const {
    const glm::vec2 cell = environment_uv(direction, rotation_) / cell_extent_;
    const unsigned x = std::min(unsigned(cell.x), width_ - 1), y = std::min(unsigned(cell.y), height_ - 1);
    return density_[size_t(y) * width_ + x];
}
