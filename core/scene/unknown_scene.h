#pragma once
#include "core/error.h"

/// The mistake that no scene has a name. Who read the name knows where it was written.
struct UnknownScene : Error {
    using Error::Error;
};
