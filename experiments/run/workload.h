#pragma once
#include <chrono>
#include <map>
#include <string>

/// What a long run has to do, by kinds of work whose units take about equally long, and how long they took so far: from
/// it the share done and hence the time left. A kind that has not been met yet is judged by a first guess.
class Workload {
public:
    /// `units` more of a kind; `guess`: seconds per unit.
    void plan(const std::string& kind, double units, double guess);

    /// The units that follow are done now, until finish() or skip(). `share` of them is done.
    void start(const std::string& kind, double units);
    void update(double share) { share_ = share; }
    void finish();  ///< they took the time since start()
    void skip();    ///< they turned out to be done already: they tell nothing about the time of others

    /// In [0, 1]: time spent / (time spent + time expected).
    double share_done() const;

private:
    struct Kind {
        double planned = 0, done = 0, seconds = 0, guess = 1;
        double seconds_per_unit() const { return done > 0 ? seconds / done : guess; }
    };
    double seconds_since_start() const;

    std::map<std::string, Kind> kinds_;
    std::string current_;
    double units_ = 0, share_ = 0;
    std::chrono::steady_clock::time_point start_;
};
