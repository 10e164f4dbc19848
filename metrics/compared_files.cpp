#include "metrics/compared_files.h"

#include "core/error.h"
#include "core/exr/radiance_file.h"
#include "core/files.h"
#include "core/image_format.h"
#include "core/list_text.h"
#include "core/png.h"
#include "core/reading_limits.h"
#include "metrics/cvvdp_metric.h"

#include <algorithm>
#include <array>

namespace {

/// linear_from_srgb() of each code. Those of 8 bits, which most are, by a table: the curve takes longer than all else
/// of reading.
HostImage decoded(HostImage codes) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (size_t code = 0; code < values.size(); ++code) values[code] = linear_from_srgb(float(code) / 255.0f);
        return values;
    }();
    for (float& v : codes.values) {
        const auto code = v >= 0.0f && v <= 1.0f ? size_t(v * 255.0f + 0.5f) : 0;
        v = v == float(code) / 255.0f ? table[code] : linear_from_srgb(v);
    }
    return codes;
}

}  // namespace

ComparedImage read_compared_image(const std::filesystem::path& file, const CompareOptions& options,
                                  std::vector<std::string>& warnings) {
    if (std::filesystem::is_directory(file))
        fail(file.string(),
             " is a folder. Give an image, or the frames of a video by a pattern: ", (file / "frame_####.exr").string(),
             " for frame_0000.exr, frame_0001.exr and so on");
    check_regular_file(file);
    const std::vector<uint8_t> bytes = first_bytes(file);
    if (const std::string why = why_unreadable(bytes, file.string(), ImageUse::comparison); !why.empty())
        fail("cannot read ", file.string(), ": it ", why);
    if (image_format(bytes) != ImageFormat::png) return {.linear = read_radiance(file, options.layer, warnings)};
    ComparedImage image{.is_radiance = false};
    image.codes = read_png_codes(file, warnings);
    image.linear = decoded(image.codes);
    for (float& v : image.codes.values) v = std::clamp(v, 0.0f, 1.0f);  // as a display shows what it has not
    return image;
}

void report_bad_pixels(Comparison& comparison) {
    const auto report = [&](const PixelCounts& counts, const std::filesystem::path& file) {
        if (counts.non_finite() + counts.negative == 0) return;
        std::string text = file.string() + ": " + std::to_string(counts.nan) + " pixels with NaN, " +
                           std::to_string(counts.infinite) + " with Inf, " + std::to_string(counts.negative) +
                           " negative";
        if (counts.non_finite() > 0)
            text += "; NaN and Inf count in no metric: such pixels are left out, or black in both images";
        if (counts.non_finite() > 0 && comparison.options.fail_on_non_finite)
            fail(text.substr(0, text.find(';')), "; NaN and Inf must not occur");
        comparison.warnings.push_back(text);
    };
    report(comparison.reference_counts, comparison.options.reference);
    report(comparison.test_counts, comparison.options.test);
}

void choose_display(CompareOptions& options, bool is_radiance) {
    Viewing& viewing = options.settings.viewing;
    viewing.display = display_named(!options.display.empty() ? options.display
                                    : is_radiance            ? "standard_hdr_linear"
                                                             : "standard_4k");
    if (options.nits_per_unit && viewing.display.transfer == Transfer::srgb)
        fail("the display ", viewing.display.name,
             " shows codes, which have no nits per unit; leave out --nits-per-unit, or choose --display "
             "standard_hdr_linear");
    viewing.nits_per_unit = options.nits_per_unit.value_or(viewing.nits_per_unit);
}

size_t count_clipped(const HostImage& linear, const MetricSettings& settings) {
    const Viewing viewing = exposed_viewing(settings);
    if (viewing.display.transfer != Transfer::linear) return 0;
    const float greatest = float(viewing.display.peak / viewing.nits_per_unit);
    size_t count = 0;
    for (size_t i = 0; i < linear.pixel_count(); ++i) {
        const glm::vec3 c = linear.rgb(i);
        count += std::isfinite(c.x + c.y + c.z) && std::max({c.x, c.y, c.z}) > greatest;
    }
    return count;
}

void warn_of_clipped(size_t pixels, const std::filesystem::path& file, const MetricSettings& settings,
                     std::vector<std::string>& warnings) {
    if (pixels == 0) return;
    warnings.push_back(message_text(file.string(), ": ", counted(pixels, "pixel"), " brighter than the ",
                                    settings.viewing.display.peak, " cd/m2 of ", settings.viewing.display.name,
                                    "; the display shows its peak instead"));
}
