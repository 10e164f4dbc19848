#include "core/files.h"

#include "core/error.h"
#include "core/leftovers.h"
#include "core/reading_limits.h"

#include <xxhash.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>

std::string lower_case_extension(const std::filesystem::path& file) {
    std::string text = file.extension().string();
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

static const char* const elsewhere = "; choose a folder that you may write to and that has space";

void fail_write(const std::filesystem::path& file, const std::string& reason) {
    fail_machine("cannot write ", file.string(), ": ", reason, elsewhere);
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
        fail(folder.string(), " is a file and no folder; name another");
    std::filesystem::create_directories(folder, error);
    if (error) fail_machine("cannot create the folder ", folder.string(), ": ", error.message(), elsewhere);
}

/// A folder may hold as many files as a study has cells, and each write would look at all of them.
static void remove_leftovers_once(const std::filesystem::path& folder) {
    static std::set<std::filesystem::path> known;
    static std::mutex mutex;
    {
        const std::lock_guard lock(mutex);
        if (!known.insert(folder).second) return;
    }
    remove_leftovers(folder);
}

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
    std::error_code error;
    if (file.has_parent_path()) create_folder(file.parent_path());
    remove_leftovers_once(file.has_parent_path() ? file.parent_path() : ".");
    const std::filesystem::path temporary = unfinished_path(file);
    std::filesystem::remove_all(temporary, error);  // of a killed process, or a link that waits there
    try {
        write(temporary);
    } catch (...) {
        std::filesystem::remove_all(temporary, error);
        throw;
    }
    std::filesystem::rename(temporary, file, error);
    if (error) {
        const std::string reason = error.message();
        std::filesystem::remove_all(temporary, error);
        fail_write(file, reason);
    }
}

void write_text(const std::filesystem::path& file, std::string_view text) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        out.write(text.data(), std::streamsize(text.size()));
        out.close();
        if (!out) fail_write(file, errno ? std::strerror(errno) : "unknown reason");
    });
}

std::string read_text(const std::filesystem::path& file) {
    check_regular_file(file);
    const uintmax_t size = std::filesystem::file_size(file);
    MemoryShare().add(double(size), file.string() + ": " + std::to_string(size) + " bytes");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) fail_machine("cannot open ", file.string(), ": ", errno ? std::strerror(errno) : "unknown reason");
    std::string text(size, '\0');  // in one piece: character by character it took 7 % of the CPU of StudyTest
    in.read(text.data(), std::streamsize(size));
    text.resize(size_t(in.gcount()));  // another process may have cut it
    if (in.bad()) fail_machine("cannot read ", file.string(), ": ", std::strerror(errno));
    return text;
}

ContentHash::ContentHash() : state_(XXH3_createState()) { XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_)); }
ContentHash::~ContentHash() { XXH3_freeState(static_cast<XXH3_state_t*>(state_)); }

void ContentHash::add(std::span<const std::byte> bytes) {
    XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), bytes.data(), bytes.size());
}

void ContentHash::add(std::string_view text) {
    add(text.size());  // so that "ab" + "c" differs from "a" + "bc"
    add(std::as_bytes(std::span(text.data(), text.size())));
}

std::string ContentHash::hex() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state_)));
    std::string text;
    for (const unsigned char byte : canonical.digest)
        for (const int nibble : {byte >> 4, byte & 15}) text += "0123456789abcdef"[nibble];
    return text;
}
