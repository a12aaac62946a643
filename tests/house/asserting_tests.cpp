// SPDX-License-Identifier: MIT
#include "tests/house/asserting_tests.hpp"

#include <cctype>
#include <regex>

#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Blanks what stands in literals, so that a brace or a macro's name in one counts for nothing.
std::string without_literals(std::string text) {
    static const std::regex kRaw(R"RAW(R"(\w*)\([^]*?\)\1")RAW");
    text = std::regex_replace(text, kRaw, "\"\"");
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool separates_digits = text[i] == '\'' && i > 0 && is_of_word(text[i - 1]);
        if ((text[i] != '"' && text[i] != '\'') || separates_digits) continue;
        const char quote = text[i];
        for (++i; i < text.size() && text[i] != quote && text[i] != '\n'; ++i) {
            if (text[i] == '\\' && i + 1 < text.size()) text[i++] = ' ';
            text[i] = ' ';
        }
    }
    return text;
}

// Returns the place behind the bracket that closes the one here; the end where none does.
std::size_t behind(const std::string& text, std::size_t at, char opens, char closes) {
    int depth = 0;
    for (; at < text.size(); ++at) {
        depth += text[at] == opens ? 1 : text[at] == closes ? -1 : 0;
        if (depth == 0) return at + 1;
    }
    return text.size();
}

// Words and signs that may stand between a function's parameters and its body.
std::size_t behind_qualifiers(const std::string& text, std::size_t at) {
    static const std::regex kQualifiers(R"(^(\s|const\b|noexcept\b|override\b|final\b|mutable\b|->[^{;()]*)*)");
    std::smatch found;
    const std::string rest = text.substr(at, 400);
    return std::regex_search(rest, found, kQualifiers) ? at + static_cast<std::size_t>(found.length()) : at;
}

// "Suite.Case" of a test's parameters; empty where they are none.
std::string case_in(const std::string& parameters) {
    static const std::regex kCase(R"(^\(\s*(\w+)\s*,\s*(\w+))");
    std::smatch found;
    return std::regex_search(parameters, found, kCase) ? found[1].str() + "." + found[2].str() : std::string();
}

bool makes_tests(const std::string& macro) {
    static const std::set<std::string> kMacros{"TEST", "TEST_F", "TEST_P", "RC_GTEST_PROP", "RC_GTEST_FIXTURE_PROP"};
    return kMacros.contains(macro);
}

}  // namespace

std::map<std::string, std::string> bodies_in(const std::string& source) {
    const std::string text = without_literals(without_comments(source));
    static const std::regex kCall(R"((\w+)\s*\()");
    static const std::set<std::string> kNoFunctions{"if", "for", "while", "switch", "catch", "return", "sizeof"};
    std::map<std::string, std::string> bodies;
    for (std::sregex_iterator at(text.begin(), text.end(), kCall), end; at != end; ++at) {
        const std::string name = (*at)[1].str();
        if (kNoFunctions.contains(name)) continue;
        const std::size_t opens = static_cast<std::size_t>(at->position() + at->length()) - 1;
        const std::size_t closed = behind(text, opens, '(', ')'), begins = behind_qualifiers(text, closed);
        if (begins >= text.size() || text[begins] != '{') continue;
        const std::string of = makes_tests(name) ? case_in(text.substr(opens, closed - opens)) : name;
        bodies[of] += text.substr(begins, behind(text, begins, '{', '}') - begins);
    }
    return bodies;
}

std::set<std::string> expecting(const std::map<std::string, std::string>& bodies) {
    static const std::regex kMacro(
        R"(\b(EXPECT|ASSERT|RC_ASSERT|RC_FAIL|RC_SUCCEED_IF)\w*\s*\(|\b(ADD_FAILURE|FAIL)\b)");
    static const std::regex kCalled(R"((\w+)\s*(?:<[^;{}()]*>)?\s*\()");
    std::set<std::string> found;
    std::map<std::string, std::set<std::string>> calls;
    for (const auto& [name, body] : bodies) {
        if (std::regex_search(body, kMacro)) found.insert(name);
        for (std::sregex_iterator at(body.begin(), body.end(), kCalled), end; at != end; ++at)
            calls[name].insert((*at)[1].str());
    }
    for (bool grows = true; grows;) {
        grows = false;
        for (const auto& [name, called] : calls)
            for (const std::string& other : called)
                if (found.contains(other) && found.insert(name).second) grows = true;
    }
    return found;
}

Findings tests_without_expectation(const std::filesystem::path& root) {
    std::map<std::string, std::string> bodies, files;
    for (const std::string& path : repository_files(root)) {
        if (!path.starts_with("tests/") || !(path.ends_with(".cpp") || path.ends_with(".hpp"))) continue;
        for (const auto& [name, body] : bodies_in(read_text(root / path))) {
            bodies[name] += body;
            if (name.contains('.')) files[name] = path;
        }
    }
    const std::set<std::string> can_fail = expecting(bodies);
    Findings found;
    for (const auto& [name, path] : files) {
        ++found.looked_at;
        if (!can_fail.contains(name)) found.places.push_back(path + ": " + name);
    }
    return found;
}

}  // namespace burin::house
