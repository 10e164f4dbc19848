#pragma once
#include <chrono>
#include <map>
#include <string>
#include <vector>

/// The time of a run by named spans. Spans nest: an outer span does not include the time of an inner one. For one
/// thread.
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

    /// Seconds by name; open spans count up to now.
    std::map<std::string, double> seconds() const;

private:
    using Clock = std::chrono::steady_clock;
    void begin(const std::string& what);
    void end();
    void count();  ///< adds the time since `since_` to the innermost span

    std::vector<std::string> open_;
    Clock::time_point since_ = Clock::now();
    std::map<std::string, double> seconds_;
};
