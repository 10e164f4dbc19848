#pragma once
#include "experiments/results/advice/advice.h"

/// A question to the table. What is empty or missing asks for all, but for surfaces.
struct AdviceQuestion {
    std::string chip;
    std::optional<double> ms;
    std::string place, movement;
    std::string surface = "all";

    /// Whether one budget of one chip is asked for.
    bool is_whole() const { return !chip.empty() && ms; }
};

/// The answer in lines of text: what to use, why, and what that rests on. A question that is not whole gets a table of
/// the techniques that err least. Fails with Error if the table lacks what is asked for, or nothing fits.
std::string advice_answer(const Advice& advice, const AdviceQuestion& question);

/// The points that err least, as the "techniques" of a study's config, each once.
nlohmann::json advised_points(const Advice& advice, const AdviceQuestion& question);
