#include "experiments/study/workload.h"

#include "core/elapsed.h"

#include <algorithm>

void Workload::plan(const std::string& family, const std::string& kind, double units, double guess) {
    families_[family][kind].planned += units;
    families_[family][kind].guess = guess;
}

void Workload::start(const std::string& family, const std::string& kind, double units) {
    family_ = family, current_ = kind, units_ = units, share_ = 0;
    start_ = std::chrono::steady_clock::now();
}

void Workload::finish() {
    Kind& kind = families_[family_][current_];
    kind.done += units_, kind.seconds += seconds_since(start_);
    family_.clear();
}

void Workload::found(double seconds) {
    Kind& kind = families_[family_][current_];
    kind.planned -= units_;
    if (units_ > 0 && seconds > 0) kind.found += units_, kind.found_in += seconds;
    family_.clear();
}

void Workload::Correction::add(const Kind& kind) {
    measured += kind.seconds + kind.found_in;
    guessed += (kind.done + kind.found) * kind.guess;
}

double Workload::share_done() const {
    Correction of_all;
    for (const auto& [name, family] : families_)
        for (const auto& [kind_name, kind] : family) of_all.add(kind);
    double spent = overhead_, left = 0;
    for (const auto& [name, family] : families_) {
        Correction of_family;
        for (const auto& [kind_name, kind] : family) of_family.add(kind);
        const double correction = of_family.guessed > 0 ? of_family.value() : of_all.value();
        for (const auto& [kind_name, kind] : family) {
            const double met = kind.done + kind.found,
                         per_unit = met > 0 ? (kind.seconds + kind.found_in) / met : kind.guess * correction;
            double units_left = kind.planned - kind.done;
            spent += kind.seconds;
            if (name == family_ && kind_name == current_) {
                const double elapsed = seconds_since(start_);
                spent += elapsed;
                units_left -= units_;
                // Once some of it is done its own pace tells more than that of others.
                left += share_ > 0.05 ? elapsed * (1 - share_) / share_ : units_ * (1 - share_) * per_unit;
            }
            left += std::max(units_left, 0.0) * per_unit;
        }
    }
    return spent + left > 0 ? spent / (spent + left) : 0.0;
}
