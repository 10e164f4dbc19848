#include "variants/passes/read_images.h"

#include "core/error.h"
#include "core/gpu/format.h"
#include "core/json_float.h"
#include "core/near_miss.h"
#include "variants/common/names.h"
#include "variants/passes/provided_images.h"

#include <algorithm>

using nlohmann::json;

glm::uvec2 read_size(JsonObject& object, const std::string& key) {
    if (!object.has(key)) return glm::uvec2(0);
    const json& size = object.any(key);
    const auto fits = [](const json& side) { return is_whole(side) && side >= 1 && side <= largest_side; };
    if (!size.is_array() || size.size() != 2 || !std::ranges::all_of(size, fits))
        fail(object.at(key), ": '", key, "' must be [width, height] in pixels, each in [1, ", largest_side, "], not ",
             shown(size));
    return {size[0].get<unsigned>(), size[1].get<unsigned>()};
}

ScreenShare read_share(JsonObject& object) {
    know_keys(object, {"divisor", "round", "margin", "times", "size"});
    ScreenShare share;
    share.divisor = unsigned(object.integer("divisor", 1, largest_side, 1));
    share.rounds_up = object.value_of<bool>("round", {{"down", false}, {"up", true}});
    share.margin = unsigned(object.integer("margin", 0, largest_side, 0));
    share.times = unsigned(object.integer("times", 1, largest_side, 1));
    share.size = read_size(object, "size");
    if (share.size.x > 0 && object.has("divisor"))
        fail(object.at("divisor"), ": an image has either a 'size' or a 'divisor'");
    return share;
}

namespace {

Format read_format(JsonObject& object) {
    const std::vector<std::string> names = names_of(all_formats(), &FormatFacts::name);
    object.any("format");
    const std::string name = object.choice("format", names, "");
    return all_formats()[size_t(std::ranges::find(names, name) - names.begin())].format;
}

glm::vec4 read_color(const json& value, const std::string& where) {
    if (value.is_number()) return glm::vec4(float_of(value, where));
    const auto is_number = [](const json& one) { return one.is_number(); };
    if (!value.is_array() || value.size() != 4 || !std::ranges::all_of(value, is_number))
        fail(where, ": must be a number or an array of four, not ", shown(value));
    return {float_of(value[0], where), float_of(value[1], where), float_of(value[2], where), float_of(value[3], where)};
}

/// `true`, a value, or an object of `to` and `when`.
void read_cleared(JsonObject& object, const KnownValues& known, DeclaredImage& image) {
    if (!object.has("cleared")) return;
    const json& cleared = object.any("cleared");
    image.is_cleared = Condition();
    if (cleared.is_boolean()) {
        if (cleared == false) image.is_cleared = Condition::never();
    } else if (cleared.is_object()) {
        JsonObject how = object.object("cleared");
        if (how.has("to")) image.cleared_to = read_color(how.any("to"), how.at("to") + ": 'to'");
        image.is_cleared = Condition(how, "when", known);
        how.finish();
    } else {
        image.cleared_to = read_color(cleared, object.at("cleared") + ": 'cleared'");
    }
}

void read_mips(JsonObject& object, DeclaredImage& image) {
    if (object.has("mips") && object.any("mips").is_string())
        image.mips_until = object.value_of<DeclaredImage::Mips>(
            "mips", {{"all", DeclaredImage::Mips::all}, {"of_shorter_side", DeclaredImage::Mips::of_shorter_side}});
    else
        image.mips = unsigned(object.integer("mips", 1, most_mips, 1));
}

}  // namespace

DeclaredImage read_image(JsonObject object, const KnownValues& known) {
    know_keys(object, {"name", "format", "divisor", "size", "mips", "history", "kept", "cleared", "same_as", "when"});
    DeclaredImage image;
    image.place = object.at("name");
    image.name = variable_name(object, "name");
    if (ProvidedImages::has(image.name))
        fail(image.place, ": every technique has an image '", image.name, "' already; call yours otherwise");
    image.when = Condition(object, "when", known);
    if (object.has("same_as")) {
        image.same_as = object.text("same_as");
        object.finish();
        return image;
    }
    image.format = read_format(object);
    image.share = read_share(object);
    read_mips(object, image);
    image.has_history = object.boolean("history", false);
    image.is_kept = object.boolean("kept", false);
    if ((image.has_history || image.is_kept) && (image.mips > 1 || image.mips_until != DeclaredImage::Mips::count))
        fail(object.at("mips"), ": an image with a history has no mips; keep each level as an image of its own");
    read_cleared(object, known, image);
    object.finish();
    return image;
}

DeclaredBuffer read_buffer(JsonObject object, const KnownValues& known) {
    know_keys(object, {"name", "bytes", "bytes_per_pixel", "times_parameter", "when"});
    DeclaredBuffer buffer;
    buffer.place = object.at("name");
    buffer.name = variable_name(object, "name");
    buffer.bytes = unsigned(object.integer("bytes", 0, most_bytes, 0));
    buffer.bytes_per_pixel = unsigned(object.integer("bytes_per_pixel", 0, 1024, 0));
    if (buffer.bytes % 4 != 0 || buffer.bytes_per_pixel % 4 != 0 || buffer.bytes + buffer.bytes_per_pixel == 0)
        fail(buffer.place, ": the buffer '", buffer.name,
             "' must have 'bytes' or 'bytes_per_pixel', in multiples of 4");
    if (object.has("times_parameter")) {
        buffer.times = object.text("times_parameter");
        if (!known.by_name().contains(buffer.times) || !known.by_name()[buffer.times].is_number_unsigned())
            fail(object.at("times_parameter"), ": '", shortened(buffer.times), "' is no parameter of whole numbers");
    }
    buffer.share = read_share(object);
    buffer.when = Condition(object, "when", known);
    object.finish();
    return buffer;
}
