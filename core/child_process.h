#pragma once
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

/// Runs a program with these arguments, the first its path, and waits for its end; it inherits the standard streams.
/// There is no shell between: an argument is whatever bytes it holds. Returns the program's exit code. Fails with
/// MachineError if it cannot be started or is ended by a signal, or hangs, in which case it is killed. Without
/// `patience` it may take any time.
int run_program(const std::vector<std::string>& arguments, const Patience* patience = nullptr);
