#pragma once
#include <string>
#include <vector>

/// Runs a program with these arguments, the first its path, and waits for its end; it inherits the standard streams.
/// There is no shell between: an argument is whatever bytes it holds. Returns the program's exit code. Fails with
/// MachineError if it cannot be started or is ended by a signal.
int run_program(const std::vector<std::string>& arguments);
