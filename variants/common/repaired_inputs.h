#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_list.h"

/// A G-buffer without NaN and Inf, in place of the pass_list's inputs as long as this lives: each
/// shader that names `depth` reads the repaired one. A fault stays in its pixel, which becomes background (depth),
/// black (colours), still (motion) or faces the viewer (normals of surfaces); normals that are not unit become so. What
/// was sound keeps its bits. repair_image.frag has the rules.
class RepairedInputs {
public:
    /// `is_wanted` false: all stays as it is, and nothing runs.
    RepairedInputs(PassList& pass_list, const GBuffer& gbuffer, bool is_wanted);
    ~RepairedInputs();
    RepairedInputs(const RepairedInputs&) = delete;
    RepairedInputs& operator=(const RepairedInputs&) = delete;

    const GBuffer& gbuffer() const { return repaired_; }

    static constexpr const char* stage = "common/repair_inputs";

private:
    PassList& pass_list_;
    bool is_wanted_;
    GBuffer given_, repaired_;
};
