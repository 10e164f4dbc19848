#include "variants/tracers/engine_march.h"
#include "variants/tracers/tracer.h"

namespace {

struct Cells final : Tracer {
    explicit Cells(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips}; }

    EngineMarchParameters march{params, "cells"};  // "the document" is explained there

    // clang-format off
    Switch interval{params, "cells.interval", true,
        {"", "compares a cell's nearest surface with all depths that the ray has from where it enters the cell to "
         "where it leaves. As printed only the first one counts, and a ray may fall behind something and come out "
         "again unseen, or meet it a pixel late", "ssrlab; the document compares at the ray's position"}};
    Param<unsigned> safe_steps{params, "cells.safe_steps", 3, {1, 64},
        {"steps", "one after the other, in cells in which the ray stays in front, before it goes a level coarser",
         "the document, 'Conservative Mip Increase'"}};
    Switch reset_safe_steps{params, "cells.reset_safe_steps", true,
        {"", "counts safe steps anew after each change of level; otherwise each one after the first few goes a level "
         "coarser", "the document does not say"}};
    Param<unsigned> pyramid_mips{params, "cells.pyramid_mips", 7, {2, 13},
        {"mips", "levels of the depth pyramid, the full resolution included; as many as the image has, at most",
         "ssrlab; the document names no number. Cells that odd-sized levels lack are looked at on finer ones"}};
    Param<unsigned> max_steps{params, "cells.max_steps", 16384, {1, 65536},
        {"cells", "looked at before a ray is given up",
         "the document: 32, 48, 64 and 96 at its qualities Low to Ultra; the default crosses any screen"}};
    Switch leave_own_plane{params, "cells.leave_own_plane", true,
        {"", "passes over what is less than half as high as the ray above the plane that it leaves: samples are "
         "steps, and at grazing angles the next one lies in the way. Its own pixel a ray leaves unlooked at in any "
         "case", "ssrlab; the document has no rule, and as printed each ray would begin with a hit on itself"}};
    Choice back_faces{params, "cells.back_faces", "reject", {"keep", "fade", "reject"},
        {"", "what becomes of hits on the side that the camera does not see. fade: they lose the cosine between ray "
         "and normal", "the document fades them, by a cosine and no formula; the default is ssrlab's"}};
    Param<float> grazing_fade{params, "cells.grazing_fade", 0.0f, {0.0f, 1.0f},
        {"sine", "of the angle between ray and surface below which hits lose confidence in proportion; 0: none do",
         "the document reduces it for rays nearly parallel to the surface, and names no number"}};
    // clang-format on
};

}  // namespace

TracerEntry cells_tracer() {
    return {.name = "cells",
            .title = "Cell by cell through a depth pyramid, cautiously",
            .source = "documentation of an engine's screen-space reflections (2026-01-14), mode HiZ",
            .description =
                "Goes from wall to wall of cells, coarser after three safe ones, and passes behind what is thin.",
            .shader = "tracers/cells/cells.glsl",
            .create = [](ParameterSet& params) { return std::make_unique<Cells>(params); }};
}
