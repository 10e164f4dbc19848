#include "core/child_process.h"

#include "core/error.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

namespace {

/// Whether the child hangs; as soon as it has ended it does not. It stays to be waited for.
bool hangs(pid_t child, const Patience& patience) {
    using Clock = std::chrono::steady_clock;
    size_t progress = patience.progress();
    auto since = Clock::now();
    const auto has_ended = [&] {
        siginfo_t info{};
        return waitid(P_PID, id_t(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
    };
    while (!has_ended()) {
        if (const size_t now = patience.progress(); now != progress) progress = now, since = Clock::now();
        if (Clock::now() - since > patience.limit) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace

pid_t start_program(const std::vector<std::string>& arguments, int at_our_end, const std::function<void()>& prepare) {
    if (access(arguments.front().c_str(), X_OK) != 0)
        fail_machine("cannot start ", arguments.front(), ": ", std::strerror(errno));
    std::vector<char*> list;
    for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
    list.push_back(nullptr);
    const pid_t parent = getpid(), child = fork();
    if (child < 0) fail_machine("cannot start ", arguments.front(), ": ", std::strerror(errno));
    if (child == 0) {  // only what is safe between fork and exec
        prctl(PR_SET_PDEATHSIG, at_our_end);
        if (getppid() != parent) _exit(127);  // it has ended meanwhile
        prepare();
        execv(list.front(), list.data());
        _exit(127);
    }
    return child;
}

int run_program(const std::vector<std::string>& arguments, const Patience* patience) {
    const pid_t child = start_program(arguments, SIGTERM);
    const bool is_killed = patience && hangs(child, *patience);
    if (is_killed) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) fail_machine("cannot wait for ", arguments.front(), ": ", std::strerror(errno));
    if (is_killed)
        fail_machine(arguments.front(), " got no further for ", std::chrono::duration<double>(patience->limit).count(),
                     " s and was ended");
    if (WIFSIGNALED(status)) fail_machine(arguments.front(), " was ended by signal ", WTERMSIG(status));
    return WEXITSTATUS(status);
}
