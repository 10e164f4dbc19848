#include "experiments/study/measuring/times/timed_rounds.h"

#include "metrics/statistics/median_interval.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

void LoadWindow::tell(const CpuTimes& start) {
    const RoundLoad load{.foreign = foreign_load(start, now_), .stolen = stolen_share(start, now_)};
    for (; told_ < rounds_.size(); ++told_) {
        rounds_[told_] = load;
        quiet_ += !load.is_disturbed();
    }
    start_before_ = start, start_ = now_;
}

void LoadWindow::end_round() {
    rounds_.emplace_back();
    now_ = cpu_times_();
    if (now_.wall - start_.wall >= load_window) tell(start_);
}

void LoadWindow::tell_rest() {
    if (untold() == 0) return;
    if (start_before_) return tell(*start_before_);
    std::this_thread::sleep_for(std::chrono::duration<double>(load_window - (now_.wall - start_.wall)));
    now_ = cpu_times_();
    tell(start_);
}

std::vector<size_t> chosen_rounds(std::span<const RoundLoad> rounds, size_t wanted) {
    std::vector<size_t> order(rounds.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return rounds[i].is_disturbed() ? *rounds[i].foreign : 0.0; });
    const auto quiet = size_t(std::ranges::count_if(rounds, [](const RoundLoad& r) { return !r.is_disturbed(); }));
    order.resize(std::min(quiet >= least_rounds ? std::min(quiet, wanted) : wanted, order.size()));
    std::ranges::sort(order);
    return order;
}

std::vector<bool> open_orders(const std::vector<std::vector<double>>& times) {
    std::vector<bool> is_open(times.size());
    for (size_t a = 0; a < times.size(); ++a)
        for (size_t b = a + 1; b < times.size(); ++b) {
            std::vector<double> ratios;
            for (size_t i = 0; i < times[a].size(); ++i) ratios.push_back(std::log(times[a][i] / times[b][i]));
            const Estimate m = median_interval(ratios);
            if (2 * m.low - m.value > 0 || 2 * m.high - m.value < 0) continue;
            is_open[a] = is_open[b] = true;
        }
    return is_open;
}
