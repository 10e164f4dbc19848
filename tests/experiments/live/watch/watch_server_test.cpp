// Clients that send slowly or not at all keep nobody from the page, and its server from no end.
#include "experiments/live/watch/watch_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <thread>
#include <utility>

namespace {

/// A connection to this machine; -1 if nobody listens.
int connected(int port) {
    const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{
        .sin_family = AF_INET, .sin_port = htons(uint16_t(port)), .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
    if (connect(made, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return made;
    close(made);
    return -1;
}

/// All that the server answers until it closes the connection; "" if it says nothing for a minute, which is enough for
/// the slowest machine.
std::string answer_to(int port, const std::string& request) {
    const int socket = connected(port);
    const timeval minute{.tv_sec = 60, .tv_usec = 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &minute, sizeof minute);
    EXPECT_EQ(send(socket, request.data(), request.size(), MSG_NOSIGNAL), ssize_t(request.size()));
    std::string answer;
    char bytes[4096];
    for (ssize_t got; (got = recv(socket, bytes, sizeof bytes, 0)) > 0;) answer.append(bytes, size_t(got));
    close(socket);
    return answer;
}

/// Connections that send nothing, or a request's bytes one by one, again as soon as the server closes them.
class SlowClients {
public:
    SlowClients(unsigned count, int port) : sockets_(count, -1), port_(port), sending_([this] { send_on(); }) {}
    ~SlowClients() {
        is_over_ = true;
        sending_.join();
        for (const int socket : sockets_)
            if (socket >= 0) close(socket);
    }
    SlowClients(const SlowClients&) = delete;
    SlowClients& operator=(const SlowClients&) = delete;

    void wait_for_all() const {
        while (!are_all_there_) usleep(1000);
    }

private:
    static bool is_closed(int socket) {
        char byte;
        return recv(socket, &byte, 1, MSG_DONTWAIT) >= 0 || errno != EAGAIN;
    }
    void send_on() {
        while (!is_over_) {
            for (size_t i = 0; i < sockets_.size(); ++i) {
                int& socket = sockets_[i];
                if (socket >= 0 && is_closed(socket)) close(std::exchange(socket, -1));
                if (socket < 0) socket = connected(port_);
                if (i % 8 > 0 && socket >= 0) send(socket, "G", 1, MSG_NOSIGNAL);
            }
            are_all_there_ = true;
            usleep(20'000);
        }
    }

    std::vector<int> sockets_;
    const int port_;
    std::atomic<bool> is_over_ = false, are_all_there_ = false;
    std::thread sending_;
};

}  // namespace

TEST(WatchServer, IsNotKeptByClientsThatSendSlowly) {
    auto server = std::make_unique<WatchServer>(WatchPages{
        .files = {{"", {"text/html", "the page"}}},
        .image = [](const std::string&) { return std::optional<WatchReply>(); },
        .take = [](const std::string& what, const nlohmann::json&) { return "'" + what + "' is not done"; }});
    const std::string address = server->address(), host = address.substr(7, address.find('/', 7) - 7),
                      path = address.substr(7 + host.size()), headers = " HTTP/1.1\r\nHost: " + host + "\r\n";
    const int port = std::stoi(host.substr(host.find(':') + 1));
    const SlowClients slow(40, port);
    slow.wait_for_all();
    EXPECT_TRUE(answer_to(port, "GET " + path + headers + "\r\n").ends_with("\r\n\r\nthe page"));
    server->publish({{"text", std::string(1 << 20, 'x')}});
    EXPECT_GT(answer_to(port, "GET " + path + "news?after=0" + headers + "\r\n").size(), size_t(1) << 20)
        << "more than a socket takes at a time";
    const std::string posted =
        "Origin: http://" + host + "\r\nContent-Type: application/json\r\nContent-Length: 4\r\n\r\nnull";
    EXPECT_NE(answer_to(port, "POST " + path + "keep" + headers + posted).find("'keep' is not done"),
              std::string::npos);
    server.reset();  // or it waits for ever, too
}
