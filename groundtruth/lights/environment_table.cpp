#include "groundtruth/lights/environment_table.h"

#include "core/shared/environment.h"
#include "groundtruth/lights/light_groups.h"
#include "groundtruth/sampling/lobes.h"
#include "groundtruth/sampling/prefetch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

constexpr unsigned max_cells_across = 1024;

/// Parts are made of blocks of cells, so many along the equator at most: 5.6 degrees.
constexpr unsigned blocks_across = 64;
constexpr size_t max_parts = 32;
constexpr float least_part = 0.1f;  ///< chord on the unit sphere below which a part is not divided

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

/// The cells of each part. `power`: of each cell.
std::vector<std::vector<uint32_t>> divide_sky(std::span<const double> power, unsigned width, unsigned height) {
    const unsigned side = (width + blocks_across - 1) / blocks_across;
    const unsigned columns = (width + side - 1) / side, rows = (height + side - 1) / side;
    std::vector<PlacedPower> blocks(size_t(columns) * rows);
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            const glm::vec3 direction =
                environment_direction({(float(column) + 0.5f) / float(columns), (float(row) + 0.5f) / float(rows)}, 0);
            blocks[size_t(row) * columns + column].place = {direction.x, direction.y, direction.z};
        }
    const auto block_of = [&](size_t cell) { return cell / width / side * columns + cell % width / side; };
    for (size_t cell = 0; cell < power.size(); ++cell) blocks[block_of(cell)].power += power[cell];

    const std::vector<std::vector<uint32_t>> divided = divide_lights(blocks, max_parts, least_part);
    std::vector<uint32_t> part_of(blocks.size(), 0);
    for (uint32_t part = 0; part < divided.size(); ++part)
        for (const uint32_t block : divided[part]) part_of[block] = part;
    std::vector<std::vector<uint32_t>> cells(divided.size());
    for (size_t cell = 0; cell < power.size(); ++cell)
        if (power[cell] > 0) cells[part_of[block_of(cell)]].push_back(uint32_t(cell));
    return cells;
}

}  // namespace

EnvironmentTable::EnvironmentTable(const Environment& environment, bool compensate) : environment_(&environment) {
    const bool is_image = environment.type == Environment::Type::image;
    const glm::uvec2 extent = is_image ? environment.latlong.extent : glm::uvec2(blocks_across, blocks_across / 2);
    // A cell is a square of texels; the last one of a row or column may be smaller.
    const unsigned side = (extent.x + max_cells_across - 1) / max_cells_across;
    width_ = (extent.x + side - 1) / side;
    height_ = (extent.y + side - 1) / side;
    cell_extent_ = glm::vec2(float(side) / float(extent.x), float(side) / float(extent.y));

    std::vector<double> sum(size_t(width_) * height_, 0.0), solid_angle(sum.size());
    const std::vector<float> means =
        is_image ? texel_means(environment.latlong) : std::vector<float>(size_t(extent.x) * extent.y, 1.0f);
    for (unsigned y = 0; y < extent.y; ++y) {
        const double top = std::cos(M_PI * y / extent.y), bottom = std::cos(M_PI * (y + 1) / extent.y);
        const double texel_angle = 2 * M_PI / extent.x * (top - bottom);
        for (unsigned x = 0; x < extent.x; ++x) {
            const size_t cell = size_t(y / side) * width_ + x / side;
            sum[cell] += texel_angle * means[size_t(y) * extent.x + x];
            solid_angle[cell] += texel_angle;
        }
    }
    const double mean = std::accumulate(sum.begin(), sum.end(), 0.0) / (4 * M_PI);
    if (compensate)
        for (size_t i = 0; i < sum.size(); ++i) sum[i] = std::max(0.0, sum[i] - mean * solid_angle[i]);

    density_.resize(sum.size(), {0, 0.0f});
    for (const std::vector<uint32_t>& cells : divide_sky(sum, width_, height_)) {
        std::vector<double> weights;
        for (const uint32_t cell : cells) weights.push_back(sum[cell]);
        const AliasTable table(weights);
        std::vector<Cell> of_part;
        for (size_t i = 0; i < cells.size(); ++i) {
            const auto pdf = float(table.probability(i) / solid_angle[cells[i]]);
            density_[cells[i]] = {part_count(), pdf};
            of_part.push_back({cells[i], pdf});
        }
        parts_.push_back({std::move(of_part), table});
    }
}

AliasTable::Choice EnvironmentTable::choose(uint32_t part, glm::uvec2 bits) const {
    const AliasTable::Choice choice = parts_[part].table.sample(bits.x);
    prefetch_line(&parts_[part].cells[choice.index]);
    return choice;
}

glm::vec2 EnvironmentTable::place(uint32_t part, AliasTable::Choice choice, glm::uvec2 bits, float& pdf) const {
    const Cell cell = parts_[part].cells[choice.index];
    pdf = cell.pdf;
    const float x = float(choice.rest) * 0x1p-32f, y = float(bits.y) * 0x1p-32f;
    const float column = float(cell.index % width_), row = float(cell.index / width_);
    const float u0 = column * cell_extent_.x, u1 = std::min(1.0f, u0 + cell_extent_.x);
    const float top = std::cos(pi * row * cell_extent_.y),
                bottom = std::cos(pi * std::min(1.0f, (row + 1) * cell_extent_.y));
    const float v = std::acos(std::clamp(top + y * (bottom - top), -1.0f, 1.0f)) / pi;
    const glm::vec2 uv(u0 + x * (u1 - u0), v);
    prefetch_radiance(uv);
    return uv;
}

glm::vec2 EnvironmentTable::place(glm::vec3 direction) const {
    const glm::vec2 uv = environment_uv(direction, environment_->rotation);
    prefetch_line(&density_[cell(uv)]);
    prefetch_radiance(uv);
    return uv;
}

size_t EnvironmentTable::cell(glm::vec2 uv) const {
    const glm::vec2 at = uv / cell_extent_;
    const unsigned x = std::min(unsigned(at.x), width_ - 1), y = std::min(unsigned(at.y), height_ - 1);
    return size_t(y) * width_ + x;
}

glm::vec3 EnvironmentTable::direction(glm::vec2 uv) const { return environment_direction(uv, environment_->rotation); }

glm::vec3 EnvironmentTable::radiance(glm::vec2 uv, glm::vec3 direction) const {
    return environment_->type == Environment::Type::image ? environment_->image_radiance(uv)
                                                          : environment_->radiance(direction);
}

/// The texels of the upper two of a bilinear lookup's corners, and of the lower two.
void EnvironmentTable::prefetch_radiance(glm::vec2 uv) const {
    if (environment_->type != Environment::Type::image) return;
    const HostImage& image = environment_->latlong;
    const glm::ivec2 at(uv * glm::vec2(image.extent) - 0.5f), last(glm::ivec2(image.extent) - 1);
    const auto x = unsigned(std::clamp(at.x, 0, last.x));
    for (const int y : {at.y, at.y + 1}) prefetch_line(image.pixel(x, unsigned(std::clamp(y, 0, last.y))));
}
