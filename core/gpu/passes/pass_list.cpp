#include "core/gpu/format.h"
#include "core/gpu/passes/pass_list_impl.h"
#include "core/gpu/resources.h"

namespace {

/// Both sides of a history are one image to those who ask for it.
std::string without_side(const std::string& name) { return name.substr(0, name.find('#')); }

}  // namespace

PassList::PassList(Device& device, glm::uvec2 extent)
    : PassList(device, extent, device.info().is_cpu() ? Clock::host_fence : Clock::gpu_timestamp) {}
PassList::PassList(Device& device, glm::uvec2 extent, Clock clock)
    : impl_(std::make_unique<Impl>(device, extent, clock)) {}
PassList::~PassList() = default;

Clock PassList::clock() const { return impl_->clock; }
void PassList::observe(PassObserver observer) { impl_->observer = std::move(observer); }
bool PassList::uses_gpu_forms() const { return impl_->uses_gpu_forms; }
void PassList::use_gpu_forms(bool uses_them) { impl_->uses_gpu_forms = uses_them; }
void PassList::set_changes(PassChanges changes) { impl_->changes = std::move(changes); }
std::string PassList::asked_name(const Image& image) const {
    for (const auto& [name, known] : impl_->images)
        if (known.storage == image.storage) return without_side(name);
    return {};
}
bool PassList::has_input(const std::string& name) const { return impl_->inputs.contains(name); }
glm::uvec2 PassList::extent() const { return impl_->extent; }
Device& PassList::device() { return impl_->device; }

Image PassList::image(const std::string& name, Format format, unsigned mips, unsigned divisor) {
    return image_of(name, format, max(impl_->extent / divisor, 1u), mips);
}

Image PassList::image_of(const std::string& name, Format asked, glm::uvec2 extent, unsigned mips) {
    const auto& format_of = impl_->changes.format_of;
    const Format format = format_of ? format_of(without_side(name), asked) : asked;
    if (extent.x == 0 || extent.y == 0) fail("image '", name, "' has zero size");
    const auto [entry, is_new] = impl_->images.try_emplace(name);
    Image& image = entry->second;
    if (is_new || image.format != format || image.extent != extent || image.mips != mips) {
        impl_->flush();  // recorded passes may use the one that it replaces
        image = {.name = name,
                 .format = format,
                 .extent = extent,
                 .mips = mips,
                 .storage = create_image(impl_->gpu, format, extent, mips)};
        if (impl_->observer) clear(image, glm::vec4(0.0f));
    }
    return image;
}

Buffer PassList::buffer(const std::string& name, size_t bytes) {
    if (bytes == 0 || bytes % 4) fail("buffer '", name, "' has ", bytes, " bytes; it takes a positive multiple of 4");
    const auto [entry, is_new] = impl_->buffers.try_emplace(name);
    if (is_new || entry->second.size != bytes) {
        impl_->flush();
        entry->second = {.name = name, .size = bytes, .storage = create_buffer(impl_->gpu, bytes)};
    }
    return entry->second;
}

Image PassList::image_black_at_first(const std::string& name, Format format, glm::uvec2 extent) {
    const auto known = impl_->images.find(name);
    const std::shared_ptr<ImageStorage> before = known == impl_->images.end() ? nullptr : known->second.storage;
    const Image image = image_of(name, format, extent);
    if (image.storage != before) clear(image, glm::vec4(0.0f));
    return image;
}

PassList::History PassList::history(const std::string& name, Format format) {
    return history(name, format, impl_->extent);
}

PassList::History PassList::history(const std::string& name, Format format, glm::uvec2 extent) {
    const Image sides[2] = {image_black_at_first(name + "#0", format, extent),
                            image_black_at_first(name + "#1", format, extent)};
    return {sides[impl_->parity].as(name), sides[1 - impl_->parity].as("previous_" + name)};
}

void PassList::clear(const Image& image, glm::vec4 value) {
    allow_use(impl_->gpu, image, vk::ImageUsageFlagBits::eTransferDst);
    impl_->execute("clear", [&](const auto& commands) {
        const ImageStorage& storage = *image.storage;
        const vk::ImageSubresourceRange range{storage.aspect, image.first_mip, image.mips, 0, 1};
        if (storage.aspect & vk::ImageAspectFlagBits::eDepth) {
            commands.clearDepthStencilImage(*storage.image, vk::ImageLayout::eGeneral,
                                            vk::ClearDepthStencilValue{value.x, uint32_t(value.y)}, range);
        } else {
            const VkClearColorValue integer{.uint32 = {uint32_t(value.x), 0, 0, 0}},
                real{.float32 = {value.x, value.y, value.z, value.w}};
            const VkClearColorValue& chosen = image.format == Format::r32ui ? integer : real;
            const auto color = std::bit_cast<vk::ClearColorValue>(chosen);
            commands.clearColorImage(*storage.image, vk::ImageLayout::eGeneral, color, range);
        }
    });
    image.storage->is_written = true;
    if (impl_->watcher) impl_->watcher->cleared(image, value);
}

void PassList::clear(const Buffer& buffer, uint32_t value) {
    impl_->check_limits(buffer);
    impl_->execute("clear", [&](const auto& commands) {
        commands.fillBuffer(*buffer.storage->buffer.buffer, 0, VK_WHOLE_SIZE, value);
    });
    if (impl_->watcher) impl_->watcher->cleared(buffer);
}

void PassList::upload(const Image& image, const HostImage& pixels) {
    const FormatFacts& layout = facts_of(image.format);
    if (pixels.extent != image.extent || pixels.channels != layout.channels)
        fail("image '", image.name, "' is ", image.extent.x, "x", image.extent.y, " with ", layout.channels,
             " channels and cannot take ", pixels.extent.x, "x", pixels.extent.y, " with ", pixels.channels);
    impl_->check_upload_limits(image);
    std::vector<std::byte> texels(pixels.pixel_count() * layout.bytes);
    encode_texels(image.format, pixels.values, texels.data());
    impl_->flush();
    upload_texels(impl_->gpu, image, texels);
    if (impl_->watcher) impl_->watcher->uploaded(image);
}

void PassList::upload_rgba8(const Image& image, std::span<const uint8_t> texels) {
    if (texels.size() != size_t(image.extent.x) * image.extent.y * 4)
        fail("image '", image.name, "' takes ", size_t(image.extent.x) * image.extent.y * 4, " bytes, not ",
             texels.size());
    impl_->flush();
    upload_texels(impl_->gpu, image, std::as_bytes(texels));
    if (impl_->watcher) impl_->watcher->uploaded(image);
}

void PassList::upload(const Buffer& buffer, std::span<const std::byte> bytes) {
    impl_->check_limits(buffer);
    if (bytes.size() > buffer.size)
        fail("buffer '", buffer.name, "' holds ", buffer.size, " bytes, not ", bytes.size());
    impl_->flush();
    upload_bytes(impl_->gpu, buffer, bytes);
}

HostImage PassList::download(const Image& image) {
    impl_->flush();
    const std::vector<std::byte> texels = download_texels(impl_->gpu, image);
    HostImage pixels(image.extent, facts_of(image.format).channels);
    decode_texels(image.format, texels.data(), pixels.values);
    return pixels;
}

std::vector<std::byte> PassList::download(const Buffer& buffer) {
    impl_->flush();
    return download_bytes(impl_->gpu, buffer);
}
