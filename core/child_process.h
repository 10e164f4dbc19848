#pragma once
#include <sys/types.h>
#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// When a program that goes on is taken for one that hangs.
struct Patience {
    std::chrono::milliseconds limit;   ///< for `progress` to change
    std::function<size_t()> progress;  ///< of the program; asked a hundred times a second
};

/// Starts a program with these arguments, the first its path. There is no shell between: an argument is whatever bytes
/// it holds. It gets the signal `at_our_end` when this process ends, however it ends, so that nothing goes on that
/// nobody asks for any more; the thread that starts it has to live until then. `prepare` runs in the child before the
/// program, and may do only what is safe after a fork of several threads: no allocation, no locks. Fails with
/// MachineError if it cannot be started.
pid_t start_program(
    const std::vector<std::string>& arguments, int at_our_end, const std::function<void()>& prepare = [] {});

/// Starts a program as above and waits for its end; it inherits the standard streams, and is asked to end (SIGTERM)
/// where this process does. Returns the program's exit code. Fails with MachineError if it cannot be started or is
/// ended by a signal, or hangs, in which case it is killed. Without `patience` it may take any time.
int run_program(const std::vector<std::string>& arguments, const Patience* patience = nullptr);
