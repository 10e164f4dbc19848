#pragma once
#include "core/gbuffer/gbuffer_file.h"

/// What a G-buffer's images show, for a look at the whole: labelled pictures in three columns, linear as write_png()
/// takes it. Each picture is as wide as the G-buffer, or an n-th of it, at most 320 pixels. Nearness is 1 at the
/// nearest surface and 0 at the far plane; normals are shown as 0.5 + 0.5 n; motion is grey where there is none, red to
/// the right and green down, by its longest; materials have a colour each. All but light is black where nothing was
/// hit.
HostImage gbuffer_sheet(const HostGBuffer& gbuffer);
