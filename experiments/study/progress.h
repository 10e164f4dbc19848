#pragma once
#include <chrono>
#include <optional>
#include <string>

/// How far work is and how long the rest takes, as it is shown: what was done stays done, and the rest shrinks by the
/// time that passes, but for what new estimates change, which enters over `smoothing` seconds.
class ProgressEstimate {
public:
    /// `elapsed`: seconds since the start, not less than the last time; `share_done` in [0, 1].
    void update(double elapsed, double share_done);

    double share() const { return share_; }               ///< never less than before
    std::optional<double> left() const { return left_; }  ///< seconds; none before two per cent are done
    bool takes_longer() const { return takes_longer_; }   ///< the rest takes clearly longer than it says yet

    static constexpr double smoothing = 30;

private:
    double share_ = 0, elapsed_ = 0;
    std::optional<double> left_;
    bool takes_longer_ = false;
};

/// One line on the terminal that says how far long work is and when it will end; on a pipe a line every ten seconds.
/// Results printed meanwhile with say() stay above it.
class Progress {
public:
    explicit Progress(double total_work);
    ~Progress();

    /// `work` is in the units of the constructor's total; `what` says what is being done.
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
