#include "experiments/live/watch/fresh_images.h"

#include "core/path_inside.h"

namespace fs = std::filesystem;

std::optional<std::chrono::system_clock::time_point> written_at(const fs::path& file) {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(file, error);
    if (error) return {};
    return std::chrono::time_point_cast<std::chrono::system_clock::duration>(std::chrono::file_clock::to_sys(time));
}

std::map<std::string, std::map<std::string, fs::path>> fresh_images(const fs::path& results,
                                                                    const std::string& technique,
                                                                    std::chrono::system_clock::time_point since) {
    std::map<std::string, std::map<std::string, fs::path>> found;
    std::error_code error;
    for (fs::recursive_directory_iterator file(path_inside(results, "images"), error), end; !error && file != end;
         file.increment(error)) {
        if (file->is_symlink(error)) continue;
        const std::string name = file->path().filename().string();
        for (const std::string target : {"image", "specular"}) {
            if (name.starts_with("reference.") && name.ends_with("." + target + ".exr"))
                found["truth"][target] = file->path();
            if (!name.starts_with(technique + ".") || !name.ends_with(".result." + target + ".exr")) continue;
            if (const auto time = written_at(file->path()); time && *time >= since) found["now"][target] = file->path();
        }
    }
    return found;
}
