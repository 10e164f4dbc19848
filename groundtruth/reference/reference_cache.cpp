#include "groundtruth/reference/reference_cache.h"

#include "core/error.h"
#include "groundtruth/reference/reference_file.h"
#include "groundtruth/reference/reference_stopping.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <optional>

namespace {

namespace fs = std::filesystem;

/// Held by the process that renders a reference. The system frees it when the process ends, however it ends.
class Lock {
public:
    Lock(const fs::path& file, const ReferenceRun& run)
        : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
        if (descriptor_ < 0)
            fail_machine("cannot write into the cache folder ", file.parent_path().string(), ": ",
                         std::strerror(errno));
        if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
        if (run.notice) run.notice("another process renders the same reference; waiting for it");
        while (flock(descriptor_, LOCK_EX) != 0)
            if (errno != EINTR) break;  // a file system without locks: both render, and the last rename wins
    }
    ~Lock() { close(descriptor_); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int descriptor_;
};

std::optional<Reference> load(const fs::path& file, const std::string& key, const ReferenceRun& run) {
    if (!fs::exists(file)) return {};
    try {
        Reference reference = read_reference(file);
        if (reference.hash == key) {
            reference.from_cache = true;
            return reference;
        }
        if (run.notice) run.notice(file.string() + " holds another reference than its name says; it is rendered anew");
    } catch (const MachineError&) {
        throw;
    } catch (const Error& error) {
        if (run.notice) run.notice(std::string(error.what()) + "; the reference is rendered anew");
    }
    return {};
}

/// The finished reference of the same samples that a render of these settings may add to and that got furthest, as far
/// by their names; empty if there is none.
fs::path extensible_reference(const fs::path& folder, const std::string& stream, const ReferenceSettings& settings) {
    fs::path best;
    std::pair<double, uint64_t> furthest{-1, 0};
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".exr") continue;
        const std::optional<ReferenceSettings> its = settings_of_key(stream, entry.path().stem().string());
        if (!its || !can_be_extended(*its, settings)) continue;
        const std::pair got{its->max_seconds, sample_limit(*its)};
        if (got > furthest) best = entry.path(), furthest = got;
    }
    return best;
}

}  // namespace

Reference cached_reference(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
                           const ReferenceSettings& settings, const fs::path& folder, const ReferenceRun& run) {
    const std::string stream = reference_stream(scene, pose, camera, extent, settings);
    const std::string key = reference_key(stream, settings);
    const fs::path file = folder / (key + ".exr"), state_file = folder / (key + ".partial.exr");
    if (std::optional<Reference> found = load(file, key, run)) return std::move(*found);

    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        fail_machine("cannot create the cache folder ", folder.string(), ": ", error.message(),
                     "; choose another with --cache or SSRLAB_CACHE");
    const Lock lock(folder / (key + ".lock"), run);
    if (std::optional<Reference> found = load(file, key, run)) return std::move(*found);  // made while waiting

    if (!fs::exists(state_file))
        if (const fs::path begun = extensible_reference(folder, stream, settings); !begun.empty())
            fs::copy_file(begun, state_file, error);  // if it fails, all is rendered
    ReferenceRun cache_run = run;
    cache_run.state_file = state_file;
    Reference reference = render_reference(scene, pose, camera, extent, settings, cache_run);
    write_reference(file, reference, settings);
    fs::remove(state_file, error);
    return reference;
}
