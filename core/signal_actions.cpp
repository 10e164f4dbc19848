#include "core/signal_actions.h"

SignalActions::SignalActions(std::span<const int> signals, const struct sigaction& action, Ignored ignored) {
    for (const int signal : signals) {
        struct sigaction before;
        sigaction(signal, nullptr, &before);
        before_.emplace_back(signal, before);
        if (before.sa_handler != SIG_IGN || ignored == Ignored::too) sigaction(signal, &action, nullptr);
    }
}

SignalActions::~SignalActions() {
    for (const auto& [signal, before] : before_) sigaction(signal, &before, nullptr);
}
