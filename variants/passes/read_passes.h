#pragma once
#include "variants/passes/declaration.h"

/// Expands texts that stand for the object of what a pass reads, writes or shows: "lit" becomes {"image": "lit"}.
void write_out_short_forms(nlohmann::json& root);

/// Reads `conditions`, `images`, `buffers`, `passes`, `result` and the parts that a technique.json can leave out, after
/// write_out_short_forms(). `known`: the technique's parameters. Each pass's shader stays as written in the file.
void read_passes(JsonObject& root, KnownValues known, Declaration& declaration);
