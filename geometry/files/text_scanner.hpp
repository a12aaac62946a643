// SPDX-License-Identifier: MIT
// Reads text token by token or line by line and counts lines. Returns views into the text; allocates nothing. Lines end
// with LF, CR LF or CR. Blank means space, tab, vertical tab, form feed. Numbers are read independently of the locale.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace burin::geometry {

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
[[nodiscard]] constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }
[[nodiscard]] constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Compares without regard to the case of ASCII letters; `b` must be in lower case.
[[nodiscard]] constexpr bool equals_ignoring_case(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (lower(a[i]) != b[i]) return false;
    }
    return true;
}

class TextScanner {
public:
    explicit TextScanner(std::string_view text) : text_(text) {}

    [[nodiscard]] std::uint64_t line() const { return line_; }
    [[nodiscard]] std::size_t position() const { return at_; }
    [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

    // Returns the next token in this line; empty at the line's end, or at a comment when `comment` is its first
    // character.
    std::string_view token_in_line(char comment = '\0') {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
        if (comment != '\0' && at_ < text_.size() && text_[at_] == comment) skip_to_line_end();
        const std::size_t start = at_;
        while (at_ < text_.size() && !is_blank(text_[at_]) && !is_line_end(text_[at_])) ++at_;
        return text_.substr(start, at_ - start);
    }

    // Returns the next token in this line or a later one; empty only at the end of the text.
    std::string_view token(char comment = '\0') {
        for (;;) {
            const std::string_view found = token_in_line(comment);
            if (!found.empty() || at_end()) return found;
            next_line();
        }
    }

    // Returns the rest of this line without leading and trailing blanks.
    std::string_view rest_of_line() {
        const std::size_t start = at_;
        skip_to_line_end();
        std::string_view rest = text_.substr(start, at_ - start);
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
        return rest;
    }

    void next_line() {
        skip_to_line_end();
        if (at_ >= text_.size()) return;
        const bool pair = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
        at_ += pair ? 2 : 1;
        ++line_;
    }

private:
    void skip_to_line_end() {
        while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1;
};

// Converts a whole token to a number; nothing when it is not one. "nan" and "inf" are numbers here; a value too large
// for a double is infinite, one too small is 0: the caller judges.
[[nodiscard]] std::optional<double> number_from(std::string_view token);

template <typename Integer>
[[nodiscard]] std::optional<Integer> integer_from(std::string_view token) {
    if (token.starts_with('+')) token.remove_prefix(1);
    Integer value{};
    const char* const end = token.data() + token.size();
    const auto [stop, code] = std::from_chars(token.data(), end, value);
    if (code != std::errc{} || stop != end) return std::nullopt;
    return value;
}

// Quotes a token of a broken file for a message: short and printable.
[[nodiscard]] std::string in_quotes(std::string_view token);

}  // namespace burin::geometry
