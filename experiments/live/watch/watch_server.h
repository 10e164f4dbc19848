#pragma once
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// What a request is answered with.
struct WatchReply {
    std::string type;  ///< of the body, as MIME names it
    std::string body;
};

/// All that the server has to give. It opens no file itself: a name is looked up, and is no path.
struct WatchPages {
    std::map<std::string, WatchReply> files;  ///< by name; "" is the page itself
    /// Of a name that the news gave; none of any other. Called by several threads.
    std::function<std::optional<WatchReply>(const std::string& name)> image;
    /// What the page asks to be done; the answer is "", or a sentence that says why it is not. Called by several
    /// threads.
    std::function<std::string(const std::string& what, const nlohmann::json& value)> take;
};

/// A page on this machine alone: the server listens on the loopback address, at a port that is free, and answers what
/// names its random token in the address, asks for this host, and comes from no other page. All else gets 403 or 404.
class WatchServer {
public:
    /// Fails with MachineError if there is no port to listen on.
    explicit WatchServer(WatchPages pages);
    ~WatchServer();
    WatchServer(const WatchServer&) = delete;
    WatchServer& operator=(const WatchServer&) = delete;

    std::string address() const;  ///< "http://127.0.0.1:PORT/TOKEN/"
    /// What pages that are open show from now on.
    void publish(nlohmann::json news);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};
