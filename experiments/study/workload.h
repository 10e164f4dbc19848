#pragma once
#include <chrono>
#include <map>
#include <string>

/// What a long run has to do, by kinds of work whose units take about equally long, and how long they took so far: from
/// it the share done and hence the time left. Kinds belong to families (all points' renders): one that has not been met
/// yet is judged by a first guess, corrected as its family was, or else all that was met.
class Workload {
public:
    /// `units` more of a kind; `guess`: seconds per unit.
    void plan(const std::string& family, const std::string& kind, double units, double guess);

    /// The units that follow are done now, until finish() or found(). `share` of them is done.
    void start(const std::string& family, const std::string& kind, double units);
    void update(double share) { share_ = share; }
    void finish();  ///< they took the time since start()
    /// They turned out to be done already, in so many seconds, which tell the time of others; 0: that is not known.
    void found(double seconds);

    /// Time that went into none of the planned kinds: it is spent, and tells nothing of what is left.
    void add_overhead(double seconds) { overhead_ += seconds; }

    /// In [0, 1]: time spent / (time spent + time expected).
    double share_done() const;

private:
    struct Kind {
        double planned = 0, guess = 1;
        double done = 0, seconds = 0;    ///< in this run
        double found = 0, found_in = 0;  ///< units of earlier runs, and their seconds
    };
    /// Measured seconds over guessed ones, of what was met.
    struct Correction {
        double measured = 0, guessed = 0;
        void add(const Kind& kind);
        double value() const { return guessed > 0 ? measured / guessed : 1; }
    };

    std::map<std::string, std::map<std::string, Kind>> families_;
    std::string family_, current_;
    double units_ = 0, share_ = 0, overhead_ = 0;
    std::chrono::steady_clock::time_point start_;
};
