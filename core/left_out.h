#pragma once
#include <string>

/// A feature, shader or pass that a scene does not need, so that it costs nothing.
struct LeftOut {
    std::string what;        ///< "alpha tests"; for a technique, a stage that does not run, or a part of `stage`
    std::string fact;        ///< of the scene: "no alpha masks"
    std::string why;         ///< one sentence
    std::string stage = {};  ///< the stage that is shorter without it; empty if `what` names all
    bool keeps_bits = true;  ///< false: images are the same up to the rounding of float32 arithmetic
};

/// "amd_sssr/reproject: motion vectors".
inline std::string full_name(const LeftOut& part) {
    return part.stage.empty() ? part.what : part.stage + ": " + part.what;
}
