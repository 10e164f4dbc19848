#include "experiments/live/watch/running_program.h"

#include "core/child_process.h"
#include "core/error.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace {

class OpenFile {
public:
    OpenFile(const char* path, int flags) : descriptor(open(path, flags | O_CLOEXEC, 0644)) {
        if (descriptor < 0) fail_machine("cannot open ", path, ": ", std::strerror(errno));
    }
    ~OpenFile() { close(descriptor); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    const int descriptor;
};

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                               const std::filesystem::path& errors, Priority priority) {
    constexpr int anew = O_WRONLY | O_CREAT | O_TRUNC;
    const OpenFile in("/dev/null", O_RDONLY), out(output.c_str(), anew), err(errors.c_str(), anew);
    process_ = start_program(arguments, SIGKILL, [&] {
        setpgid(0, 0);
        if (priority == Priority::background) setpriority(PRIO_PROCESS, 0, 19);
        dup2(in.descriptor, STDIN_FILENO), dup2(out.descriptor, STDOUT_FILENO), dup2(err.descriptor, STDERR_FILENO);
    });
    setpgid(process_, process_);  // whichever of both is first
}

RunningProgram::~RunningProgram() {
    if (exit_code()) return;
    kill(-process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::optional<int> RunningProgram::exit_code() {
    int status = 0;
    if (!exit_code_ && waitpid(process_, &status, WNOHANG) == process_)
        exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return exit_code_;
}
