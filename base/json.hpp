// SPDX-License-Identifier: MIT
// JSON values whose object keys keep their order of insertion (nlohmann/json). All reports are made of them.
//
// A braced list of pairs that begin with a string is an object, any other braced list an array:
//   {{"ticks", 3}, {"names", {"a", "b"}}}
// Null turns into an object by [key], and into an array by push_back. Reading a value as another type, or a key that is
// not there, is a programming error; at() throws there. One thread at a time.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

// Compiled once, in json.cpp: the library's templates cost every report a third of its compile time otherwise
// (docs/decisions/016-build-time.md).
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace burin {

using Json = nlohmann::ordered_json;

// Writes a report: indented by two blanks, with a line end. Numbers have as many digits as it takes to read back the
// same value; what JSON cannot express is replaced, numbers (NaN, infinity) by null and invalid UTF-8 by U+FFFD.
[[nodiscard]] inline std::string json_text(const Json& value) {
    return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Returns the value at a path of keys ("/mesh/triangles"); null when there is none.
[[nodiscard]] inline const Json* find_value(const Json& value, std::string_view path) {
    const Json* at = &value;
    while (!path.empty()) {
        const std::string_view key = path.substr(1, path.find('/', 1) - 1);
        path.remove_prefix(1 + key.size());
        const auto found = at->find(key);
        if (found == at->end()) return nullptr;
        at = &*found;
    }
    return at;
}

}  // namespace burin
