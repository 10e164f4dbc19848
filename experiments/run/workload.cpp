#include "experiments/run/workload.h"

#include <algorithm>

void Workload::plan(const std::string& kind, double units, double guess) {
    kinds_[kind].planned += units;
    kinds_[kind].guess = guess;
}

void Workload::start(const std::string& kind, double units) {
    current_ = kind, units_ = units, share_ = 0;
    start_ = std::chrono::steady_clock::now();
}

double Workload::seconds_since_start() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Workload::finish() {
    Kind& kind = kinds_[current_];
    kind.done += units_, kind.seconds += seconds_since_start();
    current_.clear();
}

void Workload::skip() {
    kinds_[current_].planned -= units_;
    current_.clear();
}

double Workload::share_done() const {
    double spent = 0, left = 0;
    for (const auto& [name, kind] : kinds_) {
        double units_left = kind.planned - kind.done;
        spent += kind.seconds;
        if (name == current_) {
            const double elapsed = seconds_since_start();
            spent += elapsed;
            units_left -= units_;
            // Once some of it is done its own pace tells more than that of others.
            left += share_ > 0.05 ? elapsed * (1 - share_) / share_ : units_ * (1 - share_) * kind.seconds_per_unit();
        }
        left += std::max(units_left, 0.0) * kind.seconds_per_unit();
    }
    return spent + left > 0 ? spent / (spent + left) : 0.0;
}
