// SPDX-License-Identifier: MIT
// A JSON value to be written, with its object's keys in the order in which they came. All reports are made of it.
// It stands before nlohmann/json, whose templates cost a compiler 5 to 15 seconds in a source that puts together a report: only
// json.cpp knows them.
//
// A braced list of pairs that begin with a text is an object, any other braced list an array: {{"ticks", 3}, {"names", {"a", "b"}}}.
// Null turns into an object by [key], and into an array by push_back. Asking for what a value is not, or does not have, is
// the programmer's fault and throws. One thread at a time.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace burin {

class Json {
public:
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;

    Json() noexcept;  // null
    Json(std::nullptr_t) noexcept;
    Json(const char* text);
    Json(std::string text);
    Json(std::string_view text);
    template <typename Number>
        requires std::is_arithmetic_v<Number>
    Json(Number value) : Json(Plain(value)) {}
    Json(std::initializer_list<Json> list);
    template <typename Value>
    Json(const std::vector<Value>& list) : Json(Array(list.begin(), list.end())) {}
    template <typename Value, std::size_t kCount>
    Json(const std::array<Value, kCount>& list) : Json(Array(list.begin(), list.end())) {}
    Json(Array list);
    Json(const Json& other);
    Json(Json&& other) noexcept;
    Json& operator=(const Json& other);
    Json& operator=(Json&& other) noexcept;
    ~Json();

    [[nodiscard]] static Json array(std::initializer_list<Json> list = {});
    [[nodiscard]] static Json object();  // without items

    [[nodiscard]] bool is_null() const;
    [[nodiscard]] bool is_string() const;
    [[nodiscard]] bool is_number() const;
    [[nodiscard]] bool is_number_float() const;

    template <typename Value>
    [[nodiscard]] Value get() const {
        if constexpr (std::same_as<Value, std::string>) return text();
        if constexpr (std::same_as<Value, bool>) return truth();
        if constexpr (std::floating_point<Value>) return static_cast<Value>(number());
        if constexpr (std::integral<Value> && !std::same_as<Value, bool>) return static_cast<Value>(integer());
    }
    // Of an object, or the other where it has no such key.
    [[nodiscard]] bool value(std::string_view key, bool otherwise) const;
    [[nodiscard]] std::string value(std::string_view key, const char* otherwise) const;

    // Of arrays and objects; of null 0.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] bool empty() const { return size() == 0; }

    [[nodiscard]] bool contains(std::string_view key) const;
    [[nodiscard]] Json& operator[](std::string_view key);  // made where it is missing
    [[nodiscard]] const Json& operator[](std::string_view key) const;
    // "/mesh/triangles"; null pointer: there is none.
    [[nodiscard]] const Json* find(std::string_view path) const;
    [[nodiscard]] const Object& items() const;
    void update(const Json& other);  // takes over all of an object's items

    [[nodiscard]] const Json& operator[](std::size_t index) const;
    [[nodiscard]] Json& back();
    void push_back(Json value);
    [[nodiscard]] Array::const_iterator begin() const;
    [[nodiscard]] Array::const_iterator end() const;

    // Numbers compare by value.
    friend bool operator==(const Json& a, const Json& b);

    // On one line, or with so many blanks for each level. Numbers are as long as it takes to read the same one back; what JSON
    // has no number for (NaN, infinity) is null.
    [[nodiscard]] std::string dump(int indent = -1) const;

private:
    struct Writer;
    struct Plain {
        template <typename Number>
        explicit Plain(Number number) {
            if constexpr (std::same_as<Number, bool>)
                value = number;
            else if constexpr (std::floating_point<Number>)
                value = static_cast<double>(number);
            else if constexpr (std::signed_integral<Number>)
                value = std::int64_t{number};
            else
                value = std::uint64_t{number};
        }
        std::variant<bool, std::int64_t, std::uint64_t, double> value;
    };
    explicit Json(const Plain& plain);
    [[nodiscard]] const std::string& text() const;
    [[nodiscard]] bool truth() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] std::int64_t integer() const;

    std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object> value_;
};

}  // namespace burin
