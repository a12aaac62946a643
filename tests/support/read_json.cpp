// SPDX-License-Identifier: MIT
#include "tests/support/read_json.hpp"

#include <nlohmann/json.hpp>

namespace burin {
namespace {

using Parsed = nlohmann::ordered_json;

Json taken_over(const Parsed& value) {
    switch (value.type()) {
        case Parsed::value_t::boolean: return value.get<bool>();
        case Parsed::value_t::number_integer: return value.get<std::int64_t>();
        case Parsed::value_t::number_unsigned: return value.get<std::uint64_t>();
        case Parsed::value_t::number_float: return value.get<double>();
        case Parsed::value_t::string: return value.get<std::string>();
        case Parsed::value_t::array: {
            Json list = Json::array();
            for (const Parsed& element : value) list.push_back(taken_over(element));
            return list;
        }
        case Parsed::value_t::object: {
            Json object = Json::object();
            for (const auto& [key, element] : value.items()) object[key] = taken_over(element);
            return object;
        }
        default: return nullptr;
    }
}

}  // namespace

Json read_json(const std::string& text) { return taken_over(Parsed::parse(text)); }

}  // namespace burin
