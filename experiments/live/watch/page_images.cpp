#include "experiments/live/watch/page_images.h"

#include "core/exr/exr.h"
#include "experiments/report/image_encoding.h"
#include "experiments/results/cells/image_path.h"

namespace {

constexpr size_t most_images = 200;  // at 480x270 some 100 MB

}  // namespace

nlohmann::json PageImages::add(const std::filesystem::path& exr, bool is_of_verdicts) {
    const std::string hash = file_hash(exr);
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = kept_.find(hash); found != kept_.end()) return found->second.description;
    }
    const HostImage rgb = read_exr_rgb(exr);
    nlohmann::json description = {{"name", hash},
                                  {"format", is_of_verdicts ? "palette" : "halves"},
                                  {"width", rgb.extent.x},
                                  {"height", rgb.extent.y}};
    size_t clamped = 0;
    const std::vector<unsigned char> bytes =
        is_of_verdicts ? encode_palette(rgb, description["palette"]) : encode_halves(rgb, clamped);
    const std::lock_guard lock(mutex_);
    kept_[hash] = {description, std::string(bytes.begin(), bytes.end())};
    order_.push_back(hash);
    if (order_.size() > most_images) kept_.erase(order_.front()), order_.pop_front();
    return description;
}

std::optional<WatchReply> PageImages::find(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(name);
    if (found == kept_.end()) return {};
    return WatchReply{.type = "application/octet-stream", .body = found->second.bytes};
}
