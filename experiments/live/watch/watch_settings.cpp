#include "experiments/live/watch/watch_settings.h"

#include "core/error.h"

namespace fs = std::filesystem;

WatchSettings with_absolute_paths(WatchSettings settings) {
    settings.folder = fs::weakly_canonical(fs::absolute(settings.folder));
    settings.out = fs::weakly_canonical(fs::absolute(settings.out));
    if (!fs::is_directory(settings.folder))
        fail(settings.folder.string(), " is no folder: `ssrlab new ", settings.folder.string(),
             " --from mcguire_dda` makes a folder with a technique");
    const fs::path inside = settings.out.lexically_relative(settings.folder);
    if (!inside.empty() && *inside.begin() != "..")
        fail("--out ", settings.out.string(),
             " lies in the watched folder: rendered files there would look like saves of the technique");
    return settings;
}
