#pragma once
#include "core/digits.h"

#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

/// A mistake of the user: a wrong key, a value out of range, a missing or broken file. Its text is one sentence that
/// names the culprit, the value found and what is allowed. `main` prints it and exits with code 2.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A fault of the machine: no Vulkan device, a full disk, no memory. `main` prints it and exits with code 3.
struct MachineError : Error {
    using Error::Error;
};

/// Joins the parts of a message. Numbers keep their digits: with the six of streams, 1.5708 may lie outside [0,
/// 1.5708].
template <class... Args>
std::string message_text(const Args&... args) {
    std::ostringstream text;
    const auto add = [&](const auto& part) {
        if constexpr (std::is_floating_point_v<std::decay_t<decltype(part)>>)
            text << message_digits(part);
        else
            text << part;
    };
    (add(args), ...);
    return text.str();
}

/// fail("no technique named '", name, "'"): puts its arguments into the message and throws Error.
template <class... Args>
[[noreturn]] void fail(const Args&... args) {
    throw Error(message_text(args...));
}

/// As fail(), for faults of the machine.
template <class... Args>
[[noreturn]] void fail_machine(const Args&... args) {
    throw MachineError(message_text(args...));
}
