#pragma once
#include <chrono>
#include <string>

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
    size_t drawn_ = 0;  ///< characters of the line on the terminal
    bool is_terminal_;
    std::chrono::steady_clock::time_point start_, last_;
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string format_duration(double seconds);
