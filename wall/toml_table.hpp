// SPDX-License-Identifier: MIT
// Reads the values of a TOML table key by key, and then knows which keys nobody asked for. Errors are kept, the first one
// wins, so that reading code is a list of keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/toml.hpp"
#include "base/error.hpp"
#include "base/space.hpp"

namespace burin {

// What is shared by all tables of a file.
struct TableReading {
    std::string file;
    std::optional<Error> error;

    void refuse(const toml::node& node, std::string what, std::string remedy);
};

class TableReader {
public:
    // The table may be missing (null): then nothing is found in it. `name` as in the file, for messages.
    TableReader(TableReading& reading, const toml::table* table, std::string name);

    [[nodiscard]] bool has(const char* key) const;
    [[nodiscard]] std::optional<double> number(const char* key);
    [[nodiscard]] std::optional<bool> flag(const char* key);
    [[nodiscard]] std::optional<std::string> text(const char* key);
    [[nodiscard]] std::optional<std::string> text_or_index(const char* key);
    [[nodiscard]] std::optional<std::vector<double>> numbers(const char* key, std::size_t count);
    [[nodiscard]] std::optional<Vec3> vector(const char* key);
    [[nodiscard]] std::optional<Quat> quaternion(const char* key);  // x, y, z, w; normalised
    [[nodiscard]] std::optional<std::vector<std::vector<double>>> rows(const char* key, std::size_t count);
    [[nodiscard]] const toml::table* table(const char* key);
    [[nodiscard]] std::vector<const toml::table*> tables(const char* key);

    void refuse(const char* key, const std::string& what, const std::string& remedy);
    void require(const char* key, const std::string& remedy);
    // After all keys were asked for: complains of the first other one.
    void refuse_unknown();

private:
    const toml::node* node(const char* key);
    std::optional<std::vector<double>> numbers_of(const toml::node& node, const char* key, std::size_t count);

    TableReading& reading_;
    const toml::table* table_;
    std::string name_;
    std::vector<std::string> asked_;
};

}  // namespace burin
