#pragma once
#include <sys/types.h>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// When a running program counts as hanging.
struct Patience {
    std::chrono::milliseconds limit;   ///< longest time without a change of `progress`
    std::function<size_t()> progress;  ///< the program's progress, asked 100 times a second
};

/// Starts a program without a shell; `arguments` begin with its path and may hold any bytes. The program gets the
/// signal `at_our_end` when this process ends in any way; the thread that starts it must live until then. `prepare`
/// runs in the child before the program. It may do only what is safe after a fork of several threads: no allocation, no
/// locks. Fails with MachineError if the program cannot be started.
pid_t start_program(
    const std::vector<std::string>& arguments, int at_our_end, const std::function<void()>& prepare = [] {});

/// Starts a program as above and waits for its end. The program inherits the standard streams, and gets SIGTERM if this
/// process ends. Returns the program's exit code. Fails with MachineError if the program cannot be started, ends by a
/// signal, or hangs (it is then killed). Without `patience` the program may take any time.
int run_program(const std::vector<std::string>& arguments, const Patience* patience = nullptr);
