// SPDX-License-Identifier: MIT
#include "tests/house/layer_rules.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/house/source_tree.hpp"

namespace burin::house {
namespace fs = std::filesystem;

namespace {

bool starts_with_folder(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

// The ruled folder that holds a path relative to the root: the longest name that fits; empty when none does.
std::string folder_of(const std::string& path, const LayerRules& rules) {
    std::string best;
    for (const auto& [folder, allowed] : rules.may_include) {
        if (starts_with_folder(path, folder) && folder.size() > best.size()) best = folder;
    }
    return best;
}

bool is_generated_shader(const std::string& name) {
    return starts_with_folder(name, "shaders") && name.ends_with(".spv.hpp");
}

// A header of the tree that an #include means, relative to the root; empty for a header from outside.
std::string resolve(const fs::path& root, const std::string& including_file, const Include& include) {
    if (include.quoted) {
        const fs::path beside = (fs::path(including_file).parent_path() / include.name).lexically_normal();
        if (fs::is_regular_file(root / beside)) return beside.generic_string();
    }
    const fs::path from_root = fs::path(include.name).lexically_normal();
    return fs::is_regular_file(root / from_root) ? from_root.generic_string() : std::string();
}

std::string complaint_about(const Include& include, const std::string& folder, const std::string& target,
                            const LayerRules& rules) {
    const auto& allowed = rules.may_include.at(folder);
    const auto may = [&](const std::string& name) { return std::ranges::find(allowed, name) != allowed.end(); };
    if (is_generated_shader(include.name)) {
        return may("gpu") ? "" : folder + " may not include compiled shaders (" + include.name + ")";
    }
    std::string other =
        folder_of(target.empty() ? fs::path(include.name).lexically_normal().generic_string() : target, rules);
    if (other.empty() && !target.empty()) other = fs::path(target).parent_path().generic_string();
    if (other.empty()) {
        return include.quoted
                   ? folder + " includes \"" + include.name + "\", which is in no folder; use <> for libraries"
                   : "";
    }
    return other == folder || may(other) ? "" : folder + " may not include " + other + " (" + include.name + ")";
}

bool is_forbidden(const std::string& name, const std::string& prefix) {
    return name == prefix || name.starts_with(prefix + "/") || name.starts_with(prefix + ".");
}

class Checker {
public:
    Checker(fs::path root, const LayerRules& rules) : root_(std::move(root)), rules_(rules) {}

    std::vector<std::string> violations() {
        for (const std::string& file : source_files(root_)) {
            const std::string folder = folder_of(file, rules_);
            if (folder.empty()) continue;
            check_folders(file, folder);
            check_forbidden(file, folder);
        }
        std::ranges::sort(found_);
        return found_;
    }

private:
    void check_folders(const std::string& file, const std::string& folder) {
        for (const Include& include : includes(file)) {
            const std::string complaint = complaint_about(include, folder, resolve(root_, file, include), rules_);
            if (!complaint.empty()) report(file, include.line, complaint);
        }
    }

    // Follows the headers of the tree, so that a forbidden header cannot come in through another folder's.
    void check_forbidden(const std::string& file, const std::string& folder) {
        const auto rule = rules_.forbidden.find(folder);
        if (rule == rules_.forbidden.end()) return;
        std::set<std::string> seen{file};
        std::vector<std::string> waiting{file};
        while (!waiting.empty()) {
            const std::string current = waiting.back();
            waiting.pop_back();
            for (const Include& include : includes(current)) {
                for (const std::string& prefix : rule->second) {
                    if (!is_forbidden(include.name, prefix)) continue;
                    const std::string through = current == file ? "" : ", through " + current;
                    report(file, current == file ? include.line : 0,
                           folder + " must not see <" + include.name + ">" + through);
                }
                const std::string next = resolve(root_, current, include);
                if (!next.empty() && seen.insert(next).second) waiting.push_back(next);
            }
        }
    }

    const std::vector<Include>& includes(const std::string& file) {
        const auto known = includes_.find(file);
        if (known != includes_.end()) return known->second;
        return includes_[file] = includes_of(read_text(root_ / file));
    }

    void report(const std::string& file, int line, const std::string& complaint) {
        found_.push_back(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + complaint);
    }

    fs::path root_;
    const LayerRules& rules_;
    std::map<std::string, std::vector<Include>> includes_;
    std::vector<std::string> found_;
};

}  // namespace

Result<LayerRules> parse_layer_rules(const std::string& text) {
    LayerRules rules;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string kind, name;
        if (!(words >> kind)) continue;
        words >> name;
        if ((kind != "folder" && kind != "forbid") || !name.ends_with(':')) {
            return fail("layer rules:" + std::to_string(number), "cannot read '" + line + "'",
                        "write 'folder NAME: folder...' or 'forbid NAME: prefix...'");
        }
        name.pop_back();
        auto& list = (kind == "folder" ? rules.may_include : rules.forbidden)[name];
        for (std::string word; words >> word;) list.push_back(word);
    }
    return rules;
}

std::vector<Include> includes_of(const std::string& source) {
    std::vector<Include> includes;
    std::istringstream lines(without_comments(source));
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::size_t at = line.find_first_not_of(" \t");
        if (at == std::string::npos || line[at] != '#') continue;
        at = line.find_first_not_of(" \t", at + 1);
        if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
        const std::size_t open = line.find_first_of("\"<", at);
        if (open == std::string::npos) continue;
        const std::size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
        if (close == std::string::npos) continue;
        includes.push_back({line.substr(open + 1, close - open - 1), number, line[open] == '"'});
    }
    return includes;
}

std::vector<std::string> layer_violations(const fs::path& root, const LayerRules& rules) {
    return Checker(root, rules).violations();
}

std::size_t ruled_files(const fs::path& root, const LayerRules& rules) {
    const auto files = source_files(root);
    return static_cast<std::size_t>(
        std::ranges::count_if(files, [&](const std::string& file) { return !folder_of(file, rules).empty(); }));
}

}  // namespace burin::house
