#pragma once
#include <initializer_list>
#include <ostream>
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

/// One value of a message and how it is streamed. Kept as two pointers until then: each message has types of its own
/// (the length of a literal is one), and what handles them is compiled once for each of some 380 messages.
class MessagePart {
public:
    template <class T>
    MessagePart(const T& value) : value_(&value) {
        if constexpr (std::is_array_v<T>)
            stream_ = &stream_text;
        else
            stream_ = &stream_value<T>;
    }

private:
    friend std::string message_text(std::initializer_list<MessagePart> parts);

    template <class T>
    static void stream_value(std::ostream& out, const void* value) {
        out << *static_cast<const T*>(value);
    }
    static void stream_text(std::ostream& out, const void* text) { out << static_cast<const char*>(text); }

    const void* value_;
    void (*stream_)(std::ostream& out, const void* value);
};

std::string message_text(std::initializer_list<MessagePart> parts);
[[noreturn]] void throw_error(std::initializer_list<MessagePart> parts);
[[noreturn]] void throw_machine_error(std::initializer_list<MessagePart> parts);

/// fail("no variant named '", name, "'"): streams its arguments into the message and throws Error.
template <class... Args>
[[noreturn]] void fail(const Args&... args) {
    throw_error({args...});
}

/// As fail(), for faults of the machine.
template <class... Args>
[[noreturn]] void fail_machine(const Args&... args) {
    throw_machine_error({args...});
}
