#include "core/gbuffer/gbuffer_checks.h"

#include "core/gbuffer/pixel_position.h"
#include "core/scene/depth_precision.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

namespace {

/// Where the camera saw a point (or, with w = 0, a direction); none if behind it.
std::optional<glm::dvec3> seen_at(const CameraData& camera, const glm::dvec4& world) {
    const glm::dvec4 clip = glm::dmat4(camera.clip_from_world) * world;
    if (clip.w <= 0) return {};
    return glm::dvec3(glm::dvec2(clip) / clip.w * 0.5 + 0.5, clip.z / clip.w);
}

glm::dvec2 motion_of_still(const HostGBuffer& g, size_t i, const CameraData& before) {
    const bool is_sky = is_background(g, i);
    if (is_sky && g.camera.frame.z == 1) return {};  // all rays of an orthographic camera meet the same sky
    glm::dvec4 point(surface_position(g, i), 1);
    if (is_sky) point = glm::dvec4(glm::dvec3(point) - glm::dvec3(g.camera.world_from_view[3]), 0);
    const auto seen = seen_at(before, point);
    return seen ? sample_uv(g, i) - glm::dvec2(*seen) : glm::dvec2(0);
}

/// Indices of some ten thousand surface pixels spread over the image, those at the border left out.
std::vector<size_t> sampled_pixels(const HostGBuffer& g) {
    std::vector<size_t> surface;
    for (unsigned y = 1; y + 1 < g.extent().y; ++y)
        for (unsigned x = 1; x + 1 < g.extent().x; ++x) {
            const size_t i = size_t(y) * g.extent().x + x;
            if (!is_background(g, i)) surface.push_back(i);
        }
    const size_t step = surface.size() / 10'000 + 1;
    std::vector<size_t> some;
    for (size_t i = 0; i < surface.size(); i += step) some.push_back(surface[i]);
    return some;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + long(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void check_values(const HostGBuffer& g, std::vector<std::string>& notes) {
    size_t bad_depth = 0, bad_normal = 0, bad_roughness = 0, bad_color = 0, bad_f0 = 0, surface = 0;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        const float depth = g.depth.values[i], *n = &g.normal.values[4 * i], *c = &g.base_color.values[4 * i];
        bad_depth += !(depth >= 0 && depth <= 1);
        if (is_background(g, i)) continue;
        ++surface;
        bad_normal +=
            !(std::abs(glm::length(glm::vec3(n[0], n[1], n[2])) - 1) < 0.02f);  // 8-bit normals are within 0.01
        bad_roughness += !(n[3] >= 0 && n[3] <= 1);
        const glm::vec3 f0 = g.dielectric_f0.values.empty() ? glm::vec3(0) : g.dielectric_f0.rgb(i);
        bad_f0 += !(std::min({f0.x, f0.y, f0.z}) >= 0 && std::max({f0.x, f0.y, f0.z}) <= 1);
        bad_color += !(std::min({c[0], c[1], c[2], c[3]}) >= 0 && std::max({c[0], c[1], c[2], c[3]}) <= 1);
    }
    const auto note = [&](size_t count, const char* what) {
        if (count) notes.push_back(std::to_string(count) + " pixels have a " + what + ".");
    };
    note(bad_depth, "depth outside [0, 1]");
    note(bad_normal, "normal that is not of unit length");
    note(bad_roughness, "roughness outside [0, 1]");
    note(bad_color, "base colour or metalness outside [0, 1]");
    note(bad_f0, "dielectric_f0 outside [0, 1]");
    if (surface == 0)
        notes.push_back("No pixel shows a surface: all depths are the far plane's, " +
                        std::to_string(int(g.camera.depth.z)) +
                        ". Is the depth reversed, and 'depth_direction' does not say so?");
    for (const auto& [layer, count] : count_non_finite(g))
        notes.push_back(std::to_string(count) + " values of '" + layer + "' are not finite.");
}

void check_camera(const HostGBuffer& g, std::vector<std::string>& notes) {
    const CameraData& c = g.camera;
    const auto device_depth = [&](double distance) {
        const glm::dvec4 clip = glm::dmat4(c.clip_from_view) * glm::dvec4(0, 0, -distance, 1);
        return clip.z / clip.w;
    };
    const double near_depth = c.depth.w == 1 ? 1 : 0, far_depth = c.depth.z;
    // Matrices of far planes at infinity miss the far depth by near / far, which is little in any of use.
    if (!(std::abs(device_depth(c.depth.x) - near_depth) < 0.01 &&
          std::abs(device_depth(c.depth.y) - far_depth) < 0.01))
        notes.push_back("camera.json contradicts itself: 'clip_from_view' gives the depths " +
                        std::to_string(device_depth(c.depth.x)) + " and " + std::to_string(device_depth(c.depth.y)) +
                        " at the planes 'near' and 'far', where 'depth_direction' has " +
                        std::to_string(int(near_depth)) + " and " + std::to_string(int(far_depth)) +
                        ". View space looks along -z; clip z goes from 0 to 1.");
    if (c.clip_from_view[1][1] > 0)
        notes.push_back(
            "'clip_from_view' of camera.json has clip space with y up, as OpenGL; it must point down: negate its "
            "second row, and turn the rows of the layers if the lowest comes first.");
    if (glm::determinant(glm::dmat3(c.view_from_world)) < 0)
        notes.push_back("'view_from_world' of camera.json mirrors: both spaces must be right-handed.");
}

/// At the farthest surface: what techniques read is no more exact than the codes of the depth.
void check_precision(const HostGBuffer& g, std::vector<std::string>& notes) {
    double farthest = 0;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i)
        if (!is_background(g, i)) farthest = std::max(farthest, double(view_distance(g.camera, g.depth.values[i])));
    const std::string warning =
        precision_warning("camera.json", g.camera, g.depth_format, farthest,
                          "The program that makes the frames can put its near plane farther out");
    if (!warning.empty()) notes.push_back(warning);
}

/// Whether the depths of surfaces are whole shares of `largest`, but for their rounding to float32. Few depths may be
/// so by chance.
bool are_codes(const HostGBuffer& g, double largest) {
    constexpr size_t least_codes = 8;
    constexpr double rounding = 0x1p-24;
    std::set<double> codes;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        if (is_background(g, i)) continue;
        const double code = double(g.depth.values[i]) * largest;
        if (!(std::abs(code - std::round(code)) <= largest * rounding)) return false;
        if (codes.size() < least_codes) codes.insert(std::round(code));
    }
    return codes.size() == least_codes;
}

/// Codes of 24 bits are no coarser than float32 near 1, where most depths are, so that nothing tells them.
void check_depth_codes(const HostGBuffer& g, std::vector<std::string>& notes) {
    if (are_codes(g, 255))
        notes.push_back(
            "All depths are multiples of 1/255, as of an image of 8 bits: save the depth buffer as floats.");
    else if (g.depth_format != DepthFormat::d16 && are_codes(g, 65535))
        notes.push_back(
            "All depths are multiples of 1/65535, but 'depth_format' of camera.json has finer steps: write \"d16\" if "
            "the depth buffer has 16 bits, else save its depths as floats.");
}

/// A reading of the file in another convention.
struct NormalReading {
    const char* name;
    std::function<glm::dvec3(glm::dvec3)> normal;
    bool has_turned_rows = false;      ///< the first row is the lowest, in all layers
    std::vector<double> cosines = {};  ///< between normals and the surfaces that the depths show
};

/// The normal of the surface through a pixel and its neighbours, towards the camera; none at edges. With turned rows
/// the depths of the rows below are taken for those above.
std::optional<glm::dvec3> normal_of_depths(const HostGBuffer& g, size_t i, bool has_turned_rows) {
    const size_t width = g.extent().x, rows = g.extent().y;
    const auto depth = [&](size_t j) {
        return g.depth.values[has_turned_rows ? (rows - 1 - j / width) * width + j % width : j];
    };
    const auto distance = [&](size_t j) { return double(view_distance(g.camera, depth(j))); };
    for (const size_t j : {i, i - 1, i + 1, i - width, i + width})
        if (depth(j) == g.camera.depth.z || std::abs(distance(j) - distance(i)) > 0.05 * distance(i)) return {};
    const auto position = [&](size_t j) { return position_at(g, j, depth(j)); };
    glm::dvec3 normal = glm::cross(position(i - width) - position(i + width), position(i - 1) - position(i + 1));
    const double length = glm::length(normal);
    if (!(length > 0)) return {};
    normal /= length;
    const bool is_orthographic = g.camera.frame.z == 1;
    const glm::dvec3 away =
        is_orthographic ? view_direction(g, i) : position(i) - glm::dvec3(g.camera.world_from_view[3]);
    return glm::dot(normal, away) > 0 ? -normal : normal;
}

constexpr size_t least_pixels = 50;  // fewer say nothing of a convention

/// Of the pixels, some of which show no surface of their own, the share whose normals fit to 25 degrees.
double fitting_share(const std::vector<double>& cosines) {
    return double(std::ranges::count_if(cosines, [](double cosine) { return cosine > 0.9; })) /
           double(std::max<size_t>(cosines.size(), 1));
}

void check_normals(const HostGBuffer& g, std::vector<std::string>& notes) {
    const glm::dmat3 world_from_view(g.camera.world_from_view);
    std::vector<NormalReading> readings = {
        {"as they are", [](glm::dvec3 n) { return n; }},
        {"with the rows turned", [](glm::dvec3 n) { return n; }, true},
        {"in view space", [&](glm::dvec3 n) { return world_from_view * n; }},
        {"in view space with z into the image",
         [&](glm::dvec3 n) { return world_from_view * glm::dvec3(n.x, n.y, -n.z); }},
        {"pointing into the surface", [](glm::dvec3 n) { return -n; }},
        {"in a world with +Z up", [](glm::dvec3 n) { return glm::dvec3(n.x, n.z, -n.y); }},
        {"as encoded in [0, 1]", [](glm::dvec3 n) { return 2.0 * n - 1.0; }}};
    const size_t width = g.extent().x, rows = g.extent().y;
    size_t facing_down = 0;
    for (const size_t i : sampled_pixels(g)) {
        const size_t turned = (rows - 1 - i / width) * width + i % width;
        const auto expected = normal_of_depths(g, i, false), when_turned = normal_of_depths(g, turned, true);
        if (!expected || !when_turned) continue;
        facing_down += expected->y < 0;
        for (NormalReading& reading : readings)
            reading.cosines.push_back(glm::dot(reading.normal(glm::dvec3(g.normal.rgb(i))),
                                               reading.has_turned_rows ? *when_turned : *expected));
    }
    NormalReading &as_read = readings[0], &upside_down = readings[1];
    if (as_read.cosines.size() < least_pixels) return;
    // Cosines. Normal maps bend normals by up to 45 degrees, half of them by less than 25.
    constexpr double fits = 0.95, may_fit = 0.9, never_fits = 0.7;
    const double as_is = median(as_read.cosines);
    const std::string text =
        "The normals do not fit the surfaces that the depths show (the median cosine between both is " +
        std::to_string(as_is).substr(0, 5) + ")";
    // Walls fit either way, so that floors and ceilings decide: most of what is seen is floors, and level normals that
    // point into what would be ceilings are those of floors, turned.
    constexpr double more = 0.1;
    const bool may_be_inward = fitting_share(readings[4].cosines) >= fitting_share(upside_down.cosines);
    if (median(upside_down.cosines) > fits &&
        fitting_share(upside_down.cosines) > fitting_share(as_read.cosines) + more &&
        (!may_be_inward || facing_down > as_read.cosines.size() / 2)) {
        notes.push_back(
            "The rows are upside down: the normals fit the surfaces that the depths show if the last row is the first "
            "one, as OpenGL reads textures (here the cosine between both is above 0.9 in " +
            percent(fitting_share(as_read.cosines)) + " of the pixels, there in " +
            percent(fitting_share(upside_down.cosines)) +
            "). Turn the rows of all layers: `oiiotool gbuffer.exr --flip -d material_id.Y=uint -o turned.exr`.");
        return;
    }
    if (as_is >= may_fit) return;
    const NormalReading* best = nullptr;  // a wall before the camera fits several of them, all that is seen fits one
    for (size_t r = 2; r < readings.size(); ++r)
        if (median(readings[r].cosines) > fits &&
            (!best || fitting_share(readings[r].cosines) > fitting_share(best->cosines)))
            best = &readings[r];
    if (best) {
        notes.push_back(text + "; they would, taken " + best->name +
                        ". They must be in world space, +Y up, and point away from the surface.");
        return;
    }
    if (as_is < never_fits) notes.push_back(text + ": check their space, the camera's matrices and 'near' and 'far'.");
}

struct MotionReading {
    std::string name;
    glm::dvec2 factor;  ///< of the file's values
};

/// Names another convention in which the motion vectors would fit the camera's path. True if they do not fit as they
/// are.
bool check_convention(const HostGBuffer& before, const HostGBuffer& now, const std::vector<size_t>& pixels,
                      std::vector<std::string>& notes) {
    const glm::dvec2 extent(now.extent());
    std::vector<MotionReading> readings;
    for (const auto& [unit, scale] : {std::pair<std::string, glm::dvec2>("", {1, 1}),
                                      {"pixels", 1.0 / extent},
                                      {"clip space (-1 to 1)", {0.5, 0.5}}})
        for (const auto& [sign, flip] : {std::pair<std::string, glm::dvec2>("", {1, 1}),
                                         {"before - now", {-1, -1}},
                                         {"y up", {1, -1}},
                                         {"before - now with y up", {-1, 1}}})
            readings.push_back({unit + (unit.empty() || sign.empty() ? "" : ", ") + sign, scale * flip});
    std::vector<std::vector<double>> off(readings.size());
    std::vector<double> moved;
    for (const size_t i : pixels) {
        const glm::dvec2 expected = motion_of_still(now, i, before.camera) * extent;
        const glm::dvec2 motion = glm::dvec2(now.motion.values[2 * i], now.motion.values[2 * i + 1]) * extent;
        moved.push_back(glm::length(expected));
        for (size_t r = 0; r < readings.size(); ++r)
            off[r].push_back(glm::length(motion * readings[r].factor - expected));
    }
    const double as_is = median(off.front()), path = median(moved);
    if (as_is < 0.5 || as_is < 0.5 * path) return false;  // pixels; most of what is seen moves by the camera alone
    const std::string text = "Half of the surfaces move differently from the cameras of both frames, by " +
                             std::to_string(as_is).substr(0, 5) +
                             " pixels and more (motion: uv now - uv before, y down)";
    size_t best = 0;
    for (size_t r = 1; r < readings.size(); ++r)
        if (median(off[r]) < median(off[best])) best = r;
    if (best != 0 && median(off[best]) < 0.2 * as_is)
        notes.push_back(text + "; they would fit, taken as " + readings[best].name + ".");
    else
        notes.push_back(text +
                        ". Do objects fill the image that move by themselves? Else the vectors, a camera or the "
                        "order of the frames is wrong.");
    return true;
}

}  // namespace

HostImage camera_motion(const HostGBuffer& now, const CameraData& before) {
    HostImage motion(now.extent(), 2);
    for (size_t i = 0; i < motion.pixel_count(); ++i) {
        const glm::dvec2 uv = motion_of_still(now, i, before);
        motion.values[2 * i] = float(uv.x), motion.values[2 * i + 1] = float(uv.y);
    }
    return motion;
}

std::vector<std::string> check_gbuffer(const HostGBuffer& gbuffer) {
    std::vector<std::string> notes;
    check_values(gbuffer, notes);
    check_camera(gbuffer, notes);
    check_precision(gbuffer, notes);
    check_depth_codes(gbuffer, notes);
    check_normals(gbuffer, notes);
    return notes;
}

std::vector<std::string> check_motion(const HostGBuffer& before, const HostGBuffer& now) {
    std::vector<std::string> notes;
    const std::vector<size_t> pixels = sampled_pixels(now);
    if (pixels.empty() || check_convention(before, now, pixels, notes)) return notes;
    size_t outside = 0, inside = 0, found = 0;
    for (const size_t i : pixels) {
        const glm::dvec2 uv = sample_uv(now, i) - glm::dvec2(now.motion.values[2 * i], now.motion.values[2 * i + 1]);
        const glm::dvec2 at = uv * glm::dvec2(now.extent());
        if (!(at.x >= 0 && at.y >= 0 && at.x < now.extent().x && at.y < now.extent().y)) {
            ++outside;
            continue;
        }
        ++inside;
        const auto expected = seen_at(before.camera, glm::dvec4(surface_position(now, i), 1));
        const size_t j = size_t(at.y) * now.extent().x + size_t(at.x);
        const double there = view_distance(before.camera, before.depth.values[j]),
                     wanted = expected ? view_distance(before.camera, float(expected->z)) : -1;
        found += std::abs(there - wanted) < 0.05 * wanted;  // between pixels depths differ, at grazing angles by much
    }
    if (outside > pixels.size() / 2)
        notes.push_back("The camera jumps: " + percent(double(outside) / double(pixels.size())) +
                        " of what is seen was outside of the frame before. Histories start anew there.");
    else if (found < inside / 2)
        notes.push_back("Only " + percent(double(found) / double(inside)) +
                        " of the surfaces are found in the depth of the frame before, where motion points. Is it "
                        "another frame's depth?");
    return notes;
}
