#include "core/child_process.h"

#include "core/error.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

int run_program(const std::vector<std::string>& arguments) {
    std::vector<char*> list;
    for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
    list.push_back(nullptr);
    pid_t child = 0;
    if (const int error = posix_spawn(&child, list.front(), nullptr, nullptr, list.data(), environ))
        fail_machine("cannot start ", arguments.front(), ": ", std::strerror(error));
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) fail_machine("cannot wait for ", arguments.front(), ": ", std::strerror(errno));
    if (WIFSIGNALED(status)) fail_machine(arguments.front(), " was ended by signal ", WTERMSIG(status));
    return WEXITSTATUS(status);
}
