#include "variants/tracers/tracer.h"

namespace {

struct Cells final : Tracer {
    explicit Cells(ParameterSet& params) : Tracer(params) {}

    TracerNeeds needs() const override { return {.nearest_mips = pyramid_mips}; }

    // "The document": an engine's documentation of its screen-space reflections, of 2026-01-14.
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
    Param<float> max_distance{params, "cells.max_distance", 0.0f, {0.0f, 1e9f},
        {"m", "length of a ray; 0: twice the distance of the far plane",
         "the document: 50; the default leaves no ray short in scenes of any size"}};
    Param<float> thickness{params, "cells.thickness", 0.1f, {0.0f, 1e6f},
        {"m", "depth behind the visible surface that counts as solid",
         "the document: 0.5, which hangs curtains below things in rooms; the default is dda's"}};
    Param<float> relative_thickness{params, "cells.relative_thickness", 0.0f, {0.0f, 10.0f},
        {"of the depth", "added to thickness; grows with the distance from the camera and so fits scenes of any "
         "size", "ssrlab"}};
    Switch clip_to_near_plane{params, "cells.clip_to_near_plane", true,
        {"", "ends rays at the near plane. As printed their far end is projected even where it lies behind the "
         "camera, and the line runs the opposite way", "ssrlab"}};
    Switch leave_own_plane{params, "cells.leave_own_plane", true,
        {"", "passes over what is less than half as high as the ray above the plane that it leaves: samples are "
         "steps, and at grazing angles the next one lies in the way. Its own pixel a ray leaves unlooked at in any "
         "case", "ssrlab; the document has no rule, and as printed each ray would begin with a hit on itself"}};
    Param<float> sky_depth{params, "cells.sky_depth", 0.0f, {0.0f, 1.0f},
        {"device depth", "distance from the far plane's up to which nothing counts as drawn; 0: that plane's own "
         "only", "the document: 1e-4, which with planes at 0.1 m and 100 m is all beyond 91 m"}};
    Choice back_faces{params, "cells.back_faces", "reject", {"keep", "fade", "reject"},
        {"", "what becomes of hits on the side that the camera does not see. fade: they lose the cosine between ray "
         "and normal", "the document fades them, by a cosine and no formula; the default is ssrlab's"}};
    Switch edge_fade{params, "cells.edge_fade", false,
        {"", "hits lose confidence from `cells.fade_start` to `cells.fade_end`", "the document: on"}};
    Param<float> fade_start{params, "cells.fade_start", 0.8f, {0.0f, 1.0f},
        {"of half the screen", "distance from its middle from which hits fade out, on the axis where it is larger",
         "the document; the linear fall is ssrlab's"}};
    Param<float> fade_end{params, "cells.fade_end", 1.0f, {0.0f, 2.0f},
        {"of half the screen", "distance from its middle at which nothing is left of them", "the document"}};
    Switch distance_fade{params, "cells.distance_fade", false,
        {"", "hits lose confidence in proportion to the ray's length, all of it at `cells.max_distance`",
         "the document: on; the linear fall is ssrlab's"}};
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
