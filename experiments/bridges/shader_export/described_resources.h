#pragma once
#include "experiments/bridges/shader_export/resource_lives.h"

#include <nlohmann/json.hpp>

/// What the frames of a technique show only together with its declaration.
struct DeclaredFacts {
    struct Arguments {
        std::string buffer;
        unsigned offset = 0;  ///< bytes
    };
    std::map<std::string, Arguments> arguments;  ///< of passes that are dispatched indirectly, by their shaders
    std::set<std::string> kept_images;           ///< pixels that passes do not write keep older frames' content
};
/// Of the technique's technique.json and the chosen denoiser's denoiser.json.
DeclaredFacts declared_facts(const PointConfig& point);

/// What the shader does with the resource: "read", "write", "read and write", or "none".
std::string access_name(const ShaderResourceLayout& layout);
/// Of a resource of the compute or fragment shader; nullopt if its pipeline has none of the name.
std::optional<unsigned> binding_of(const FrameCommand& command, const std::string& name);

/// Describes what passes use, and lists it: the parts "inputs", "images" and "buffers" of passes.json.
class DescribedResources {
public:
    /// `other`: of another screen, see screen_share.h. All references must outlive this.
    DescribedResources(const FramePasses& frames, const FramePasses& other, const DeclaredFacts& facts,
                       const ResourceLives& lives)
        : frames_(frames), other_(other), facts_(facts), lives_(lives) {}

    /// `layout`: of the shader; empty for what a pass draws to. `other`: the same use on the other screen.
    nlohmann::json image_use(const FrameCommand& command, const UsedResource& used, const UsedResource& other,
                             const ShaderLayout& layout);
    nlohmann::json buffer_use(const FrameCommand& command, const UsedResource& used, const UsedResource& other,
                              const ShaderLayout& layout);
    /// A number of pixels or workgroups as a share of the screen: share_text().
    std::string share_of(glm::uvec2 size, glm::uvec2 other_size) const;
    /// Moves images that no pass writes from the images to a list of their own, which it returns.
    nlohmann::json take_fixed_images();

    nlohmann::json inputs = nlohmann::json::array(), images = nlohmann::json::array(),
                   buffers = nlohmann::json::array();

private:
    void list_image(const FrameCommand& command, const UsedResource& used, const nlohmann::json& use);

    const FramePasses &frames_, &other_;
    const DeclaredFacts& facts_;
    const ResourceLives& lives_;
};
