#pragma once
#include "experiments/bridges/inspect/describe.h"

#include <string>

/// A description as text in aligned columns; each line is ended. shown_text() shows names from files. Lists show their
/// first eight entries and a count of the others, with `has_all` all entries.
std::string page_of(const Description& description, bool has_all);
