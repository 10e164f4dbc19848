#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

/// Time left, smoothed for display, and the share of the time that is over, by this time left. The time left shrinks by
/// the time that passes; a new estimate enters over a tenth of the whole time.
class ProgressEstimate {
public:
    /// `elapsed`: seconds since the start, never decreasing; `share_done` in [0, 1].
    void update(double elapsed, double share_done);

    /// Time passes without news of the work.
    void pass(double elapsed);

    /// elapsed / (elapsed + left()), never less than before; a dip of up to `held` is not shown. None before two per
    /// cent are done, and while a longer estimate of the rest makes it less than it was.
    std::optional<double> share() const { return share_; }
    std::optional<double> left() const { return left_; }  ///< seconds; none before two per cent are done
    bool takes_longer() const { return takes_longer_; }   ///< the rest clearly takes longer than left() states

    static constexpr double held = 0.005;

private:
    void set_share();

    double greatest_ = 0, elapsed_ = 0, updated_ = 0;
    std::optional<double> share_, left_;
    bool takes_longer_ = false;
};

/// "[ 40 %, 4 min 00 s, 6 min 00 s left]". After ten minutes with tenths of a per cent, as one may take minutes. Never
/// all of it.
std::string progress_text(const ProgressEstimate& estimate, double elapsed);

/// Shows progress and the expected end of long work: one line on a terminal; on a pipe a line every ten seconds. The
/// line goes on with the time while the work says nothing. Results printed with say() stay above it.
class Progress {
public:
    explicit Progress(double total_work);
    ~Progress();

    /// `done_work` is in the units of the constructor's total; `what` says what is being done.
    void update(double done_work, const std::string& what);

    /// Prints a line of results above the progress line.
    void say(const std::string& line);

private:
    void clear();
    void draw();
    void draw_as_time_passes(const std::stop_token& stop);

    double total_;
    ProgressEstimate estimate_;
    std::string what_;
    size_t drawn_ = 0;  ///< characters of the line on the terminal
    bool is_terminal_;
    std::chrono::steady_clock::time_point start_, last_;
    std::mutex mutex_;  ///< of all above
    std::condition_variable_any end_;
    std::jthread clock_;
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string format_duration(double seconds);
