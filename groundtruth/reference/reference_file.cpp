#include "groundtruth/reference/reference_file.h"

#include "core/digits.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "groundtruth/reference/platform.h"
#include "groundtruth/reference/reference_audit.h"

#include <charconv>

namespace {

struct NamedImage {
    std::string name;
    std::string channels;
    HostImage* image;
    PixelType type = PixelType::float32;
};

/// `parts`: ReferenceSettings::lit_only and ladder.
std::vector<NamedImage> named_images(Reference& reference, const ReferenceSettings& parts) {
    std::vector<NamedImage> images;
    std::vector<std::pair<std::string, ReferenceOutput*>> outputs = {{"diffuse", &reference.diffuse}};
    if (!parts.lit_only) {
        outputs.insert(
            outputs.end(),
            {{"image", &reference.image}, {"specular", &reference.specular}, {"incident", &reference.incident}});
        images.push_back({"guide.specular", "RGB", &reference.guide.specular});
        images.push_back({"guide.incident", "RGB", &reference.guide.incident});
        images.push_back({"guide.diffuse", "RGB", &reference.guide.diffuse});
    }
    TruthLadder& ladder = reference.ladder;
    if (parts.ladder) {
        outputs.push_back({"camera_radiance", &ladder.camera_radiance});
        outputs.push_back({"on_screen", &ladder.on_screen});
        images.push_back({"on_screen_share", "Y", &ladder.on_screen_share});
        images.push_back({"reflectance", "RGB", &ladder.reflectance});
        images.push_back({"fallback", "RGB", &ladder.fallback});
        for (const auto& [name, error] :
             {std::pair("camera_radiance", &ladder.camera_radiance_error), {"on_screen", &ladder.on_screen_error}}) {
            images.push_back({std::string(name) + ".error_variance.incident", "RGB", &error->incident});
            images.push_back({std::string(name) + ".error_variance.specular", "RGB", &error->specular});
        }
    }
    for (const auto& [name, output] : outputs) {
        images.push_back({name, "RGB", &output->mean});
        images.push_back({name + ".a", "RGB", &output->half_a});
        images.push_back({name + ".b", "RGB", &output->half_b});
        images.push_back({name + ".variance", "RGB", &output->variance});
    }
    images.push_back({"highlights", "RGB", &reference.highlights});
    images.push_back({"cut_share", "Y", &reference.cut_share});
    images.push_back({"sample_count", "Y", &reference.sample_count, PixelType::uint32});
    images.push_back({"lobe_samples", "XY", &reference.lobe_samples, PixelType::uint32});
    images.push_back({"depth", "Z", &reference.depth});
    images.push_back({"geometric_normal", "XYZ", &reference.geometric_normal});
    images.push_back({"normal", "XYZ", &reference.normal});
    images.push_back({"material_id", "Y", &reference.material_id, PixelType::uint32});
    return images;
}

/// Of references with an adaptive share.
NamedImage directions_layer(Reference& reference) {
    return {"directions", "XY", &reference.directions, PixelType::uint32};
}

/// All that a reference holds, whatever it was asked for.
std::vector<NamedImage> layers_of(Reference& reference) {
    std::vector<NamedImage> images =
        named_images(reference, {.lit_only = reference.is_lit_only(), .ladder = !reference.ladder.is_empty()});
    if (!reference.directions.values.empty()) images.push_back(directions_layer(reference));
    return images;
}

std::vector<NamedImage> named_images(ReferenceState& state) {
    return {{"sample_goal", "Y", &state.sample_goal, PixelType::uint32},
            {"earlier", "XY", &state.earlier},
            {"guide_variance", "RGB", &state.guide_variance},
            {"rays_per_sample", "Y", &state.rays_per_sample}};
}

std::map<std::string, std::string> attributes(const Reference& reference, const ReferenceSettings& settings,
                                              uint64_t level) {
    return {
        {"ssrlab.stream", reference.stream},
        {"ssrlab.hash", reference.hash},
        {"ssrlab.passes", reference.passes},
        {"ssrlab.seconds", shortest_digits(reference.seconds)},
        {"ssrlab.rays", shortest_digits(reference.rays)},
        {"ssrlab.non_finite_samples", shortest_digits(reference.non_finite_samples)},
        {"ssrlab.reached_share", shortest_digits(reference.reached_share)},
        {"ssrlab.max_samples", shortest_digits(settings.max_samples)},
        {"ssrlab.adaptive_share", shortest_digits(settings.adaptive_share)},
        {"ssrlab.adaptive_image", shortest_digits(unsigned(settings.adaptive_image))},
        {"ssrlab.max_seconds", shortest_digits(settings.max_seconds)},
        {"ssrlab.target_relative_error", shortest_digits(settings.target_relative_error)},
        {"ssrlab.max_depth", shortest_digits(settings.max_depth)},
        {"ssrlab.seed", shortest_digits(settings.seed)},
        {"ssrlab.lit_samples", shortest_digits(settings.lit_samples)},
        {"ssrlab.guide_samples", shortest_digits(settings.guide_samples)},
        {"ssrlab.lit_only", shortest_digits(unsigned(reference.is_lit_only()))},
        {"ssrlab.ladder", shortest_digits(unsigned(!reference.ladder.is_empty()))},
        {"ssrlab.keep_all", shortest_digits(unsigned(settings.keep_all))},
        {"ssrlab.level", shortest_digits(level)},
        {"ssrlab.code_version", groundtruth_code_version()},
        {"ssrlab.platform", render_platform()},
        {"ssrlab.highlight_policy",
         "image = diffuse + specular + highlights; highlights: punctual lights reflected by the first hit"},
        {"ssrlab.alpha_policy", "ggx alpha = max(roughness^2, 0.001)"},
    };
}

/// Reads the attributes of one file, with messages that name it.
struct Attributes {
    const std::filesystem::path& file;
    const std::map<std::string, std::string>& values;

    const std::string& text(const std::string& name) const {
        const auto found = values.find("ssrlab." + name);
        if (found == values.end()) fail(file.string(), " is no reference: its header lacks 'ssrlab.", name, "'");
        return found->second;
    }

    template <class T>
    void read(const std::string& name, T& value) const {
        const std::string& digits = text(name);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size())
            fail(file.string(), ": 'ssrlab.", name, "' is '", digits, "', which is no number that it can hold");
    }

    bool flag(const std::string& name) const {
        unsigned value = 0;
        read(name, value);
        return value != 0;
    }
};

/// Images lie in the file's layers while it lives, and move back when it ends, however it ends.
class BorrowedLayers {
public:
    explicit BorrowedLayers(std::vector<NamedImage> images) : images_(std::move(images)) {
        for (NamedImage& image : images_)
            file.layers.push_back({.name = image.name,
                                   .channel_names = image.channels,
                                   .image = std::move(*image.image),
                                   .type = image.type});
    }
    ~BorrowedLayers() {
        for (size_t i = 0; i < images_.size(); ++i) *images_[i].image = std::move(file.layers[i].image);
    }
    BorrowedLayers(const BorrowedLayers&) = delete;
    BorrowedLayers& operator=(const BorrowedLayers&) = delete;

    LayeredImage file;

private:
    std::vector<NamedImage> images_;
};

void write(const std::filesystem::path& file, std::vector<NamedImage> images,
           std::map<std::string, std::string> header) {
    BorrowedLayers borrowed(std::move(images));
    borrowed.file.attributes = std::move(header);
    write_exr(file, borrowed.file);
}

void take_layer(const std::filesystem::path& file, LayeredImage& layers, const NamedImage& into) {
    for (Layer& layer : layers.layers) {
        if (layer.name != into.name) continue;
        if (layer.channel_names != into.channels)
            fail(file.string(), ": layer '", into.name, "' has the channels ", layer.channel_names,
                 ", but should have ", into.channels);
        *into.image = std::move(layer.image);
        return;
    }
    if (into.name.starts_with("guide."))
        fail(file.string(), " lacks the layer '", into.name,
             "', which weighs relative errors: an older version wrote it; render it again with `ssrlab reference`");
    fail(file.string(), " is no reference: it lacks the layer '", into.name, "'");
}

}  // namespace

void write_reference(const std::filesystem::path& file, Reference& reference, const ReferenceSettings& settings) {
    std::map<std::string, std::string> header = attributes(reference, settings, 0);
    const ReferenceAudit audit = audit_reference(reference);
    header["ssrlab.light_cut"] = shortest_digits(audit.light_cut);
    for (const auto& [output, halves] : audit.outputs) {
        header["ssrlab.audit." + output + ".mean_z_squared"] = shortest_digits(halves.mean_z_squared);
        header["ssrlab.audit." + output + ".correlation"] = shortest_digits(halves.correlation);
    }
    write(file, layers_of(reference), std::move(header));
}

void write_reference_state(const std::filesystem::path& file, ReferenceState& state) {
    std::vector<NamedImage> images = layers_of(state.reference);
    for (const NamedImage& image : named_images(state))
        if (!image.image->values.empty()) images.push_back(image);
    write(file, std::move(images), attributes(state.reference, state.settings, state.level));
}

ReferenceState read_reference_state(const std::filesystem::path& file) {
    LayeredImage layers = read_exr(file);
    const Attributes header{file, layers.attributes};
    ReferenceState state;
    Reference& reference = state.reference;
    reference.stream = header.text("stream");
    reference.hash = header.text("hash");
    reference.passes = header.text("passes");
    header.read("seconds", reference.seconds);
    header.read("rays", reference.rays);
    header.read("non_finite_samples", reference.non_finite_samples);
    header.read("reached_share", reference.reached_share);
    header.read("max_samples", state.settings.max_samples);
    if (layers.attributes.contains("ssrlab.adaptive_share"))
        header.read("adaptive_share", state.settings.adaptive_share);
    state.settings.adaptive_image =
        layers.attributes.contains("ssrlab.adaptive_image") && header.flag("adaptive_image");
    header.read("max_seconds", state.settings.max_seconds);
    header.read("target_relative_error", state.settings.target_relative_error);
    header.read("max_depth", state.settings.max_depth);
    header.read("seed", state.settings.seed);
    header.read("lit_samples", state.settings.lit_samples);
    header.read("guide_samples", state.settings.guide_samples);
    state.settings.lit_only = layers.attributes.contains("ssrlab.lit_only") && header.flag("lit_only");
    state.settings.ladder = header.flag("ladder");
    state.settings.keep_all = header.flag("keep_all");
    header.read("level", state.level);

    for (const NamedImage& image : named_images(reference, state.settings)) take_layer(file, layers, image);
    std::vector<NamedImage> others = named_images(state);
    others.push_back(directions_layer(reference));
    for (const NamedImage& image : others)
        if (layers.find(image.name)) take_layer(file, layers, image);
    reference.extent = reference.sample_count.extent;
    return state;
}

Reference read_reference(const std::filesystem::path& file) {
    ReferenceState state = read_reference_state(file);
    if (!state.sample_goal.values.empty())
        fail(file.string(), " holds an unfinished render: continue it to get a reference");
    return std::move(state.reference);
}
