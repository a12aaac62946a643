// SPDX-License-Identifier: MIT
#include "tests/house/structure_rules.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "tests/house/layer_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace fs = std::filesystem;

namespace {

std::vector<std::string> judged_sources(const fs::path& root) {
    std::vector<std::string> files = source_files(root);
    std::erase_if(files, [](const std::string& file) {
        return file.starts_with("tests/") ||
               !(file.ends_with(".cpp") || file.ends_with(".hpp") || file.ends_with(".h"));
    });
    return files;
}

// ---- Rooms

// By room, the rooms that it includes, each with one example.
using Rooms = std::map<std::string, std::map<std::string, std::string>>;

Rooms rooms_of(const fs::path& root) {
    Rooms rooms;
    for (const std::string& file : judged_sources(root)) {
        const std::string room = fs::path(file).parent_path().generic_string();
        for (const Include& include : includes_of(read_text(root / file))) {
            if (!include.quoted || !fs::is_regular_file(root / include.name)) continue;
            const std::string other = fs::path(include.name).parent_path().generic_string();
            if (other != room) rooms[room].emplace(other, file + " includes " + include.name);
        }
    }
    return rooms;
}

std::set<std::string> reachable(const Rooms& rooms, const std::string& from) {
    std::set<std::string> seen;
    std::vector<std::string> waiting{from};
    while (!waiting.empty()) {
        const auto at = rooms.find(waiting.back());
        waiting.pop_back();
        if (at == rooms.end()) continue;
        for (const auto& [next, example] : at->second)
            if (seen.insert(next).second) waiting.push_back(next);
    }
    return seen;
}

// ---- Names

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Words and single other characters of a text without comments, literals and preprocessor lines.
std::vector<std::string> tokens_of(const std::string& source) {
    const std::string text = without_comments(source);
    std::vector<std::string> tokens;
    bool line_is_empty = true;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '\n') line_is_empty = true;
        if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            ++i;
        } else if (c == '#' && line_is_empty) {
            while (i < text.size() && (text[i] != '\n' || text[i - 1] == '\\')) ++i;
        } else if (c == '"' || (c == '\'' && !(i > 0 && is_word(text[i - 1])))) {  // not the separator of 1'000
            for (++i; i < text.size() && text[i] != c && text[i] != '\n'; ++i)
                if (text[i] == '\\') ++i;
            ++i;
            line_is_empty = false;
        } else if (is_word(c)) {
            const std::size_t first = i;
            while (i < text.size() && is_word(text[i])) ++i;
            tokens.push_back(text.substr(first, i - first));
            line_is_empty = false;
        } else {
            tokens.emplace_back(1, c);
            ++i;
            line_is_empty = false;
        }
    }
    return tokens;
}

bool is_name(const std::string& token) {
    return !token.empty() && (std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_');
}

// Walks over the braces of a text and keeps what each of them opened.
class TypeFinder {
public:
    explicit TypeFinder(std::vector<std::string> tokens) : tokens_(std::move(tokens)) {}

    std::vector<std::string> find() {
        for (at_ = 0; at_ < tokens_.size(); ++at_) step();
        return found_;
    }

private:
    // An empty name: what is inside cannot be seen from other sources.
    struct Scope {
        std::string name;
    };

    void step() {
        const std::string& token = tokens_[at_];
        if (token == "{") {
            scopes_.push_back({std::exchange(opening_, "")});
        } else if (token == "}") {
            if (!scopes_.empty()) scopes_.pop_back();
        } else if (token == ";" || token == "(" || token == "=") {
            opening_.clear();
        } else if (token == "namespace") {
            opening_ = words_until_brace();
        } else if (token == "enum" || token == "struct" || token == "class" || token == "union") {
            define();
        }
    }

    // "a::b" of "namespace a::b {"; empty for an anonymous one.
    std::string words_until_brace() {
        std::string words;
        while (at_ + 1 < tokens_.size() && tokens_[at_ + 1] != "{" && tokens_[at_ + 1] != ";") words += tokens_[++at_];
        return words;
    }

    void define() {
        if (at_ > 0 && (tokens_[at_ - 1] == "<" || tokens_[at_ - 1] == ",")) return;  // a template's parameter
        std::size_t name = at_ + 1;
        if (name < tokens_.size() && (tokens_[name] == "class" || tokens_[name] == "struct")) ++name;
        while (name + 1 < tokens_.size() && tokens_[name] == "[") {  // an attribute
            while (name < tokens_.size() && tokens_[name] != "]") ++name;
            while (name < tokens_.size() && tokens_[name] == "]") ++name;
        }
        if (name + 1 >= tokens_.size() || !is_name(tokens_[name])) return;
        const std::string& after = tokens_[name + 1];
        if (after != "{" && after != ":" && after != "final") return;  // a declaration, a variable, a specialization
        if (after == ":" && name + 2 < tokens_.size() && tokens_[name + 2] == ":")
            return;  // Outer::Inner, defined elsewhere
        const bool seen = std::ranges::none_of(scopes_, [](const Scope& scope) { return scope.name.empty(); });
        if (seen && !scopes_.empty()) found_.push_back(prefix() + tokens_[name]);
        opening_ = tokens_[name];
        // Base classes and the underlying type hold no brace.
        while (at_ + 1 < tokens_.size() && tokens_[at_ + 1] != "{" && tokens_[at_ + 1] != ";") ++at_;
    }

    std::string prefix() const {
        std::string all;
        for (const Scope& scope : scopes_) all += scope.name + "::";
        return all;
    }

    std::vector<std::string> tokens_;
    std::size_t at_ = 0;
    std::vector<Scope> scopes_;
    std::string opening_;  // what the next brace opens, if it has a name
    std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> room_cycles(const fs::path& root) {
    const Rooms rooms = rooms_of(root);
    std::vector<std::string> found;
    std::set<std::string> reported;
    for (const auto& [room, others] : rooms) {
        if (reported.contains(room)) continue;
        std::set<std::string> circle;
        for (const std::string& other : reachable(rooms, room))
            if (reachable(rooms, other).contains(room)) circle.insert(other);
        if (circle.empty()) continue;
        std::string line;
        for (const std::string& from : circle) {
            reported.insert(from);
            for (const auto& [to, example] : rooms.at(from))
                if (circle.contains(to)) line += (line.empty() ? "" : ", ") + from + " -> " + to + " (" + example + ")";
        }
        found.push_back(line);
    }
    return found;
}

std::vector<std::string> types_defined_in(const std::string& source) { return TypeFinder(tokens_of(source)).find(); }

std::vector<std::string> types_defined_twice(const fs::path& root) {
    std::map<std::string, std::string> first_file;
    std::vector<std::string> found;
    for (const std::string& file : judged_sources(root)) {
        for (const std::string& type : types_defined_in(read_text(root / file))) {
            const auto [known, fresh] = first_file.emplace(type, file);
            if (!fresh && known->second != file)
                found.push_back(type + " is defined in " + known->second + " and in " + file);
        }
    }
    return found;
}

}  // namespace burin::house
