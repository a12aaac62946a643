// SPDX-License-Identifier: MIT
#include "tests/house/house_rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {

namespace {

std::string line_number_of(const std::string& text, std::size_t at) {
    return std::to_string(1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string slashed(const std::string& name) { return "/" + name + "/"; }

bool continues_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

constexpr std::array kFileEndings{".cpp", ".hpp",   ".h",   ".glsl", ".comp", ".vert", ".frag",
                                  ".md",  ".cmake", ".txt", ".toml", ".csv",  ".json", ".svg"};

std::string without_punctuation(const std::string& word) {
    const std::string around = ".,;()[]\"'";
    const std::size_t first = word.find_first_not_of("([\"'"), last = word.find_last_not_of(around);
    return first == std::string::npos || last == std::string::npos || last < first
               ? ""
               : word.substr(first, last + 1 - first);
}

bool is_path_of_the_tree(const std::string& word, std::span<const std::string> top_folders) {
    const std::size_t slash = word.find('/');
    if (slash == std::string::npos || slash == 0 || word.find_first_of("*=:<>${}\\|") != std::string::npos)
        return false;
    const std::string top = word.substr(0, slash);
    if (top == "build" || top == "out" || top.starts_with('-')) return false;
    return std::ranges::find(top_folders, top) != top_folders.end() ||
           std::ranges::any_of(kFileEndings, [&](const char* ending) { return word.ends_with(ending); });
}

// Where the links of a line lead to, without the places within a document.
std::vector<std::string> links_in(const std::string& line) {
    std::vector<std::string> targets;
    for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
        const std::size_t end = line.find_first_of(")#", at);
        const std::string target = line.substr(at + 2, end == std::string::npos ? end : end - at - 2);
        if (!target.empty() && !target.contains("://")) targets.push_back(target);
    }
    return targets;
}

// Reads a document line by line, and remembers whether it is within a block or a span of code.
class CodeReader {
public:
    // What of the line is code, with blanks between the spans.
    std::string code_of(const std::string& line) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos) in_span_ = false;  // a span ends with its paragraph
        if (first != std::string::npos && line.compare(first, 3, "```") == 0) {
            in_block_ = !in_block_;
            return "";
        }
        if (in_block_) return line;
        std::string code;
        for (const char c : line) {
            if (c == '`') in_span_ = !in_span_;
            code += in_span_ && c != '`' ? c : ' ';
        }
        return code;
    }
    [[nodiscard]] bool in_block() const { return in_block_; }

private:
    bool in_block_ = false, in_span_ = false;
};

}  // namespace

std::string complaint_on_paths(const std::string& text) {
    // Put together here, so that this file does not complain about itself.
    static const std::vector<std::string> kPlaces = {slashed("home"), slashed("root"), slashed("Users"),
                                                     slashed("work"), std::string("C:") + "\\Users"};
    for (const std::string& place : kPlaces) {
        for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + 1)) {
            const bool inside_relative_path = at > 0 && continues_a_word(text[at - 1]);  // e.g. assets/home/
            const char after = at + place.size() < text.size() ? text[at + place.size()] : ' ';
            if (!inside_relative_path && (continues_a_word(after) || after == '\\')) {
                return "line " + line_number_of(text, at) + " names a machine's own path (" + place + "...)";
            }
        }
    }
    return "";
}

std::string complaint_on_licence(const std::string& text) {
    std::istringstream lines(text);
    std::string first, second;
    std::getline(lines, first);
    std::getline(lines, second);
    const std::string wanted = "SPDX-License-Identifier: MIT";
    const bool in_second = (first.starts_with("#version") || first.starts_with("#!")) && second.contains(wanted);
    return first.contains(wanted) || in_second ? "" : "the first line does not say '// " + wanted + "'";
}

std::string complaint_on_length(const std::string& text) {
    const auto lines = std::count(text.begin(), text.end(), '\n');
    return lines <= kMostLines
               ? ""
               : "has " + std::to_string(lines) + " lines; split it (at most " + std::to_string(kMostLines) + ")";
}

std::vector<int> lines_too_long(const std::string& text) {
    const auto begins_a_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; };
    std::vector<int> numbers;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (std::ranges::count_if(line, begins_a_character) > kMostColumns) numbers.push_back(number);
    }
    return numbers;
}

std::vector<NamedPath> paths_named_in(const std::string& document, const std::string& folder,
                                      std::span<const std::string> top_folders) {
    std::vector<NamedPath> paths;
    CodeReader reader;
    std::istringstream lines(document);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(reader.code_of(line));
        for (std::string word; words >> word;) {
            const std::string path = without_punctuation(word);
            if (is_path_of_the_tree(path, top_folders)) paths.push_back({path, number});
        }
        if (reader.in_block()) continue;
        for (const std::string& target : links_in(line)) {
            paths.push_back({(std::filesystem::path(folder) / target).lexically_normal().generic_string(), number});
        }
    }
    return paths;
}

std::string complaint_on_guard(const std::string& text) {
    const std::string code = without_comments(text);
    const std::size_t first = code.find_first_not_of(" \n");
    return first != std::string::npos && code.compare(first, 12, "#pragma once") == 0
               ? ""
               : "does not begin with #pragma once";
}

std::string complaint_on_first_include(const std::string& text, const std::string& own_header) {
    const std::vector<Include> includes = includes_of(text);
    return !includes.empty() && includes.front().name == own_header ? "" : "does not include " + own_header + " first";
}

std::string complaint_on_whitespace(const std::string& text) {
    if (!text.empty() && text.back() != '\n') return "does not end with a newline";
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::string where = "line " + std::to_string(number);
        if (line.contains('\t')) return where + " has a tab";
        if (line.ends_with('\r')) return where + " ends with a carriage return";
        if (line.ends_with(' ')) return where + " ends with a blank";
        if (line.starts_with("<<<<<<< ") || line.starts_with(">>>>>>> ")) return where + " is a merge marker";
    }
    return "";
}

Findings long_lines(const std::filesystem::path& root) {
    Findings found;
    for (const std::string& path : repository_files(root)) {
        if (!is_source(path)) continue;
        ++found.looked_at;
        for (const int line : lines_too_long(read_text(root / path)))
            found.places.push_back(path + ":" + std::to_string(line));
    }
    return found;
}

namespace {

std::vector<std::string> top_folders_of(std::span<const std::string> files) {
    std::set<std::string> tops;
    for (const std::string& path : files)
        if (path.contains('/')) tops.insert(path.substr(0, path.find('/')));
    return {tops.begin(), tops.end()};
}

}  // namespace

Findings missing_document_paths(const std::filesystem::path& root) {
    const std::vector<std::string> files = repository_files(root);
    const std::vector<std::string> top_folders = top_folders_of(files);
    Findings found;
    for (const std::string& path : files) {
        if (!path.ends_with(".md")) continue;
        const std::string folder = std::filesystem::path(path).parent_path().generic_string();
        for (const NamedPath& named : paths_named_in(read_text(root / path), folder, top_folders)) {
            ++found.looked_at;
            if (!std::filesystem::exists(root / named.path))
                found.places.push_back(path + ":" + std::to_string(named.line) + ": names " + named.path);
        }
    }
    return found;
}

Findings missing_comment_paths(const std::filesystem::path& root) {
    const std::vector<std::string> files = repository_files(root);
    const std::vector<std::string> top_folders = top_folders_of(files);
    Findings found;
    for (const std::string& path : files) {
        if (!is_source(path) || path.starts_with("tests/house/")) continue;
        std::istringstream lines(read_text(root / path));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::size_t comment = line.find("//");
            if (comment == std::string::npos) continue;
            std::istringstream words(line.substr(comment));
            for (std::string word; words >> word;) {
                const std::string named = without_punctuation(word);
                if (!is_path_of_the_tree(named, top_folders) || !std::filesystem::path(named).has_extension()) continue;
                ++found.looked_at;
                if (!std::filesystem::exists(root / named))
                    found.places.push_back(path + ":" + std::to_string(number) + ": names " + named);
            }
        }
    }
    return found;
}

}  // namespace burin::house
