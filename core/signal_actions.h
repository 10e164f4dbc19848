#pragma once
#include <csignal>
#include <span>
#include <utility>
#include <vector>

/// While it lives, signals have another action; then the one that they had before.
class SignalActions {
public:
    enum class Ignored { stay, too };  ///< what holds for signals that whoever started this process ignores

    SignalActions(std::span<const int> signals, const struct sigaction& action, Ignored ignored = Ignored::stay);
    ~SignalActions();
    SignalActions(const SignalActions&) = delete;
    SignalActions& operator=(const SignalActions&) = delete;

private:
    std::vector<std::pair<int, struct sigaction>> before_;
};
