#include "experiments/store/cell_store.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"
#include "experiments/store/result_images.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

namespace {

/// JSON objects are ordered by key and numbers written by the shortest text that reads back, so that what was read is
/// written as it was.
std::string content_hash(const nlohmann::json& cell) {
    ContentHash hash;
    hash.add(cell.dump());
    return hash.hex();
}

/// A sentence if the file is not what the cell's image entry says.
std::string damage(const std::filesystem::path& results, const nlohmann::json& image, const char* kind) {
    const std::string name = image.at(kind), hash = file_hash(results / name);
    if (hash.empty()) return "its image " + name + " is missing";
    return hash == image.at(kind + std::string("_hash")) ? "" : "its image " + name + " is not the one that it made";
}

}  // namespace

std::optional<Cell> CellStore::read(const std::string& name) const {
    std::error_code error;
    if (!std::filesystem::exists(file(name), error)) return {};
    try {
        const nlohmann::json json = read_json(file(name));
        if (json.at("name") == name && json.at("content") == content_hash(json.at("cell"))) {
            Cell cell = json.at("cell").get<Cell>();
            cell.name = name;
            return cell;
        }
    } catch (const MachineError&) {
        throw;
    } catch (const std::exception&) {  // as good as none
    }
    notice_("note: " + file(name).string() + " is damaged, or of another version; it is not used");
    return {};
}

std::optional<Cell> CellStore::load(const std::string& name) const {
    std::optional<Cell> cell = read(name);
    if (!cell) return {};
    for (const nlohmann::json& image : cell->images)
        for (const char* kind : {"exr", "png"})
            if (const std::string why = damage(results_, image, kind); !why.empty()) {
                notice_("note: " + file(name).string() + " is done again: " + why);
                return {};
            }
    return cell;
}

void CellStore::save(const std::string& name, const Cell& cell) const {
    const nlohmann::json content = cell;
    write_text(file(name),
               nlohmann::json{{"name", name}, {"content", content_hash(content)}, {"cell", content}}.dump() + "\n");
}

std::vector<std::string> CellStore::names() const {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(results_ / "cells", error)) {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() == ".json" && entry.is_regular_file(error) && !entry.is_symlink(error) &&
            read(stem))
            names.push_back(stem);
    }
    std::ranges::sort(names);
    return names;
}

CellStore::Claim::~Claim() {
    std::error_code ignored;  // another process may have removed it
    std::filesystem::remove(file_, ignored);
    close(descriptor_);
}

std::unique_ptr<CellStore::Claim> CellStore::claim(const std::string& name, bool waits) const {
    const std::filesystem::path file = results_ / "cells" / (name + ".claim");
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
        fail_machine("cannot write into the folder ", file.parent_path().string(), ": ", std::strerror(errno));
    while (flock(descriptor, waits ? LOCK_EX : LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) break;
        close(descriptor);
        return nullptr;
    }
    return std::make_unique<Claim>(file, descriptor);
}
