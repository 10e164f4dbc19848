#pragma once
#include <string>

/// A point of a study during which a signal ended the program.
struct EndedPoint {
    std::string technique, point;
    std::string how;  ///< a clause: "its pass 'trace' ended the program by signal 11 (Segmentation fault)"
};
