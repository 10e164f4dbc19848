#include "experiments/cli/frame_numbers.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <re2/re2.h>
#include <set>

std::vector<unsigned> frame_numbers(std::span<const std::string> texts, size_t most, const std::string& holder) {
    static const RE2 single(R"((\d{1,6}))"), range(R"((\d{1,6})-(\d{1,6}))");
    std::set<unsigned> frames;
    for (const std::string& text : texts) {
        unsigned first = 0, last = 0;
        if (RE2::FullMatch(text, single, &first))
            last = first;
        else if (!RE2::FullMatch(text, range, &first, &last))
            fail("--frames: '", shortened(text),
                 "' must be a frame, as 3, or the first and the last of several, as 0-63, up to 999999");
        if (last < first) fail("--frames: '", text, "' ends before it begins");
        for (unsigned frame = first; frame <= last; ++frame) frames.insert(frame);
    }
    if (frames.size() > most)
        fail("--frames: ", frames.size(), " frames are more than the ", most, " that ", holder, " holds");
    return {frames.begin(), frames.end()};
}
