#pragma once
#include <algorithm>
#include <functional>
#include <future>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

/// Saves images in a second thread while others are rendered. One call runs at a time, so that few images are held.
class ImageQueue {
public:
    using Entries = std::vector<nlohmann::json>;  ///< manifest entries, see result_images.h

    /// Waits for the previous call, then starts `save`, whose data must live until finish(). Throws what the previous
    /// call threw.
    void add(std::function<Entries()> save) {
        collect();
        saving_ = std::async(std::launch::async, std::move(save));
    }
    /// Waits for the last call. Returns the entries of all calls, in the order of add().
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
