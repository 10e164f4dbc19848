// Which rounds count, which points go on, and that neither spoils an interval.
#include "experiments/study/measuring/times/timed_rounds.h"
#include "metrics/statistics/median_interval.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

std::vector<RoundLoad> loads(const std::vector<double>& foreign) {
    std::vector<RoundLoad> rounds;
    for (const double f : foreign) rounds.push_back({.foreign = f});
    return rounds;
}

/// Times of points in rounds as a busy machine gives them: what slows a round down lasts for several (`memory`: the
/// correlation of one round with the next) and has heavy tails, and so has what a point has of its own (Student's t of
/// 2 degrees: no variance). The median of each point's time is its entry of `medians`.
class BusyMachine {
public:
    BusyMachine(std::vector<double> medians, double memory) : medians_(std::move(medians)), memory_(memory) {}

    std::vector<std::vector<double>> times(size_t rounds) {
        std::vector<std::vector<double>> times(medians_.size());
        double state = normal_(random_);
        for (size_t i = 0; i < rounds; ++i) {
            const double common = std::exp(0.1 * std::copysign(std::pow(std::abs(state), 1.5), state));
            for (size_t p = 0; p < medians_.size(); ++p)
                times[p].push_back(medians_[p] * common * std::exp(0.03 * tails_(random_)));
            state = memory_ * state + std::sqrt(1 - memory_ * memory_) * normal_(random_);
        }
        return times;
    }

private:
    std::vector<double> medians_;
    double memory_;
    std::mt19937 random_{1};
    std::normal_distribution<double> normal_;
    std::student_t_distribution<double> tails_{2};
};

struct Count {
    double trials = 0, covered = 0, log_errors = 0;
    void add(const std::vector<double>& values, double truth) {
        const Estimate m = median_interval(values);
        ++trials, covered += m.low <= truth && truth <= m.high, log_errors += std::log(m.value / truth);
    }
};

}  // namespace

TEST(ChosenRounds, AreTheQuietOnesIfTheyAreEnough) {
    const std::vector<RoundLoad> rounds = loads({0, 0.3, 0, 0, 0.9, 0, 0, 0, 0.06, 0, 0.05, 0});
    EXPECT_EQ(chosen_rounds(rounds, 15), (std::vector<size_t>{0, 2, 3, 5, 6, 7, 9, 10, 11}));
    EXPECT_EQ(chosen_rounds(rounds, 8), (std::vector<size_t>{0, 2, 3, 5, 6, 7, 9, 10})) << "the first of them";
    // Seven are quiet: too few for an interval of their own.
    EXPECT_EQ(chosen_rounds(std::span(rounds).first(10), 9).size(), 9u);
    EXPECT_EQ(chosen_rounds(std::span(rounds).first(10), 9), (std::vector<size_t>{0, 1, 2, 3, 5, 6, 7, 8, 9}));
    EXPECT_EQ(chosen_rounds(std::span(rounds).first(3), 15), (std::vector<size_t>{0, 1, 2}));
    EXPECT_TRUE(chosen_rounds({}, 15).empty());
}

TEST(OpenOrders, AreThoseWithinTwiceTheIntervalOfOne) {
    // The ratios of the first two reach by 2 % to each side of their median.
    const auto orders = [](double median) {
        std::vector<double> first, second(8, 1.0);
        for (int i = 0; i < 8; ++i) first.push_back(median * std::exp(i % 2 ? 0.02 : -0.02));
        return open_orders({first, second, std::vector<double>(8, 100.0)});
    };
    EXPECT_EQ(orders(1.0), (std::vector<bool>{true, true, false}));
    EXPECT_EQ(orders(std::exp(0.03)), (std::vector<bool>{true, true, false})) << "apart, but no more than that";
    EXPECT_EQ(orders(std::exp(0.05)), (std::vector<bool>{false, false, false}));
    EXPECT_EQ(orders(std::exp(-0.03)), (std::vector<bool>{true, true, false}));
    EXPECT_EQ(orders(std::exp(-0.05)), (std::vector<bool>{false, false, false}));
    EXPECT_EQ(open_orders({{1, 1, 1, 1, 1, 1, 1, 1}}), (std::vector<bool>{false})) << "alone";
}

/// Studies that look at least_rounds rounds and play on, with a budget that slow rounds use up sooner, only the points
/// whose order is open: two alike, one near them, two far off.
TEST(TimedRounds, LooksDoNotSpoilTheCoverage) {
    const std::vector<double> medians = {1, 1, 1.03, 1.3, 2};
    constexpr size_t studies = 1500, wanted = 15;
    for (const auto& [memory, of_times] : {std::pair(0.0, 0.98), std::pair(0.5, 0.94)}) {
        BusyMachine machine(medians, memory);
        Count times, ratios, alike;
        double rounds = 0;
        for (size_t study = 0; study < studies; ++study) {
            const std::vector<std::vector<double>> all = machine.times(wanted);
            std::vector<std::vector<double>> played;
            double seconds = 0, planned = 0;
            for (const std::vector<double>& of_point : all) {
                played.emplace_back(of_point.begin(), of_point.begin() + least_rounds);
                for (const double t : played.back()) seconds += t;
            }
            const std::vector<bool> is_open = open_orders(played);
            for (size_t p = 0; p < all.size(); ++p) planned += is_open[p] ? medians[p] : 0;
            const double budget = 1.35 * least_rounds * 6.33;  // of the sum of the medians
            for (size_t i = least_rounds; i < wanted && planned > 0 && seconds + planned <= budget; ++i)
                for (size_t p = 0; p < all.size(); ++p)
                    if (is_open[p]) played[p].push_back(all[p][i]), seconds += all[p][i];
            for (size_t p = 0; p < all.size(); ++p) {
                times.add(played[p], medians[p]), rounds += double(played[p].size());
                for (size_t q = 0; q < p; ++q) {
                    std::vector<double> of_rounds;
                    for (size_t i = 0; i < std::min(played[p].size(), played[q].size()); ++i)
                        of_rounds.push_back(played[p][i] / played[q][i]);
                    ratios.add(of_rounds, medians[p] / medians[q]);
                    if (p == 1) alike.add(of_rounds, 1);
                }
            }
        }
        EXPECT_LT(rounds, 0.8 * wanted * times.trials) << "few points go on";
        // 1500 studies know a share of 95 % to 0.6 % (and more of them those of five points); of rounds that tell half
        // of the next, 15 without any look cover 95.0 % of medians.
        EXPECT_GT(times.covered / times.trials, of_times) << memory;
        EXPECT_GT(ratios.covered / ratios.trials, 0.98) << memory;
        EXPECT_GT(alike.covered / alike.trials, 0.98) << memory << ": where a look might decide by chance";
        // Slow rounds use up the budget, so that few others set them right: a quarter of a per cent, where a single
        // study's medians scatter by 4 to 6 %.
        EXPECT_LT(std::abs(times.log_errors / times.trials), 0.01) << memory;
        EXPECT_LT(std::abs(ratios.log_errors / ratios.trials), 0.005) << memory;
    }
}
