#pragma once
#include "metrics/compare.h"

/// compare() for options.video: the frames of both patterns, one after the other. Does not write the map.
Comparison compare_videos(const CompareOptions& options);
