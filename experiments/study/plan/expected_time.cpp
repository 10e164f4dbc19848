#include "experiments/study/plan/expected_time.h"

#include "core/cpu_times.h"
#include "core/number_text.h"
#include "experiments/study/progress.h"

namespace {

// Taken / estimated, of small studies on two cores (tests/experiments/study/plan_benchmark.py). Processor time: 0.61 to
// 1.35 of 20 without other load, 0.76 to 1.38 of 16 of 17 with much. Time: 0.66 to 1.42 without other load. The rest is
// a margin for other machines, and for changing load.
constexpr ExpectedRange of_wall = {0.6, 2.5}, of_processors = {0.6, 2.0};

ExpectedRange scaled(ExpectedRange range, double seconds) { return {range.low * seconds, range.high * seconds}; }

}  // namespace

ExpectedRange range_of_seconds(double seconds) { return scaled(of_wall, seconds); }
ExpectedRange range_of_processor_seconds(double seconds) { return scaled(of_processors, seconds); }

std::string with_range(double seconds, ExpectedRange range) {
    return format_duration(seconds) + " (" + format_duration(range.low) + " to " + format_duration(range.high) + ")";
}

std::string expected_time_text(const ExpectedTime& time, std::optional<double> load_of_others, unsigned processors) {
    const std::string text = "The study takes " + with_range(time.seconds, range_of_seconds(time.seconds)) + ", and " +
                             with_range(time.processor_seconds, range_of_processor_seconds(time.processor_seconds)) +
                             " of processor time. ";
    if (load_of_others.value_or(0) <= disturbing_load)
        return text + "Other programs lengthen the time, and hardly the processor time.";
    return text + "Other programs now take " + fixed_text(*load_of_others * processors, 1) + " of " +
           std::to_string(processors) +
           " processors. Without them the study takes less time, with more of them more, and hardly another "
           "processor time.";
}
