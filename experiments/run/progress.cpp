#include "experiments/run/progress.h"

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

std::string format_duration(double seconds) {
    const long long whole = std::llround(std::max(seconds, 0.0));
    char text[32];
    if (whole >= 3600)
        std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
    else if (whole >= 60)
        std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%lld s", whole);
    return text;
}

Progress::Progress(double total_work)
    : total_(std::max(total_work, 1e-9)),
      is_terminal_(isatty(STDERR_FILENO)),
      start_(std::chrono::steady_clock::now()),
      last_(start_ - std::chrono::hours(1)) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
    if (drawn_) std::fprintf(stderr, "\r%*s\r", int(drawn_), "");
    drawn_ = 0;
}

void Progress::update(double done_work, const std::string& what) {
    const auto now = std::chrono::steady_clock::now();
    if (seconds(now - last_) < (is_terminal_ ? 0.2 : 10.0)) return;
    last_ = now;
    const double fraction = std::clamp(done_work / total_, 0.0, 1.0), elapsed = seconds(now - start_);
    // Before two per cent are done an estimate would only mislead.
    const std::string left =
        fraction < 0.02 ? "" : ", " + format_duration(elapsed * (1.0 - fraction) / fraction) + " left";
    char head[64];
    std::snprintf(head, sizeof head, "[%3.0f %%, %s", 100.0 * fraction, format_duration(elapsed).c_str());
    const std::string line = head + left + "] " + what;
    if (!is_terminal_) {
        std::fprintf(stderr, "%s\n", line.c_str());
        return;
    }
    clear();
    std::fputs(line.c_str(), stderr);
    drawn_ = line.size();
}

void Progress::say(const std::string& line) {
    clear();
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}
