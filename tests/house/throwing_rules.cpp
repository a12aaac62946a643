// SPDX-License-Identifier: MIT
#include "tests/house/throwing_rules.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "tests/house/source_words.hpp"

namespace burin::house {
namespace {

constexpr std::array<std::string_view, 40> kOfPaths{"absolute",
                                                    "canonical",
                                                    "copy",
                                                    "copy_file",
                                                    "copy_symlink",
                                                    "create_directories",
                                                    "create_directory",
                                                    "create_hard_link",
                                                    "create_symlink",
                                                    "current_path",
                                                    "directory_iterator",
                                                    "equivalent",
                                                    "exists",
                                                    "file_size",
                                                    "hard_link_count",
                                                    "is_block_file",
                                                    "is_character_file",
                                                    "is_directory",
                                                    "is_empty",
                                                    "is_fifo",
                                                    "is_other",
                                                    "is_regular_file",
                                                    "is_socket",
                                                    "is_symlink",
                                                    "last_write_time",
                                                    "permissions",
                                                    "proximate",
                                                    "read_symlink",
                                                    "relative",
                                                    "remove",
                                                    "remove_all",
                                                    "rename",
                                                    "resize_file",
                                                    "space",
                                                    "status",
                                                    "symlink_status",
                                                    "directory_entry",
                                                    "recursive_directory_iterator",
                                                    "weakly_canonical",
                                                    "temp_directory_path"};
constexpr std::array<std::string_view, 6> kOfEntries{"is_regular_file", "is_directory",    "is_symlink",
                                                     "file_size",       "last_write_time", "hard_link_count"};

using Words = std::vector<SourceWord>;

const std::string& text_at(const Words& words, std::size_t at) {
    static const std::string none;
    return at < words.size() ? words[at].text : none;
}

// The names that are declared behind std::error_code.
std::set<std::string> error_codes(const Words& words) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i].text != "error_code") continue;
        for (++i; is_identifier(text_at(words, i)) || text_at(words, i) == "," || text_at(words, i) == "&"; ++i)
            if (is_identifier(words[i].text)) names.insert(words[i].text);
    }
    return names;
}

// Whether the call whose arguments open at this word hands over an error code at last, or asks about a status.
bool has_an_error_code(const Words& words, std::size_t open, const std::set<std::string>& codes) {
    int depth = 1;
    std::size_t last = open;  // the word before the last argument
    std::size_t at = open + 1;
    for (; at < words.size(); ++at) {
        const std::string& word = words[at].text;
        if (word == "(" || word == "{" || word == "[") ++depth;
        if ((word == ")" || word == "}" || word == "]") && --depth == 0) break;
        if (word == "," && depth == 1) last = at;
        if (word == "status" || word == "symlink_status") return true;  // complained about itself
    }
    return at == last + 2 && codes.contains(words[last + 1].text);
}

template <std::size_t N>
bool is_one_of(const std::array<std::string_view, N>& names, const std::string& word) {
    return std::ranges::find(names, word) != names.end();
}

// Whether a call begins here that would throw.
bool throws_at(const Words& words, std::size_t at, const std::set<std::string>& codes) {
    if (at < 2) return false;
    const std::string &before = words[at - 1].text, &space = words[at - 2].text, &name = words[at].text;
    if ((before == "." || before == "->") && is_one_of(kOfEntries, name))
        return text_at(words, at + 1) == "(" && text_at(words, at + 2) == ")";
    if (before != "::" || (space != "filesystem" && space != "fs") || !is_one_of(kOfPaths, name)) return false;
    const std::size_t open = is_identifier(text_at(words, at + 1)) ? at + 2 : at + 1;
    if (text_at(words, open) != "(" && text_at(words, open) != "{") return false;
    const bool is_qualified = at >= 4 && words[at - 3].text == "::";
    const std::size_t first = is_qualified ? at - 4 : at - 2;
    const bool is_looped_over = name.ends_with("directory_iterator") && first > 0 && words[first - 1].text == ":";
    return is_looped_over || !has_an_error_code(words, open, codes);
}

}  // namespace

std::vector<std::string> throwing_calls(const std::string& source) {
    const Words words = words_of_source(source);
    const std::set<std::string> codes = error_codes(words);
    std::vector<std::string> found;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (throws_at(words, i, codes))
            found.push_back("line " + std::to_string(words[i].line) + ": " + words[i].text + "() throws");
    return found;
}

}  // namespace burin::house
