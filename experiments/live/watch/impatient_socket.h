#pragma once
#include <sys/types.h>
#include <atomic>
#include <chrono>
#include <optional>

/// The server's side of a connection. A request must be there after a short time, and its answer taken, however slowly
/// the bytes come and go: a client cannot keep the server.
class ImpatientSocket {
public:
    /// Takes over the socket. It gives up at once while `is_ending`, which must outlive it.
    ImpatientSocket(int socket, const std::atomic<bool>& is_ending) : socket_(socket), is_ending_(is_ending) {}
    ~ImpatientSocket();
    ImpatientSocket(const ImpatientSocket&) = delete;
    ImpatientSocket& operator=(const ImpatientSocket&) = delete;

    /// These wait until it can be read or written; false if its time is over.
    bool is_readable() const;
    bool is_writable() const;
    ssize_t read(char* bytes, size_t size) const;   ///< as recv(): some bytes, 0 at the end; -1 if its time is over
    ssize_t write(const char* bytes, size_t size);  ///< all bytes; -1 if its time is over
    int number() const { return socket_; }

private:
    using Clock = std::chrono::steady_clock;
    bool waits_for(short event, Clock::time_point end) const;

    const int socket_;
    const std::atomic<bool>& is_ending_;
    const Clock::time_point begin_ = Clock::now();
    std::optional<Clock::time_point> answer_end_;  ///< once something is written
};
