#include "core/gbuffer/gbuffer_layers.h"

#include "core/error.h"
#include "core/exr/exr_colors.h"
#include "core/exr/exr_layers.h"
#include "core/exr/exr_pixels.h"
#include "core/near_miss.h"

#include <algorithm>
#include <cmath>

namespace {

using G = HostGBuffer;
const GBufferLayer all_layers[] = {
    {"depth", "Z", &G::depth, 0, 1,
     "device depth, from 0 to 1, as `depth_direction` of camera.json says; exactly 1, or 0 if reversed, where there is "
     "no surface",
     ""},
    {"normal", "XYZ", &G::normal, 0, 4, "unit shading normal in world space, away from the surface", ""},
    {"roughness", "Y", &G::normal, 3, 4, "perceptual roughness, from 0 to 1; GGX alpha is its square", ""},
    {"base_color", "RGB", &G::base_color, 0, 4, "base colour, linear Rec. 709, from 0 to 1", ""},
    {"metalness", "Y", &G::base_color, 3, 4, "from 0 to 1", ""},
    {"lit", "RGB", &G::lit, 0, 4,
     "radiance that the surface emits and reflects diffusely towards the camera; the environment's where there is no "
     "surface",
     "a reference must provide it"},
    {"geometric_normal", "XYZ", &G::geometric_normal, 0, 4,
     "unit normal of the triangle in world space, towards the camera", "the shading normal is taken"},
    {"emission", "RGB", &G::emission, 0, 4, "emitted radiance, also a part of `lit`", "0 is taken"},
    {"specular", "Y", &G::emission, 3, 4,
     "factor of what dielectrics reflect, from 0 to 1; 0: no reflection; metals do not use it",
     "1 is taken, and 0 in the background"},
    {"dielectric_f0", "RGB", &G::dielectric_f0, 0, 4,
     "reflectance of dielectrics at normal incidence, from 0 to 1; of an index of refraction n: ((n - 1) / (n + 1))^2",
     "0.04 is taken"},
    {"motion", "XY", &G::motion, 0, 2,
     "position on the screen minus that in the previous frame, without jitter; uv from 0 to 1, x right, y down",
     "0 is taken; in a sequence, the motion that follows from depth and cameras"},
    {"material_id", "Y", &G::material_id, 0, 1,
     "whole number of the material, from 1 to 2^24; 0 where there is no surface", "1 is taken, and 0 in the background",
     PixelType::uint32},
    {"previous_depth", "Z", &G::previous_depth, 0, 1, "`depth` of the previous frame, in that frame's pixels",
     "that of the previous frame is taken, or else `depth`"},
    {"previous_normal", "XYZ", &G::previous_normal, 0, 4, "`normal` of the previous frame",
     "that of the previous frame is taken, or else `normal`"},
    {"previous_roughness", "Y", &G::previous_normal, 3, 4, "`roughness` of the previous frame",
     "that of the previous frame is taken, or else `roughness`"},
    {"fallback", "RGB", &G::fallback, 0, 4, "radiance to reflect where a ray hits nothing",
     "0 is taken, unless there is an environment.json"},
};

std::vector<std::string> layer_names() { return names_of(all_layers, &GBufferLayer::name); }

std::string spaced(std::string_view letters) {
    std::string text;
    for (const char letter : letters) text += (text.empty() ? "" : " ") + std::string(1, letter);
    return text;
}

/// A layer of the file, and the channels of it that are read.
struct Chosen {
    const GBufferLayer& layer;
    std::vector<ExrComponent> components;
    ExrPlanes planes;
};

class LayerReader {
public:
    LayerReader(const std::filesystem::path& file, HostGBuffer& gbuffer)
        : file_(file),
          where_(file.string()),
          gbuffer_(gbuffer),
          header_(read_exr_header(file)),
          layers_(layers_of(header_)) {}

    FoundLayers read() {
        std::vector<ExrPlanes> planes;
        for (const GBufferLayer& layer : all_layers) choose(layer);
        for (const Chosen& chosen : chosen_) planes.push_back(chosen.planes);
        found_.memory = read_planes(file_, header_, planes);
        for (size_t i = 0; i < planes.size(); ++i) take(chosen_[i], planes[i]);
        note_cropped();
        note_compression();
        note_unused();
        return std::move(found_);
    }

private:
    const ExrPart& part_of(const Chosen& chosen) const { return header_.parts[chosen.planes.part]; }

    /// Whose other channels, such as alpha, are not looked at. None if there are others alone.
    std::optional<std::vector<ExrComponent>> components(const ExrLayer& layer, std::string_view letters) const {
        if (auto found = components_named(layer, letters)) return found;
        if (letters == "XYZ") return components_named(layer, "RGB");
        if (letters == "XY") {
            auto found = components_named(layer, "RG");
            return found ? found : components_named(layer, "UV");
        }
        if (letters.size() == 1 && layer.components.size() == 1) return layer.components;
        return {};
    }

    void choose(const GBufferLayer& wanted) {
        const ExrLayer* layer = find_layer(header_, layers_, wanted.name);
        if (!layer) {
            if (wanted.is_required()) refuse_missing(wanted);
            return;
        }
        auto found = components(*layer, wanted.channels);
        if (!found) fail(where_, ": layer ", shown(*layer), " needs the channels ", spaced(wanted.channels));
        check_extent(header_.parts[layer->part]);
        Chosen chosen{.layer = wanted, .components = *found, .planes = {.part = layer->part, .channels = {}}};
        for (const ExrComponent& component : *found) {
            chosen.planes.channels.push_back(component.channel);
            used_.insert({layer->part, component.channel});
        }
        chosen_.push_back(std::move(chosen));
    }

    [[noreturn]] void refuse_missing(const GBufferLayer& wanted) const {
        for (const ExrLayer& other : layers_)
            if (nearest_name(other.name, layer_names()) == wanted.name)
                fail(where_, ": lacks the layer '", wanted.name, "', but has '", other.name, "'");
        fail(where_, ": lacks the layer '", wanted.name, "'; it has ", shown(layers_));
    }

    void check_extent(const ExrPart& part) const {
        const glm::dvec2 extent = part.display.extent(), stored = part.data.extent(),
                         wanted(gbuffer_.camera.extent.x, gbuffer_.camera.extent.y);
        if (extent == wanted) return;
        std::string windows;
        if (!(part.data == part.display)) {
            windows =
                "; that is its display window (" + shown(part.display) + "), its data window is " + shown(part.data);
            if (stored == wanted)
                windows +=
                    ": if that is the picture, say so: `oiiotool gbuffer.exr --fullpixels -d "
                    "material_id.Y=uint -o full.exr`";
        }
        fail(where_, ": is ", extent.x, " x ", extent.y, ", but camera.json says ", wanted.x, " x ", wanted.y, windows);
    }

    void take(const Chosen& chosen, ExrPlanes& planes) {
        const GBufferLayer& layer = chosen.layer;
        if (std::string_view(layer.channels) == "RGB") {
            const std::string note = convert_to_rec709(file_, part_of(chosen), planes.image);
            if (!note.empty() && std::ranges::find(found_.notes, note) == found_.notes.end())
                found_.notes.push_back(note);
        }
        if (layer.image == &G::material_id) check_numbers(chosen, planes);
        if (layer.image == &G::depth && part_of(chosen).channels[planes.channels[0]].type == PixelType::half)
            found_.notes.push_back(
                "The layer 'depth' is stored as half floats, which tell only 1025 depths from 0.5 to "
                "1 apart: store it as 32-bit floats.");
        HostImage& image = gbuffer_.*layer.image;
        if (image.values.empty()) image = HostImage(planes.image.extent, layer.image_channels);
        copy_channels(planes.image, 0, image, layer.first_channel, layer.count());
        found_.names.insert(layer.name);
        planes = {};
    }

    /// Of materials: as floats they are kept apart up to 2^24.
    void check_numbers(const Chosen& chosen, const ExrPlanes& planes) {
        constexpr float most = 16777216;
        constexpr float most_of_halves = 2048;
        const ExrChannel& channel = part_of(chosen).channels[planes.channels[0]];
        std::vector<float> fractions;
        float largest = 0;
        for (size_t i = 0; i < planes.image.values.size(); ++i) {
            const float value = planes.image.values[i];
            const double number = planes.integers.empty() ? double(value) : double(planes.integers[i]);
            if (number > most)
                fail(where_, ": layer 'material_id' has the number ", uint64_t(std::min(number, 1e18)), " in pixel (",
                     i % planes.image.extent.x, ", ", i / planes.image.extent.x, "), but numbers above ",
                     uint32_t(most), " would not be kept apart: count the materials from 1, or leave the layer out");
            if (!(value >= 0 && value == std::floor(value))) fractions.push_back(value);
            largest = std::max(largest, value);
        }
        if (!fractions.empty())
            found_.notes.push_back(std::to_string(fractions.size()) +
                                   " pixels have a material_id that is no whole number: " +
                                   why_not_whole(fractions, part_of(chosen), channel));
        if (channel.type == PixelType::half && largest > most_of_halves)
            found_.notes.push_back("The layer 'material_id' is stored as half floats, which keep numbers above " +
                                   std::to_string(int(most_of_halves)) +
                                   " apart no longer: store it as 32-bit integers.");
    }

    /// `fractions`: values of material_id that are no whole numbers.
    static std::string why_not_whole(const std::vector<float>& fractions, const ExrPart& part,
                                     const ExrChannel& channel) {
        if (!std::ranges::all_of(fractions, [](float v) { return v >= 0 && std::isfinite(v); }))
            return "some are negative or not finite. Count the materials from 1.";
        // Shares of the largest integer come back as numbers but for the rounding of what they are stored as. Larger
        // numbers than these any value would be near to.
        const double rounding = channel.type == PixelType::half ? 0x1p-11 : 0x1p-24;
        const auto are_shares_of = [&](double whole) {
            return std::ranges::all_of(fractions, [&](double v) {
                const double number = v * whole;
                return v <= 1 && number * rounding < 0.1 &&
                       std::abs(number - std::round(number)) <= 2 * number * rounding;
            });
        };
        if (are_shares_of(4294967295.0))
            return "they are shares of 4294967295, as oiiotool writes integers. They come back with `oiiotool "
                   "gbuffer.exr -d material_id.Y=uint -o whole.exr`.";
        for (const unsigned whole : {255u, 65535u})
            if (are_shares_of(whole))
                return "they are shares of " + std::to_string(whole) + ", as of a texture whose format is 'unorm'. " +
                       "Multiply them by " + std::to_string(whole) + ".";
        if (part.is_lossy(channel))
            return std::string("the compression ") + part.compression_name() +
                   " changed them. Store the layer as 32-bit integers.";
        return "a filter mixed the numbers of neighbours, as where an image is resized. Resize it to the nearest "
               "pixel.";
    }

    /// What was not stored is background: of the far plane's depth, and 0 in all else.
    void note_cropped() {
        for (const Chosen& chosen : chosen_) {
            const GBufferLayer& layer = chosen.layer;
            const ExrPart& part = part_of(chosen);
            if (std::string_view(layer.channels) != "Z" || part.data == part.display) continue;
            HostImage& depth = gbuffer_.*layer.image;
            size_t outside = 0;
            for (unsigned y = 0; y < depth.extent.y; ++y)
                for (unsigned x = 0; x < depth.extent.x; ++x) {
                    const glm::ivec2 at = part.display.min + glm::ivec2(x, y);
                    if (at.x >= part.data.min.x && at.x <= part.data.max.x && at.y >= part.data.min.y &&
                        at.y <= part.data.max.y)
                        continue;
                    *depth.pixel(x, y) = gbuffer_.camera.depth.z, ++outside;
                }
            if (outside > 0 && layer.image == &G::depth)
                found_.notes.push_back(std::to_string(outside) + " pixels of the display window (" +
                                       shown(part.display) + ") lie outside of the data window (" + shown(part.data) +
                                       "): they count as background without light.");
        }
    }

    void note_compression() {
        std::map<std::string, std::pair<std::string, std::string>> losses;  ///< what is lost, and in which layers
        for (const Chosen& chosen : chosen_) {
            const ExrPart& part = part_of(chosen);
            ExrLayer lossy{.name = chosen.layer.name, .in_part = "", .part = chosen.planes.part, .components = {}};
            for (const ExrComponent& component : chosen.components)
                if (part.is_lossy(part.channels[component.channel])) lossy.components.push_back(component);
            if (lossy.components.empty()) continue;
            auto& [loss, layers] = losses[part.compression_name()];
            loss = part.loss();
            layers += (layers.empty() ? "" : ", ") + shown(lossy);
        }
        for (const auto& [name, loss] : losses)
            found_.notes.push_back("The file is compressed by " + name + ", which " + loss.first +
                                   ". That concerns the layers " + loss.second +
                                   ". Write the file with ZIP, PIZ or without compression.");
    }

    void note_unused() {
        const std::vector<std::string> names = layer_names();
        std::string unused;
        for (const ExrLayer& layer : layers_) {
            ExrLayer rest = layer;
            std::erase_if(rest.components, [&](const ExrComponent& c) {
                return used_.contains({layer.part, c.channel});
            });
            if (rest.components.empty()) continue;
            const std::string near = layer.name.empty() ? "" : nearest_name(layer.name, names);
            if (rest.components.size() == layer.components.size() && !near.empty() && near != layer.name)
                found_.notes.push_back("The layer '" + layer.name + "' is not used; did you mean '" + near + "'?");
            else
                unused += (unused.empty() ? "" : ", ") + shown(rest);
        }
        if (!unused.empty()) found_.notes.push_back("Layers or channels that are not used: " + unused + ".");
    }

    std::filesystem::path file_;
    std::string where_;
    HostGBuffer& gbuffer_;
    ExrHeader header_;
    std::vector<ExrLayer> layers_;
    std::vector<Chosen> chosen_;
    std::set<std::pair<size_t, size_t>> used_;  ///< part and channel
    FoundLayers found_;
};

}  // namespace

std::span<const GBufferLayer> gbuffer_layers() { return all_layers; }

void copy_channels(const HostImage& from, unsigned from_channel, HostImage& to, unsigned to_channel, unsigned count) {
    for (size_t i = 0; i < from.pixel_count(); ++i)
        for (unsigned c = 0; c < count; ++c)
            to.values[i * to.channels + to_channel + c] = from.values[i * from.channels + from_channel + c];
}

FoundLayers read_gbuffer_layers(const std::filesystem::path& file, HostGBuffer& gbuffer) {
    return LayerReader(file, gbuffer).read();
}
