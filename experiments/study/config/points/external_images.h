#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

struct Shot;

/// Frames that another program rendered, judged as a technique's frames are. Their folder has external.json, which says
/// what rendered them, and two kinds of images for each view and frame (experiments/docs/judge.md).
struct ExternalImages {
    std::filesystem::path folder;
    std::string name, point;                       ///< technique and point in results
    std::string engine, version, driver, licence;  ///< for readers; driver and licence may be ""
    nlohmann::json settings;                       ///< values by name: texts, numbers, true or false
    unsigned seeds = 1;                            ///< images of each frame that differ by chance alone
    bool has_given_light = false;  ///< surfaces emit the light that `ssrlab scene-for` wrote: without reflections each
                                   ///< pixel equals the truth
    std::optional<double> milliseconds;  ///< time of a frame's reflections, as the engine states it

    /// The frame's image of this seed: all light, linear Rec. 709.
    std::filesystem::path image(const Shot& shot, unsigned frame, unsigned seed) const;
    /// The frame with reflections off. It shows whether camera and materials are those of the scene.
    std::filesystem::path proof(const Shot& shot, unsigned frame) const;
    /// The folder of a view's images within `folder`: `<scene>.<camera>.<width>x<height>`.
    static std::string view_name(const Shot& shot);
    bool has_view(const Shot& shot) const;
    /// The frame rendered with the light of one half of its samples: `which` is 'a' or 'b'.
    std::filesystem::path half(const Shot& shot, unsigned frame, char which) const;
    /// Whether both halves exist. They hold the noise of given light as the renderer saw it.
    bool has_halves(const Shot& shot, unsigned frame) const;

    /// Hash of external.json and of the images of the frames that the shot measures. Fails with Error where one is
    /// missing.
    std::string content_hash(const Shot& shot) const;
};

/// Reads the folder's external.json. Every mistake is an Error that names place and key; `where` begins the message if
/// the folder is missing.
std::shared_ptr<const ExternalImages> read_external_images(const std::filesystem::path& folder,
                                                           const std::string& where);

/// Why external images cannot show a shot; "" if they can.
std::string why_not_external(const Shot& shot);
