#pragma once
#include "variants/declared/technique.h"

/// `parameters` and `tracers` of a technique.json.
void read_parameters(JsonObject& root, Technique& technique);
