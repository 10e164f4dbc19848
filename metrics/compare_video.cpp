#include "metrics/compare_video.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/numbered_files.h"
#include "core/reading_limits.h"
#include "metrics/compared_files.h"
#include "metrics/cvvdp_metric.h"

#include <algorithm>

namespace {

void add(PixelCounts& sum, const PixelCounts& counts) {
    sum.nan += counts.nan, sum.infinite += counts.infinite, sum.negative += counts.negative;
}

/// Both patterns' files, as many of one as of the other.
struct VideoFiles {
    std::vector<std::filesystem::path> reference, test;

    explicit VideoFiles(const CompareOptions& options)
        : reference(numbered_files(options.reference)), test(numbered_files(options.test)) {
        if (reference.size() != test.size())
            fail(options.reference.string(), " has ", counted(reference.size(), "frame"), ", but ",
                 options.test.string(), " has ", counted(test.size(), "frame"), ": both must have as many");
        if (reference.size() < 2)
            fail(options.reference.string(), " has one frame, and a video needs two; compare ", reference[0].string(),
                 " and ", test[0].string(), " as stills");
    }
};

/// What is noted of a video's frames, each note once: with the first frame that has it, and the number of the others.
class FrameNotes {
public:
    ComparedImage read(const std::filesystem::path& file, const CompareOptions& options) {
        std::vector<std::string> found;
        ComparedImage image = read_compared_image(file, options, found);
        for (const std::string& note : found) {
            const std::string name = file.string();
            const std::string said = note.starts_with(name) ? note.substr(name.size()) : note;
            const auto known = std::ranges::find(notes_, said, &Note::said);
            if (known == notes_.end())
                notes_.push_back({said, note, 0});
            else
                ++known->others;
        }
        return image;
    }
    void report(std::vector<std::string>& warnings) const {
        for (const Note& note : notes_)
            warnings.push_back(note.others == 0
                                   ? note.first
                                   : note.first + " (the same of " + counted(note.others, "other frame") + ")");
    }

private:
    struct Note {
        std::string said, first;
        size_t others;
    };
    std::vector<Note> notes_;
};

/// Fails unless the image is as the first of the reference.
void check_frame(const ComparedImage& image, const std::filesystem::path& file, glm::uvec2 extent, bool is_radiance,
                 const std::filesystem::path& first) {
    if (image.linear.extent != extent)
        fail(file.string(), " has ", image.linear.extent.x, "x", image.linear.extent.y, " pixels, but ", first.string(),
             " has ", extent.x, "x", extent.y, ": all frames must be of one size");
    if (image.is_radiance != is_radiance)
        fail(file.string(), " holds ", image.is_radiance ? "radiance" : "display codes", ", but ", first.string(),
             " does not: all frames must be of one kind");
}

/// Sets aside what a comparison takes: the filters' window, pyramids, and two frames while they are read.
void reserve(MemoryShare& memory, glm::uvec2 extent, double frames_per_second, const std::filesystem::path& file) {
    memory.add(double(extent.x) * extent.y * video_bytes_per_pixel(frames_per_second),
               file.string() + ": the comparison of videos of " + std::to_string(extent.x) + "x" +
                   std::to_string(extent.y) + " pixels");
}

HostImage shown_values(ComparedImage image, const MetricSettings& settings) {
    if (settings.viewing.display.transfer == Transfer::linear) return std::move(image.linear);
    if (!image.is_radiance) return std::move(image.codes);
    // Bad pixels become black in both images later, and must still be found then.
    HostImage codes = display_codes(image.linear, settings.exposure_ev, settings.tone_map);
    for (size_t i = 0; i < codes.values.size(); ++i)
        if (!std::isfinite(image.linear.values[i])) codes.values[i] = NAN;
    return codes;
}

}  // namespace

Comparison compare_videos(const CompareOptions& options) {
    Comparison comparison{.options = options};
    CompareOptions& used = comparison.options;
    const VideoFiles files(options);
    std::vector<std::string>& warnings = comparison.warnings;
    std::optional<CvvdpVideo> video;
    bool is_radiance = true;
    MemoryShare memory;
    FrameNotes notes_of_reference, notes_of_test;
    size_t clipped_reference = 0, clipped_test = 0, pixels = 0;
    for (size_t f = 0; f < files.reference.size(); ++f) {
        ComparedImage reference = notes_of_reference.read(files.reference[f], options);
        ComparedImage test = notes_of_test.read(files.test[f], options);
        if (!video) {
            comparison.extent = reference.linear.extent;
            is_radiance = comparison.is_radiance = reference.is_radiance;
            choose_display(used, is_radiance);
            reserve(memory, comparison.extent, options.video->frames_per_second, options.reference);
            video.emplace(comparison.extent, exposed_viewing(used.settings), options.video->frames_per_second,
                          options.video->padding, !options.map.empty());
        }
        check_frame(reference, files.reference[f], comparison.extent, is_radiance, files.reference[0]);
        check_frame(test, files.test[f], comparison.extent, is_radiance, files.reference[0]);
        add(comparison.reference_counts, count_bad_pixels(reference.linear));
        add(comparison.test_counts, count_bad_pixels(test.linear));
        clipped_reference += count_clipped(reference.linear, used.settings);
        clipped_test += count_clipped(test.linear, used.settings);
        pixels += reference.linear.pixel_count();
        video->add(shown_values(std::move(reference), used.settings), shown_values(std::move(test), used.settings));
    }
    notes_of_reference.report(warnings), notes_of_test.report(warnings);
    report_bad_pixels(comparison);
    warn_of_clipped(clipped_reference, options.reference, used.settings, warnings);
    warn_of_clipped(clipped_test, options.test, used.settings, warnings);
    CvvdpScore score = video->score();
    comparison.pixels = pixels - score.non_finite;
    comparison.frames = files.reference.size(), comparison.pooled_frames = score.frames.size();
    comparison.results.push_back({&metric_named("cvvdp_0_5_6"), score.jod, std::move(score.map)});
    return comparison;
}
