#pragma once
#include "experiments/live/watch/watch_server.h"

/// The page with its script and style, by the names that it asks for: made of page/, of what the recorder's page has
/// for sliders, and of what the report's has for colours.
std::map<std::string, WatchAnswer> page_files();
