#pragma once
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <string>

/// Whether the process of this number ends within two seconds. Whoever adopts it takes a moment to bury it.
inline bool ends_soon(const std::string& process) {
    const auto goes_on = [&] {
        std::ifstream command(std::filesystem::path("/proc") / process / "cmdline");
        return command.get() != std::char_traits<char>::eof();  // of one that waits to be buried it is empty
    };
    for (unsigned i = 0; i < 2000 && goes_on(); ++i) usleep(1000);
    return !goes_on();
}
