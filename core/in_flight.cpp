#include "core/in_flight.h"

#include <sys/mman.h>
#include <algorithm>
#include <new>

InFlight& in_flight() {
    static InFlight& shared = [&]() -> InFlight& {
        void* const memory = mmap(nullptr, sizeof(InFlight), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) throw std::bad_alloc();
        return *new (memory) InFlight;
    }();
    return shared;
}

InFlightText::InFlightText(InFlight::Text& text, std::string_view content) : text_(text), before_(text) {
    InFlight::Text now{};
    std::copy_n(content.begin(), std::min(content.size(), now.size() - 1), now.begin());
    text_ = now;
}
