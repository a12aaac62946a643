// SPDX-License-Identifier: MIT
#include "session/input/input_words.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace burin::session {
namespace {

// More than any event has, so that a line of a million blanks does not make a million words.
constexpr std::size_t kMostWords = 64;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Returns the character that a sequence after a backslash stands for; takes it off the text.
std::optional<char> unescaped(std::string_view& rest) {
    if (rest.empty()) return std::nullopt;
    const char c = rest.front();
    rest.remove_prefix(1);
    switch (c) {
        case '"':
        case '\\': return c;
        case 'n': return '\n';
        case 't': return '\t';
        case 'r': return '\r';
        case 'x': {
            unsigned char value = 0;
            if (rest.size() < 2) return std::nullopt;
            const auto [end, error] = std::from_chars(rest.data(), rest.data() + 2, value, 16);
            if (error != std::errc{} || end != rest.data() + 2) return std::nullopt;
            rest.remove_prefix(2);
            return static_cast<char>(value);
        }
        default: return std::nullopt;
    }
}

Result<std::string> take_quoted(std::string_view& rest, const std::string& where) {
    rest.remove_prefix(1);
    std::string word;
    while (!rest.empty() && rest.front() != '"') {
        char c = rest.front();
        rest.remove_prefix(1);
        if (c == '\\') {
            const auto meant = unescaped(rest);
            if (!meant)
                return fail(where, "a backslash is followed by what means nothing",
                            "write \\\" \\\\ \\n \\t \\r or \\xHH");
            c = *meant;
        }
        word += c;
    }
    if (rest.empty()) return fail(where, "a quotation mark is missing", "close the quoted text with \"");
    rest.remove_prefix(1);
    if (!rest.empty() && !is_blank(rest.front()) && rest.front() != '#')
        return fail(where, "a quoted text is followed by more without a blank", "put a blank behind the closing \"");
    return word;
}

Result<std::string> take_bare(std::string_view& rest, const std::string& where) {
    std::size_t length = 0;
    while (length < rest.size() && !is_blank(rest[length])) ++length;
    std::string word(rest.substr(0, length));
    rest.remove_prefix(length);
    const auto odd = [](char c) { return c == '"' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (std::ranges::any_of(word, odd))
        return fail(where, "a word holds a quotation mark or a control character",
                    "put the whole word in quotes and write \\\" or \\xHH for it");
    return word;
}

}  // namespace

std::string quoted(std::string_view text) {
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string word = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            word += '\\';
            word += c;
        } else if (code < 0x20 || code == 0x7f) {
            word += "\\x";
            word += kHex[code >> 4];
            word += kHex[code & 15];
        } else {
            word += c;
        }
    }
    return word + '"';
}

std::string as_word(std::string_view text) {
    const auto plain = [](char c) { return c > ' ' && c < 0x7f && c != '"' && c != '#' && c != '\\'; };
    return !text.empty() && std::ranges::all_of(text, plain) ? std::string(text) : quoted(text);
}

Result<std::vector<std::string>> words_of(std::string_view line, const std::string& where) {
    std::vector<std::string> words;
    while (true) {
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        if (line.empty() || line.front() == '#') return words;
        if (words.size() == kMostWords)
            return fail(where, "the line has more than " + std::to_string(kMostWords) + " words", "split it");
        Result<std::string> word = line.front() == '"' ? take_quoted(line, where) : take_bare(line, where);
        if (!word) return std::unexpected(word.error());
        words.push_back(std::move(*word));
    }
}

}  // namespace burin::session
