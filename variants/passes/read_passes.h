#pragma once
#include "variants/passes/declaration.h"

/// Lets a text stand for the object of what a pass reads, writes or shows: "lit" for {"image": "lit"}.
void write_out_short_forms(nlohmann::json& root);

/// `conditions`, `images`, `buffers`, `passes`, `result` and what scenes can spare of a technique.json, after
/// write_out_short_forms(). `known`: the technique's parameters. Each pass's shader is still as it was written.
void read_passes(JsonObject& root, KnownValues known, Declaration& declaration);
