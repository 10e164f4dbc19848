// What most sources include and the compiler would read each time, for half of the build's time. Sources include what
// they use all the same.
#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

// What nlohmann::json consists of, and its parser of texts and of literals: compiled once, in core/json_instances.cpp,
// and not in each source that uses it.
namespace json_instances {
using Json = nlohmann::json;
using TextInput = nlohmann::detail::iterator_input_adapter<std::string::const_iterator>;
using LiteralInput = nlohmann::detail::iterator_input_adapter<const char*>;
using Builder = nlohmann::detail::json_sax_dom_parser<Json>;
using FilteringBuilder = nlohmann::detail::json_sax_dom_callback_parser<Json>;
}  // namespace json_instances
#define SSRLAB_JSON_PARSER(storage, Input)                                                           \
    storage template class nlohmann::detail::lexer<json_instances::Json, Input>;                     \
    storage template class nlohmann::detail::parser<json_instances::Json, Input>;                    \
    storage template bool nlohmann::detail::parser<json_instances::Json, Input>::sax_parse_internal( \
        json_instances::Builder*);                                                                   \
    storage template bool nlohmann::detail::parser<json_instances::Json, Input>::sax_parse_internal( \
        json_instances::FilteringBuilder*);
#define SSRLAB_JSON_INSTANCES(storage)                                                           \
    storage template class nlohmann::basic_json<>;                                               \
    storage template class nlohmann::detail::serializer<json_instances::Json>;                   \
    storage template class nlohmann::detail::json_sax_dom_parser<json_instances::Json>;          \
    storage template class nlohmann::detail::json_sax_dom_callback_parser<json_instances::Json>; \
    SSRLAB_JSON_PARSER(storage, json_instances::TextInput)                                       \
    SSRLAB_JSON_PARSER(storage, json_instances::LiteralInput)
SSRLAB_JSON_INSTANCES(extern)
