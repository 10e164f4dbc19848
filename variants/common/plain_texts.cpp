#include "variants/common/plain_texts.h"

#include "core/error.h"
#include "core/shown_text.h"

namespace {

void check_text(const std::string& text, const std::string& pointer, const JsonDocument& document) {
    if (shown_text(text) == text) return;
    const auto place = document.places.find(pointer);
    const std::string where = place == document.places.end() ? ""
                                                             : message_text(place->second.file, ":", place->second.line,
                                                                            ":", place->second.column, ": ");
    fail(where, "the text '", shortened(shown_text(text)), "' has a character that a terminal obeys; leave it out");
}

void check_value(const nlohmann::json& value, const std::string& pointer, const JsonDocument& document) {
    if (value.is_string()) check_text(value.get<std::string>(), pointer, document);
    if (!value.is_structured()) return;
    for (const auto& [key, member] : value.items()) {
        const std::string of_member = member_pointer(pointer, key);
        if (value.is_object()) check_text(key, of_member, document);
        check_value(member, of_member, document);
    }
}

}  // namespace

void require_plain_texts(const JsonDocument& document) { check_value(document.value, "", document); }
