#include "experiments/bridges/inspect/page.h"

#include "core/list_text.h"
#include "core/number_text.h"
#include "core/shown_text.h"
#include "core/wrapped_text.h"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace {

constexpr size_t most_rows = 8, widest_name = 40;

std::string text_of(const Description& value) {
    if (value.is_string()) return shown_text(value.get<std::string>());
    if (value.is_number_float()) return number_text(value.get<double>(), 6);
    if (!value.is_array()) return value.dump();
    return "(" + joined(names_of(value, text_of)) + ")";
}

/// A grey is one number.
std::string color_text(const Description& rgb) {
    return rgb[0] == rgb[1] && rgb[1] == rgb[2] ? text_of(rgb[0]) : text_of(rgb);
}

std::string name_text(const Description& name, bool has_all) {
    const std::string text = text_of(name);
    if (text.empty()) return "(no name)";
    return has_all ? text : cut_to(text, widest_name);
}

class Page {
public:
    explicit Page(bool has_all) : has_all_(has_all) {}

    void line(const std::string& text) { text_ += text + "\n"; }

    /// "bounds       29.7 x 12.4 m".
    void fact(const std::string& name, const std::string& text) {
        line(name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + text);
    }

    /// A heading with the count, then a row for each entry, whose cells are aligned. `count`: "": of the entries.
    void list(const std::string& heading, const Description& entries,
              const std::function<std::vector<std::string>(const Description&)>& cells_of,
              const std::string& count = "") {
        if (entries.empty()) return fact(heading, "none");
        fact(heading, count.empty() ? std::to_string(entries.size()) : count);
        std::vector<std::vector<std::string>> rows;
        const size_t shown = has_all_ || entries.size() <= most_rows + 1 ? entries.size() : most_rows;
        for (size_t i = 0; i < shown; ++i) rows.push_back(cells_of(entries[i]));
        table(rows);
        if (shown < entries.size()) line("  and " + std::to_string(entries.size() - shown) + " more; --all lists them");
    }

    void table(const std::vector<std::vector<std::string>>& rows) {
        std::vector<size_t> widths;
        for (const auto& row : rows)
            for (size_t i = 0; i < row.size(); ++i) {
                if (i == widths.size()) widths.push_back(0);
                widths[i] = std::max(widths[i], letters_of(row[i]));
            }
        for (const auto& row : rows) {
            std::string text = " ";
            for (size_t i = 0; i < row.size(); ++i)
                text += " " + row[i] + std::string(1 + widths[i] - letters_of(row[i]), ' ');
            text.erase(text.find_last_not_of(' ') + 1);
            line(text);
        }
    }

    void sentences(const std::string& heading, const Description& texts) {
        list(heading, texts, [](const Description& text) { return std::vector<std::string>{text_of(text)}; });
    }

    std::string name(const Description& name) const { return name_text(name, has_all_); }
    std::string take() { return std::move(text_); }

private:
    bool has_all_;
    std::string text_;
};

std::string size_text(const Description& d) { return text_of(d["width"]) + " x " + text_of(d["height"]); }

std::string size_of_block(const Description& size) { return text_of(size[0]) + " x " + text_of(size[1]); }

std::string lens_text(const Description& camera) {
    return camera.contains("height") ? "orthographic, " + text_of(camera["height"]) + " m high"
                                     : "perspective, " + text_of(camera["vertical_fov"]) + " degrees high";
}

std::string planes_text(const Description& camera) {
    return "planes " + text_of(camera["near"]) + " to " + text_of(camera["far"]) + " m";
}

void add_channels(Page& page, const Description& channels) {
    page.list("channels", channels, [&](const Description& c) {
        std::vector<std::string> row = {page.name(c["name"]), text_of(c["type"])};
        if (c.contains("least")) {
            row.push_back(text_of(c["least"]) + " to " + text_of(c["largest"]));
            row.push_back("mean " + text_of(c["mean"]));
            if (c["nan"] > 0) row.push_back(text_of(c["nan"]) + " NaN");
            if (c["infinite"] > 0) row.push_back(text_of(c["infinite"]) + " infinite");
        }
        if (c.contains("sampling")) row.push_back("one value for each " + size_of_block(c["sampling"]) + " pixels");
        if (c.contains("is_lossy")) row.push_back("changed by lossy compression");
        return row;
    });
}

/// "0 to 31, 0 to 17".
std::string window_text(const Description& window) {
    return text_of(window[0]) + " to " + text_of(window[2]) + ", " + text_of(window[1]) + " to " + text_of(window[3]);
}

std::vector<std::string> part_row(const Page& page, const Description& part) {
    std::string how = text_of(part["compression"]);
    if (part.contains("tile")) how += ", tiles of " + size_of_block(part["tile"]);
    if (part.contains("is_deep")) how += ", deep";
    std::vector<std::string> row = {part.contains("name") ? page.name(part["name"]) : "part", how,
                                    "primaries " + text_of(part["primaries"])};
    if (part["data_window"] != part["display_window"])
        row.push_back("holds pixels " + window_text(part["data_window"]) + " of the picture's " +
                      window_text(part["display_window"]));
    if (part.contains("view")) row.push_back("view " + text_of(part["view"]));
    return row;
}

void add_exr(Page& page, const Description& d) {
    page.list("parts", d["parts"], [&](const Description& part) { return part_row(page, part); });
    const Description& picture = d["picture"];
    if (picture.contains("refusal")) {
        page.fact("picture", "none: " + text_of(picture["refusal"]));
    } else {
        std::string channels;
        for (const Description& name : picture["channels"]) channels += (channels.empty() ? "" : " ") + text_of(name);
        page.fact("picture", channels + ", " + text_of(picture["colors"]));
        if (!picture["notes"].empty()) page.sentences("notes", picture["notes"]);
    }
    add_channels(page, d["channels"]);
    Description attributes = Description::array();
    for (const Description& part : d["parts"])
        if (part.contains("attributes"))
            for (const auto& [name, value] : part["attributes"].items())
                attributes.push_back(Description::array({name, value}));
    if (!attributes.empty())
        page.list("attributes", attributes, [&](const Description& a) {
            return std::vector<std::string>{page.name(a[0]), page.name(a[1])};
        });
}

void add_image(Page& page, const Description& d) {
    page.line(text_of(d["file"]) + ": " + text_of(d["format"]) + " image of " + size_text(d) + " pixels");
    if (d.contains("parts")) return add_exr(page, d);
    if (d.contains("stored")) page.fact("stored", text_of(d["stored"]));
    page.fact("colours", text_of(d["colors"]));
    add_channels(page, d["channels"]);
    if (!d["notes"].empty()) page.sentences("notes", d["notes"]);
}

std::string environment_text(const Description& e) {
    if (e["type"] == "constant") return "radiance " + color_text(e["radiance"]) + " from everywhere";
    if (e["type"] == "gradient")
        return "gradient along " + text_of(e["axis"]) + ": radiance " + color_text(e["color"]) + " + " +
               color_text(e["slope"]) + " cos";
    return "image of " + size_text(e) + " pixels, turned by " + text_of(e["rotation"]) + " degrees; mean radiance " +
           color_text(e["mean"]) + ", largest " + text_of(e["largest"]);
}

void add_bounds(Page& page, const Description& bounds) {
    const Description &low = bounds["low"], &high = bounds["high"];
    std::string size;
    for (size_t i = 0; i < 3; ++i)
        size += (i > 0 ? " x " : "") + text_of(Description(high[i].get<double>() - low[i].get<double>()));
    page.fact("bounds", size + " m, from " + text_of(low) + " to " + text_of(high));
}

std::vector<std::string> camera_row(const Page& page, const Description& c) {
    std::vector<std::string> row = {page.name(c["name"]), lens_text(c), planes_text(c),
                                    counted(c["frames"].get<size_t>(), "frame")};
    if (c.contains("aspect")) row.push_back("aspect " + text_of(c["aspect"]));
    return row;
}

std::vector<std::string> light_row(const Page& page, const Description& l) {
    const Description& strength = l.contains("irradiance") ? l["irradiance"] : l["intensity"];
    std::vector<std::string> row = {page.name(l["name"]), text_of(l["type"]),
                                    color_text(strength) + " " + text_of(l["unit"])};
    if (l.contains("outer_cone"))
        row.push_back("cone " + text_of(l["inner_cone"]) + " to " + text_of(l["outer_cone"]) + " degrees");
    if (l.contains("range")) row.push_back("range " + text_of(l["range"]) + " m");
    return row;
}

std::vector<std::string> material_row(const Page& page, const Description& m) {
    std::string how =
        m["is_unlit"] ? "unlit" : "metalness " + text_of(m["metalness"]) + ", roughness " + text_of(m["roughness"]);
    if (m["specular"] != 1.0) how += ", specular " + text_of(m["specular"]);
    if (m["emission"] != Description{0.0, 0.0, 0.0}) how += ", emits " + color_text(m["emission"]);
    if (m["alpha_mode"] == "mask") how += ", mask at " + text_of(m["alpha_cutoff"]);
    if (m["is_double_sided"]) how += ", double-sided";
    std::string textures;
    for (const auto& [name, slot] : m["textures"].items())
        textures += (textures.empty() ? "" : " ") + name + ":" + text_of(slot["texture"]);
    return {page.name(m["name"]), counted(m["triangles"].get<size_t>(), "triangle"),
            "base colour " + color_text(m["base_color"]), how, textures};
}

/// Textures that differ in number and name alone share a row.
void add_textures(Page& page, const Description& textures) {
    std::vector<std::pair<std::string, std::vector<size_t>>> kinds;
    for (size_t i = 0; i < textures.size(); ++i) {
        const Description& t = textures[i];
        std::string kind = size_text(t) + ", " + text_of(t["bits"]) + " bits, " + text_of(t["colors"]) + ", " +
                           text_of(t["wrap_u"]) + (t["wrap_u"] == t["wrap_v"] ? "" : " and " + text_of(t["wrap_v"])) +
                           ", " + text_of(t["filter"]);
        const auto found = std::ranges::find(kinds, kind, &std::pair<std::string, std::vector<size_t>>::first);
        (found == kinds.end() ? kinds.emplace_back(std::move(kind), std::vector<size_t>{}) : *found)
            .second.push_back(i);
    }
    Description rows = Description::array();
    for (const auto& [kind, numbers] : kinds) {
        std::string which = "texture " + std::to_string(numbers.front());
        if (numbers.size() > 1)
            which = std::to_string(numbers.size()) + " textures, the first is " + std::to_string(numbers.front());
        rows.push_back({which, kind, page.name(textures[numbers.front()]["name"])});
    }
    page.list(
        "textures", rows, [](const Description& row) { return row.get<std::vector<std::string>>(); },
        std::to_string(textures.size()) + (textures.size() > rows.size() ? " of " + counted(rows.size(), "kind") : ""));
}

void add_first_view(Page& page, const Description& v) {
    const auto count = [&](const char* key) { return v[key].get<size_t>(); };
    const std::string share = percent_text(double(count("differ")) / double(count("pixels")), 2);
    page.fact("first view", text_of(v["picture"]) + ", " + size_text(v) + " pixels: the renderers differ in " +
                                counted(count("differ"), "pixel") + " (" + share +
                                "): " + std::to_string(count("other_surface")) + " by surface, " +
                                std::to_string(count("other_color")) + " by colour, " +
                                std::to_string(count("other_normal")) + " by normal");
    page.line(
        "            columns: rasteriser, path tracer, difference; rows: base colour and emission, normal, depth");
}

std::string list_text(const Description& texts) { return joined(names_of(texts, text_of)); }

/// What a glTF says of itself.
void add_document(Page& page, const Description& d) {
    page.fact("file", text_of(d["format"]) + " " + list_text(d["version"]) +
                          (d["generator"].empty() ? "" : " by " + list_text(d["generator"])) + ", " +
                          text_of(d["bytes"]) + " bytes");
    if (!d["extensions_used"].empty()) page.fact("extensions", list_text(d["extensions_used"]));
    if (!d["extensions_required"].empty()) page.fact("required", list_text(d["extensions_required"]));
}

void add_refused_scene(Page& page, const Description& d) {
    page.line(text_of(d["document"]["file"]) + ": a scene that ssrlab cannot use");
    add_document(page, d["document"]);
    std::string counts;
    for (const auto& [name, count] : d["document"]["counts"].items())
        counts += (counts.empty() ? "" : ", ") + text_of(count) + " " + name;
    page.fact("holds", counts.empty() ? "nothing" : counts);
}

/// What moves and deforms, of a scene in which something does.
void add_motion(Page& page, const Description& d) {
    if (!d["clips"].empty())
        page.list("clips", d["clips"], [&](const Description& clip) {
            return std::vector<std::string>{page.name(clip["name"]), clip["is_played"] ? "played" : "not played"};
        });
    if (!d["skins"].empty())
        page.list("skins", d["skins"], [](const Description& skin) {
            return std::vector<std::string>{counted(skin["joints"].get<size_t>(), "joint")};
        });
    if (d["meshes_with_morph_targets"] > 0)
        page.fact("morphs", counted(d["meshes_with_morph_targets"].get<size_t>(), "mesh part") + " with morph targets");
}

void add_scene(Page& page, const Description& d) {
    const std::string name = text_of(d["name"]), asset = text_of(d["asset"]);
    page.line("scene " + name + (asset.empty() || asset == name ? "" : ", which shows " + asset));
    if (d.contains("document")) add_document(page, d["document"]);
    add_bounds(page, d["bounds"]);
    page.fact("geometry", counted(d["triangles"].get<size_t>(), "triangle") + " in " +
                              counted(d["instances"].get<size_t>(), "instance") + " of " +
                              counted(d["meshes"].get<size_t>(), "mesh part") + ", " +
                              counted(d["nodes"].get<size_t>(), "node"));
    page.fact("backs", text_of(d["backs_of_single_sided_surfaces"]) + ", for single-sided surfaces");
    page.fact("environment", environment_text(d["environment"]));
    if (const Description& a = d["animation"]; !a.is_null())
        page.fact("animation", text_of(a["seconds"]) + " s of " + counted(a["nodes"].get<size_t>(), "node") + ": " +
                                   counted(a["translations"].get<size_t>(), "translation") + ", " +
                                   counted(a["rotations"].get<size_t>(), "rotation") + ", " +
                                   counted(a["scales"].get<size_t>(), "scale") + ", " +
                                   counted(a["weights"].get<size_t>(), "morph weight"));
    add_motion(page, d);
    page.fact("time", counted(d["frames"].get<size_t>(), "frame") + ", " + text_of(d["frame_rate"]) + " a second");
    page.list("cameras", d["cameras"], [&](const Description& c) { return camera_row(page, c); });
    page.list("lights", d["lights"], [&](const Description& l) { return light_row(page, l); });
    page.list("materials", d["materials"], [&](const Description& m) { return material_row(page, m); });
    add_textures(page, d["textures"]);
    page.sentences("ignored", d["ignored"]);
    if (d.contains("first_view")) add_first_view(page, d["first_view"]);
}

void add_capture(Page& page, const Description& d) {
    page.line("capture " + text_of(d["name"]) + ": " + counted(d["frames"].size(), "frame") + " of " + size_text(d) +
              " pixels");
    const Description& camera = d["camera"];
    page.fact("camera", lens_text(camera) + ", " + planes_text(camera) + ", " + text_of(camera["depth"]) +
                            " depth, at " + text_of(camera["position"]));
    page.fact("lit colour", d["has_lit"] ? "in the files" : "none: a reference must provide it");
    page.fact("environment", d["has_environment"] ? "in environment.json" : "none");
    add_channels(page, d["channels"]);
    Description pixels = Description::array();
    for (const auto& [name, fact] : d["pixels"].items())
        pixels.push_back({name, text_of(fact["value"]), text_of(fact["why"])});
    page.list("pixels", pixels, [](const Description& row) { return row.get<std::vector<std::string>>(); });
    page.sentences("notes", d["notes"]);
}

void add_frames(Page& page, const Description& d) {
    page.line("frames of " + text_of(d["engine"]) + " " + text_of(d["version"]) + ", called " + text_of(d["name"]));
    page.fact("seeds", text_of(d["seeds"]));
    Description settings = Description::array();
    for (const auto& [name, value] : d["settings"].items()) settings.push_back({name, text_of(value)});
    if (!settings.empty())
        page.list("settings", settings, [](const Description& row) { return row.get<std::vector<std::string>>(); });
    page.list("views", d["views"], [&](const Description& v) {
        return std::vector<std::string>{page.name(v["scene"]), "camera " + page.name(v["camera"]), size_text(v),
                                        counted(v["frames"].size(), "frame")};
    });
    if (!d["views"].empty()) add_channels(page, d["views"][0]["channels"]);
}

}  // namespace

std::string page_of(const Description& description, bool has_all) {
    Page page(has_all);
    const std::string kind = description.at("kind");
    if (kind == "image") add_image(page, description);
    if (kind == "scene") add_scene(page, description);
    if (kind == "refused scene") add_refused_scene(page, description);
    if (kind == "capture") add_capture(page, description);
    if (kind == "frames") add_frames(page, description);
    return page.take();
}
