#pragma once
#include <chrono>
#include <map>
#include <string>

/// Estimates the share done of a long run. Work has kinds, whose units take about equally long, and families of kinds
/// (all points' renders). A kind that has not run yet counts with a first guess, corrected as its family was, or else
/// as all measured kinds were.
class Workload {
public:
    /// Adds `units` of a kind; `guess`: seconds per unit.
    void plan(const std::string& family, const std::string& kind, double units, double guess);

    /// Starts these units; they last until finish() or found(). update() sets the share of them that is done.
    void start(const std::string& family, const std::string& kind, double units);
    void update(double share) { share_ = share; }
    void finish();  ///< the units took the time since start()
    /// The units were already done, in `seconds`, which inform later estimates; 0: unknown.
    void found(double seconds);

    /// Adds time spent outside the planned kinds. It does not affect the estimate of what is left.
    void add_overhead(double seconds) { overhead_ += seconds; }

    /// In [0, 1]: time spent / (time spent + time expected).
    double share_done() const;

private:
    struct Kind {
        double planned = 0, guess = 1;
        double done = 0, seconds = 0;    ///< in this run
        double found = 0, found_in = 0;  ///< units of earlier runs, and their seconds
    };
    /// Measured seconds / guessed seconds of the kinds that have run.
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
