#include "experiments/study/spent_time.h"

void SpentTime::count() {
    const Clock::time_point now = Clock::now();
    if (!open_.empty()) seconds_[open_.back()] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
}

void SpentTime::begin(const std::string& what) { count(), open_.push_back(what); }
void SpentTime::end() { count(), open_.pop_back(); }

std::map<std::string, double> SpentTime::seconds() const {
    SpentTime now = *this;
    now.count();
    return now.seconds_;
}
