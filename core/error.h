#pragma once
#include <sstream>
#include <stdexcept>
#include <string>

/// A mistake of the user: a wrong key, a value out of range, a missing or broken file. Its text is one sentence that names
/// the culprit, the value found and what is allowed. `main` prints it and exits with code 2.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A fault of the machine: no Vulkan device, a full disk, no memory. `main` prints it and exits with code 3.
struct MachineError : Error {
    using Error::Error;
};

/// fail("no variant named '", name, "'"): streams its arguments into the message and throws Error.
template <class... Args>
[[noreturn]] void fail(const Args&... args) {
    std::ostringstream text;
    (text << ... << args);
    throw Error(text.str());
}

/// As fail(), for faults of the machine.
template <class... Args>
[[noreturn]] void fail_machine(const Args&... args) {
    std::ostringstream text;
    (text << ... << args);
    throw MachineError(text.str());
}
