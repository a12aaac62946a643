// SPDX-License-Identifier: MIT
#include "base/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace burin {
namespace {

bool is_pair(const Json& value) { return value.size() == 2 && value[0].is_string(); }

const Json* find_in(const Json::Object& object, std::string_view key) {
    const auto at = std::ranges::find(object, key, [](const auto& item) { return std::string_view(item.first); });
    return at == object.end() ? nullptr : &at->second;
}

}  // namespace

Json::Json() noexcept : value_(nullptr) {}
Json::Json(std::nullptr_t) noexcept : value_(nullptr) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(std::string_view text) : value_(std::string(text)) {}
Json::Json(Array list) : value_(std::move(list)) {}
Json::Json(const Plain& plain) {
    std::visit([&](auto value) { value_ = value; }, plain.value);
}
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> list) {
    const auto is_array_pair = [](const Json& v) { return std::holds_alternative<Array>(v.value_) && is_pair(v); };
    if (!std::ranges::all_of(list, is_array_pair)) {
        value_ = Array(list);
        return;
    }
    Object object;
    for (const Json& pair : list) object.emplace_back(pair[0].text(), pair[1]);
    value_ = std::move(object);
}

Json Json::array(std::initializer_list<Json> list) { return Array(list); }

Json Json::object() {
    Json value;
    value.value_ = Object();
    return value;
}

bool Json::is_null() const { return std::holds_alternative<std::nullptr_t>(value_); }
bool Json::is_string() const { return std::holds_alternative<std::string>(value_); }
bool Json::is_number_float() const { return std::holds_alternative<double>(value_); }
bool Json::is_number() const {
    return is_number_float() || std::holds_alternative<std::int64_t>(value_) ||
           std::holds_alternative<std::uint64_t>(value_);
}

const std::string& Json::text() const { return std::get<std::string>(value_); }
bool Json::truth() const { return std::get<bool>(value_); }

double Json::number() const {
    if (const auto* n = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*n);
    if (const auto* n = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*n);
    return std::get<double>(value_);
}

std::int64_t Json::integer() const {
    if (const auto* n = std::get_if<std::uint64_t>(&value_)) return static_cast<std::int64_t>(*n);
    if (const auto* n = std::get_if<double>(&value_)) return static_cast<std::int64_t>(*n);
    return std::get<std::int64_t>(value_);
}

bool Json::value(std::string_view key, bool otherwise) const {
    const Json* found = find_in(items(), key);
    return found != nullptr ? found->truth() : otherwise;
}

std::string Json::value(std::string_view key, const char* otherwise) const {
    const Json* found = find_in(items(), key);
    return found != nullptr ? found->text() : otherwise;
}

std::size_t Json::size() const {
    if (is_null()) return 0;
    if (const auto* object = std::get_if<Object>(&value_)) return object->size();
    if (const auto* list = std::get_if<Array>(&value_)) return list->size();
    return 1;
}

bool Json::contains(std::string_view key) const {
    const auto* object = std::get_if<Object>(&value_);
    return object != nullptr && find_in(*object, key) != nullptr;
}

Json& Json::operator[](std::string_view key) {
    if (is_null()) value_ = Object();
    auto& object = std::get<Object>(value_);
    const auto at = std::ranges::find(object, key, [](const auto& item) { return std::string_view(item.first); });
    return at != object.end() ? at->second : object.emplace_back(key, Json()).second;
}

const Json& Json::operator[](std::string_view key) const {
    const Json* found = find_in(items(), key);
    if (found == nullptr) throw std::out_of_range("no such key: " + std::string(key));
    return *found;
}

const Json* Json::find(std::string_view path) const {
    const Json* at = this;
    while (at != nullptr && !path.empty()) {
        const std::string_view key = path.substr(1, path.find('/', 1) - 1);
        path.remove_prefix(1 + key.size());
        const auto* object = std::get_if<Object>(&at->value_);
        at = object != nullptr ? find_in(*object, key) : nullptr;
    }
    return at;
}

const Json::Object& Json::items() const { return std::get<Object>(value_); }

void Json::update(const Json& other) {
    for (const auto& [key, value] : other.items()) (*this)[key] = value;
}

const Json& Json::operator[](std::size_t index) const { return std::get<Array>(value_).at(index); }
Json& Json::back() { return std::get<Array>(value_).back(); }

void Json::push_back(Json value) {
    if (is_null()) value_ = Array();
    std::get<Array>(value_).push_back(std::move(value));
}

Json::Array::const_iterator Json::begin() const { return std::get<Array>(value_).begin(); }
Json::Array::const_iterator Json::end() const { return std::get<Array>(value_).end(); }

bool operator==(const Json& a, const Json& b) {
    if (!a.is_number() || !b.is_number()) return a.value_ == b.value_;
    if (a.is_number_float() || b.is_number_float()) return a.number() == b.number();
    return a.value_ == b.value_ || (a.integer() == b.integer() && a.integer() >= 0);
}

struct Json::Writer {
    using Written = nlohmann::ordered_json;

    static Written written(const Json& value) { return std::visit(Writer(), value.value_); }
    Written operator()(const Array& list) const {
        Written all = Written::array();
        for (const Json& value : list) all.push_back(written(value));
        return all;
    }
    Written operator()(const Object& object) const {
        Written all = Written::object();
        for (const auto& [key, value] : object) all[key] = written(value);
        return all;
    }
    Written operator()(const auto& plain) const { return plain; }
};

std::string Json::dump(int indent) const {
    return Writer::written(*this).dump(indent, ' ', false, Writer::Written::error_handler_t::replace);
}

}  // namespace burin
