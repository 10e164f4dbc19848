#include "experiments/cell.h"

#include "core/error.h"
#include "core/files.h"
#include "core/json.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

namespace nlohmann {
template <class T>
struct adl_serializer<std::optional<T>> {
    static void to_json(json& j, const std::optional<T>& value) {
        if (value)
            j = *value;
        else
            j = nullptr;
    }
    static void from_json(const json& j, std::optional<T>& value) {
        if (j.is_null())
            value.reset();
        else
            value = j.get<T>();
    }
};
}  // namespace nlohmann

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ResultRow, shot, scene, camera, frame, width, height, variant, point, seed, target,
                                   metric, formula, mask, value, is_corrected, uncorrected, low, high, floor, lit_noise,
                                   lit_half_width, pixels, non_finite, negative)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeedPairs, variance, bias_squared)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SplitRow, shot, frame, variant, point, target, mask, seeds, mse, bias_squared,
                                   variance, variance_low, variance_high, pixels, bias_squared_low, bias_squared_high,
                                   seed_numbers, pairs, reference_noise)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReferenceNoise, shot, frame, variant, point, target, metric, mask, sums)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeRow, shot, variant, point, seed, stage, frame, milliseconds, clock)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cell, rows, splits, reference_noise, times, images, timing, notes)

std::optional<Cell> CellStore::load(const std::string& hash) const {
    const std::filesystem::path file = folder_ / (hash + ".json");
    if (!std::filesystem::exists(file)) return {};
    try {
        return read_json(file).get<Cell>();
    } catch (const std::exception&) {
        return {};  // a broken file is as good as none: the cell is done again
    }
}

void CellStore::save(const std::string& hash, const Cell& cell) const {
    write_text(folder_ / (hash + ".json"), nlohmann::json(cell).dump() + "\n");
}

CellStore::Claim::~Claim() {
    std::error_code ignored;  // another process may have removed it
    std::filesystem::remove(file_, ignored);
    close(descriptor_);
}

std::unique_ptr<CellStore::Claim> CellStore::claim(const std::string& hash, bool waits) const {
    const std::filesystem::path file = folder_ / (hash + ".claim");
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) fail_machine("cannot write into the folder ", folder_.string(), ": ", std::strerror(errno));
    while (flock(descriptor, waits ? LOCK_EX : LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) break;
        close(descriptor);
        return nullptr;
    }
    return std::make_unique<Claim>(file, descriptor);
}
