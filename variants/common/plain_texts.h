#pragma once
#include "core/json.h"

/// Fails where a key or text of the document has a character that a terminal obeys (core/shown_text.h): the texts of a
/// technique's folder are printed by many commands.
void require_plain_texts(const JsonDocument& document);
