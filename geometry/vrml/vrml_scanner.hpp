// SPDX-License-Identifier: MIT
// The words of a VRML text (ISO/IEC 14772-1:1997, A.3). Returns views into the text; allocates nothing; cheap to copy,
// so that a reader looks ahead by going on with a copy. Blank: control characters, the blank, the comma, and comments
// from # to the line's end. A word is everything up to a blank, a quote or one of []{}, so that names which the
// standard forbids, as some programs write them, are read too.
#pragma once

#include <cstdint>
#include <string_view>

namespace burin::geometry {

enum class VrmlToken : std::uint8_t {
    end,
    word,
    string,       // the text without its quotes
    open_string,  // a string without a closing quote, up to the text's end
    open_brace,
    close_brace,
    open_bracket,
    close_bracket,
};

struct VrmlLexeme {
    VrmlToken token = VrmlToken::end;
    std::uint32_t at = 0;   // byte of the text; of a string, its quote
    std::string_view text;  // of a word or string

    [[nodiscard]] bool is(std::string_view word) const { return token == VrmlToken::word && text == word; }
    // Tells whether the word is a number or was meant to be one: no name begins with a digit, a sign or a point.
    [[nodiscard]] bool numeric() const {
        if (token != VrmlToken::word) return false;
        const char c = text.front();
        return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    }
};

class VrmlScanner {
public:
    // The text must be shorter than 4 GiB.
    explicit VrmlScanner(std::string_view text, std::uint32_t at = 0) : text_(text), at_(at) {}

    VrmlLexeme take() {
        skip_blanks();
        VrmlLexeme found{.token = VrmlToken::end, .at = at_, .text = {}};
        if (at_ >= text_.size()) return found;
        switch (text_[at_]) {
            case '{': return brace(found, VrmlToken::open_brace);
            case '}': return brace(found, VrmlToken::close_brace);
            case '[': return brace(found, VrmlToken::open_bracket);
            case ']': return brace(found, VrmlToken::close_bracket);
            case '"': return string(found);
            default: break;
        }
        while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
        found.token = VrmlToken::word;
        found.text = text_.substr(found.at, at_ - found.at);
        return found;
    }

    [[nodiscard]] VrmlLexeme peek() const { return VrmlScanner(*this).take(); }

    // Returns the token behind the next one.
    [[nodiscard]] VrmlLexeme peek_second() const {
        VrmlScanner ahead(*this);
        static_cast<void>(ahead.take());
        return ahead.take();
    }

private:
    [[nodiscard]] static bool is_vrml_blank(char c) { return static_cast<unsigned char>(c) <= ' ' || c == ','; }
    [[nodiscard]] static bool ends_word(char c) {
        return is_vrml_blank(c) || c == '#' || c == '"' || c == '[' || c == ']' || c == '{' || c == '}';
    }

    void skip_blanks() {
        while (at_ < text_.size()) {
            if (text_[at_] == '#') {
                while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
            } else if (is_vrml_blank(text_[at_])) {
                ++at_;
            } else {
                return;
            }
        }
    }

    VrmlLexeme brace(VrmlLexeme found, VrmlToken token) {
        ++at_;
        found.token = token;
        return found;
    }

    VrmlLexeme string(VrmlLexeme found) {
        const std::uint32_t first = ++at_;
        while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' && at_ + 1 < text_.size() ? 2 : 1;
        found.text = text_.substr(first, at_ - first);
        found.token = at_ < text_.size() ? VrmlToken::string : VrmlToken::open_string;
        if (at_ < text_.size()) ++at_;
        return found;
    }

    std::string_view text_;
    std::uint32_t at_ = 0;
};

}  // namespace burin::geometry
