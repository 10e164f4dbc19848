#pragma once
#include "experiments/bridges/inspect/describe.h"

#include <string>

/// A description as text, aligned in columns, each line ended. Names that come from files are shown by shown_text().
/// Of each list the first eight entries and a count of the others, or with `has_all` all of them.
std::string page_of(const Description& description, bool has_all);
