#pragma once
#include "core/error.h"

#include <string>

/// What `action` fails with; "no error" if it does not fail.
std::string error_message(const auto& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}
