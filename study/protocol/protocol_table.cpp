// SPDX-License-Identifier: MIT
#include "study/protocol/protocol_table.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kLongestText = 2000, kLongestCode = 32, kMostEntries = 2000;
constexpr double kLargestCoordinate_m = 10.0;

bool code_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

}  // namespace

ProtocolTable::ProtocolTable(std::vector<ProtocolFault>& faults, const toml::table* table, std::string name,
                             toml::source_position place)
    : faults_(faults), table_(table), name_(std::move(name)), place_(place) {
    if (table_ != nullptr && table_->source().begin.line > 0) place_ = table_->source().begin;
}

bool ProtocolTable::has(const char* key) const { return table_ != nullptr && table_->contains(key); }

const toml::node* ProtocolTable::node(const char* key) {
    asked_.emplace_back(key);
    return table_ == nullptr ? nullptr : table_->get(key);
}

void ProtocolTable::at(const toml::source_position& place, std::string what, std::string remedy) {
    faults_.push_back({std::max<std::size_t>(1, place.line), std::max<std::size_t>(1, place.column), std::move(what),
                       std::move(remedy)});
}

void ProtocolTable::refuse(const char* key, const std::string& what, const std::string& remedy) {
    const toml::node* n = table_ == nullptr ? nullptr : table_->get(key);
    at(n == nullptr ? place_ : n->source().begin, name_ + ": " + key + " " + what, remedy);
}

void ProtocolTable::require(const char* key, const std::string& remedy) {
    if (!has(key)) at(place_, name_ + " has no " + key, remedy);
}

void ProtocolTable::number(const char* key, double& to, double least, double most, const char* unit) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    const auto value = n->is_number() ? n->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) return refuse(key, "is not a number", "write " + std::string(key) + " = 1.5");
    if (*value < least || *value > most)
        return refuse(key, formatted("is %g %s", *value, unit), formatted("write %g to %g %s", least, most, unit));
    to = *value;
}

void ProtocolTable::count(const char* key, unsigned& to, unsigned least, unsigned most) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    const auto value = n->is_integer() ? n->value<std::int64_t>() : std::nullopt;
    if (!value || *value < least || *value > most)
        return refuse(key, "is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                      "write one");
    to = static_cast<unsigned>(*value);
}

void ProtocolTable::flag(const char* key, bool& to) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    if (!n->is_boolean()) return refuse(key, "is neither true nor false", "write true or false");
    to = *n->value<bool>();
}

void ProtocolTable::text(const char* key, std::string& to) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    if (!n->is_string()) return refuse(key, "is not a text", "write it in quotes");
    std::string value = *n->value<std::string>();
    if (value.size() > kLongestText)
        return refuse(key, formatted("is longer than %zu bytes", kLongestText), "shorten it");
    to = std::move(value);
}

bool ProtocolTable::is_code(const toml::node& n, const char* key) {
    const std::string value = n.is_string() ? *n.value<std::string>() : std::string();
    if (!value.empty() && value.size() <= kLongestCode && std::ranges::all_of(value, code_letter)) return true;
    at(n.source().begin, name_ + ": " + key + " is not a code",
       "write at most 32 letters, digits, hyphens and underscores in quotes; no names, no mail addresses");
    return false;
}

void ProtocolTable::code(const char* key, std::string& to) {
    const toml::node* n = node(key);
    if (n != nullptr && is_code(*n, key)) to = *n->value<std::string>();
}

void ProtocolTable::codes(const char* key, std::vector<std::string>& to) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    const toml::array* array = n->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostEntries)
        return refuse(key, "is not a list of codes", "write " + std::string(key) + " = [\"a\", \"b\"]");
    for (const toml::node& element : *array) {
        if (is_code(element, key)) to.push_back(*element.value<std::string>());
    }
}

void ProtocolTable::counts(const char* key, std::vector<unsigned>& to, unsigned least, unsigned most) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    const toml::array* array = n->as_array();
    if (array == nullptr || array->empty() || array->size() > kMostEntries)
        return refuse(key, "is not a list of whole numbers", "write " + std::string(key) + " = [4, 6]");
    for (const toml::node& element : *array) {
        const auto value = element.is_integer() ? element.value<std::int64_t>() : std::nullopt;
        if (value && *value >= least && *value <= most) {
            to.push_back(static_cast<unsigned>(*value));
        } else {
            at(element.source().begin, name_ + ": " + key + " holds no whole number here",
               "write " + std::to_string(least) + " to " + std::to_string(most));
        }
    }
}

void ProtocolTable::points(const char* key, std::vector<Vec3>& to) {
    const toml::node* n = node(key);
    if (n == nullptr) return;
    const toml::array* array = n->as_array();
    if (array == nullptr || array->size() < 2 || array->size() > kMostEntries)
        return refuse(key, "is not a list of 2 to 2000 points", "write " + std::string(key) + " = [[0, 0, 0], ...]");
    for (const toml::node& row : *array) {
        std::vector<double> values;
        if (const toml::array* inner = row.as_array(); inner != nullptr && inner->size() == 3) {
            for (const toml::node& element : *inner) {
                const auto value = element.is_number() ? element.value<double>() : std::nullopt;
                if (value && std::abs(*value) <= kLargestCoordinate_m) values.push_back(*value);
            }
        }
        if (values.size() == 3) {
            to.emplace_back(values[0], values[1], values[2]);
        } else {
            at(row.source().begin, name_ + ": " + key + " holds no point here",
               formatted("write [x, y, z] in metres, each within %g", kLargestCoordinate_m));
        }
    }
}

const toml::table* ProtocolTable::table(const char* key) {
    const toml::node* n = node(key);
    if (n != nullptr && !n->is_table()) refuse(key, "is not a table", "write [" + std::string(key) + "]");
    return n == nullptr ? nullptr : n->as_table();
}

std::vector<const toml::table*> ProtocolTable::tables(const char* key) {
    std::vector<const toml::table*> found;
    const toml::node* n = node(key);
    if (n == nullptr) return found;
    const toml::array* array = n->as_array();
    if (array == nullptr || array->size() > kMostEntries || !array->is_homogeneous<toml::table>()) {
        refuse(key, "is not a list of tables", "write [[" + std::string(key) + "]] above each");
        return found;
    }
    for (const toml::node& element : *array) found.push_back(element.as_table());
    return found;
}

void ProtocolTable::refuse_unknown() {
    if (table_ == nullptr) return;
    for (const auto& [key, value] : *table_) {
        const std::string name(key.str());
        if (std::ranges::find(asked_, name) != asked_.end()) continue;
        const std::string nearest(asked_.empty() ? std::string_view() : nearest_name(name, asked_));
        at(key.source().begin, name_ + " has no key named " + name.substr(0, 64),
           edit_distance(name.substr(0, 64), nearest) <= 2 + name.size() / 3 ? "did you mean " + nearest + "?"
                                                                             : "its keys are " + joined(asked_));
    }
}

}  // namespace burin::study
