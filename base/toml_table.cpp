// SPDX-License-Identifier: MIT
#include "base/toml_table.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace burin {

Result<toml::table> parse_toml(std::string_view text, const std::string& name) {
    try {
        return toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        return fail(name + ":" + std::to_string(error.source().begin.line),
                    "is not TOML: " + std::string(error.description()), "correct this line");
    }
}

void TableReading::add(Error error) {
    if (errors.size() < kMaxErrors) errors.push_back(std::move(error));
}

Result<void> TableReading::outcome() const {
    if (errors.empty()) return {};
    if (errors.size() == 1) return std::unexpected(errors.front());
    std::string lines = std::to_string(errors.size()) + " problems:";
    for (const Error& error : errors) lines += "\n  " + error.line();
    return fail(file, lines);
}

void TableReading::refuse(const toml::node& node, std::string what, std::string remedy) {
    add({std::move(what), file + ":" + std::to_string(node.source().begin.line), std::move(remedy)});
}

TableReader::TableReader(TableReading& reading, const toml::table* table, std::string name)
    : reading_(reading), table_(table), name_(std::move(name)) {}

bool TableReader::has(const char* key) const { return find(key) != nullptr; }

const toml::node* TableReader::find(const char* key) const { return table_ == nullptr ? nullptr : table_->get(key); }

const toml::node* TableReader::node(const char* key) {
    asked_.emplace_back(key);
    return find(key);
}

std::optional<double> TableReader::number(const char* key, const char* remedy) {
    const toml::node* n = node(key);
    if (n == nullptr) return std::nullopt;
    const auto value = n->value<double>();
    if (!n->is_number() || !value || !std::isfinite(*value)) {
        reading_.refuse(*n, std::string(key) + " is not a number",
                        *remedy != 0 ? remedy : "write " + std::string(key) + " = 0.5, say");
        return std::nullopt;
    }
    return value;
}

std::optional<bool> TableReader::flag(const char* key) {
    const toml::node* n = node(key);
    if (n == nullptr) return std::nullopt;
    if (!n->is_boolean()) reading_.refuse(*n, std::string(key) + " is neither true nor false", "write true or false");
    return n->is_boolean() ? n->value<bool>() : std::nullopt;
}

std::optional<std::string> TableReader::text(const char* key) {
    const toml::node* n = node(key);
    if (n == nullptr) return std::nullopt;
    if (!n->is_string()) reading_.refuse(*n, std::string(key) + " is not a text", "write it in quotes");
    return n->is_string() ? n->value<std::string>() : std::nullopt;
}

std::optional<std::string> TableReader::text_or_index(const char* key) {
    if (table_ != nullptr && table_->get(key) != nullptr && table_->get(key)->is_integer()) {
        const auto index = node(key)->value<std::int64_t>();
        if (*index < 0) refuse(key, "is below 0", "count from 0, or give a name in quotes");
        return std::to_string(*index);
    }
    return text(key);
}

std::optional<std::vector<std::string>> TableReader::texts(const char* key) {
    const toml::node* n = node(key);
    if (n == nullptr) return std::nullopt;
    std::vector<std::string> values;
    const toml::array* const array = n->as_array();
    if (array != nullptr)
        for (const toml::node& element : *array)
            if (element.is_string()) values.push_back(*element.value<std::string>());
    if (array != nullptr && values.size() == array->size()) return values;
    reading_.refuse(*n, std::string(key) + " is not a list of texts",
                    "write " + std::string(key) + " = [ ... ] with each in quotes");
    return std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers_of(const toml::node& n, const char* key, std::size_t count) {
    std::vector<double> values;
    if (const toml::array* array = n.as_array(); array != nullptr && array->size() == count) {
        for (const toml::node& element : *array) {
            const auto value = element.is_number() ? element.value<double>() : std::nullopt;
            if (value && std::isfinite(*value)) values.push_back(*value);
        }
    }
    if (values.size() == count) return values;
    reading_.refuse(n, std::string(key) + " is not a list of " + std::to_string(count) + " numbers",
                    "write " + std::string(key) + " = [ ... ] with " + std::to_string(count) + " numbers");
    return std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers(const char* key, std::size_t count) {
    const toml::node* n = node(key);
    return n == nullptr ? std::nullopt : numbers_of(*n, key, count);
}

std::optional<Vec3> TableReader::vector(const char* key) {
    const auto v = numbers(key, 3);
    return v ? std::optional(Vec3{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}

std::optional<Quat> TableReader::quaternion(const char* key) {
    const auto v = numbers(key, 4);
    if (!v) return std::nullopt;
    const Quat q((*v)[3], (*v)[0], (*v)[1], (*v)[2]);
    const double length = glm::length(q);
    if (!(length > 1e-9) || !std::isfinite(length)) {
        refuse(key, "has no length", "write [0, 0, 0, 1] (x, y, z, w) for no rotation");
        return std::nullopt;
    }
    // A quaternion that is of unit length up to its printed digits is not normalised, so that writing and reading a
    // file changes nothing.
    return std::abs(length - 1.0) < 1e-12 ? q : q / length;
}

std::optional<std::vector<std::vector<double>>> TableReader::rows(const char* key, std::size_t count) {
    const toml::node* n = node(key);
    if (n == nullptr) return std::nullopt;
    const toml::array* array = n->as_array();
    if (array == nullptr || array->size() != count) {
        reading_.refuse(*n, std::string(key) + " is not a list of " + std::to_string(count) + " rows",
                        "write " + std::string(key) + " = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
        return std::nullopt;
    }
    std::vector<std::vector<double>> made;
    for (const toml::node& row : *array) {
        auto values = numbers_of(row, key, count);
        if (!values) return std::nullopt;
        made.push_back(std::move(*values));
    }
    return made;
}

const toml::table* TableReader::table(const char* key) {
    const toml::node* n = node(key);
    if (n == nullptr) return nullptr;
    if (!n->is_table()) reading_.refuse(*n, std::string(key) + " is not a table", "write [" + std::string(key) + "]");
    return n->as_table();
}

std::vector<const toml::table*> TableReader::tables(const char* key) {
    std::vector<const toml::table*> found;
    const toml::node* n = node(key);
    if (n == nullptr) return found;
    if (const toml::array* array = n->as_array()) {
        for (const toml::node& element : *array) {
            if (element.is_table()) found.push_back(element.as_table());
        }
    }
    if (found.empty() || found.size() != n->as_array()->size()) {
        reading_.refuse(*n, std::string(key) + " is not a list of tables", "write [[" + std::string(key) + "]]");
        found.clear();
    }
    return found;
}

void TableReader::refuse(const char* key, const std::string& what, const std::string& remedy) {
    const toml::node* n = find(key);
    if (n != nullptr) reading_.refuse(*n, std::string(key) + " " + what, remedy);
}

void TableReader::require(const char* key, const std::string& remedy) {
    if (has(key)) return;
    const std::string what = name_ + " has no " + key;
    if (table_ != nullptr) {
        reading_.refuse(*table_, what, remedy);
    } else {
        reading_.add({what, reading_.file, remedy});
    }
}

void TableReader::refuse_unknown() {
    if (table_ == nullptr) return;
    for (const auto& [key, node] : *table_) {
        const std::string name(key.str());
        if (std::ranges::find(asked_, name) != asked_.end()) continue;
        const std::string nearest(asked_.empty() ? std::string_view() : nearest_name(name, asked_));
        reading_.add({name_ + " has no key named " + name,
                      reading_.file + ":" + std::to_string(key.source().begin.line),
                      edit_distance(name, nearest) <= 2 + name.size() / 3 ? "did you mean " + nearest + "?"
                                                                          : "its keys are " + joined(asked_)});
    }
}

}  // namespace burin
