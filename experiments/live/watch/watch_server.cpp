#include "experiments/live/watch/watch_server.h"

#include "core/error.h"
#include "experiments/live/watch/impatient_socket.h"

#include <httplib.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace {

constexpr size_t longest_path = 200, largest_body = 1 << 16;
constexpr auto longest_wait = std::chrono::seconds(20);  // of a page for news, which then asks again
constexpr size_t most_connections = 256;                 // each page that waits has one
constexpr int most_waiting = 128;                        // connections that are not accepted yet

/// 128 random bits as hexadecimal digits.
std::string random_token() {
    unsigned char bytes[16];
    if (getrandom(bytes, sizeof bytes, 0) != ssize_t(sizeof bytes)) fail_machine("the system gives no random numbers");
    std::string token;
    for (const unsigned char byte : bytes)
        for (const int digit : {byte >> 4, byte & 15}) token += "0123456789abcdef"[digit];
    return token;
}

/// In a time that does not tell how much of it is right.
bool is_token(const std::string& text, const std::string& token) {
    unsigned differing = text.size() != token.size();
    for (size_t i = 0; i < token.size(); ++i) differing |= unsigned(token[i] ^ (i < text.size() ? text[i] : '\0'));
    return differing == 0;
}

/// For pages that run nothing but their own scripts, are shown in no other page, and tell nobody their address.
httplib::Headers headers_of_all() {
    return {{"Content-Security-Policy",
             "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
             "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
            {"Referrer-Policy", "no-referrer"},
            {"X-Content-Type-Options", "nosniff"},
            {"Cross-Origin-Resource-Policy", "same-origin"},
            {"Cache-Control", "no-store"}};
}

/// A thread for each connection, which a slow client thus keeps from nobody.
class ThreadForEach : public httplib::TaskQueue {
public:
    void enqueue(std::function<void()> serve) override {
        std::unique_lock lock(mutex_);
        has_room_.wait(lock, [&] { return running_ < most_connections; });
        ++running_;
        lock.unlock();
        const auto run = [this, serve = std::move(serve)] {
            serve();
            const std::lock_guard ended(mutex_);
            --running_;
            has_room_.notify_all();
        };
        try {
            std::thread(run).detach();
        } catch (const std::system_error&) {  // there are no more threads
            run();
        }
    }
    void shutdown() override {
        std::unique_lock lock(mutex_);
        has_room_.wait(lock, [&] { return running_ == 0; });
    }

private:
    std::mutex mutex_;
    std::condition_variable has_room_;
    size_t running_ = 0;
};

/// An ImpatientSocket as httplib reads and writes it.
class SocketStream : public httplib::Stream {
public:
    SocketStream(socket_t socket, const std::atomic<bool>& is_ending) : socket_(socket, is_ending) {}

    bool is_readable() const override { return socket_.is_readable(); }
    bool is_writable() const override { return socket_.is_writable(); }
    ssize_t read(char* bytes, size_t size) override { return socket_.read(bytes, size); }
    ssize_t write(const char* bytes, size_t size) override { return socket_.write(bytes, size); }
    void get_remote_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
    void get_local_ip_and_port(std::string& ip, int& port) const override { ip = "127.0.0.1", port = 0; }
    socket_t socket() const override { return socket_.number(); }

private:
    ImpatientSocket socket_;
};

/// A server of one request for each connection, which no client can keep waiting, or from its end.
class ImpatientServer : public httplib::Server {
public:
    ImpatientServer() {
        new_task_queue = [] { return new ThreadForEach; };
    }
    /// Returns the port; 0 or less if none is free.
    int bind() {
        const int port = bind_to_any_port("127.0.0.1");
        ::listen(svr_sock_, most_waiting);  // httplib's own 5 refuse a page beside a few others
        return port;
    }
    void end() {
        is_ending_ = true;
        stop();
    }

private:
    bool process_and_close_socket(socket_t socket) override {
        SocketStream stream(socket, is_ending_);
        bool is_closed = false;
        return process_request(stream, /*close_connection=*/true, is_closed, nullptr);
    }

    std::atomic<bool> is_ending_ = false;
};

}  // namespace

struct WatchServer::Parts {
    explicit Parts(WatchPages pages) : pages(std::move(pages)) {
        server.set_default_headers(headers_of_all());
        server.set_payload_max_length(largest_body);
        server.set_pre_routing_handler([this](const auto& request, auto& response) {
            const int refusal = refusal_of(request);
            if (refusal == 0) return httplib::Server::HandlerResponse::Unhandled;
            response.status = refusal;
            return httplib::Server::HandlerResponse::Handled;
        });
        server.Get("/.*", [this](const auto& request, auto& response) { get(request, response); });
        server.Post("/.*", [this](const auto& request, auto& response) { post(request, response); });
        port = server.bind();
        if (port <= 0) fail_machine("no port of 127.0.0.1 is free to listen on");
        listening = std::thread([this] { server.listen_after_bind(); });
        while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    ~Parts() {
        {
            const std::lock_guard lock(mutex);
            is_ending = true;
        }
        changed.notify_all();
        server.end();
        listening.join();
    }

    /// Whether it is what this server is called: a page of a name that somebody else made to lead here is told nothing.
    bool is_own_host(const std::string& host) const {
        const std::string at = ":" + std::to_string(port);
        return host == "127.0.0.1" + at || host == "localhost" + at;
    }

    /// The status that refuses it; 0 if it is answered.
    int refusal_of(const httplib::Request& request) const {
        constexpr int forbidden = 403, unknown = 404;
        const std::string origin = request.get_header_value("Origin"), prefix = "http://";
        const std::string site = request.get_header_value("Sec-Fetch-Site");
        const bool is_post = request.method == "POST";
        if (!is_own_host(request.get_header_value("Host"))) return forbidden;
        if (request.has_header("Origin") || is_post)
            if (!origin.starts_with(prefix) || !is_own_host(origin.substr(prefix.size()))) return forbidden;
        if (!site.empty() && site != "same-origin" && site != "none") return forbidden;
        if (is_post && !request.get_header_value("Content-Type").starts_with("application/json")) return forbidden;
        if (request.path.size() > longest_path) return unknown;
        const size_t end = request.path.find('/', 1);
        return end != std::string::npos && is_token(request.path.substr(1, end - 1), token) ? 0 : unknown;
    }

    /// Behind the token.
    std::string name_in(const httplib::Request& request) const { return request.path.substr(token.size() + 2); }

    void get(const httplib::Request& request, httplib::Response& response) {
        const std::string name = name_in(request), of_images = "image/";
        std::optional<WatchReply> answer;
        if (name == "news")
            answer = news_after(request.get_param_value("after"));
        else if (name.starts_with(of_images))
            answer = pages.image(name.substr(of_images.size()));
        else if (const auto file = pages.files.find(name); file != pages.files.end())
            answer = file->second;
        if (!answer) {
            response.status = 404;
            return;
        }
        response.set_content(answer->body, answer->type.c_str());
    }

    void post(const httplib::Request& request, httplib::Response& response) {
        const nlohmann::json value = nlohmann::json::parse(request.body, nullptr, false);
        const std::string refusal =
            value.is_discarded() ? "the page sent what is no JSON" : pages.take(name_in(request), value);
        const nlohmann::json answer = {{"refusal", refusal}};
        response.set_content(answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json");
    }

    /// At once if there are other news than `known`, else as soon as there are, or after a while those that are known.
    WatchReply news_after(const std::string& known) {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, longest_wait,
                         [&] { return is_ending || (number > 0 && std::to_string(number) != known); });
        return {.type = "application/json", .body = news};
    }

    const WatchPages pages;
    const std::string token = random_token();
    ImpatientServer server;
    int port = 0;
    std::thread listening;
    std::mutex mutex;
    std::condition_variable changed;
    size_t number = 0;  ///< of the news
    std::string news = "{}";
    bool is_ending = false;
};

WatchServer::WatchServer(WatchPages pages) : parts_(std::make_unique<Parts>(std::move(pages))) {}
WatchServer::~WatchServer() = default;

std::string WatchServer::address() const {
    return "http://127.0.0.1:" + std::to_string(parts_->port) + "/" + parts_->token + "/";
}

void WatchServer::publish(nlohmann::json news) {
    {
        const std::lock_guard lock(parts_->mutex);
        news["number"] = ++parts_->number;
        parts_->news = news.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
    parts_->changed.notify_all();
}
