#pragma once
#include "experiments/live/watch/watch_server.h"

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>

/// Images of results, encoded for the report's viewer; a page asks for them by the hash of their files.
class PageImages {
public:
    /// Adds an image. Returns {"name", "format", "width", "height"}, with which the page asks for it. `is_of_verdicts`:
    /// it is a map of rays' verdicts, with few colours. Fails with Error if it cannot be read.
    nlohmann::json add(const std::filesystem::path& exr, bool is_of_verdicts = false);

    /// The image of a name from add(); nullopt for other names and images dropped since. Thread-safe.
    std::optional<WatchReply> find(const std::string& name) const;

private:
    struct Kept {
        nlohmann::json description;
        std::string bytes;
    };
    mutable std::mutex mutex_;
    std::map<std::string, Kept> kept_;
    std::deque<std::string> order_;  ///< the oldest first
};
