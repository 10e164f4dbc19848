// Hands inputs to the readers of fuzz_targets(): those that libFuzzer makes (tests/fuzz.sh), or, built without it,
// those of a folder and some that are made from them.
#include "core/error.h"
#include "core/files.h"
#include "core/reading_limits.h"
#include "core/shown_text.h"
#include "tests/fuzz/targets.h"

#include <unistd.h>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

constexpr uint64_t memory = 256'000'000;  // bytes: what is refused is refused fast

/// A folder of this process, in memory where the machine has such.
struct InputFolder {
    fs::path path;
    explicit InputFolder(const FuzzTarget& target) {
        std::string name =
            (fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path().string()) + "/ssrlab_fuzz_XXXXXX";
        if (!mkdtemp(name.data())) fail_machine("cannot make the folder ", name);
        path = name;
        if (target.prepare) target.prepare(path);
    }
    ~InputFolder() { fs::remove_all(path); }
};

/// Whether the reader takes the input. What it throws beside Error is a finding.
bool is_read(const FuzzTarget& target, const fs::path& folder, std::string_view bytes) {
    const fs::path file = folder / target.file_name;
    FILE* out = std::fopen(file.c_str(), "wb");  // write_text() renames, which is slower
    std::fwrite(bytes.data(), 1, bytes.size(), out);
    std::fclose(out);
    try {
        target.read(file);
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

#ifdef SSRLAB_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const FuzzTarget target = [] {
        reading_limits().memory = memory;
        const char* name = std::getenv("SSRLAB_FUZZ_TARGET");
        for (const FuzzTarget& one : fuzz_targets())
            if (name && std::string(name) == one.name) return one;
        std::fprintf(stderr, "SSRLAB_FUZZ_TARGET names no target of this program\n");
        std::exit(2);
    }();
    static const InputFolder folder(target);
    is_read(target, folder.path, {reinterpret_cast<const char*>(data), size});
    return 0;
}

#else

namespace {

/// The input with up to four of its bits flipped, cut off or with a part of it twice.
std::string mutated(std::string input, std::mt19937& random) {
    const auto below = [&](size_t count) { return size_t(random() % std::max<size_t>(count, 1)); };
    switch (random() % 3) {
        case 0:
            for (size_t flips = below(4) + 1; flips > 0 && !input.empty(); --flips)
                input[below(input.size())] ^= char(1u << random() % 8);
            break;
        case 1:
            input.resize(below(input.size()));
            break;
        default:
            input.insert(below(input.size()), input.substr(below(input.size()), below(64)));
    }
    return input;
}

/// Prints what the target's reader says of each file, in a line each: nothing of what it takes.
int say(const std::string& name, std::span<char*> files) {
    const auto target = std::ranges::find(fuzz_targets(), name, &FuzzTarget::name);
    if (target == fuzz_targets().end()) return 2;
    for (const char* file : files) try {
            target->read(file);
            std::puts("");
        } catch (const Error& error) {
            std::puts(shown_text(error.what()).c_str());
        }
    return 0;
}

/// Reads all of INPUTS/<target>, and so many inputs made from each.
int replay(const fs::path& inputs, int mutations) {
    bool is_complete = true;
    for (const FuzzTarget& target : fuzz_targets()) {
        const InputFolder folder(target);
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(inputs / target.name)) files.push_back(entry.path());
        std::ranges::sort(files);
        std::mt19937 random(1);
        size_t taken = 0, refused = 0;
        for (const fs::path& file : files) {
            const std::string input = read_text(file);
            ++(is_read(target, folder.path, input) ? taken : refused);
            for (int i = 0; i < mutations; ++i) is_read(target, folder.path, mutated(input, random));
        }
        std::printf("%s: %zu inputs taken, %zu refused, %zu made from them\n", target.name, taken, refused,
                    files.size() * size_t(mutations));
        is_complete = is_complete && taken > 0;
    }
    if (!is_complete) std::fprintf(stderr, "a target has no input that its reader takes\n");
    return is_complete ? 0 : 1;
}

}  // namespace

/// usage: PROGRAM INPUTS MUTATIONS
///        PROGRAM say TARGET FILE...
int main(int argc, char** argv) {
    if (argc < 3) return 2;
    reading_limits().memory = memory;
    if (argv[1] == std::string("say")) return say(argv[2], {argv + 3, argv + argc});
    return replay(argv[1], std::atoi(argv[2]));
}

#endif
