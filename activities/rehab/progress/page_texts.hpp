// SPDX-License-Identifier: MIT
// Texts of a participant's page in one language, of a file in assets/languages. All languages have the same keys, and
// in each text the same words in braces; English says what they are.
//
//   PageTexts::in("de") -> text("peak_force"), filled("level", {{"level", "2"}}), number(2.5, 2) -> "2,50"
// Failure: an Error with each key that is missing, unknown or has other words in braces than English. Any thread.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace burin::activities {

class PageTexts {
public:
    static constexpr const char* kUsual = "en";

    // Reads the file of a language, CODE.toml; a code that there is not fails with those that there are.
    [[nodiscard]] static Result<PageTexts> in(const std::string& code);
    // Reads a file, and checks it against one that is known to be whole; null: against nothing.
    [[nodiscard]] static Result<PageTexts> read(const std::filesystem::path& file, const PageTexts* model);
    // Returns the codes that there are, sorted.
    [[nodiscard]] static std::vector<std::string> codes();
    [[nodiscard]] static std::string listed();  // "de, en, fr"

    [[nodiscard]] const std::string& code() const { return code_; }
    [[nodiscard]] bool has(std::string_view key) const { return texts_.contains(key); }
    // Requires a key that English has: a literal of the code that asks.
    [[nodiscard]] const std::string& text(std::string_view key) const;
    // Returns the text of what a file names, such as an exercise; the name itself where there is none.
    [[nodiscard]] std::string named(std::string_view name) const;
    // Returns a text with the words in braces filled in.
    using Words = std::vector<std::pair<std::string_view, std::string>>;
    [[nodiscard]] std::string filled(std::string_view key, const Words& words) const;
    // Returns a number with so many decimals, in the language's form; a dash of what is no number.
    [[nodiscard]] std::string number(double value, int decimals) const;
    // Returns a date of the form 2026-11-03 in the language's form.
    [[nodiscard]] std::string date(const std::string& iso) const;

private:
    std::string code_;
    std::map<std::string, std::string, std::less<>> texts_;
};

}  // namespace burin::activities
