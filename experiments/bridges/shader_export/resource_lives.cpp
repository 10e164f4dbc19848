#include "experiments/bridges/shader_export/resource_lives.h"

namespace {

/// Whether the shader reads or writes the resource; a clear only writes.
ShaderResourceLayout access_of(const ShaderLayout& layout, const UsedResource& used) {
    const auto found = layout.resources.find(used.variable);
    return found == layout.resources.end() ? ShaderResourceLayout{} : found->second;
}

}  // namespace

ResourceLives::ResourceLives(const FramePasses& frames, const std::vector<ShaderLayout>& layouts) {
    for (const std::vector<FrameCommand>& frame : frames.frames)
        for (const FrameCommand& command : frame)
            for (const auto* resources : {&command.samplers, &command.images, &command.targets})
                for (const UsedResource& used : *resources)
                    if (!used.is_input) sides_[used.resource].insert(used.storage);
    std::set<const void*> ever_written;
    for (const FrameCommand& command : frames.frames[0])
        for (const auto* resources : {&command.images, &command.targets, &command.buffers})
            for (const UsedResource& used : *resources) ever_written.insert(used.storage);
    for (size_t i = 0; i < frames.frames[1].size(); ++i) {
        const FrameCommand& command = frames.frames[1][i];
        const auto note_read = [&](const UsedResource& used) {
            const bool is_coarser_mip = used.first_mip > 0;  // which a pass that makes a pyramid writes, too
            if (access_of(layouts[i], used).is_read && !is_coarser_mip && !written_.contains(used.storage) &&
                ever_written.contains(used.storage))
                kept_.insert(used.resource);
        };
        for (const UsedResource& used : command.samplers) {
            note_read(used);
            if (used.variable == "previous_" + used.resource) previous_.insert(used.storage);
        }
        for (const auto* resources : {&command.images, &command.buffers})
            for (const UsedResource& used : *resources) note_read(used);
        for (const UsedResource& used : command.targets) written_.insert(used.storage);
        for (const auto* resources : {&command.images, &command.buffers})
            for (const UsedResource& used : *resources)
                if (command.is_clear() || access_of(layouts[i], used).is_written) written_.insert(used.storage);
    }
}

bool ResourceLives::is_history(const std::string& resource) const {
    const auto found = sides_.find(resource);
    return found != sides_.end() && found->second.size() == 2;
}

bool ResourceLives::is_previous(const UsedResource& used) const {
    return is_history(used.resource) && (previous_.contains(used.storage) || !written_.contains(used.storage));
}
