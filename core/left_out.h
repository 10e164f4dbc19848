#pragma once
#include <string>

/// A feature, shader or pass that a scene does not need, so that it costs nothing: no image changes with it.
struct LeftOut {
    std::string what;  ///< "alpha tests"
    std::string fact;  ///< of the scene: "no alpha masks"
    std::string why;   ///< one sentence
};
