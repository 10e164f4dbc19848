#pragma once
#include "experiments/live/watch/watch_server.h"

#include <deque>
#include <filesystem>
#include <map>
#include <mutex>

/// The images of results that a page asks for by the hash of their files, in the codes that the report's viewer reads.
class PageImages {
public:
    /// What the page is told of an image: {"name", "format", "width", "height"}, with which it asks for it.
    /// `is_of_verdicts`: of a map of rays' verdicts, whose colours are few. Fails with Error if it cannot be read.
    nlohmann::json add(const std::filesystem::path& exr, bool is_of_verdicts = false);

    /// Of a name that add() gave; none of others, and of images that are long gone. Any thread may ask.
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
