#pragma once
#include <chrono>
#include <map>
#include <string>
#include <vector>

/// What a run spends its time on, by name. Spans nest: the time of an inner one is not the outer's. One thread.
class SpentTime {
public:
    class Span {
    public:
        Span(SpentTime& spent, const std::string& what) : spent_(spent) { spent_.begin(what); }
        ~Span() { spent_.end(); }
        Span(const Span&) = delete;
        Span& operator=(const Span&) = delete;

    private:
        SpentTime& spent_;
    };

    /// Seconds by name; of open spans up to now.
    std::map<std::string, double> seconds() const;

private:
    using Clock = std::chrono::steady_clock;
    void begin(const std::string& what);
    void end();
    void count();  ///< what passed since `since_` belongs to the innermost span

    std::vector<std::string> open_;
    Clock::time_point since_ = Clock::now();
    std::map<std::string, double> seconds_;
};
