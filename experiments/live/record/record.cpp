#include "experiments/live/record/record.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/live/record/recorder.h"
#include "experiments/live/record/sliders.h"
#include "experiments/report/image_encoding.h"
#include "experiments/report/page_template.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "experiments/study/measuring/measure.h"
#include "experiments/study/measuring/render_technique.h"
#include "groundtruth/reference/reference_cache.h"
#include "metrics/score.h"

#include <cstdio>
#include <cstring>

namespace {

using nlohmann::json;

/// Of the truth's values: they are wrong by 0.4 % at most, which no display shows and which errors do not notice.
constexpr unsigned truth_significand_bits = 7;

/// Of all frames together: some 30 bytes each in a page, and texts of browsers end at 512 MB.
constexpr size_t most_pixels = 16'000'000;

json words_of(const CameraData& camera) {
    std::vector<uint32_t> words(sizeof camera / 4);
    std::memcpy(words.data(), &camera, sizeof camera);
    return words;
}

/// 1 inside.
HostImage image_of(const Mask& mask, glm::uvec2 extent) {
    HostImage image(extent, 1);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = mask.inside[i] ? 1.0f : 0.0f;
    return image;
}

/// What frames of a shot are compared with: the mask where errors are measured, and nothing else.
Config measuring_config(const PointConfig& point) {
    Config config;
    config.techniques = {point};
    config.masks = {"reflective"};
    return config;
}

Reference obtain_reference(const Shot& shot, unsigned frame, const RecordSettings& settings) {
    const ShotFrame now = shot_frame(shot, frame);
    ReferenceRun run;
    run.progress = [&](double fraction, double, double) {
        settings.report(fraction, "truth of frame " + std::to_string(frame));
    };
    run.notice = [&](const std::string& text) { settings.say("note: " + text); };
    return cached_reference(shot.scene, now.scene, now.camera, shot.config.extent, {.max_samples = settings.samples},
                            settings.cache, run);
}

/// Without the noise of the truth taken off, since a page cannot. NaN where nothing reflects.
double error_of(const HostImage& truth, const HostImage& test, const Mask& mask) {
    const MetricReference reference = metric_reference(truth, {}, {"relmse"}, {});
    return score(reference, test, {&mask, 1}).front().value;
}

/// A technique on its way through a shot.
class Recording {
public:
    Recording(Device& device, const Shot& shot, const RecordSettings& settings)
        : shot_(shot),
          settings_(settings),
          config_(measuring_config(settings.point)),
          source_(scene_source(device, shot, config_, true)),
          store_(*source_, shot.config, 0),
          renderer_(device, shot.config.extent, settings.point),
          recorder_(*renderer_.pass_list, texels_, known_reads, settings.has_passes) {
        renderer_.technique->limits = Limits::webgl2;
    }

    void add(const FrameStep& step) {
        const Reference reference = obtain_reference(shot_, step.frame, settings_);
        const FrameStore::Frame frame = store_.frame(step, reference.diffuse.mean);
        const HostGBuffer host =
            download_gbuffer(source_->pass_list(), frame.gbuffer, frame.camera, shot_.config.depth_format);
        const FrameTruth truth = frame_truth(
            std::make_shared<PoseTruth>(pose_truth(reference, config_, shot_.camera.exposure_ev, {})), host, config_);
        CameraData camera = frame.camera;
        camera.frame.y = settings_.point.seeds.front();

        recorder_.begin_frame(frame.gbuffer);
        const Reflections reflections = renderer_.render(camera, camera.frame.y, frame.gbuffer);
        json entry = recorder_.end_frame(reflections);
        const Composite composite = renderer_.compositor->render(frame.gbuffer, reflections);
        const HostImage& specular = reference.specular.mean;
        errors.push_back(
            error_of(specular, channels_of(renderer_.pass_list->download(composite.specular), 0, 3), truth.masks[0]));
        entry["number"] = step.frame;
        entry["camera"] = words_of(camera);
        entry["error"] = errors.back();
        entry["lit"] = texels_.add(channels_of(host.lit, 0, 3));
        entry["fallback"] = texels_.add(channels_of(host.fallback, 0, 3));
        entry["reflectance"] = texels_.add_rounded(truth.reflectance, 10);
        entry["truth"] = texels_.add_rounded(specular, truth_significand_bits);
        entry["mask"] = texels_.add(image_of(truth.masks[0], host.extent()));
        if (settings_.has_results || settings_.has_passes)
            entry["result"] = texels_.add(renderer_.pass_list->download(reflections.radiance));
        frames_.push_back(std::move(entry));
    }

    json recording() const {
        return {{"images", recorder_.images()},
                {"vertex", recorder_.vertex()},
                {"programs", recorder_.programs()},
                {"command_lists", recorder_.command_lists()},
                {"frames", frames_},
                {"texels", texels_.descriptions()}};
    }
    const Recorder& recorder() const { return recorder_; }
    const std::vector<std::string>& texts() const { return texels_.texts(); }
    std::vector<double> errors;
    KnownReads known_reads;

private:
    const Shot& shot_;
    const RecordSettings& settings_;
    const Config config_;
    std::unique_ptr<FrameSource> source_;
    FrameStore store_;
    Renderer renderer_;
    RecordedTexels texels_;
    Recorder recorder_;
    json frames_ = json::array();
};

/// What the page says of itself.
json facts_of(const Shot& shot, const RecordSettings& settings, const Device& device) {
    const json build = build_info();
    const std::string commit = build.value("commit", "");
    return {{"scene", shot.scene.name},
            {"camera", shot.camera.name},
            {"technique", settings.point.technique},
            {"point", settings.point.point},
            {"width", shot.config.extent.x},
            {"height", shot.config.extent.y},
            {"exposure_ev", shot.camera.exposure_ev},
            {"samples", settings.samples},
            {"is_packed", shot.config.gbuffer_formats == GBufferFormats::packed},
            {"truth_significand_bits", truth_significand_bits},
            {"commit", commit.empty() ? "unknown" : commit + (build.value("dirty", false) ? " with changes" : "")},
            {"device", device.info().name + ", " + device.info().driver}};
}

std::string page_of(const json& recording, const std::vector<std::string>& texts, const std::string& title) {
    const std::string text = recording.dump(-1, ' ', false, json::error_handler_t::replace);
    std::vector<PageElement> elements = {{"recording", base64(compressed({text.begin(), text.end()}))}};
    for (size_t i = 0; i < texts.size(); ++i) elements.push_back({"texels-" + std::to_string(i), texts[i]});
    return page_text("record", "record", title, {}, elements);
}

}  // namespace

RecordedPage record_page(Device& device, const RecordSettings& settings) {
    const ShotConfig& asked = settings.shot;
    if (size_t(asked.extent.x) * asked.extent.y * asked.frames.size() > most_pixels)
        fail("a page cannot hold ", asked.frames.size(), " frames of ", asked.extent.x, "x", asked.extent.y,
             "; it holds ", most_pixels / 1'000'000, " million pixels: record fewer or smaller frames");
    require_replayable(device, settings.point);
    const Shot shot = load_shot(asked, settings.search_path);
    for (const std::string& warning : warning_sentences(shot.scene)) settings.say("warning: " + warning);

    Recording made(device, shot, settings);
    for (const FrameStep& step : shot.steps) made.add(step);
    json recording = made.recording();
    recording["facts"] = facts_of(shot, settings, device);
    recording["parameters"] =
        recorded_parameters(device, settings.point, asked.extent, made.recorder().params_read(), made.known_reads);

    RecordedPage result{.errors = made.errors, .sliders = {}};
    const json& last = recording["command_lists"][recording["frames"].back()["commands"].get<size_t>()];
    for (const json& command : last) result.passes += command.contains("program");
    for (const json& parameter : recording["parameters"])
        if (parameter["is_slider"]) result.sliders.push_back(parameter["name"]);
    const std::string page =
        page_of(recording, made.texts(), settings.point.technique + " in " + shot.scene.name + ", replayed by WebGL 2");
    result.bytes = page.size();
    write_text(settings.page, page);
    return result;
}
