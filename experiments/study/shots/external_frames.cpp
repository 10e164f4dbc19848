#include "experiments/study/shots/external_frames.h"

#include "core/error.h"
#include "core/exr/exr_picture.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "core/png.h"
#include "experiments/study/config/points/external_images.h"
#include "experiments/study/measuring/frames/external_proof.h"
#include "experiments/study/shots/image_queue.h"
#include "experiments/study/shots/point_errors.h"
#include "experiments/study/shots/result_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace {

/// Standard error of the light without reflections, from its two halves; of a pixel the largest around it, since two
/// halves of one pixel may agree by chance.
HostImage noise_of(const ReferenceHalves& halves) {
    const glm::ivec2 extent = halves.a.extent;
    HostImage noise(halves.a.extent, 1);
    const auto apart = [&](int x, int y) {
        const size_t i = size_t(y) * size_t(extent.x) + size_t(x);
        const glm::vec3 d = glm::abs(halves.a.rgb(i) - halves.b.rgb(i)) * 0.5f;
        return std::max({d.x, d.y, d.z});
    };
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x)
            for (int near_y = std::max(y - 1, 0); near_y <= std::min(y + 1, extent.y - 1); ++near_y)
                for (int near_x = std::max(x - 1, 0); near_x <= std::min(x + 1, extent.x - 1); ++near_x) {
                    float& largest = *noise.pixel(unsigned(x), unsigned(y));
                    largest = std::max(largest, apart(near_x, near_y));
                }
    return noise;
}

HostImage difference(const HostImage& a, const HostImage& b) {
    HostImage left = a;
    for (size_t i = 0; i < left.values.size(); ++i) left.values[i] -= b.values[i];
    return left;
}

/// A frame's proof pixels for images without reflections, and for those with them.
struct Proofs {
    ProofPixels off, on;
};

class ExternalPoint {
public:
    ExternalPoint(const PointInShot& point, const PointSettings& settings)
        : point_(point), settings_(settings), images_(*point.technique.external) {}

    Cell measure() {
        for (const FrameStep& step : point_.shot.steps)
            if (step.is_measured) prove(step);
        PointErrors errors(point_, lit_noise());
        for (const unsigned seed : point_.technique.seeds) {
            SeedErrors of_seed{.seed = seed};
            for (const FrameStep& step : point_.shot.steps)
                if (step.is_measured) add_frame(errors, of_seed, step);
            errors.add_whole(of_seed);
            settings_.report(double(seed + 1) / double(point_.technique.seeds.size()));
        }
        Cell cell;
        errors.move_to(cell);
        // A difference of two images is below zero by their rounding wherever nothing is reflected, which is no fault.
        for (ResultRow& row : cell.results)
            if (row.target == "specular") row.negative = 0;
        cell.images = queue_.finish();
        cell.notes.push_back(note());
        for (const std::string& conversion : conversions_)
            cell.notes.push_back(point_.shot.name() + ": images of " + images_.engine + ": " + conversion);
        return cell;
    }

private:
    const FrameTruth& truth(const FrameStep& step) const { return *point_.truth.frame(step); }

    HostImage read(const std::filesystem::path& file) const {
        std::error_code error;
        if (!std::filesystem::is_regular_file(file, error))
            fail(file.string(), " is missing: ", images_.engine, " rendered ", ExternalImages::view_name(point_.shot),
                 ", of which each measured frame is asked, with reflections and without");
        ExrPicture picture = read_exr_picture(file);
        for (const std::string& note : picture.notes) conversions_.insert(note.substr(file.string().size() + 2));
        HostImage image = std::move(picture.rgb);
        if (image.extent != point_.shot.config.extent)
            fail(file.string(), " has ", image.extent.x, "x", image.extent.y, " pixels; the shot has ",
                 point_.shot.config.extent.x, "x", point_.shot.config.extent.y);
        const auto broken = std::ranges::count_if(image.values, [](float v) { return !std::isfinite(v); });
        if (broken > 0)
            fail(file.string(), " holds ", broken,
                 " values that are NaN or infinite; what divides by zero there, or "
                 "overflows a half float?");
        return image;
    }

    Proofs proofs(const FrameStep& step) const {
        const FrameTruth& of_step = truth(step);
        const PoseTruth& pose = *of_step.pose;
        HostImage is_background(pose.material_id.extent, 1);
        for (size_t i = 0; i < is_background.pixel_count(); ++i)
            is_background.values[i] = pose.material_id.values[i] == 0 ? 1.0f : 0.0f;
        const HostImage noise = pose.lit_halves ? noise_of(*pose.lit_halves) : HostImage(pose.direct.extent, 1);
        const auto target = pose.targets.find("specular");
        const HostImage none,
            &specular = target != pose.targets.end() ? target->second.image
                        : pose.frame_reference       ? pose.frame_reference->image  // of a frame before the last
                                                     : none;
        const HostImage all(is_background.extent, 1, 1.0f);
        return {.off = proof_pixels(pose.direct, noise, none, of_step.emission,
                                    images_.has_given_light ? all : is_background),
                .on = proof_pixels(pose.direct, noise, specular, of_step.emission, is_background)};
    }

    /// Fails unless the image shows the scene.
    void check(const HostImage& image, const ProofPixels& proof, const std::filesystem::path& file,
               const FrameStep& step, bool has_reflections) const {
        const bool is_proved = has_reflections && images_.has_given_light;  // by each pixel of the other image
        if (proof.count() < least_proof_pixels && is_proved) return;
        if (proof.count() < least_proof_pixels)
            fail(point_.shot.name(), ": ", proof.count(),
                 " pixels show the background or surfaces that emit, of which ", least_proof_pixels,
                 " are needed to see whether images of another program have the same camera; choose another view");
        std::string why =
            has_reflections ? why_refused_with_reflections(image, proof, is_proved) : why_refused(image, proof);
        if (why.empty()) return;
        if (images_.has_given_light && !has_reflections)
            why += ". The light that scene-for wrote must have as many samples as the truth here, which has " +
                   std::to_string(point_.config.reference.max_samples) + " (--samples)";
        const std::string name = "images/refused." + point_.technique.technique + "." + point_.shot.name() + ".f" +
                                 std::to_string(step.frame) + ".png";
        const std::filesystem::path picture = path_inside(settings_.out, name);
        write_png(picture, difference_picture(image, proof));
        fail(file.string(), ": ", why, " (", picture.string(), " shows where, in red)");
    }

    /// Takes down what each image of the frame must show.
    void prove(const FrameStep& step) {
        const Proofs of_step = proofs(step);
        const std::filesystem::path file = images_.proof(point_.shot, step.frame);
        const HostImage off = read(file);
        check(off, of_step.off, file, step, false);
        compared_ += of_step.off.count(), differing_ += differences(off, of_step.off).count;
        with_reflections_[step.frame] = of_step.on;
    }

    void add_frame(PointErrors& errors, SeedErrors& seed, const FrameStep& step) {
        const std::filesystem::path file = images_.image(point_.shot, step.frame, seed.seed);
        const HostImage image = read(file);
        const ProofPixels& proof = with_reflections_.at(step.frame);
        check(image, proof, file, step, true);
        const size_t leaks = differences(image, proof).count;
        if (leaks > most_differing(proof.count())) most_leaks_ = std::max(most_leaks_, leaks);
        const CompositedImages result{.specular = difference(image, truth(step).pose->direct), .image = image};
        errors.add(seed, step, result);
        if (seed.seed != point_.technique.seeds.front() ||
            point_.shot.images_of(step, point_.config.kept_images) != StepImages::all)
            return;
        queue_.add([this, row = point_.row(std::to_string(step.frame), seed.seed),
                    suffix = settings_.image_suffix + (point_.is_last(step) ? "" : ".f" + std::to_string(step.frame)),
                    &pose = point_.truth.pose(step), result] {
            return save_result_images(settings_.out, row, suffix, pose, result, point_.shot.camera.exposure_ev);
        });
    }

    /// What the noise of the truth's light without reflections adds, which is taken from the image: all of it, or of a
    /// given light what is reflected of it, where the image was rendered in each half of that light, too.
    LitNoiseOfErrors lit_noise() const {
        LitNoiseOfErrors noise = unknown_lit_noise;
        for (const FrameStep& step : point_.shot.steps) {
            if (!step.is_measured) continue;
            const PoseTruth& pose = *truth(step).pose;
            if (!pose.lit_halves) return unknown_lit_noise;
            const HostImage highlights = difference(pose.direct, pose.diffuse);
            const bool has_halves = images_.has_halves(point_.shot, step.frame);
            const auto composited = [&](char which, const HostImage& lit) {
                const HostImage image = read(has_halves ? images_.half(point_.shot, step.frame, which)
                                                        : images_.image(point_.shot, step.frame, 0));
                return CompositedImages{.specular = difference(image, sum(lit, highlights)), .image = image};
            };
            const CompositedImages a = composited('a', pose.lit_halves->a), b = composited('b', pose.lit_halves->b);
            const std::vector<Mask> masks = masks_of(truth(step), {}, point_.config);
            const std::string name = std::to_string(step.frame);
            if (pose.frame_reference && point_.shot.config.frames.size() > 1)
                add_lit_noise_of_frame(noise, pose, a, b, masks, name);
            if (point_.is_last(step)) add_lit_noise_of_targets(noise, pose, a, b, masks, name);
        }
        return noise;
    }

    std::string note() const {
        std::string text = point_.shot.name() + ": " + point_.technique.technique + " " + point_.technique.point +
                           " was rendered by " + images_.engine + " " + images_.version +
                           (images_.driver.empty() ? "" : " on " + images_.driver) + "; of " +
                           std::to_string(compared_) +
                           (images_.has_given_light ? " pixels " : " pixels of background and emission ") +
                           std::to_string(differing_) + " differ from the truth";
        if (most_leaks_ > 0)
            text += ", with reflections up to " + std::to_string(most_leaks_) +
                    ": the technique adds light where nothing reflects, which counts as its error";
        if (images_.milliseconds)
            text += "; it states " + number_text(*images_.milliseconds, 3) +
                    " ms for a frame's reflections, which ssrlab did not measure";
        return text;
    }

    const PointInShot& point_;
    const PointSettings& settings_;
    const ExternalImages& images_;
    ImageQueue queue_;
    std::map<unsigned, ProofPixels> with_reflections_;  ///< by frame
    size_t compared_ = 0, differing_ = 0;               ///< without reflections
    mutable std::set<std::string> conversions_;         ///< what was converted when images were read
    size_t most_leaks_ = 0;                             ///< of an image with them; 0: none to speak of
};

}  // namespace

Cell measure_external(const Shot& shot, const ShotTruth& truth, const Config& config, const PointConfig& technique,
                      const PointSettings& settings) {
    const PointInShot point{.shot = shot, .truth = truth, .config = config, .technique = technique};
    return ExternalPoint(point, settings).measure();
}
