#include "experiments/cli/supervised.h"

#include "core/error.h"
#include "core/in_flight.h"
#include "core/shown_text.h"
#include "core/signal_actions.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace {

/// By which others ask a program to end.
constexpr std::array requests = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

pid_t child = 0;

/// A terminal sends its signals to both processes, so only those of other senders are handed on.
void hand_on(int signal, siginfo_t* info, void*) {
    if (info->si_code <= 0) kill(child, signal);
}

/// How `work` ended in a process of its own, as waitpid() says it.
int status_of_child(const std::function<int()>& work) {
    // Requests wait until it is known whom they go to.
    sigset_t held, before;
    sigemptyset(&held);
    for (const int signal : requests) sigaddset(&held, signal);
    sigprocmask(SIG_BLOCK, &held, &before);
    std::fflush(nullptr);  // or the child would print it again
    const pid_t parent = getpid();
    child = fork();
    if (child < 0) {
        const int error = errno;
        sigprocmask(SIG_SETMASK, &before, nullptr);
        fail_machine("cannot start a process: ", std::strerror(error));
    }
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(127);  // it has ended meanwhile
        sigprocmask(SIG_SETMASK, &before, nullptr);
        std::exit(work());
    }
    struct sigaction action {};
    action.sa_sigaction = hand_on;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    const SignalActions handed_on(requests, action);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) fail_machine("cannot wait for a process: ", std::strerror(errno));
    return status;
}

std::string name_of(int signal) {
    const std::string name = "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
    return signal == SIGKILL ? name + ", as the system does where memory is short" : name;
}

/// The point that was at work when `signal` ended the child, with empty names if none was.
EndedPoint ended_by(int signal) {
    const InFlight& last = in_flight();
    const std::string pass = last.pass.data();
    return {.technique = last.technique.data(),
            .point = last.point.data(),
            .how = (pass.empty() ? "work between its passes" : "its pass '" + pass + "'") + " ended the program by " +
                   name_of(signal)};
}

[[noreturn]] void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    raise(signal);
    _exit(128 + signal);
}

}  // namespace

int supervised(const std::function<int(const std::vector<EndedPoint>&)>& work, bool leaves_out_points) {
    std::vector<EndedPoint> ended;
    while (true) {
        in_flight() = {};
        const int status = status_of_child([&] { return work(ended); });
        if (WIFEXITED(status)) return WEXITSTATUS(status);
        const int signal = WTERMSIG(status);
        if (std::ranges::count(requests, signal) || signal == SIGPIPE) end_by(signal);
        const EndedPoint point = ended_by(signal);
        if (point.technique.empty()) {
            const std::string pass = in_flight().pass.data();
            fail_machine("the program was ended by ", name_of(signal),
                         pass.empty() ? std::string() : " in the pass '" + pass + "'");
        }
        const std::string name = point.technique + " " + point.point;
        const bool was_left_out = std::ranges::any_of(ended, [&](const EndedPoint& before) {
            return before.technique == point.technique && before.point == point.point;
        });
        if (!leaves_out_points || was_left_out) fail_machine(name, ": ", point.how);
        std::fprintf(stderr, "\nwarning: %s; the study goes on without this point\n",
                     shown_text(name + ": " + point.how).c_str());
        ended.push_back(point);
    }
}
