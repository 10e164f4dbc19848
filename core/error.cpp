#include "core/error.h"

#include <sstream>

std::string message_text(std::initializer_list<MessagePart> parts) {
    std::ostringstream text;
    for (const MessagePart& part : parts) part.stream_(text, part.value_);
    return text.str();
}

void throw_error(std::initializer_list<MessagePart> parts) { throw Error(message_text(parts)); }

void throw_machine_error(std::initializer_list<MessagePart> parts) { throw MachineError(message_text(parts)); }
