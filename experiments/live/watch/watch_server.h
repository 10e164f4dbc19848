#pragma once
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// The answer to a request.
struct WatchReply {
    std::string type;  ///< MIME type of the body
    std::string body;
};

/// What the server offers. It opens no file itself: names are looked up and are no paths.
struct WatchPages {
    std::map<std::string, WatchReply> files;  ///< by name; "" is the page itself
    /// The image of a name from the news; nullopt for others. Called by several threads.
    std::function<std::optional<WatchReply>(const std::string& name)> image;
    /// Does what the page asks. Returns "", or a sentence that says why it was not done. Called by several threads.
    std::function<std::string(const std::string& what, const nlohmann::json& value)> take;
};

/// Serves a page on this machine alone, at a free port of the loopback address. It answers requests whose address has
/// its random token, that ask for this host, and that come from no other page. All others get 403 or 404.
class WatchServer {
public:
    /// Starts to listen. Fails with MachineError if no port is free.
    explicit WatchServer(WatchPages pages);
    ~WatchServer();
    WatchServer(const WatchServer&) = delete;
    WatchServer& operator=(const WatchServer&) = delete;

    std::string address() const;  ///< "http://127.0.0.1:PORT/TOKEN/"
    /// Sends news to all open pages; pages opened later show them, too.
    void publish(nlohmann::json news);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};
