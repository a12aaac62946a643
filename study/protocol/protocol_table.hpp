// SPDX-License-Identifier: MIT
// Reads a TOML table key by key, keeps every fault with its place, and finds keys that nobody asked for. A value with a
// fault leaves the default, so that reading goes on. One thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/toml.hpp"
#include "study/protocol/protocol.hpp"

namespace burin::study {

class ProtocolTable {
public:
    // The table may be missing (null): then every key is absent. Faults of absent keys stand at `place`.
    ProtocolTable(std::vector<ProtocolFault>& faults, const toml::table* table, std::string name,
                  toml::source_position place = {1, 1});

    [[nodiscard]] bool has(const char* key) const;
    void require(const char* key, const std::string& remedy);
    // The value stays as it is where the key is absent. Both ends of a range belong to it.
    void number(const char* key, double& to, double least, double most, const char* unit);
    void count(const char* key, unsigned& to, unsigned least, unsigned most);
    void flag(const char* key, bool& to);
    void text(const char* key, std::string& to);  // printable, at most kLongestText bytes
    void code(const char* key, std::string& to);  // letters, digits, hyphen, underscore; at most 32
    void codes(const char* key, std::vector<std::string>& to);
    void counts(const char* key, std::vector<unsigned>& to, unsigned least, unsigned most);
    void points(const char* key, std::vector<Vec3>& to);
    [[nodiscard]] const toml::table* table(const char* key);
    [[nodiscard]] std::vector<const toml::table*> tables(const char* key);
    // At the key's value, or at the table where the key is absent.
    void refuse(const char* key, const std::string& what, const std::string& remedy);
    // After all keys have been read.
    void refuse_unknown();

private:
    const toml::node* node(const char* key);
    void at(const toml::source_position& place, std::string what, std::string remedy);
    [[nodiscard]] bool is_code(const toml::node& node, const char* key);

    std::vector<ProtocolFault>& faults_;
    const toml::table* table_;
    std::string name_;
    toml::source_position place_;
    std::vector<std::string_view> asked_;
};

}  // namespace burin::study
