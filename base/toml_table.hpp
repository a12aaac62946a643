// SPDX-License-Identifier: MIT
// Reads the values of a TOML table key by key and reports keys that were never requested. Errors are collected, so that
// reading code is a plain list of keys, and a file's mistakes are listed together. Any thread; nothing shared.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "base/toml.hpp"

namespace burin {

// Parses a text. `name` stands for the file in messages.
[[nodiscard]] Result<toml::table> parse_toml(std::string_view text, const std::string& name);

// State shared by all tables of a file.
struct TableReading {
    static constexpr std::size_t kMaxErrors = 200;  // further ones are dropped

    std::string file;
    std::vector<Error> errors{};  // in the order in which they were found

    void add(Error error);
    // Returns all errors as one, if there is any; further ones stand on lines of their own.
    [[nodiscard]] Result<void> outcome() const;
    void refuse(const toml::node& node, std::string what, std::string remedy);
};

class TableReader {
public:
    // The table may be missing (null): then every key is absent. `name` as in the file, for messages.
    TableReader(TableReading& reading, const toml::table* table, std::string name);

    [[nodiscard]] bool has(const char* key) const;
    // Returns the value as it stands in the file; null where there is none.
    [[nodiscard]] const toml::node* find(const char* key) const;
    // remedy: of what is no number; empty: a number as an example.
    [[nodiscard]] std::optional<double> number(const char* key, const char* remedy = "");
    [[nodiscard]] std::optional<bool> flag(const char* key);
    [[nodiscard]] std::optional<std::string> text(const char* key);
    [[nodiscard]] std::optional<std::string> text_or_index(const char* key);
    [[nodiscard]] std::optional<std::vector<std::string>> texts(const char* key);  // a list of any length
    [[nodiscard]] std::optional<std::vector<double>> numbers(const char* key, std::size_t count);
    [[nodiscard]] std::optional<Vec3> vector(const char* key);
    [[nodiscard]] std::optional<Quat> quaternion(const char* key);  // x, y, z, w; normalised
    [[nodiscard]] std::optional<std::vector<std::vector<double>>> rows(const char* key, std::size_t count);
    [[nodiscard]] const toml::table* table(const char* key);
    [[nodiscard]] std::vector<const toml::table*> tables(const char* key);

    void refuse(const char* key, const std::string& what, const std::string& remedy);
    void require(const char* key, const std::string& remedy);
    // After all keys have been read: reports each other key as an error.
    void refuse_unknown();

private:
    const toml::node* node(const char* key);
    std::optional<std::vector<double>> numbers_of(const toml::node& node, const char* key, std::size_t count);

    TableReading& reading_;
    const toml::table* table_;
    std::string name_;
    std::vector<std::string_view> asked_;  // keys that were requested: literals of the reading code
};

}  // namespace burin
