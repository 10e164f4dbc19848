#include "core/cpu_times.h"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

std::optional<MachineTimes> parse_proc_stat(std::string_view text, double ticks_per_second) {
    std::istringstream lines{std::string(text)};
    MachineTimes times;
    double elapsed = 0;
    for (std::string line; std::getline(lines, line) && line.starts_with("cpu");) {
        if (line[3] != ' ') {
            ++times.cpus;
            continue;
        }
        std::istringstream fields(line.substr(4));
        // user nice system idle iowait irq softirq steal; guests are in user already.
        double ticks = 0;
        for (int field = 0; field < 8 && fields >> ticks; ++field) {
            elapsed += ticks;
            if (field != 3 && field != 4) times.busy += ticks / ticks_per_second;
            if (field == 7) times.stolen = ticks / ticks_per_second;
        }
    }
    if (times.cpus == 0 || elapsed == 0) return {};
    return times;
}

CpuTimes read_cpu_times() {
    CpuTimes times;
    std::ifstream in("/proc/stat");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (const auto machine = parse_proc_stat(text, double(sysconf(_SC_CLK_TCK))))
        times.machine = machine->busy, times.stolen = machine->stolen, times.cpus = machine->cpus;
    timespec own{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &own);
    times.own = double(own.tv_sec) + 1e-9 * double(own.tv_nsec);
    times.wall = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    return times;
}

std::optional<double> foreign_load(const CpuTimes& before, const CpuTimes& after) {
    const double available = (after.wall - before.wall) * after.cpus;
    if (!before.machine || !after.machine || !(available > 0)) return {};
    const double others = (*after.machine - *before.machine) - (after.own - before.own);
    return std::clamp(others / available, 0.0, 1.0);
}

double stolen_share(const CpuTimes& before, const CpuTimes& after) {
    const double available = (after.wall - before.wall) * after.cpus;
    return available > 0 ? std::clamp((after.stolen - before.stolen) / available, 0.0, 1.0) : 0.0;
}
