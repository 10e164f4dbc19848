#pragma once
#include <array>
#include <string_view>

/// What this process works on, in memory that it shares with the process that started it: whoever finds that a signal
/// ended this process reads there which work did. Texts end with a zero and are cut at 255 bytes.
struct InFlight {
    using Text = std::array<char, 256>;
    Text technique{}, point{};  ///< of a study
    Text pass{};                ///< the stage of a PassList
};

InFlight& in_flight();

/// Holds a text of in_flight() for as long as it lives; then the text is what it was before.
class InFlightText {
public:
    InFlightText(InFlight::Text& text, std::string_view content);
    ~InFlightText() { text_ = before_; }
    InFlightText(const InFlightText&) = delete;
    InFlightText& operator=(const InFlightText&) = delete;

private:
    InFlight::Text& text_;
    const InFlight::Text before_;
};
