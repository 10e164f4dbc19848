#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_list.h"

/// Replaces the pass_list's inputs by a G-buffer without NaN and Inf while this lives: a shader that names `depth`
/// reads the repaired image. A faulty pixel becomes background (depth), black (colours), still (motion) or faces the
/// viewer (normals of surfaces). Normals become unit. Sound values keep their bits. repair_image.frag has the rules.
class RepairedInputs {
public:
    /// With `is_wanted` false nothing changes and no pass runs.
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
