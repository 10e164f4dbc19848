#pragma once
#include <chrono>
#include <optional>
#include <string>

/// Share done and time left, smoothed for display. The share never falls. The time left shrinks by the time that
/// passes; new estimates enter over `smoothing` seconds.
class ProgressEstimate {
public:
    /// `elapsed`: seconds since the start, never decreasing; `share_done` in [0, 1].
    void update(double elapsed, double share_done);

    double share() const { return share_; }               ///< never less than before
    std::optional<double> left() const { return left_; }  ///< seconds; none before two per cent are done
    bool takes_longer() const { return takes_longer_; }   ///< the rest clearly takes longer than left() states

    static constexpr double smoothing = 30;

private:
    double share_ = 0, elapsed_ = 0;
    std::optional<double> left_;
    bool takes_longer_ = false;
};

/// Shows progress and the expected end of long work: one line on a terminal; on a pipe a line every ten seconds.
/// Results printed with say() stay above it.
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

    double total_;
    ProgressEstimate estimate_;
    size_t drawn_ = 0;  ///< characters of the line on the terminal
    bool is_terminal_;
    std::chrono::steady_clock::time_point start_, last_;
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string format_duration(double seconds);
