#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

struct Shot;

/// Frames that another program rendered, which stand in a study as a technique's do: a folder with external.json, which
/// says what rendered them, and two kinds of images for each view and frame (experiments/README.md).
struct ExternalImages {
    std::filesystem::path folder;
    std::string name, point;                       ///< as results call technique and point
    std::string engine, version, driver, licence;  ///< as people know them; the last two may be ""
    nlohmann::json settings;                       ///< values by name: texts, numbers, true or false
    unsigned seeds = 1;                            ///< images of each frame, which differ by chance alone
    bool has_given_light =
        false;  ///< surfaces emit what scene-for wrote: without reflections each pixel is the truth's
    std::optional<double> milliseconds;  ///< of a frame's reflections, as the engine states it

    /// The frame as `seed` rendered it: all light, linear Rec. 709.
    std::filesystem::path image(const Shot& shot, unsigned frame, unsigned seed) const;
    /// The same with reflections off, which shows whether camera and materials are those of the scene.
    std::filesystem::path proof(const Shot& shot, unsigned frame) const;
    /// The folder of a view's images, within `folder`: `<scene>.<camera>.<width>x<height>`.
    static std::string view_name(const Shot& shot);
    bool has_view(const Shot& shot) const;
    /// The frame as rendered in the light of one half of its samples, 'a' or 'b'.
    std::filesystem::path half(const Shot& shot, unsigned frame, char which) const;
    /// Whether there is both: of a given light, where what rendered the images has seen its noise.
    bool has_halves(const Shot& shot, unsigned frame) const;

    /// Of external.json and of the images of the frames that a shot measures. Fails where one is missing.
    std::string content_hash(const Shot& shot) const;
};

/// Reads the folder's external.json. Every mistake is an Error that names place and key; `where` begins the message if
/// there is no such folder.
std::shared_ptr<const ExternalImages> read_external_images(const std::filesystem::path& folder,
                                                           const std::string& where);

/// Why no shot like this can hold external images; "" if it can.
std::string why_not_external(const Shot& shot);
