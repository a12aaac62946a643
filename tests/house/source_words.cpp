// SPDX-License-Identifier: MIT
#include "tests/house/source_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace burin::house {
namespace {

bool begins_identifier(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool goes_on_identifier(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class WordReader {
public:
    explicit WordReader(const std::string& source) : source_(source) {}

    std::vector<SourceWord> read() {
        while (at_ < source_.size()) step();
        return std::move(words_);
    }

private:
    void step() {
        const char here = source_[at_];
        if (here == '\n') return end_line();
        if (std::isspace(static_cast<unsigned char>(here)) != 0) return skip(1);
        if (source_.compare(at_, 2, "//") == 0) return skip_to("\n", 0);
        if (source_.compare(at_, 2, "/*") == 0) return skip_to("*/", 2);
        if (here == '#' && line_is_empty_) return begin_directive();
        line_is_empty_ = false;
        if (here == '"' || here == '\'') return skip_literal(here);
        if (begins_identifier(here)) return read_identifier();
        if (std::isdigit(static_cast<unsigned char>(here)) != 0) return skip_number();
        const bool is_double = source_.compare(at_, 2, "::") == 0 || source_.compare(at_, 2, "->") == 0;
        add(source_.substr(at_, is_double ? 2 : 1));
    }

    void end_line() {
        if (at_ == 0 || source_[at_ - 1] != '\\') directive_ = false;
        line_is_empty_ = true;
        skip(1);
    }

    void begin_directive() {
        directive_ = true;
        line_is_empty_ = false;
        const std::size_t word = source_.find_first_not_of(" \t", at_ + 1);
        if (word != std::string::npos && source_.compare(word, 7, "include") == 0) return skip_to("\n", 0);
        skip(1);
    }

    void read_identifier() {
        std::size_t end = at_;
        while (end < source_.size() && goes_on_identifier(source_[end])) ++end;
        const std::string_view word = std::string_view(source_).substr(at_, end - at_);
        const bool is_raw = end < source_.size() && source_[end] == '"' && word.ends_with('R');
        if (!is_raw) return add(std::string(word));
        const std::size_t open = source_.find('(', end);
        if (open == std::string::npos) return skip(source_.size() - at_);
        skip_to(")" + source_.substr(end + 1, open - end - 1) + "\"", open - end);
    }

    void skip_literal(char quote) {
        std::size_t end = at_ + 1;
        while (end < source_.size() && source_[end] != quote && source_[end] != '\n')
            end += source_[end] == '\\' ? 2 : 1;
        skip(std::min(end + 1, source_.size()) - at_);
    }

    // Digits with their separators, suffix and exponent: 1'000u, 0x1fu, 1.5e3.
    void skip_number() {
        std::size_t end = at_;
        while (end < source_.size() &&
               (goes_on_identifier(source_[end]) || source_[end] == '.' || source_[end] == '\''))
            ++end;
        skip(end - at_);
    }

    void skip_to(const std::string& mark, std::size_t beyond) {
        const std::size_t found = source_.find(mark, at_ + beyond);
        const std::size_t end = found == std::string::npos ? source_.size() : found;
        skip(std::min(end + (mark == "\n" ? 0 : mark.size()), source_.size()) - at_);
    }

    void skip(std::size_t count) {
        line_ += static_cast<int>(std::count(source_.begin() + static_cast<std::ptrdiff_t>(at_),
                                             source_.begin() + static_cast<std::ptrdiff_t>(at_ + count), '\n'));
        at_ += count;
    }

    void add(std::string text) {
        const std::size_t length = text.size();
        words_.push_back({std::move(text), line_, directive_});
        skip(length);
    }

    const std::string& source_;
    std::size_t at_ = 0;
    int line_ = 1;
    bool directive_ = false, line_is_empty_ = true;
    std::vector<SourceWord> words_;
};

// Words of the language that a parenthesis may follow.
constexpr std::array<std::string_view, 19> kNoFunctions{"if",       "for",      "while",    "switch",   "return",
                                                        "sizeof",   "alignas",  "decltype", "noexcept", "static_assert",
                                                        "requires", "explicit", "operator", "void",     "double",
                                                        "float",    "int",      "bool",     "auto"};

// Reads the words outside all blocks but those of namespaces.
class DeclarationReader {
public:
    explicit DeclarationReader(const std::vector<SourceWord>& words) : words_(words) {}

    std::vector<std::string> read() {
        for (std::size_t i = 0; i < words_.size(); ++i)
            if (words_[i].directive)
                see_directive(i);
            else
                see(i);
        return std::move(names_);
    }

private:
    void see(std::size_t i) {
        const std::string& word = words_[i].text;
        if (word == "{") {
            const bool is_namespace = saw_namespace_;
            if (!is_namespace) ++depth_;
            blocks_.push_back(is_namespace);
        } else if (word == "}" && !blocks_.empty()) {
            if (!blocks_.back()) --depth_;
            blocks_.pop_back();
        } else if (depth_ == 0) {
            see_outside(i);
        }
        if (word == "{" || word == "}" || word == ";") saw_namespace_ = false;
        if (word == "namespace") saw_namespace_ = true;
    }

    // "#define BURIN_CHECK(...)"; what only guards or configures a text has no parenthesis.
    void see_directive(std::size_t i) {
        if (i > 0 && words_[i - 1].directive && words_[i - 1].text == "define" && at(i + 1) == "(")
            names_.push_back(words_[i].text);
    }

    void see_outside(std::size_t i) {
        const std::string &word = words_[i].text, &next = at(i + 1);
        if (!is_identifier(word)) return;
        const std::string& before = i > 0 ? words_[i - 1].text : none_;
        const bool is_type = (before == "struct" || before == "class" || before == "enum" || before == "union") &&
                             (next == "{" || next == ":" || next == "final");
        const bool is_named = before == "concept" || (before == "using" && next == "=");
        const bool is_function =
            next == "(" && !word.starts_with("__") && std::ranges::find(kNoFunctions, word) == kNoFunctions.end();
        const bool is_constant = word.size() > 1 && word[0] == 'k' && (next == "=" || next == "{" || next == "[");
        if (is_type || is_named || is_function || is_constant) names_.push_back(word);
    }

    [[nodiscard]] const std::string& at(std::size_t i) const { return i < words_.size() ? words_[i].text : none_; }

    const std::vector<SourceWord>& words_;
    const std::string none_{};
    std::vector<std::string> names_;
    std::vector<bool> blocks_;  // whether each open block is a namespace
    int depth_ = 0;             // open blocks that are none
    bool saw_namespace_ = false;
};

}  // namespace

bool is_identifier(const std::string& word) { return !word.empty() && begins_identifier(word[0]); }

std::vector<SourceWord> words_of_source(const std::string& source) { return WordReader(source).read(); }

std::vector<std::string> declared_names(const std::vector<SourceWord>& words) {
    return DeclarationReader(words).read();
}

}  // namespace burin::house
