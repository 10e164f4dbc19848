#include "core/precompiled.h"

SSRLAB_JSON_INSTANCES()
