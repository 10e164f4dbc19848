#include "experiments/live/watch/impatient_socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

using namespace std::chrono_literals;

constexpr auto longest_request = 5s, longest_answer = 10s;  // all of it, not each of its parts
constexpr auto look = 50ms;                                 // between looks whether the server ends

}  // namespace

ImpatientSocket::~ImpatientSocket() {
    shutdown(socket_, SHUT_RDWR);
    close(socket_);
}

bool ImpatientSocket::is_readable() const { return waits_for(POLLIN, begin_ + longest_request); }

bool ImpatientSocket::is_writable() const { return waits_for(POLLOUT, answer_end_.value_or(Clock::time_point::max())); }

ssize_t ImpatientSocket::read(char* bytes, size_t size) const {
    return is_readable() ? recv(socket_, bytes, size, 0) : -1;
}

ssize_t ImpatientSocket::write(const char* bytes, size_t size) {
    if (!answer_end_) answer_end_ = Clock::now() + longest_answer;
    for (size_t done = 0; done < size;) {
        const ssize_t sent = is_writable() ? send(socket_, bytes + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
        if (sent < 0) return -1;
        done += size_t(sent);
    }
    return ssize_t(size);
}

bool ImpatientSocket::waits_for(short event, Clock::time_point end) const {
    while (!is_ending_ && Clock::now() < end) {
        pollfd one{.fd = socket_, .events = event, .revents = 0};
        if (poll(&one, 1, int(std::chrono::milliseconds(look).count())) > 0) return true;
    }
    return false;
}
