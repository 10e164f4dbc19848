#include "core/exr/exr_picture.h"

#include "core/error.h"
#include "core/exr/exr_colors.h"
#include "core/exr/exr_layers.h"
#include "core/exr/exr_pixels.h"
#include "core/near_miss.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace {

using Components = std::vector<ExrComponent>;

bool has_rgb(const ExrLayer& layer) { return components_named(layer, "RGB").has_value(); }

bool has_chroma(const ExrLayer& layer) { return layer.find("Y") && layer.find("RY") && layer.find("BY"); }

/// X Y Z; or one channel, which is grey: Y, or the only one beside A. None if neither is there.
std::optional<Components> vector_or_grey(const ExrLayer& layer) {
    if (auto xyz = components_named(layer, "XYZ")) return xyz;
    auto y = components_named(layer, "Y");
    if (y && !components_named(layer, "X")) return y;
    Components others;
    for (const ExrComponent& component : layer.components)
        if (component.letter != 'A') others.push_back(component);
    if (others.empty()) others = layer.components;
    if (others.size() != 1) return {};
    return others;
}

/// A file's layers, and the choice among them.
class Chooser {
public:
    Chooser(const fs::path& file, const ExrHeader& header)
        : file_(file.string()), header_(header), layers_(layers_of(header)) {}

    ExrLayer named(const std::string& name) const {
        if (const ExrLayer* layer = find_layer(header_, layers_, name)) return *layer;
        for (const ExrLayer& layer : layers_)  // "Z", "normal.X", or with the part's name: a channel of its own
            for (const ExrComponent& component : layer.components) {
                const ExrPart& part = header_.parts[layer.part];
                const std::string& channel = part.channels[component.channel].name;
                if (channel == name || part.name + "." + channel == name)
                    return {.name = name, .in_part = name, .part = layer.part, .components = {component}};
            }
        if (layers_.size() == 1 && layers_.front().in_part.empty()) return layers_.front();
        std::vector<std::string> names;
        for (const ExrLayer& layer : layers_)
            if (!layer.name.empty()) names.push_back(layer.name);
        if (nearest_name(name, names).empty()) fail(file_, " has no layer '", name, "'; it has ", shown(layers_));
        fail(file_, " has no layer '", name, "'", suggestion(name, names));
    }

    ExrLayer picture(std::vector<std::string>& notes) const {
        const auto is_unnamed = [](const ExrLayer& layer) { return layer.in_part.empty(); };
        for (const auto& is_colour : {has_rgb, has_chroma})
            for (const ExrLayer& layer : layers_)
                if (is_unnamed(layer) && is_colour(layer)) return layer;
        for (const ExrLayer& layer : layers_)
            if (layer.name == "image") return layer;
        if (layers_.size() == 1) return layers_.front();
        const auto colours = std::ranges::count_if(layers_, has_rgb);
        if (colours == 1) {
            const ExrLayer layer = *std::ranges::find_if(layers_, has_rgb);
            notes.push_back(file_ + ": its picture is taken from the layer " + shown(layer) +
                            ", the only one with R, G and B.");
            return layer;
        }
        if (colours == 0)
            for (const ExrLayer& layer : layers_)
                if (is_unnamed(layer) && vector_or_grey(layer)) return layer;
        fail(file_, " does not say which of its layers is the picture: ",
             colours == 0 ? "none has" : std::to_string(colours) + " have",
             " R, G and B, and none of these is without a name; it has ", shown(layers_),
             "; name one with --layer where a command has it, or write R, G and B without a layer's name");
    }

private:
    std::string file_;
    const ExrHeader& header_;
    std::vector<ExrLayer> layers_;
};

void convert(const fs::path& file, const ExrPart& part, ExrPicture& picture) {
    if (const std::string note = convert_to_rec709(file, part, picture.rgb); !note.empty())
        picture.notes.push_back(note);
}

/// A note, if the compression changed colours that are looked at.
void note_compression(const fs::path& file, const ExrPart& part, const ExrPictureSource& source,
                      std::vector<std::string>& notes) {
    if (std::ranges::any_of(source.components,
                            [&](const ExrComponent& c) { return part.is_lossy(part.channels[c.channel]); }))
        notes.push_back(file.string() + ": its compression " + part.compression_name() + " " + part.loss() +
                        ". For exact values write it with ZIP, PIZ or without compression.");
}

/// exr_picture_source() without the note on the compression.
ExrPictureSource chosen_source(const fs::path& file, const ExrHeader& header, const std::string& name,
                               std::vector<std::string>& notes) {
    using Kind = ExrPictureSource::Kind;
    const Chooser chooser(file, header);
    const ExrLayer layer = name.empty() ? chooser.picture(notes) : chooser.named(name);
    if (const auto rgb = components_named(layer, "RGB")) return {layer, *rgb, Kind::rgb};
    if (has_chroma(layer))
        return {layer, {*layer.find("Y"), *layer.find("RY"), *layer.find("BY")}, Kind::luminance_chroma};
    const auto others = vector_or_grey(layer);
    if (!others)
        fail(file.string(), ": layer ", shown(layer), " is no colour: it has ", layer.components.size(),
             " channels, and neither R, G and B nor X, Y and Z; name one of them with --layer, as '",
             header.parts[layer.part].channels[layer.components.front().channel].name, "'");
    return {layer, *others, others->size() == 3 ? Kind::vector : Kind::grey};
}

}  // namespace

ExrPictureSource exr_picture_source(const fs::path& file, const ExrHeader& header, const std::string& name,
                                    std::vector<std::string>& notes) {
    ExrPictureSource source = chosen_source(file, header, name, notes);
    note_compression(file, header.parts[source.layer.part], source, notes);
    return source;
}

ExrPicture read_exr_picture(const fs::path& file, const std::string& name) {
    using Kind = ExrPictureSource::Kind;
    const ExrHeader header = read_exr_header(file);
    ExrPicture picture;
    const ExrPictureSource source = exr_picture_source(file, header, name, picture.notes);
    const ExrPart& part = header.parts[source.layer.part];
    const auto channel = [&](size_t i) { return source.components[i].channel; };
    if (source.kind == Kind::luminance_chroma) {
        picture.rgb = read_luminance_chroma(file, header, source.layer.part, {channel(0), channel(1), channel(2)},
                                            picture.memory);
        convert(file, part, picture);
        return picture;
    }
    ExrPlanes planes{.part = source.layer.part, .channels = {}};
    for (size_t i = 0; i < source.components.size(); ++i) planes.channels.push_back(channel(i));
    picture.memory = read_planes(file, header, {&planes, 1});
    refuse_rounding(file, header, planes);
    if (source.kind != Kind::grey) {
        picture.rgb = std::move(planes.image);
        if (source.kind == Kind::rgb) convert(file, part, picture);
        return picture;
    }
    picture.memory.add(double(planes.image.pixel_count()) * sizeof(glm::vec3), file.string() + ": its colours");
    picture.rgb = HostImage(planes.image.extent, 3);
    for (size_t i = 0; i < picture.rgb.pixel_count(); ++i) picture.rgb.set_rgb(i, glm::vec3(planes.image.values[i]));
    return picture;
}
