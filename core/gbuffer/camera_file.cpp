#include "core/gbuffer/camera_file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "core/json_float.h"
#include "core/parameters.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using nlohmann::json;

constexpr float max_side = 32768;  // pixels

const std::vector<std::string> depth_formats{"d32f", "d24", "d16"};

constexpr const char *four_rows = "four rows of four numbers", *is_derived = "derived";

const CameraFileKey keys_of_file[] = {
    {"extent", "[width, height]", "", "size of the layers in pixels, at most 32768"},
    {"near", "m", "", "distance of the near plane from the camera, above 0; of an orthographic camera 0 is allowed"},
    {"far", "m", "", "distance of the far plane"},
    {"clip_from_view", four_rows, "",
     "projection without jitter, to Vulkan's clip space: x right, y down, z from 0 to 1; with `reversed` from 1 to 0"},
    {"view_from_world", four_rows, "",
     "view space is right-handed, with y up, and looks along -z; world space has +Y up"},
    {"depth_direction", "`standard`, `reversed`", "`standard`", "device depth of the near plane: 0, or 1 if reversed"},
    {"depth_format", "`d32f`, `d24`, `d16`", "`d32f`", "format of the depth buffer from which `depth` comes"},
    {"is_orthographic", "true, false", "false", "true if `clip_from_view` has no perspective"},
    {"jitter", "[x, y]", "[0, 0]",
     "pixels, x right, y down: a pixel shows the point of its centre plus `jitter` on the screen of `clip_from_view`"},
    {"previous_jitter", "[x, y]", "[0, 0]",
     "jitter of the previous frame; in a sequence, that of its camera.json is taken"},
    {"previous_clip_from_view", four_rows, "no previous frame",
     "matrix of the previous frame; in a sequence, it must be the same as in that frame's camera.json"},
    {"previous_view_from_world", four_rows, "no previous frame", "the same for `view_from_world`; write both or none"},
    {"exposure_ev", "-100 to 100", "0", "pictures and FLIP show radiance times 2 to this power"},
    {"frame", "a whole number", "0", "number of the frame; studies count frames themselves"},
    {"seed", "a whole number", "0", "seed of random numbers; studies have their own seeds"},
    {"view_from_clip", four_rows, is_derived, "inverse of `clip_from_view`; ssrlab refuses values that contradict it"},
    {"world_from_view", four_rows, is_derived, "inverse of `view_from_world`"},
    {"clip_from_world", four_rows, is_derived, "`clip_from_view` times `view_from_world`"},
    {"world_from_clip", four_rows, is_derived, "inverse of `clip_from_world`"},
    {"previous_view_from_clip", four_rows, is_derived, "the same of the previous frame"},
    {"previous_world_from_view", four_rows, is_derived, "the same of the previous frame"},
    {"previous_clip_from_world", four_rows, is_derived, "the same of the previous frame"},
};

/// The shortest decimal that reads back as the same bits; JSON's integer 0 would lose the sign of -0.
json exact(float value) { return value == 0 ? json(double(value)) : json_number(value); }

json json_vector(glm::vec2 v) { return {exact(v.x), exact(v.y)}; }

json json_matrix(const glm::mat4& m) {
    json rows = json::array();
    for (int row = 0; row < 4; ++row) {
        json numbers = json::array();
        for (int column = 0; column < 4; ++column) numbers.push_back(exact(m[column][row]));
        rows.push_back(numbers);
    }
    return rows;
}

/// An array of `count` numbers.
std::vector<float> numbers(const json& array, size_t count, const std::string& where) {
    const auto is_number = [](const json& value) { return value.is_number(); };
    if (!array.is_array() || array.size() != count || !std::ranges::all_of(array, is_number))
        fail(where, " is ", shown(array), ", but must be an array of ", count, " numbers");
    std::vector<float> list;
    for (const json& number : array) list.push_back(float_of(number, where));
    return list;
}

glm::mat4 matrix(JsonObject& object, const std::string& key) {
    const json& rows = object.any(key);
    const std::string where = object.where() + ": '" + key + "'";
    if (!rows.is_array() || rows.size() != 4) fail(where, " is ", shown(rows), ", but must be an array of four rows");
    glm::mat4 result;
    for (int row = 0; row < 4; ++row) {
        const std::vector<float> values = numbers(rows[row], 4, where + " row " + std::to_string(row));
        for (int column = 0; column < 4; ++column) result[column][row] = values[column];
    }
    return result;
}

glm::mat4 matrix(JsonObject& object, const std::string& key, const glm::mat4& fallback) {
    return object.has(key) ? matrix(object, key) : fallback;
}

glm::vec2 pair(JsonObject& object, const std::string& key, glm::vec2 fallback) {
    if (!object.has(key)) return fallback;
    const std::vector<float> values = numbers(object.any(key), 2, object.where() + ": '" + key + "'");
    for (const float value : values)
        if (std::abs(value) > max_side)
            fail(object.where(), ": '", key, "' holds ", value, ", but must be within +-", max_side, " pixels");
    return {values[0], values[1]};
}

glm::mat4 checked_inverse(const glm::mat4& m, JsonObject& object, const std::string& key) {
    const float determinant = glm::determinant(m);
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant))
        fail(object.where(), ": '", key, "' has determinant ", determinant, ", but must be invertible");
    return glm::inverse(m);
}

/// Products and inverses of finite matrices need not be finite.
void refuse_overflow(const CameraData& c, const std::string& where) {
    for (const glm::mat4* m : {&c.view_from_clip, &c.world_from_view, &c.clip_from_world, &c.world_from_clip,
                               &c.previous_view_from_clip, &c.previous_world_from_view, &c.previous_clip_from_world})
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                if (!std::isfinite((*m)[column][row]))
                    fail(where,
                         ": the product or the inverse of 'clip_from_view' and 'view_from_world', or of the previous "
                         "ones, has the number ",
                         (*m)[column][row], "; their numbers are too large or too small");
}

/// Fails where the product of `a` and `b` differs from `expected` by more than rounding explains: float32 loses digits
/// of the product's parts, whose sum may be small beside them.
void refuse_contradiction(const glm::dmat4& a, const glm::dmat4& b, const glm::dmat4& expected,
                          const std::string& sentence) {
    constexpr double tolerance = 1e-3;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            double sum = 0, size = 0;
            for (int k = 0; k < 4; ++k) {
                const double part = a[k][row] * b[column][k];
                sum += part, size += std::abs(part);
            }
            if (!(std::abs(sum - expected[column][row]) <= tolerance * size)) fail(sentence);
        }
}

/// What a file may leave out, since it follows from the others, must follow from them where it is there. `prefix`: ""
/// or "previous_".
void refuse_contradictions(const std::string& where, const std::string& prefix, const glm::mat4& clip_from_view,
                           const glm::mat4& view_from_clip, const glm::mat4& view_from_world,
                           const glm::mat4& world_from_view, const glm::mat4& clip_from_world) {
    const auto contradicts = [&](const char* derived, const std::string& others) {
        return where + ": '" + prefix + derived + "' contradicts " + others + "; leave it out, and it is derived";
    };
    const std::string clip = "'" + prefix + "clip_from_view'", view = "'" + prefix + "view_from_world'";
    refuse_contradiction(view_from_clip, clip_from_view, glm::dmat4(1), contradicts("view_from_clip", clip));
    refuse_contradiction(world_from_view, view_from_world, glm::dmat4(1), contradicts("world_from_view", view));
    refuse_contradiction(clip_from_view, view_from_world, clip_from_world,
                         contradicts("clip_from_world", clip + " and " + view));
}

void read_matrices(JsonObject& object, CameraData& c) {
    c.clip_from_view = matrix(object, "clip_from_view");
    c.view_from_world = matrix(object, "view_from_world");
    c.view_from_clip = matrix(object, "view_from_clip", checked_inverse(c.clip_from_view, object, "clip_from_view"));
    c.world_from_view =
        matrix(object, "world_from_view", checked_inverse(c.view_from_world, object, "view_from_world"));
    c.clip_from_world = matrix(object, "clip_from_world", c.clip_from_view * c.view_from_world);
    c.world_from_clip =
        matrix(object, "world_from_clip", glm::mat4(glm::dmat4(c.world_from_view) * glm::dmat4(c.view_from_clip)));

    const std::string clip = "previous_clip_from_view", view = "previous_view_from_world";
    if (object.has(clip) != object.has(view))
        fail(object.where(), ": has only one of '", clip, "' and '", view, "', but needs both or none");
    c.frame.w = object.has(view);
    const glm::mat4 previous_clip_from_view = matrix(object, clip, c.clip_from_view);
    c.previous_view_from_world = matrix(object, view, c.view_from_world);
    const bool is_first = c.frame.w == 0;
    c.previous_view_from_clip =
        matrix(object, "previous_view_from_clip",
               is_first ? c.view_from_clip : checked_inverse(previous_clip_from_view, object, clip));
    c.previous_world_from_view =
        matrix(object, "previous_world_from_view",
               is_first ? c.world_from_view : checked_inverse(c.previous_view_from_world, object, view));
    c.previous_clip_from_world =
        matrix(object, "previous_clip_from_world",
               is_first ? c.clip_from_world : previous_clip_from_view * c.previous_view_from_world);
    refuse_overflow(c, object.where());

    refuse_contradictions(object.where(), "", c.clip_from_view, c.view_from_clip, c.view_from_world, c.world_from_view,
                          c.clip_from_world);
    refuse_contradiction(c.world_from_view, c.view_from_clip, c.world_from_clip,
                         object.where() +
                             ": 'world_from_clip' contradicts 'clip_from_view' and 'view_from_world'; leave "
                             "it out, and it is derived");
    refuse_contradictions(object.where(), "previous_", previous_clip_from_view, c.previous_view_from_clip,
                          c.previous_view_from_world, c.previous_world_from_view, c.previous_clip_from_world);
    const bool divides = c.clip_from_view[0][3] != 0 || c.clip_from_view[1][3] != 0 || c.clip_from_view[2][3] != 0;
    if (divides == (c.frame.z == 1))
        fail(object.where(), ": 'is_orthographic' is ", divides ? "true" : "false",
             ", but the last row of "
             "'clip_from_view' ",
             divides ? "divides by the depth" : "is that of an orthographic camera");
}

}  // namespace

std::span<const CameraFileKey> camera_file_keys() { return keys_of_file; }

void write_camera(const std::filesystem::path& file, const CameraFile& f) {
    const CameraData& c = f.camera;
    json object{
        {"extent", {unsigned(c.extent.x), unsigned(c.extent.y)}},
        {"depth_direction", c.depth.w == 1 ? "reversed" : "standard"},
        {"depth_format", depth_formats[size_t(f.depth_format)]},
        {"near", json_number(c.depth.x)},
        {"far", json_number(c.depth.y)},
        {"frame", c.frame.x},
        {"seed", c.frame.y},
        {"exposure_ev", json_number(f.exposure_ev)},
        {"is_orthographic", c.frame.z == 1},
        {"jitter", json_vector({c.jitter.x, c.jitter.y})},
        {"previous_jitter", json_vector({c.jitter.z, c.jitter.w})},
        {"clip_from_view", json_matrix(c.clip_from_view)},
        {"view_from_clip", json_matrix(c.view_from_clip)},
        {"view_from_world", json_matrix(c.view_from_world)},
        {"world_from_view", json_matrix(c.world_from_view)},
        {"clip_from_world", json_matrix(c.clip_from_world)},
        {"world_from_clip", json_matrix(c.world_from_clip)},
    };
    if (c.frame.w == 1) {
        object["previous_clip_from_view"] = json_matrix(glm::inverse(c.previous_view_from_clip));
        object["previous_view_from_clip"] = json_matrix(c.previous_view_from_clip);
        object["previous_view_from_world"] = json_matrix(c.previous_view_from_world);
        object["previous_world_from_view"] = json_matrix(c.previous_world_from_view);
        object["previous_clip_from_world"] = json_matrix(c.previous_clip_from_world);
    }
    write_text(file, object.dump(2) + "\n");
}

CameraFile read_camera(const std::filesystem::path& file) {
    const json text = read_json(file);
    JsonObject object(text, file.string());
    const int max_integer = std::numeric_limits<int>::max();
    CameraFile result;
    CameraData& c = result.camera;

    const std::vector<float> extent = numbers(object.any("extent"), 2, object.where() + ": 'extent'");
    for (const float size : extent)
        if (size < 1 || size > max_side || size != std::floor(size))
            fail(object.where(), ": 'extent' holds ", size, ", but both must be whole numbers from 1 to ", max_side);
    c.extent = {extent[0], extent[1], 1 / extent[0], 1 / extent[1]};

    const bool is_reversed = object.choice("depth_direction", {"standard", "reversed"}, "standard") == "reversed";
    const std::string format = object.choice("depth_format", depth_formats, "d32f");
    result.depth_format = DepthFormat(std::ranges::find(depth_formats, format) - depth_formats.begin());
    // No orthographic camera divides by it: glTF 2.0, 5.13, has the minimum 0.
    const bool is_orthographic = object.boolean("is_orthographic", false);
    const float near = object.number("near", is_orthographic ? 0 : std::numeric_limits<float>::min(), any_length);
    c.depth = {near, object.number("far", near, any_far_plane), is_reversed ? 0 : 1, is_reversed ? 1 : 0};
    if (c.depth.y == near) fail(object.where(), ": 'far' is ", near, ", but must be beyond 'near'");

    c.frame = {object.integer("frame", 0, max_integer, 0), 0, is_orthographic, 0};
    c.frame.y = object.integer("seed", 0, max_integer, 0);
    result.exposure_ev = object.number("exposure_ev", -100, 100, 0);
    c.jitter = glm::vec4(pair(object, "jitter", {0, 0}), pair(object, "previous_jitter", {0, 0}));
    read_matrices(object, c);
    object.finish();
    return result;
}
