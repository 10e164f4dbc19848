#pragma once
#include <optional>
#include <string>

/// Of a study's cells that are to be done, in seconds: CellEstimate.
struct ExpectedTime {
    double seconds = 0, processor_seconds = 0;
};

/// Holds a study's time in 9 of 10 cases, as long as the load of other programs stays.
struct ExpectedRange {
    double low, high;
};
ExpectedRange range_of_seconds(double seconds);
ExpectedRange range_of_processor_seconds(double seconds);

/// "4 min 05 s (2 min 30 s to 7 min 20 s)".
std::string with_range(double seconds, ExpectedRange range);

/// Two sentences on a study's time, with its intervals, and on the programs that make it longer. `load_of_others`: the
/// share in [0, 1] that they took of all processors, if it is known; `processors`: of the machine.
std::string expected_time_text(const ExpectedTime& time, std::optional<double> load_of_others, unsigned processors);
