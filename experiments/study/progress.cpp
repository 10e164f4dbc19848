#include "experiments/study/progress.h"

#include "core/shown_text.h"
#include "core/terminal.h"
#include "core/wrapped_text.h"

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace std::chrono_literals;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

double left_after(double passed, double left) { return std::max(left - passed, 0.0); }

}  // namespace

void ProgressEstimate::update(double elapsed, double share_done) {
    constexpr double least_smoothing = 5;  // s
    if (left_) left_ = left_after(elapsed - elapsed_, *left_);
    elapsed_ = elapsed;
    if (share_done < 0.02) return;  // an estimate would only mislead
    const double now = elapsed * (1 - share_done) / share_done, passed = elapsed - updated_;
    updated_ = elapsed;
    if (left_) {
        const double expected = *left_, smoothing = std::max(0.1 * (elapsed + expected), least_smoothing);
        takes_longer_ = now > 1.3 * expected + 10;
        left_ = expected + (now - expected) * (1 - std::exp(-passed / smoothing));
    } else {
        left_ = now;
    }
    set_share();
}

void ProgressEstimate::pass(double elapsed) {
    if (left_) left_ = left_after(elapsed - elapsed_, *left_);
    elapsed_ = elapsed;
    if (left_) set_share();
}

void ProgressEstimate::set_share() {
    const double share = elapsed_ > 0 ? elapsed_ / (elapsed_ + *left_) : 0;
    greatest_ = std::max(greatest_, share);
    share_ = share >= greatest_ - held ? std::optional(greatest_) : std::nullopt;
}

std::string progress_text(const ProgressEstimate& estimate, double elapsed) {
    std::string text = "[";
    if (const auto share = estimate.share()) {
        const int digits = elapsed < 600 ? 0 : 1;
        const double step = digits == 0 ? 1 : 0.1;
        char percent[32];
        std::snprintf(percent, sizeof percent, "%*.*f %%, ", 3 + digits, digits,
                      std::min(std::floor(100 * *share / step + 1e-9) * step, 100 - step));
        text += percent;
    }
    text += format_duration(elapsed);
    if (estimate.left()) text += ", " + format_duration(*estimate.left()) + " left";
    if (estimate.takes_longer()) text += ", rising: this takes longer than what came before";
    return text + "]";
}

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
      last_(start_ - std::chrono::hours(1)),
      clock_([this](const std::stop_token& stop) { draw_as_time_passes(stop); }) {}

Progress::~Progress() {
    clock_.request_stop();
    clock_.join();
    clear();
}

void Progress::draw_as_time_passes(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto pause = is_terminal_ ? 1s : 10s;
    while (!stop.stop_requested()) {
        end_.wait_for(lock, stop, pause, [] { return false; });
        const auto now = std::chrono::steady_clock::now();
        if (stop.stop_requested() || what_.empty() || now - last_ < pause) continue;
        last_ = now;
        estimate_.pass(seconds(now - start_));
        draw();
    }
}

void Progress::clear() {
    if (drawn_) std::fprintf(stderr, "\r%*s\r", int(drawn_), "");
    drawn_ = 0;
}

void Progress::update(double done_work, const std::string& what) {
    const std::lock_guard lock(mutex_);
    what_ = what;
    const auto now = std::chrono::steady_clock::now();
    estimate_.update(seconds(now - start_), std::clamp(done_work / total_, 0.0, 1.0));
    if (seconds(now - last_) < (is_terminal_ ? 0.2 : 10.0)) return;
    last_ = now;
    draw();
}

void Progress::draw() {
    const std::string line = progress_text(estimate_, seconds(last_ - start_)) + " " + shown_text(what_);
    if (!is_terminal_) {
        std::fprintf(stderr, "%s\n", line.c_str());
        return;
    }
    clear();
    // A line that reaches the last column would go on in the next line, which clear() does not reach.
    const auto columns = terminal_columns(stderr);
    const std::string fitting = columns ? cut_to(line, *columns - 1) : line;
    std::fputs(fitting.c_str(), stderr);
    drawn_ = letters_of(fitting);
}

void Progress::say(const std::string& line) {
    const std::lock_guard lock(mutex_);
    clear();
    std::printf("%s\n", shown_text(line).c_str());
    std::fflush(stdout);
}
