#pragma once
#include <algorithm>
#include <functional>
#include <future>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

/// Saves images in a thread of its own, while others are rendered: one call at a time, so that few are held.
class ImageQueue {
public:
    using Entries = std::vector<nlohmann::json>;  ///< of the manifest, see result_images.h

    /// Waits for the call before it. `save` holds or outlives what it needs until finish(). Fails with what the call
    /// before it failed with.
    void add(std::function<Entries()> save) {
        collect();
        saving_ = std::async(std::launch::async, std::move(save));
    }
    /// Of all calls, in the order of add().
    Entries finish() {
        collect();
        return std::move(entries_);
    }

private:
    void collect() {
        if (saving_.valid()) std::ranges::move(saving_.get(), std::back_inserter(entries_));
    }

    std::future<Entries> saving_;
    Entries entries_;
};
