#include "core/child_process.h"

#include "core/error.h"

#include <fcntl.h>
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

/// What it ended with, as waitpid() says it.
int wait_for(pid_t child, const std::string& program) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) fail_machine("cannot wait for ", program, ": ", std::strerror(errno));
    return status;
}

void set_handled_signals_to_default() {
    for (int number = 1; number < NSIG; ++number) {
        struct sigaction action;
        if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action = {};
        action.sa_handler = SIG_DFL;
        sigaction(number, &action, nullptr);
    }
}

}  // namespace

pid_t start_program(const std::vector<std::string>& arguments, int at_our_end, const std::function<void()>& prepare) {
    std::vector<char*> list;
    for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
    list.push_back(nullptr);
    int why[2];  // a pipe, by which the child says why it cannot become the program
    if (pipe2(why, O_CLOEXEC) != 0) fail_machine("cannot start ", arguments.front(), ": ", std::strerror(errno));
    // Signals that come before the child is the program wait until it is: what this process does of them is not its
    // affair.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t parent = getpid(), child = fork();
    int error = child < 0 ? errno : 0;
    if (child == 0) {  // only what is safe between fork and exec
        prctl(PR_SET_PDEATHSIG, at_our_end);
        if (getppid() != parent) _exit(127);  // it has ended meanwhile
        prepare();
        set_handled_signals_to_default();
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        execv(list.front(), list.data());
        error = errno;
        _exit(write(why[1], &error, sizeof error) == sizeof error ? 127 : 126);
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    close(why[1]);
    if (child > 0) {
        while (read(why[0], &error, sizeof error) < 0 && errno == EINTR) {
        }
        if (error != 0) wait_for(child, arguments.front());
    }
    close(why[0]);
    if (error != 0) fail_machine("cannot start ", arguments.front(), ": ", std::strerror(error));
    return child;
}

int run_program(const std::vector<std::string>& arguments, const Patience* patience) {
    const pid_t child = start_program(arguments, SIGTERM);
    const bool is_killed = patience && hangs(child, *patience);
    if (is_killed) kill(child, SIGKILL);
    const int status = wait_for(child, arguments.front());
    if (is_killed)
        fail_machine(arguments.front(), " made no progress for ",
                     std::chrono::duration<double>(patience->limit).count(), " s and was ended");
    if (WIFSIGNALED(status)) fail_machine(arguments.front(), " was ended by signal ", WTERMSIG(status));
    return WEXITSTATUS(status);
}
